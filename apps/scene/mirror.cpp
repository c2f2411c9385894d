#include "apps/scene/mirror.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;

constexpr double in_plane = 1e-9;  // of the surface's length: roundoff of coordinates

/// Cuts facets at the plane; new vertices are shared between the facets at an edge.
template <int d>
class Cutter {
 public:
  Cutter(const ShapeMirror<d>& mirror, const Surface<d>& surface) : surface_(surface) {
    const double tiny = in_plane * extents<d>(surface).diagonal().norm();
    for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v) {
      const Vec<d> x = surface.vertices.col(v);
      const double distance = mirror.distance(x);
      const bool lies_in = std::abs(distance) <= tiny;
      distance_.push_back(lies_in ? 0 : distance);
      at_.push_back(-1);
      vertices_.push_back(lies_in ? Vec<d>(x - distance * mirror.normal) : x);
    }
  }

  Surface<d> cut() {
    for (Eigen::Index f = 0; f < surface_.facets.cols(); ++f) {
      std::vector<int> rest;
      for (int k = 0; k < d; ++k) {
        const int a = surface_.facets(k, f), b = surface_.facets((k + 1) % d, f);
        if (distance_[a] >= 0) rest.push_back(kept(a));
        if (d == 2 && k == 1) break;  // a segment has one edge
        if (distance_[a] * distance_[b] < 0) rest.push_back(crossing(a, b));
      }
      // A fan; what touches the plane and lies beyond leaves a corner or an edge of nothing.
      if (!reaches_in(f)) continue;
      for (std::size_t k = d - 1; k < rest.size(); ++k) {
        std::array<int, d> facet;
        for (int j = 0; j < d; ++j) facet[j] = rest[j == 0 ? 0 : k + j + 1 - d];
        facets_.push_back(facet);
      }
    }
    Surface<d> out;
    out.vertices.resize(d, static_cast<Eigen::Index>(used_.size()));
    for (std::size_t v = 0; v < used_.size(); ++v) out.vertices.col(static_cast<Eigen::Index>(v)) = used_[v];
    out.facets.resize(d, static_cast<Eigen::Index>(facets_.size()));
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (int k = 0; k < d; ++k) out.facets(k, static_cast<Eigen::Index>(f)) = facets_[f][k];
    return out;
  }

 private:
  bool reaches_in(Eigen::Index f) const {
    for (int k = 0; k < d; ++k)
      if (distance_[surface_.facets(k, f)] > 0) return true;
    return false;
  }
  int add(const Vec<d>& x) {
    used_.push_back(x);
    return static_cast<int>(used_.size()) - 1;
  }
  int kept(int v) {
    if (at_[v] < 0) at_[v] = add(vertices_[v]);
    return at_[v];
  }
  int crossing(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [place, is_new] = crossings_.try_emplace({a, b}, -1);
    if (is_new)
      place->second = add(vertices_[a] + distance_[a] / (distance_[a] - distance_[b]) * (vertices_[b] - vertices_[a]));
    return place->second;
  }

  const Surface<d>& surface_;
  std::vector<double> distance_;
  std::vector<int> at_;  // in used_, of vertices
  std::vector<Vec<d>> vertices_, used_;
  std::map<std::pair<int, int>, int> crossings_;
  std::vector<std::array<int, d>> facets_;
};

}  // namespace

std::optional<Mirror> mirror_of(const Scene& scene) {
  for (const auto* kind : effect_kinds())
    if (const auto mirror = kind->mirror(scene)) return mirror;
  return {};
}

template <int d>
ShapeMirror<d> in_frame(const Mirror& mirror, const rigid::Isometry<d>& pose) {
  return {pose.linear().row(mirror.axis).transpose(), mirror.at - pose.translation()[mirror.axis]};
}

template <int d>
std::optional<double> off_plane(const Mirror& mirror, const Body& body, const Vec<d>& point) {
  const double off = mirror.distance<d>(shape_pose<d>(body) * point);
  if (std::abs(off) <= written_digits * extents<d>(outline<d>(body)).sizes().maxCoeff()) return {};
  return off;
}

template <int d>
Asymmetry<d> asymmetry_of(const Mirror& mirror, const Surface<d>& surface) {
  const Solid<d> solid(surface);
  Asymmetry<d> most;
  for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v) {
    const Vec<d> x = surface.vertices.col(v);
    if (const double distance = solid.distance(mirror.image<d>(x)); distance > most.distance) most = {distance, x};
  }
  return most;
}

template <int d>
Surface<d> kept_part(const ShapeMirror<d>& mirror, const Surface<d>& surface) {
  return Cutter<d>(mirror, surface).cut();
}

template <int d>
Surface<d> symmetrised(const ShapeMirror<d>& mirror, const Surface<d>& surface) {
  const Surface<d> half = kept_part<d>(mirror, surface);
  const double tiny = in_plane * extents<d>(surface).diagonal().norm();
  const Eigen::Index vertices = half.vertices.cols(), facets = half.facets.cols();
  Surface<d> whole;
  whole.vertices.resize(d, 2 * vertices);
  whole.vertices.leftCols(vertices) = half.vertices;
  std::vector<int> image(static_cast<std::size_t>(vertices));
  Eigen::Index count = vertices;
  for (Eigen::Index v = 0; v < vertices; ++v) {
    const Vec<d> x = half.vertices.col(v);
    const bool lies_in = std::abs(mirror.distance(x)) <= tiny;
    image[static_cast<std::size_t>(v)] = static_cast<int>(lies_in ? v : count);
    if (!lies_in) whole.vertices.col(count++) = mirror.image(x);
  }
  whole.vertices.conservativeResize(d, count);
  whole.facets.resize(d, 2 * facets);
  whole.facets.leftCols(facets) = half.facets;
  for (Eigen::Index f = 0; f < facets; ++f)
    for (int k = 0; k < d; ++k)  // the other way round
      whole.facets(k, facets + f) = image[static_cast<std::size_t>(half.facets(d - 1 - k, f))];
  return whole;
}

#define SPLASHDOWN_INSTANTIATE(d)                                                         \
  template ShapeMirror<d> in_frame<d>(const Mirror&, const rigid::Isometry<d>&);          \
  template Asymmetry<d> asymmetry_of<d>(const Mirror&, const Surface<d>&);                \
  template std::optional<double> off_plane<d>(const Mirror&, const Body&, const Vec<d>&); \
  template Surface<d> kept_part<d>(const ShapeMirror<d>&, const Surface<d>&);             \
  template Surface<d> symmetrised<d>(const ShapeMirror<d>&, const Surface<d>&);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::apps
