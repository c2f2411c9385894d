#include "rigid/contact/hull.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unsupported/Eigen/BVH>

#include "core/geometry.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

template <int d>
using Box = Eigen::AlignedBox<double, d>;

/// Boxes of facets or edges.
template <int d>
class Tree {
 public:
  void build(const std::vector<Box<d>>& boxes) {
    boxes_ = boxes;
    std::vector<int> numbers(boxes.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    tree_.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
  }
  /// Those that `meets` holds for, in the tree's order. It holds for a box around others if it does for one of them.
  template <class Meets>
  std::vector<int> found(Meets meets) const {
    struct Search {
      const std::vector<Box<d>>& boxes;
      Meets meets;
      std::vector<int> found;
      bool intersectVolume(const Box<d>& box) const { return meets(box); }
      bool intersectObject(int number) {
        if (meets(boxes[static_cast<std::size_t>(number)])) found.push_back(number);
        return false;
      }
    } search{boxes_, meets, {}};
    if (!boxes_.empty()) Eigen::BVIntersect(tree_, search);
    return std::move(search.found);
  }

 private:
  std::vector<Box<d>> boxes_;
  Eigen::KdBVH<double, d, int> tree_;
};

// Directions from one unit vector to another one: their polygon leaves the arc by 0.04 at most.
std::vector<Eigen::Vector3d> arc(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double step = 0.5;
  const Eigen::Vector3d normal = from.cross(to);
  const double angle = std::atan2(normal.norm(), from.dot(to));
  const Eigen::Vector3d aside = normal.isZero() ? from.unitOrthogonal() : normal.cross(from).normalized();
  const int parts = std::max(1, static_cast<int>(std::ceil(angle / step)));
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i <= parts; ++i)
    all.emplace_back(std::cos(angle * i / parts) * from + std::sin(angle * i / parts) * aside);
  return all;
}

// (w - v) . (c - v) = |w - v|^2 / 2 for all neighbours w, by least squares.
template <int d>
Round<d> round_through(const Eigen::Matrix<double, d, Eigen::Dynamic>& x, int v, const std::vector<int>& neighbours,
                       const Vec<d>& outward) {
  constexpr double longest_edge = 0.2;  // of the radius: what bulges between vertices is 0.5 % of it
  constexpr double off_the_sphere =
      1e-3;  // of what an edge's end is below the tangent: files in single precision are closer
  const auto count = static_cast<Eigen::Index>(neighbours.size());
  Eigen::Matrix<double, Eigen::Dynamic, d> edges(count, d);
  for (Eigen::Index i = 0; i < count; ++i)
    edges.row(i) = (x.col(neighbours[static_cast<std::size_t>(i)]) - x.col(v)).transpose();
  const Eigen::VectorXd half_squares = 0.5 * edges.rowwise().squaredNorm();
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, d>> fit(edges);
  if (fit.rank() < d) return {};
  const Vec<d> to_centre = fit.solve(half_squares);
  const Eigen::VectorXd off = (edges * to_centre - half_squares).cwiseAbs();
  const double radius = to_centre.norm();
  if (to_centre.dot(outward) >= 0 || std::sqrt(2 * half_squares.maxCoeff()) > longest_edge * radius ||
      (off.array() > off_the_sphere * half_squares.array()).any())
    return {};
  return {x.col(v) + to_centre, radius};
}

}  // namespace

template <int d>
struct Hull<d>::Boxes {
  Tree<d> facets, edges;
};

template <int d>
Hull<d>::Hull(const Surface<d>& surface)
    : surface_(&surface), tree_(surface.vertices, surface.facets), boxes_(std::make_unique<Boxes>()) {
  find_neighbours();
  find_round_vertices();
  if constexpr (d == 3) find_edges();
  std::vector<Box<d>> boxes;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    boxes.emplace_back();
    for (const Vec<d>& corner : facet_corners(surface, f)) boxes.back().extend(corner);
  }
  boxes_->facets.build(boxes);
  boxes.clear();
  for (const Edge& edge : edges_) {
    boxes.emplace_back();
    for (int v : edge.vertices) boxes.back().extend(Vec<d>(surface.vertices.col(v)));
  }
  boxes_->edges.build(boxes);
}

template <int d>
Hull<d>::~Hull() = default;
template <int d>
Hull<d>::Hull(Hull&&) noexcept = default;

template <int d>
void Hull<d>::find_neighbours() {
  neighbours_.resize(static_cast<std::size_t>(surface_->vertices.cols()));
  const auto& facets = surface_->facets;
  for (Eigen::Index f = 0; f < facets.cols(); ++f)
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b)
        if (a != b) neighbours_[static_cast<std::size_t>(facets(a, f))].push_back(facets(b, f));
}

template <int d>
void Hull<d>::find_round_vertices() {
  const auto& x = surface_->vertices;
  std::vector<Vec<d>> outward(static_cast<std::size_t>(x.cols()), Vec<d>::Zero());
  for (Eigen::Index f = 0; f < surface_->facets.cols(); ++f)
    for (int k = 0; k < d; ++k)
      outward[static_cast<std::size_t>(surface_->facets(k, f))] += area_vector(facet_corners(*surface_, f));
  for (int v = 0; v < x.cols(); ++v)
    round_.push_back(round_through<d>(x, v, neighbours(v), outward[static_cast<std::size_t>(v)]));
}

template <>
void Hull<2>::find_edges() {}
template <>
void Hull<3>::find_edges() {
  struct Side {
    Eigen::Vector3d normal, into, opposite;
  };
  constexpr double flat = 1e-6;  // sine of the turn, below which an edge only divides a face
  std::map<std::array<int, 2>, Side> waiting;
  convex_ = true;
  const auto& x = surface_->vertices;
  for (Eigen::Index f = 0; f < surface_->facets.cols(); ++f) {
    const auto corners = facet_corners(*surface_, f);
    const Eigen::Vector3d normal = area_vector(corners).normalized();
    for (int k = 0; k < 3; ++k) {
      const int from = surface_->facets(k, f), to = surface_->facets((k + 1) % 3, f);
      const Eigen::Vector3d along = (x.col(to) - x.col(from)).normalized();
      const Side side{normal, normal.cross(along), x.col(surface_->facets((k + 2) % 3, f))};
      const auto [other, first] = waiting.try_emplace({std::min(from, to), std::max(from, to)}, side);
      if (first) continue;
      // The facet falls away from the other one's plane.
      convex_ = convex_ && other->second.normal.dot(side.into) < flat;
      if (other->second.normal.dot(side.into) < -flat)
        edges_.push_back({{from, to},
                          other->second.normal + side.normal,
                          {other->second.into, side.into},
                          arc(other->second.normal, side.normal)});
    }
  }
  // One closed surface without holes through it, by Euler's formula.
  convex_ =
      convex_ && surface_->vertices.cols() + surface_->facets.cols() == 2 + static_cast<Eigen::Index>(waiting.size());
}

template <int d>
double Hull<d>::distance(const Vec<d>& x, double reach) const {
  const auto hit = tree_.nearest(x, reach);
  return hit.facet < 0 ? std::numeric_limits<double>::infinity() : std::sqrt(hit.squared_distance);
}

template <int d>
std::vector<int> Hull<d>::facets_near(const Vec<d>& x, double reach) const {
  auto found = boxes_->facets.found(
      [&, squared = reach * reach](const Box<d>& box) { return box.squaredExteriorDistance(x) <= squared; });
  std::sort(found.begin(), found.end());
  return found;
}

template <int d>
std::vector<int> Hull<d>::all_facets() const {
  std::vector<int> all(static_cast<std::size_t>(surface_->facets.cols()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <int d>
std::vector<int> Hull<d>::edges_within(const Eigen::AlignedBox<double, d>& place) const {
  return boxes_->edges.found([&](const Box<d>& box) { return box.intersects(place); });
}

template class Hull<2>;
template class Hull<3>;

}  // namespace splashdown::rigid
