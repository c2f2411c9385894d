#include "apps/check/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/build/build.hpp"
#include "apps/check/words.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

// Of a first mesh: who waits longer wants to know before.
constexpr double seconds_to_wait = 10;

/// Elements of the two walls as small as a gap needs.
Scene with_elements(Scene scene, const fluid::Gap& gap, double size) {
  for (const std::size_t wall : {gap.first, gap.second}) {
    double& of_wall = wall < scene.bodies.size() ? scene.bodies[wall].size : scene.tank->size;
    of_wall = std::min(of_wall, size);
  }
  return scene;
}

std::string size_key(const Scene& scene, std::size_t wall) {
  return wall < scene.bodies.size() ? "body." + scene.bodies[wall].name + ".size" : "tank.size";
}

/// What smaller elements would do and cost; nothing where the width is not known.
template <int d>
std::string remedy(const Scene& scene, const fluid::Gap& gap) {
  if (!(gap.width > 0)) return "";
  const double size = gap.width / fluid::filled_gap;
  const auto cost = predicted_cost<d>(with_elements(scene, gap, size));
  return fmt::format(" With {} and {} = {:.2g} m it is filled: {}{} nodes, {} to begin with, on one core.",
                     size_key(scene, gap.first), size_key(scene, gap.second), size,
                     cost.at_least ? "more than " : "about ", rough(cost.nodes), with_unit(cost.seconds_to_start, "s"));
}

std::string wall_name(const Scene& scene, std::size_t wall) {
  return wall < scene.bodies.size() ? "body." + scene.bodies[wall].name : "the tank";
}

template <int d>
[[noreturn]] void refuse_doubtful(const Scene& scene, const fluid::Gap& gap, const Cost& cost) {
  throw std::invalid_argument(fmt::format(
      "the gap between {} and {} at ({:.4g}, {:.4g}, {:.4g}) m is {:.3g} m wide, {:.2g} of an element of {:.3g} m; a "
      "mesh is sure to fill gaps of {:g} and more.{} Or move the two apart, let them touch, or add --large: then the "
      "mesh is tried, which takes {} and may fail",
      wall_name(scene, gap.first), wall_name(scene, gap.second), gap.at.x(), gap.at.y(), gap.at.z(), gap.width,
      gap.width / gap.size, gap.size, fluid::filled_gap, remedy<d>(scene, gap), with_unit(cost.seconds_to_start, "s")));
}

}  // namespace

template <int d>
void tell_gaps(const Scene& scene, const std::optional<fluid::Gap>& doubtful, const std::function<void()>& make) {
  try {
    make();
  } catch (const fluid::GapRefused& refused) {
    fluid::Gap gap = refused.gap;
    if (!(gap.width > 0) && doubtful) gap = *doubtful;
    throw std::invalid_argument(fmt::format("{}.{}", refused.what(), remedy<d>(scene, gap)));
  }
}

template <int d>
std::optional<fluid::Gap> check_start(const Scene& scene, const Cost& cost, Doubt doubt) {
  bodies_of<d>(scene);
  if (!scene.fluid) return {};
  const auto spec = fluid_spec<d>(scene);
  std::vector<fluid::Wall<d>> walls;
  std::vector<fluid::WallPlace<d>> places;
  for (const auto& wall : spec.walls) walls.emplace_back(wall), places.push_back(walls.back().place());
  std::optional<fluid::Gap> gap;
  tell_gaps<d>(scene, {}, [&] { gap = fluid::look_at_start<d>(spec, {walls, places}); });
  if (!gap || doubt == Doubt::accept) return gap;
  if (cost.seconds_to_start > seconds_to_wait) refuse_doubtful<d>(scene, *gap, cost);
  if (doubt == Doubt::mesh) tell_gaps<d>(scene, gap, [&] { fluid::fill<d>(spec, {walls, places}); });
  return gap;
}

template std::optional<fluid::Gap> check_start<2>(const Scene&, const Cost&, Doubt);
template std::optional<fluid::Gap> check_start<3>(const Scene&, const Cost&, Doubt);
template void tell_gaps<2>(const Scene&, const std::optional<fluid::Gap>&, const std::function<void()>&);
template void tell_gaps<3>(const Scene&, const std::optional<fluid::Gap>&, const std::function<void()>&);

}  // namespace splashdown::apps
