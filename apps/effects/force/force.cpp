#include "apps/effects/force/force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/effects/elastic/elastic.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/read/parts.hpp"
#include "rigid/forces/applied/applied.hpp"

namespace splashdown::apps {
namespace {

template <int values>
rigid::Curve<values> over_time(const std::vector<std::vector<double>>& rows) {
  std::vector<typename rigid::Curve<values>::Row> all;
  for (const auto& row : rows) {
    auto& to = all.emplace_back();
    to.at = row[0];
    for (int k = 0; k < values; ++k) to.value[k] = row[static_cast<std::size_t>(k) + 1];
  }
  return rigid::Curve<values>(std::move(all));
}

}  // namespace

void ForceKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<ForceTables>().all.emplace_back();
  const bool plane = scene.dimension == 2;
  table.body = scene.bodies.size() - 1;
  reader.choice("axes", table.axes, {"body", "world"});
  reader.curve("force", table.force, plane ? 3 : 4,
               any(plane ? "N/m" : "N", plane ? "Use [10.0, 0.0], or rows of a time and two components: [[0, 10, 0], "
                                                "[2, 10, 0], [2.1, 0, 0]]."
                                              : "Use [10.0, 0.0, 0.0], or rows of a time and three components."));
  reader.curve("moment", table.moment, plane ? 2 : 4,
               any(plane ? "N" : "N m", "Use a constant, or rows that begin with a time."));
  reader.point("point", table.point, place_rule(scene.dimension));
  auto& problems = reader.context().problems;
  if (reader.context().sketch || problems.found_in(reader.path())) return;
  if (table.force.empty() && table.moment.empty())
    problems.add_missing(reader.key("force"), "it has neither a force nor a moment", "Add force or moment.");
  if (table.force.empty() && table.point)
    problems.add(reader.key("point"), "a moment acts at no point", "Remove it, or add a force.");
}

std::optional<EffectNote> ForceKind::note(const Scene& scene, const Scales& s) const {
  const auto* tables = scene.effects.find<ForceTables>();
  if (!tables) return {};
  double most = 0;
  for (const auto& table : tables->all)
    for (const auto& row : table.force)
      most = std::max(most, Eigen::Map<const Eigen::VectorXd>(row.data() + 1, scene.dimension).norm());
  return EffectNote{"force", true,
                    fmt::format("up to {:.3g} {}{}", most, scene.dimension == 2 ? "N/m" : "N",
                                s.gravity > 0 ? "" : "; there is no gravity beside it")};
}

template <int d>
std::optional<std::string> ForceKind::asymmetry_in(const Scene& scene, const Mirror& mirror) const {
  constexpr double roundoff = 1e-9;  // of a force
  const auto kept = mirror.kept<d>();
  for (const auto& table : scene.effects.find<ForceTables>()->all) {
    const auto& body = scene.bodies[table.body];
    const auto pose = shape_pose<d>(body);
    const auto leaves = [&](const auto& rows, auto turn, auto stays) {
      return std::ranges::any_of(rows, [&](const std::vector<double>& row) {
        const Eigen::VectorXd there = turn * Eigen::Map<const Eigen::VectorXd>(row.data() + 1, stays.size());
        return there.cwiseProduct(Eigen::VectorXd::Ones(stays.size()) - stays).norm() > roundoff * there.norm();
      });
    };
    const Eigen::MatrixXd turn =
        table.axes == "body" ? Eigen::MatrixXd(pose.linear()) : Eigen::MatrixXd::Identity(d, d);
    if (leaves(table.force, turn, Eigen::VectorXd(kept.template head<d>())))
      return fmt::format("pushes '{}' across the plane", body.name);
    constexpr int turns = rigid::rotations<d>;
    if (leaves(table.moment, d == 3 ? turn : Eigen::MatrixXd::Identity(turns, turns),
               Eigen::VectorXd(kept.template tail<turns>())))
      return fmt::format("turns '{}' out of the plane", body.name);
    if (!table.point) continue;
    if (const auto off = off_plane<d>(mirror, body, vec<d>(*table.point)))
      return fmt::format("acts on '{}' {:g} m off the plane", body.name, *off);
  }
  return {};
}

std::optional<std::string> ForceKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  return scene.dimension == 2 ? asymmetry_in<2>(scene, mirror) : asymmetry_in<3>(scene, mirror);
}

template <int d>
void ForceKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  std::vector<rigid::AppliedForceSpec<d>> specs;
  for (const auto& table : scene.effects.find<ForceTables>()->all) {
    if (deforms(scene, table.body)) continue;
    auto& spec = specs.emplace_back();
    spec.body = table.body;
    spec.force = over_time<d>(table.force);
    spec.moment = over_time<rigid::rotations<d>>(table.moment);
    spec.turns_with_body = table.axes == "body";
    if (table.point) spec.point = vec<d>(*table.point) - mass_properties<d>(scene.bodies[table.body]).centre;
  }
  parts.forces.push_back(std::make_unique<rigid::AppliedForces<d>>(std::move(specs)));
}

template void ForceKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void ForceKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
