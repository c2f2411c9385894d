#include "apps/effects/elastic/clamps.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>

#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/problems.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {
namespace {

/// Unknowns that clamps hold, node by node, and whose clamp holds each last; -1: none.
template <int d>
std::vector<int> holders_of(const ElasticTable& table, const elastic::SolidMesh<d>& mesh, Problems& problems) {
  const double roundoff = 1e-9 * elastic::extent(mesh);
  std::vector<int> holders(static_cast<std::size_t>(d * mesh.size()), -1);
  for (std::size_t c = 0; c < table.clamps.size(); ++c) {
    const auto& clamp = table.clamps[c];
    const auto key = fmt::format("{}.clamp[{}]", table.path, c);
    bool found = false, parts = false;
    for (int a = 0; a < mesh.size(); ++a) {
      if (!covers(clamp, in_space<d>(mesh.nodes.col(a)), roundoff)) continue;
      found = true;
      for (int k = 0; k < d; ++k) {
        if (!holds(clamp, k)) continue;
        int& holder = holders[static_cast<std::size_t>(d * a + k)];
        parts |= holder >= 0 && table.clamps[static_cast<std::size_t>(holder)].velocity != clamp.velocity;
        holder = static_cast<int>(c);
      }
    }
    if (!found)
      problems.add(key, "holds nothing: no node of the mesh lies there",
                   "Move or enlarge it (shape's frame), or use smaller elements.");
    if (parts)
      problems.add(key + ".velocity", "another clamp moves the same nodes differently",
                   "Make them one, or move them apart.");
  }
  return holders;
}

/// How many rigid motions clamps leave.
template <int d>
int rigid_motions_left(const Body& body, const elastic::SolidMesh<d>& mesh, const std::vector<int>& holders) {
  constexpr int turns = rotations<d>;
  using Row = Eigen::Matrix<double, 1, freedoms<d>>;
  const double length = elastic::extent(mesh);
  const Mat<d> turn = shape_pose<d>(body).linear();  // axes are the world's
  Eigen::Matrix<double, freedoms<d>, freedoms<d>> normal = decltype(normal)::Zero();
  for (std::size_t i = 0; i < holders.size(); ++i) {
    if (holders[i] < 0) continue;
    const auto k = static_cast<Eigen::Index>(i) % d;
    const Vec<d> arm = turn * (mesh.nodes.col(static_cast<Eigen::Index>(i) / d) - mesh.nodes.col(0)) / length;
    Row row = Row::Zero();
    row[k] = 1;
    for (int t = 0; t < turns; ++t) row[d + t] = cross(Eigen::Matrix<double, turns, 1>::Unit(t).eval(), arm)[k];
    normal += row.transpose() * row;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(normal);
  qr.setThreshold(1e-10);
  return freedoms<d> - static_cast<int>(qr.rank());
}

void check_velocities(const Scene& scene, const ElasticTable& table, int dimension, Problems& problems) {
  for (std::size_t c = 0; c < table.clamps.size(); ++c) {
    const auto& clamp = table.clamps[c];
    const auto key = fmt::format("{}.clamp[{}].velocity", table.path, c);
    for (int k = 0; k < dimension; ++k)
      if (!holds(clamp, k) && std::ranges::any_of(clamp.velocity, [&](const auto& row) {
            return row[static_cast<std::size_t>(k) + 1] != 0;
          }))
        problems.add(key, fmt::format("moves along {}, along which the clamp does not hold", "xyz"[k]),
                     "Use zero, or add it to axes.");
    if (!clamp.velocity.empty() && !scene.has_fluid())
      problems.add(key, "clamps of a body that meets no fluid stay where they are", "Remove it, or add a [fluid].");
    if (table.coordinates == "modes" && clamp.velocity != table.clamps.front().velocity)
      problems.add(key, "modes know one motion of all clamps",
                   "Give all clamps the same velocity, or use coordinates = \"nodes\".");
  }
}

}  // namespace

template <int d>
void check_clamps(const Scene& scene, const ElasticTable& table, const elastic::SolidMesh<d>& mesh,
                  Problems& problems) {
  const auto holders = holders_of<d>(table, mesh, problems);
  check_velocities(scene, table, d, problems);
  const auto free = std::ranges::count(holders, -1);
  if (free == 0)
    problems.add(table.path + ".clamp", "holds the whole body", "Make it smaller, or make the body rigid.");
  else if (table.modes >= free)
    problems.add(table.path + ".modes", fmt::format("must be below {}, the free unknowns of the mesh", free),
                 "Ask for fewer, or use smaller elements.");
  const int left = rigid_motions_left<d>(scene.bodies[table.body], mesh, holders), fewest = left == 0 ? 1 : freedoms<d>;
  const bool modal = table.coordinates == "modes";
  if (modal && left > 0 && left < freedoms<d> && !table.clamps.empty())
    problems.add(table.path + ".clamp",
                 fmt::format("leaves {} of {} rigid motions, which modes do not follow", left, freedoms<d>),
                 "Hold more of the body, or use coordinates = \"nodes\".");
  else if (table.coordinates != "nodes" && table.modes < fewest)
    problems.add(table.path + ".modes",
                 fmt::format("must be {} at least with coordinates = \"{}\"{}", fewest, table.coordinates,
                             left == 0 ? "" : ": a body that nothing holds has so many rigid ones"),
                 "Use e.g. 20, or coordinates = \"nodes\".");
  if (table.scheme == "steady" && left > 0)
    problems.add(table.path + ".scheme", "a body that nothing holds has no equilibrium",
                 "Add a clamp, or change the scheme.");
  if (table.start == "equilibrium" && left > 0)
    problems.add(table.path + ".start", "a body that nothing holds has no equilibrium", "Add a clamp, or remove it.");
}

template void check_clamps<2>(const Scene&, const ElasticTable&, const elastic::SolidMesh<2>&, Problems&);
template void check_clamps<3>(const Scene&, const ElasticTable&, const elastic::SolidMesh<3>&, Problems&);

}  // namespace splashdown::apps
