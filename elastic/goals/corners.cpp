// Corners of what moves, and the orders that they leave.
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "core/goals/corner_order.hpp"
#include "elastic/goals/goals.hpp"

namespace splashdown::elastic {
namespace {

/// A corner of the plane, an edge in space: the angle that the solid has around it, and the sides that end there.
struct Ridge {
  double angle = 0;
  std::vector<CornerSide> sides;
  std::set<int> materials;  // of the cells around it
};

/// Corners of cells without some of them, by their numbers, ascending.
template <int d, std::size_t n>
std::array<int, d + 1 - n> others(const std::array<int, cell_nodes<d>>& cell, const std::array<int, n>& without) {
  std::array<int, d + 1 - n> all{};
  std::size_t count = 0;
  for (int k = 0; k <= d; ++k)
    if (std::ranges::find(without, k) == without.end()) all[count++] = cell[static_cast<std::size_t>(k)];
  std::ranges::sort(all);
  return all;
}

/// The angle between the facets of a cell that end in all corners but i and j.
template <int d>
double angle_at(const Solid<d>& solid, const std::array<int, cell_nodes<d>>& cell, const std::array<int, d - 1>& ridge,
                int i, int j) {
  const auto& x = solid.mesh().nodes;
  const Vec<d> from = x.col(ridge[0]);
  Vec<d> a = x.col(cell[static_cast<std::size_t>(i)]) - from, b = x.col(cell[static_cast<std::size_t>(j)]) - from;
  for (std::size_t k = 1; k < ridge.size(); ++k) {
    const Vec<d> along = (x.col(ridge[k]) - from).normalized();
    a -= a.dot(along) * along;
    b -= b.dot(along) * along;
  }
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1., 1.));
}

template <int d>
bool is_held(const Solid<d>& solid, int node) {
  for (int k = 0; k < d; ++k)
    if (!solid.held()[static_cast<std::size_t>(d * node + k)]) return false;
  return true;
}

/// Of cells that move.
template <int d>
std::map<std::array<int, d - 1>, Ridge> ridges_of(const Solid<d>& solid) {
  struct Facet {
    int cells = 0;
    bool is_held = true;
  };
  std::map<std::array<int, d - 1>, Ridge> ridges;
  std::map<std::array<int, d>, Facet> facets;
  for (std::size_t c = 0; c < solid.mesh().cells.size(); ++c) {
    const auto& cell = solid.mesh().cells[c];
    if (std::ranges::all_of(cell, [&](int a) { return is_held(solid, a); })) continue;
    for (int i = 0; i <= d; ++i) {
      auto& facet = facets[others<d>(cell, std::array{i})];
      ++facet.cells;
      for (int k = 0; k < cell_nodes<d>; ++k)
        if (node_place<d>(k)[i] == 0) facet.is_held &= is_held(solid, cell[static_cast<std::size_t>(k)]);
      for (int j = i + 1; j <= d; ++j) {
        const auto corners = others<d>(cell, std::array{i, j});
        auto& ridge = ridges[corners];
        ridge.angle += angle_at(solid, cell, corners, i, j);
        ridge.materials.insert(solid.part(c));
      }
    }
  }
  for (const auto& [corners, facet] : facets) {
    if (facet.cells > 1) continue;
    for (int without = 0; without < d; ++without) {
      std::array<int, d - 1> ridge{};
      for (int k = 0, at = 0; k < d; ++k)
        if (k != without) ridge[static_cast<std::size_t>(at++)] = corners[static_cast<std::size_t>(k)];
      ridges[ridge].sides.push_back(facet.is_held ? CornerSide::held : CornerSide::free);
    }
  }
  return ridges;
}

/// 3 - 4 nu of the unloaded solid, as if it were isotropic.
template <int d>
double kappa_of(const Law<d>& law) {
  const auto A = law.tangent(Mat<d>::Identity());
  double stretch = 0, shear = 0;
  for (int k = 0; k < d; ++k) stretch += A(k + d * k, k + d * k) / d;
  for (int i = 0; i < d; ++i)
    for (int k = 0; k < d; ++k)
      if (i != k) shear += A(i + d * k, i + d * k) / (d * (d - 1));
  return std::max(1., (stretch + shear) / (stretch - shear));
}

}  // namespace

template <int d>
std::vector<double> whole_errors(const Solid<d>& solid) {
  std::map<int, double> kappas;  // of materials
  for (std::size_t c = 0; c < solid.mesh().cells.size(); ++c)
    if (!kappas.contains(solid.part(c))) kappas[solid.part(c)] = kappa_of(solid.law(c));
  std::map<int, double> exponents;  // of nodes at singular corners
  for (const auto& [nodes, ridge] : ridges_of(solid)) {
    if (ridge.sides.size() != 2) continue;
    const auto one = ridge.sides[0], other = ridge.sides[1];
    if (one == other && ridge.angle < std::numbers::pi + least_corner_turn) continue;
    double exponent = 1;
    for (const int material : ridge.materials)
      exponent = std::min(exponent, corner_exponent(ridge.angle, one, other, kappas.at(material)));
    for (const int a : nodes) {
      const auto [found, is_new] = exponents.try_emplace(a, exponent);
      if (!is_new) found->second = std::min(found->second, exponent);
    }
  }
  std::vector<double> all;
  for (const auto& cell : solid.mesh().cells) {
    double order = smooth_order;
    for (std::size_t k = 0; k <= d; ++k)
      if (const auto found = exponents.find(cell[k]); found != exponents.end() && found->second < 1)
        order = std::min(order, 2 * found->second);
    all.push_back(over_shown(order));
  }
  return all;
}

template std::vector<double> whole_errors<2>(const Solid<2>&);
template std::vector<double> whole_errors<3>(const Solid<3>&);

}  // namespace splashdown::elastic
