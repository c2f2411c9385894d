#include "apps/effects/elastic/solid.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/named.hpp"
#include "elastic/mesh/boundary.hpp"
#include "elastic/participant.hpp"
#include "rigid/forces/curve.hpp"

namespace splashdown::apps {
namespace {

using elastic::Dynamics;
using elastic::Field;
using elastic::Scheme;

struct SchemeRow {
  std::string name;
  std::unique_ptr<Scheme> (*make)(const ElasticTable&, Dynamics);
};

const std::vector<SchemeRow>& scheme_rows() {
  using Table = ElasticTable;
  static const std::vector<SchemeRow> rows = {
      {"generalised_alpha",
       [](const Table& t, Dynamics d) { return elastic::generalised_alpha(std::move(d), t.spectral_radius); }},
      {"newmark", [](const Table&, Dynamics d) { return elastic::newmark(std::move(d)); }},
      {"shifted_crank_nicolson",
       [](const Table& t, Dynamics d) { return elastic::shifted_crank_nicolson(std::move(d), t.shift); }},
      {"fractional_step_theta", [](const Table&, Dynamics d) { return elastic::fractional_step_theta(std::move(d)); }},
      {"midpoint", [](const Table&, Dynamics d) { return elastic::midpoint(std::move(d)); }},
      {"implicit_euler", [](const Table&, Dynamics d) { return elastic::implicit_euler(std::move(d)); }},
      {"steady", [](const Table&, Dynamics d) { return elastic::steady(std::move(d)); }}};
  return rows;
}

template <int d>
struct LawRow {
  std::string name;
  std::unique_ptr<const elastic::Law<d>> (*make)(const elastic::Isotropic&);
};

template <int d>
const std::vector<LawRow<d>>& law_rows() {
  static const std::vector<LawRow<d>> rows = {{"st_venant_kirchhoff", &elastic::st_venant_kirchhoff<d>},
                                              {"neo_hookean", &elastic::neo_hookean<d>},
                                              {"small_strain", &elastic::small_strain<d>}};
  return rows;
}

struct SignalRow {
  std::string name;
  elastic::PointSignal signal;
};
const std::vector<SignalRow>& signal_rows() {
  using elastic::PointSignal;
  static const std::vector<SignalRow> rows = {{"displacement", PointSignal::displacement},
                                              {"velocity", PointSignal::velocity},
                                              {"acceleration", PointSignal::acceleration},
                                              {"strain", PointSignal::strain}};
  return rows;
}

std::vector<elastic::PointSignal> signals_of(const ElasticPoint& point) {
  std::vector<elastic::PointSignal> all;
  for (const auto& name : point.signals) all.push_back(named(signal_rows(), name).signal);
  return all;
}

/// Unit vectors: along the fibres, across them in the ply, along the normal.
Eigen::Matrix3d axes_of(const ElasticPly& ply) {
  Eigen::Matrix3d axes;
  axes.col(0) = ply.fibres.normalized();
  axes.col(1) = ply.normal.cross(axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Of all clamps of a body that move.
template <int d>
std::function<Field(double)> drive_of(const ElasticTable& table, const elastic::SolidMesh<d>& mesh) {
  struct Pull {
    rigid::Curve<d> velocity;
    std::vector<Eigen::Index> unknowns;
  };
  std::vector<Pull> pulls;
  const double roundoff = 1e-9 * elastic::extent(mesh);
  for (const auto& clamp : table.clamps) {
    if (clamp.velocity.empty()) continue;
    std::vector<typename rigid::Curve<d>::Row> rows;
    for (const auto& row : clamp.velocity)
      rows.push_back({row[0], Eigen::Map<const Eigen::Matrix<double, d, 1>>(row.data() + 1)});
    auto& pull = pulls.emplace_back(Pull{rigid::Curve<d>(std::move(rows)), {}});
    for (int a = 0; a < mesh.size(); ++a)
      if (covers(clamp, in_space<d>(mesh.nodes.col(a)), roundoff))
        for (int k = 0; k < d; ++k)
          if (holds(clamp, k)) pull.unknowns.push_back(d * a + k);
  }
  if (pulls.empty()) return {};
  return [pulls, size = d * mesh.size()](double t) {
    Field all = Field::Zero(size);
    for (const auto& pull : pulls) {
      const auto velocity = pull.velocity.at(t);
      for (const auto i : pull.unknowns) all[i] = velocity[i % d];
    }
    return all;
  };
}

/// As it is at t = 0.
template <int d>
elastic::SolidMesh<d> in_world(const Body& body, elastic::SolidMesh<d> mesh) {
  mesh.nodes = (shape_pose<d>(body) * mesh.nodes).eval();
  return mesh;
}

}  // namespace

template <int d>
std::unique_ptr<elastic::Solid<d>> make_solid(const Body& body, const ElasticTable& table,
                                              const elastic::SolidMesh<d>& mesh) {
  auto placed = in_world<d>(body, mesh);
  const double density = density_of<d>(body, table, mesh);
  std::vector<elastic::Material<d>> materials{{solid_law<d>(body, table), density}};
  for (const auto& part : table.parts) materials.push_back({solid_law<d>(body, part), part.density.value_or(density)});
  auto solid = std::make_unique<elastic::Solid<d>>(std::move(placed), std::move(materials), parts_of<d>(table, mesh));
  const double roundoff = 1e-9 * elastic::extent(mesh);
  for (int a = 0; a < mesh.size(); ++a)
    for (const auto& clamp : table.clamps)
      if (covers(clamp, in_space<d>(mesh.nodes.col(a)), roundoff))
        for (int k = 0; k < d; ++k)
          if (holds(clamp, k)) solid->hold(d * a + k);
  for (const auto& part : table.point_masses) solid->add_point_mass(*place_in<d>(mesh, part.point), part.mass);
  return solid;
}

std::vector<std::string> elastic_laws() {
  auto names = names_of(law_rows<2>());
  names.emplace_back("orthotropic");
  return names;
}
std::vector<std::string> elastic_schemes() { return names_of(scheme_rows()); }
std::vector<std::string> elastic_signals() { return names_of(signal_rows()); }

bool holds(const ElasticClamp& clamp, int axis) {
  return clamp.axes.empty() || std::ranges::find(clamp.axes, std::string(1, "xyz"[axis])) != clamp.axes.end();
}

template <int d>
std::unique_ptr<const elastic::Law<d>> solid_law(const Body& body, const ElasticMaterial& material) {
  for (const auto& row : law_rows<d>())
    if (row.name == material.law) return row.make({material.young_modulus, material.poisson_ratio});
  const auto& [E, nu, G, fibres, normal] = material.ply;
  elastic::Orthotropic moduli{.E1 = E.at(0),
                              .E2 = E.at(1),
                              .E3 = E.at(2),
                              .nu12 = nu.at(0),
                              .nu13 = nu.at(1),
                              .nu23 = nu.at(2),
                              .G12 = G.at(0),
                              .G13 = G.at(1),
                              .G23 = G.at(2)};
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<d, d>() = shape_pose<d>(body).linear();
  moduli.axes = turn * axes_of(material.ply);
  return elastic::orthotropic<d>(moduli);
}

template <int d>
std::unique_ptr<elastic::Solid<d>> make_solid(const Body& body, const ElasticTable& table) {
  return make_solid<d>(body, table, solid_mesh<d>(body, table));
}

template <int d>
Surface<d> solid_surface(const Body& body, const ElasticTable& table) {
  return elastic::boundary_of(in_world<d>(body, solid_mesh<d>(body, table))).surface;
}

template <int d>
std::vector<elastic::SolidSpec<d>> solid_specs(const Scene& scene) {
  std::vector<elastic::SolidSpec<d>> specs;
  for (const auto& table : scene.effects.find<ElasticTables>()->of_bodies) {
    const auto& body = scene.bodies[table.body];
    const auto mesh = goal_mesh<d>(scene, table);
    auto& spec = specs.emplace_back();
    spec.solid = make_solid<d>(body, table, mesh);
    spec.scheme = [table](Dynamics dynamics) {
      return named(scheme_rows(), table.scheme).make(table, std::move(dynamics));
    };
    // Kicks of a fluid feed vibrations that steps do not resolve. A step leaves 72 % of them.
    if (scene.has_fluid()) spec.unresolved = 0.1;
    spec.damping = {table.mass_damping, table.stiffness_damping};
    if (scene.has_fluid())
      spec.wall = elastic::WallChoice{table.coordinates == "nodes" ? 0 : table.modes, table.coordinates != "modes"};
    if (scene.gravity) spec.gravity = vec<d>(scene.gravity->acceleration);
    spec.drive = drive_of<d>(table, mesh);
    spec.forces = solid_loads<d>(scene, table, *spec.solid, mesh);
    spec.goals = solid_goals<d>(body, table, mesh);
    if (!spec.goals.empty()) spec.forces_on = loads_on<d>(scene, table);
    spec.from_equilibrium = table.start == "equilibrium";
    for (const auto& part : table.parts) spec.parts.push_back(part.name);
    for (const auto& point : table.points)
      spec.points.push_back({point.name, *place_in<d>(mesh, point.point), signals_of(point)});
  }
  return specs;
}

template std::unique_ptr<const elastic::Law<2>> solid_law<2>(const Body&, const ElasticMaterial&);
template std::unique_ptr<const elastic::Law<3>> solid_law<3>(const Body&, const ElasticMaterial&);
template std::unique_ptr<elastic::Solid<2>> make_solid<2>(const Body&, const ElasticTable&);
template std::unique_ptr<elastic::Solid<3>> make_solid<3>(const Body&, const ElasticTable&);
template std::unique_ptr<elastic::Solid<2>> make_solid<2>(const Body&, const ElasticTable&,
                                                          const elastic::SolidMesh<2>&);
template std::unique_ptr<elastic::Solid<3>> make_solid<3>(const Body&, const ElasticTable&,
                                                          const elastic::SolidMesh<3>&);
template Surface<2> solid_surface<2>(const Body&, const ElasticTable&);
template Surface<3> solid_surface<3>(const Body&, const ElasticTable&);
template std::vector<elastic::SolidSpec<2>> solid_specs<2>(const Scene&);
template std::vector<elastic::SolidSpec<3>> solid_specs<3>(const Scene&);

}  // namespace splashdown::apps
