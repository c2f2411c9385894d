// What is told of elastic bodies before a run.
#include <fmt/format.h>

#include <numbers>

#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"
#include "elastic/modes/modes.hpp"

namespace splashdown::apps {
namespace {

/// Mass with its centre, and what elements of parts share.
template <int d>
std::string mass_of(const Body& body, const ElasticTable& table, const elastic::Solid<d>& solid) {
  const Vec<d> centre = shape_pose<d>(body).inverse() * solid.centre(elastic::Field::Zero(solid.size()));
  auto text = fmt::format(", mass {:.4g} {} with centre {} m of its shape", solid.total_mass(), d == 2 ? "kg/m" : "kg",
                          apps::text<d>(centre, 4));
  for (std::size_t p = 0; p < table.parts.size(); ++p) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < solid.mesh().cells.size(); ++c) count += solid.part(c) == static_cast<int>(p) + 1;
    text += fmt::format(", {}: {} elements", table.parts[p].name, count);
  }
  return text;
}

/// Natural frequencies at rest [Hz].
template <int d>
std::string frequencies_of(const Scene& scene, const ElasticTable& table) {
  const auto solid = make_solid<d>(scene.bodies[table.body], table);
  auto nodes = fmt::format("{} nodes{}", solid->mesh().size(),
                           table.adapt > 0 ? fmt::format(" before it is refined {} times", table.adapt) : "");
  if constexpr (d == 3) {
    nodes = fmt::format("{} elements, {}, least quality {:.2f}", solid->mesh().cells.size(), nodes,
                        elastic::least_quality<3>(solid->mesh()));
    if (table.mesh_file.empty())
      nodes += fmt::format(", meshed in {:.1f} s", mesh_in_space(scene.bodies[table.body], table).seconds);
  }
  if (!table.parts.empty() || !table.point_masses.empty()) nodes += mass_of<d>(scene.bodies[table.body], table, *solid);
  if (table.modes == 0) return nodes;
  const auto modes = elastic::lowest_modes(*solid, table.modes, elastic::Field::Zero(solid->size()));
  std::string list;
  for (const double w : modes.angular_frequencies)
    list += fmt::format("{}{:.5g}", list.empty() ? "" : ", ", w / (2 * std::numbers::pi));
  return nodes + (modes.status.ok() ? "" : ", " + modes.status.cause) + "; natural frequencies " + list + " Hz";
}

}  // namespace

std::optional<EffectNote> ElasticKind::note(const Scene& scene, const Scales&) const {
  const auto* tables = scene.effects.find<ElasticTables>();
  if (!tables) return {};
  std::string reason;
  for (const auto& table : tables->of_bodies)
    reason += fmt::format("{}{}: {}", reason.empty() ? "" : "; ", scene.bodies[table.body].name,
                          scene.dimension == 2 ? frequencies_of<2>(scene, table) : frequencies_of<3>(scene, table));
  return EffectNote{"elastic", true, reason};
}

}  // namespace splashdown::apps
