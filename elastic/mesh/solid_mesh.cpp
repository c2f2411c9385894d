#include "elastic/mesh/solid_mesh.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

namespace splashdown::elastic {
namespace {

/// Nodes of a cell's facet opposite to corner `k`, corners first and middles in the order of `cell_edges`.
template <int d>
std::array<int, facet_nodes<d>> facet_of(const std::array<int, cell_nodes<d>>& cell, int k) {
  std::array<int, d> corners;
  for (int i = 0; i < d; ++i) corners[i] = (k + 1 + i) % (d + 1);
  // Taken in turn from k they run around the facet the right way: in space for every second k.
  if (d == 3 && k % 2 == 1) std::swap(corners[1], corners[d - 1]);
  std::array<int, facet_nodes<d>> facet{};
  for (int i = 0; i < d; ++i) facet[i] = cell[corners[i]];
  for (int e = 0; e < edge_count<d - 1>; ++e) {
    const auto ends = std::minmax(corners[cell_edges[e][0]], corners[cell_edges[e][1]]);
    for (int edge = 0; edge < edge_count<d>; ++edge)
      if (std::minmax(cell_edges[edge][0], cell_edges[edge][1]) == ends) facet[d + e] = cell[d + 1 + edge];
  }
  return facet;
}

template <int d>
Mat<d> jacobian(const Points<d>& nodes, const std::array<int, cell_nodes<d>>& cell, const Barycentric<d>& at) {
  const auto slopes = shape_slopes<d>(at);
  Mat<d> J = Mat<d>::Zero();
  for (int a = 0; a < cell_nodes<d>; ++a) J += nodes.col(cell[a]) * slopes.col(a).transpose();
  return J;
}

template <int d>
std::string where(const Vec<d>& x) {
  std::ostringstream text;
  text << " at (" << x.transpose().format(Eigen::IOFormat(6, 0, ", ", ", ")) << ")";
  return text.str();
}

/// Turns cells that are wound the other way.
template <int d>
void orient(const Points<d>& nodes, std::vector<std::array<int, cell_nodes<d>>>& cells) {
  const Barycentric<d> middle = Barycentric<d>::Constant(1. / (d + 1));
  for (auto& cell : cells) {
    if (jacobian<d>(nodes, cell, middle).determinant() > 0) continue;
    std::swap(cell[0], cell[1]);  // edges 1 and 2, 3 and 5 change places
    std::swap(cell[d + 2], cell[d + 3]);
    if constexpr (d == 3) std::swap(cell[d + 4], cell[d + 6]);
  }
}

/// A cell may not be folded anywhere that it is looked at: at its nodes and where it is integrated.
template <int d>
void require_unfolded(const Points<d>& nodes, const std::vector<std::array<int, cell_nodes<d>>>& cells) {
  std::vector<Barycentric<d>> looks;
  for (int i = 0; i <= d; ++i) looks.push_back(Barycentric<d>::Unit(i));
  for (const auto& point : rule<d>()) looks.push_back(point.at);
  constexpr double flat = 1e-6;  // of the cube of its size: a thousandth of its size is thin, a millionth is nothing
  for (const auto& cell : cells) {
    double size = 0;
    for (int i = 1; i <= d; ++i) size = std::max(size, (nodes.col(cell[i]) - nodes.col(cell[0])).norm());
    for (const auto& at : looks)
      if (!(jacobian<d>(nodes, cell, at).determinant() > flat * std::pow(size, d)))
        throw MeshError("an element is folded or flat" + where<d>(nodes.col(cell[0])),
                        "Mesh the solid anew, finer where it is curved, or with straight elements.");
  }
}

/// Facets by their corners, with the cells on both sides.
template <int d>
struct Sides {
  std::map<std::array<int, d>, std::vector<std::pair<int, int>>> cells;  // cell and corner opposite to the facet
  explicit Sides(const std::vector<std::array<int, cell_nodes<d>>>& all) {
    for (std::size_t c = 0; c < all.size(); ++c)
      for (int k = 0; k <= d; ++k) {
        std::array<int, d> corners;
        for (int i = 0; i < d; ++i) corners[i] = all[c][(k + 1 + i) % (d + 1)];
        std::ranges::sort(corners);
        cells[corners].emplace_back(static_cast<int>(c), k);
      }
  }
};

template <int d>
void require_one_part(const SolidMesh<d>& mesh, const Sides<d>& sides) {
  std::vector<int> part(mesh.cells.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int c) {
    while (part[c] != c) c = part[c] = part[part[c]];
    return c;
  };
  for (const auto& [corners, cells] : sides.cells) {
    if (cells.size() > 2)
      throw MeshError("three elements meet at one side" + where<d>(mesh.nodes.col(corners[0])),
                      "Remove elements that overlap, and mesh the solid anew.");
    if (cells.size() == 2) part[root(cells[0].first)] = root(cells[1].first);
  }
  for (std::size_t c = 1; c < mesh.cells.size(); ++c)
    if (root(static_cast<int>(c)) != root(0))
      throw MeshError("the solid is not in one piece: the part" + where<d>(mesh.nodes.col(mesh.cells[c][0])) +
                          " hangs on the rest by a corner or not at all",
                      "Join the parts by elements that share sides (in Gmsh: Coherence), or make a body of each.");
}

}  // namespace

template <int d>
SolidMesh<d> solid_mesh(const Points<d>& nodes, std::vector<std::array<int, cell_nodes<d>>> cells) {
  if (cells.empty())
    throw MeshError("the mesh has no elements", "Give a mesh of the solid itself, not of its surface.");
  std::vector<int> number(nodes.cols(), -1);
  for (const auto& cell : cells)
    for (const int a : cell) number[a] = 0;
  int count = 0;
  for (int& n : number)
    if (n == 0) n = count++;
  SolidMesh<d> mesh;
  mesh.nodes.resize(d, count);
  for (Eigen::Index a = 0; a < nodes.cols(); ++a)
    if (number[a] >= 0) mesh.nodes.col(number[a]) = nodes.col(a);
  for (auto& cell : cells)
    for (int& a : cell) a = number[a];
  orient<d>(mesh.nodes, cells);
  require_unfolded<d>(mesh.nodes, cells);
  mesh.cells = std::move(cells);
  const Sides<d> sides(mesh.cells);
  require_one_part(mesh, sides);
  for (const auto& [corners, on] : sides.cells)
    if (on.size() == 1) mesh.facets.push_back(facet_of<d>(mesh.cells[on[0].first], on[0].second));
  return mesh;
}

template <int d>
SolidMesh<d> quadratic_mesh(const Points<d>& corners, const Simplices<d>& simplices) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Vec<d>> nodes(corners.cols());
  for (Eigen::Index a = 0; a < corners.cols(); ++a) nodes[a] = corners.col(a);
  std::vector<std::array<int, cell_nodes<d>>> cells;
  for (const auto& simplex : simplices) {
    auto& cell = cells.emplace_back();
    std::ranges::copy(simplex, cell.begin());
    for (int e = 0; e < edge_count<d>; ++e) {
      const int i = simplex[cell_edges[e][0]], j = simplex[cell_edges[e][1]];
      const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<int>(nodes.size()));
      if (is_new) nodes.push_back(0.5 * (corners.col(i) + corners.col(j)));
      cell[d + 1 + e] = at->second;
    }
  }
  Points<d> all(d, nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) all.col(a) = nodes[a];
  return solid_mesh<d>(all, std::move(cells));
}

template <int d>
std::optional<Place<d>> locate(const SolidMesh<d>& mesh, const Vec<d>& point, double near) {
  Place<d> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& cell = mesh.cells[c];
    Barycentric<d> at = Barycentric<d>::Constant(1. / (d + 1));
    constexpr int most = 20;  // straight cells need one step, curved ones a few
    for (int step = 0; step < most; ++step) {
      Vec<d> x = Vec<d>::Zero();
      const auto N = shapes<d>(at);
      for (int a = 0; a < cell_nodes<d>; ++a) x += N[a] * mesh.nodes.col(cell[a]);
      const Vec<d> move = jacobian<d>(mesh.nodes, cell, at).inverse() * (point - x);
      if (!move.allFinite() || move.cwiseAbs().maxCoeff() > 1e3) break;
      at.template tail<d>() += move;
      at[0] -= move.sum();
      if (move.cwiseAbs().maxCoeff() < 1e-14) break;
    }
    // Outside, the nearest point of the cell as its straight twin has it.
    Barycentric<d> inside = at.cwiseMax(0.);
    inside /= inside.sum();
    Vec<d> x = Vec<d>::Zero();
    const auto N = shapes<d>(inside);
    for (int a = 0; a < cell_nodes<d>; ++a) x += N[a] * mesh.nodes.col(cell[a]);
    if (const double away = (x - point).norm(); away < least) {
      least = away;
      best = {static_cast<int>(c), inside};
    }
  }
  if (least > near) return std::nullopt;
  return best;
}

template <int d>
double least_quality(const SolidMesh<d>& mesh) {
  double least = 1;
  for (const auto& cell : mesh.cells) least = std::min(least, mean_ratio<d>(mesh.nodes, cell));
  return least;
}

template <int d>
double longest_edge(const SolidMesh<d>& mesh) {
  double longest = 0;
  for (const auto& cell : mesh.cells)
    for (int i = 1; i <= d; ++i)
      for (int k = 0; k < i; ++k)
        longest = std::max(longest, (mesh.nodes.col(cell[i]) - mesh.nodes.col(cell[k])).norm());
  return longest;
}

template double least_quality<2>(const SolidMesh<2>&);
template double least_quality<3>(const SolidMesh<3>&);
template double longest_edge<2>(const SolidMesh<2>&);
template double longest_edge<3>(const SolidMesh<3>&);
template SolidMesh<2> solid_mesh<2>(const Points<2>&, std::vector<std::array<int, 6>>);
template SolidMesh<3> solid_mesh<3>(const Points<3>&, std::vector<std::array<int, 10>>);
template SolidMesh<2> quadratic_mesh<2>(const Points<2>&, const Simplices<2>&);
template SolidMesh<3> quadratic_mesh<3>(const Points<3>&, const Simplices<3>&);
template std::optional<Place<2>> locate<2>(const SolidMesh<2>&, const Vec<2>&, double);
template std::optional<Place<3>> locate<3>(const SolidMesh<3>&, const Vec<3>&, double);

}  // namespace splashdown::elastic
