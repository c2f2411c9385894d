#include "tests/stability/ensemble/classes.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace splashdown::ensemble {

void Member::write_to(const std::filesystem::path& folder) const {
  std::ofstream(folder / "scene.toml") << scene;
  for (const auto& file : files)
    std::filesystem::create_symlink(std::filesystem::path(SPLASHDOWN_SOURCE) / file, folder / file.filename());
  for (const TextFile& each : texts) std::ofstream(folder / each.name) << each.text;
}

const std::vector<Class>& classes() {
  static const std::vector<Class> all{
      {"round_drops", "circles, ellipses and capsules dropped on still water, in the plane", round_drop},
      {"round_drops_3d", "spheres and capsules dropped on still water, in space", round_drop_in_space},
      {"light_solids", "boxes, cones, capsules and revolved bodies down to no mass, in space", light_solid},
      {"light_hulls", "hulls from files, with corners and hollows, in space: free, hinged, in piles", light_hull},
      {"light_polygons", "convex polygons and boxes down to a millionth of water's density, free, hinged, in piles",
       light_polygon},
      {"drops_and_jets", "drops and jets into pools, at each other and on walls, without bodies", drop_or_jet},
      {"still_tanks", "water at rest", still_tank},
      {"slots", "gaps below the element size, squeezed bodies, drops of a few nodes, enclosed liquid", slot},
      {"uav_attitudes", "the aircraft of the example at eight attitudes", uav_attitude},
      {"effect_mixes", "three to six effects at a time: the sea, air, lines, drag, beach, symmetry, stages",
       effect_mix},
  };
  return all;
}

Member generate(const std::string& name, std::uint64_t seed) {
  std::string known;
  for (const Class& each : classes()) {
    if (each.name == name) {
      Member member = each.member(seed);
      member.kind = name;
      member.seed = seed;
      return member;
    }
    known += " " + each.name;
  }
  throw std::runtime_error(fmt::format("there is no class '{}'; there are:{}", name, known));
}

}  // namespace splashdown::ensemble
