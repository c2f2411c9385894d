#include "core/surface/unite.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_set_2.h>

#include <iterator>
#include <stdexcept>
#include <vector>

#include "core/surface/soup.hpp"

namespace splashdown {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<Exact>;

/// Its loops; those of holes run clockwise.
std::vector<ExactPolygon> loops_of(const Surface<2>& surface) {
  std::vector<Eigen::Index> next(static_cast<std::size_t>(surface.vertices.cols()));
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    next[static_cast<std::size_t>(surface.facets(0, f))] = surface.facets(1, f);
  std::vector<char> seen(next.size(), 0);
  std::vector<ExactPolygon> loops;
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (seen[first] != 0) continue;
    auto& loop = loops.emplace_back();
    for (std::size_t at = first; seen[at] == 0; at = static_cast<std::size_t>(next[at])) {
      seen[at] = 1;
      loop.push_back(
          {surface.vertices(0, static_cast<Eigen::Index>(at)), surface.vertices(1, static_cast<Eigen::Index>(at))});
    }
  }
  return loops;
}

/// Collects loops as a surface; what rounding leaves of a vertex that is there twice becomes one.
class Outline {
 public:
  explicit Outline(double same) : same_(same) {}
  void add(const ExactPolygon& loop) {
    const auto first = points_.size();
    const auto n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& vertex = loop.vertex(i);
      if (CGAL::collinear(loop.vertex((i + n - 1) % n), vertex, loop.vertex((i + 1) % n))) continue;  // where sides met
      const Vec<2> x(CGAL::to_double(vertex.x()), CGAL::to_double(vertex.y()));
      if (points_.size() == first || (x - points_.back()).norm() > same_) points_.push_back(x);
    }
    while (points_.size() > first + 1 && (points_.back() - points_[first]).norm() <= same_) points_.pop_back();
    if (points_.size() < first + 3)
      points_.resize(first);
    else
      ends_.push_back(points_.size());
  }
  Surface<2> surface() const {
    Surface<2> surface;
    const auto n = static_cast<Eigen::Index>(points_.size());
    surface.vertices.resize(2, n);
    surface.facets.resize(2, n);
    std::size_t first = 0;
    for (const std::size_t end : ends_) {
      for (std::size_t i = first; i < end; ++i) {
        surface.vertices.col(static_cast<Eigen::Index>(i)) = points_[i];
        surface.facets.col(static_cast<Eigen::Index>(i)) << static_cast<int>(i),
            static_cast<int>(i + 1 == end ? first : i + 1);
      }
      first = end;
    }
    return surface;
  }

 private:
  double same_;
  std::vector<Vec<2>> points_;
  std::vector<std::size_t> ends_;  // of loops
};

}  // namespace

template <>
Surface<2> united<2>(std::span<const Surface<2>> parts) {
  CGAL::Polygon_set_2<Exact> sum;
  double extent = 0;
  for (const auto& part : parts) {
    if (part.vertices.cols() > 0) extent = std::max(extent, part.vertices.cwiseAbs().maxCoeff());
    const auto loops = loops_of(part);
    CGAL::Polygon_set_2<Exact> whole;
    for (const auto& loop : loops)
      if (loop.is_counterclockwise_oriented()) whole.join(loop);
    for (auto loop : loops)
      if (loop.is_clockwise_oriented()) {
        loop.reverse_orientation();
        whole.difference(loop);
      }
    sum.join(whole);
  }
  constexpr double roundoff = 1e-12;
  Outline outline(roundoff * extent);
  std::vector<CGAL::Polygon_with_holes_2<Exact>> pieces;
  sum.polygons_with_holes(std::back_inserter(pieces));
  for (const auto& piece : pieces) {
    outline.add(piece.outer_boundary());
    for (const auto& hole : piece.holes()) outline.add(hole);
  }
  return outline.surface();
}

template <>
Surface<3> united<3>(std::span<const Surface<3>> parts) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  Shell sum;
  for (const auto& part : parts) {
    auto shell = shell_of(part);
    Shell both;
    if (!pmp::corefine_and_compute_union(sum, shell, both))
      throw std::invalid_argument(
          "the union of the parts is not the surface of a solid: two of them touch in an edge or a point");
    sum = std::move(both);
  }
  pmp::remove_degenerate_faces(sum);
  Soup soup = soup_of(sum);
  merge_points(soup);
  pmp::repair_polygon_soup(soup.points, soup.polygons);
  return surface_of(soup);
}

}  // namespace splashdown
