// Goals of elastic bodies, and meshes that are refined for them.
#include "elastic/goals/goals.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "apps/effects/elastic/solid.hpp"
#include "apps/effects/gravity/gravity.hpp"
#include "apps/scene/geometry.hpp"
#include "core/goals/refined_size.hpp"
#include "elastic/mesh/outline_mesh.hpp"
#include "elastic/steps/scheme.hpp"

namespace splashdown::apps {
namespace {

using elastic::Field;

/// In equilibrium with the loads of the run's end.
template <int d>
Field settled(const elastic::Solid<d>& solid, const elastic::LoadOn<d>& load) {
  const Field none = Field::Zero(solid.size());
  elastic::SolidState end;
  const auto status = elastic::steady({.system = &solid, .load = [at = load(solid)](double) { return at; }})
                          ->step({0, none, none, none}, 1, end);
  if (!status.ok()) throw std::runtime_error("the mesh could not be refined for its goals: " + status.cause);
  return end.u;
}

}  // namespace

template <int d>
std::vector<elastic::SolidGoal<d>> solid_goals(const Body& body, const ElasticTable& table,
                                               const elastic::SolidMesh<d>& mesh) {
  std::vector<elastic::SolidGoal<d>> all;
  for (const auto& goal : table.goals) {
    auto& asked = all.emplace_back();
    asked.name = name_of(goal, body.name);
    asked.mode = goal.mode;
    if (goal.mode > 0) continue;
    asked.place = *place_in<d>(mesh, std::ranges::find(table.points, goal.point, &ElasticPoint::name)->point);
    asked.direction = Vec<d>::Unit(static_cast<Eigen::Index>(std::string("xyz").find(goal.direction)));
  }
  return all;
}

template <int d>
std::function<Field(const elastic::Solid<d>&, double)> loads_on(const Scene& scene, const ElasticTable& table) {
  return [scene, table](const elastic::Solid<d>& solid, double time) -> Field {
    auto mesh = solid.mesh();
    mesh.nodes = (shape_pose<d>(scene.bodies[table.body]).inverse() * mesh.nodes).eval();
    const auto loads = solid_loads<d>(scene, table, solid, mesh);
    return loads ? loads(time) : Field::Zero(solid.size());
  };
}

template <int d>
elastic::SolidMesh<d> goal_mesh(const Scene& scene, const ElasticTable& table) {
  const auto& body = scene.bodies[table.body];
  auto mesh = solid_mesh<d>(body, table);
  if constexpr (d == 2) {
    const Vec<2> gravity = scene.gravity ? vec<2>(scene.gravity->acceleration) : Vec<2>::Zero();
    const elastic::LoadOn<2> load = [&, forces = loads_on<2>(scene, table)](const elastic::Solid<2>& solid) -> Field {
      return solid.mass() * solid.uniform(gravity) + forces(solid, scene.time.end);
    };
    for (int k = 0; k < table.adapt; ++k) {
      const auto solid = make_solid<2>(body, table, mesh);
      const auto goals = solid_goals<2>(body, table, mesh);
      const bool bends = std::ranges::any_of(goals, [](const auto& goal) { return goal.mode == 0; });
      const Field u = bends ? settled<2>(*solid, load) : Field(Field::Zero(solid->size()));
      JointShares together(mesh.cells.size());
      for (const auto& goal : goals) together.add(elastic::goal_error<2>(goal, *solid, u, load).by_cell);
      const auto size = refined_size(mesh.nodes, mesh.cells, together.all(), refined_share);
      mesh = elastic::outline_mesh(
          shape_of<2>(body.shape).surface, [&](const Vec<2>& x) { return std::min(table.size, size(x)); },
          lines_of(table));
    }
  }
  return mesh;
}

template std::vector<elastic::SolidGoal<2>> solid_goals<2>(const Body&, const ElasticTable&,
                                                           const elastic::SolidMesh<2>&);
template std::vector<elastic::SolidGoal<3>> solid_goals<3>(const Body&, const ElasticTable&,
                                                           const elastic::SolidMesh<3>&);
template std::function<Field(const elastic::Solid<2>&, double)> loads_on<2>(const Scene&, const ElasticTable&);
template std::function<Field(const elastic::Solid<3>&, double)> loads_on<3>(const Scene&, const ElasticTable&);
template elastic::SolidMesh<2> goal_mesh<2>(const Scene&, const ElasticTable&);
template elastic::SolidMesh<3> goal_mesh<3>(const Scene&, const ElasticTable&);

}  // namespace splashdown::apps
