#include "apps/scene/outlook/immersion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splashdown::apps {
namespace {

using rigid::Vec;

/// The part of a facet below a level, its corners in order around it.
template <int d>
struct CutFacet {
  std::array<Vec<d>, 4> corner;
  int count = 0;
};

template <int d>
CutFacet<d> cut_facet(const rigid::Surface<d>& hull, Eigen::Index f, double level) {
  CutFacet<d> cut;
  for (int k = 0; k < d; ++k) {
    const Vec<d> a = hull.vertices.col(hull.facets(k, f)), b = hull.vertices.col(hull.facets((k + 1) % d, f));
    const bool a_wet = a[d - 1] <= level, b_wet = b[d - 1] <= level;
    if (a_wet) cut.corner[static_cast<std::size_t>(cut.count++)] = a;
    // Segments have two corners and one edge between them.
    if (a_wet != b_wet && (d == 3 || k == 0))
      cut.corner[static_cast<std::size_t>(cut.count++)] = a + (level - a[d - 1]) / (b[d - 1] - a[d - 1]) * (b - a);
  }
  return cut;
}

void add_piece(Immersion<2>& sum, const std::array<const Vec<2>*, 2>& piece, double level) {
  const Vec<2> along = *piece[1] - *piece[0];
  sum.wetted += along.norm();
  sum.plan += std::max(0., along.x());
  sum.volume += along.x() * (level - (piece[0]->y() + piece[1]->y()) / 2);
}

void add_piece(Immersion<3>& sum, const std::array<const Vec<3>*, 3>& piece, double level) {
  const Vec<3> area = (*piece[1] - *piece[0]).cross(*piece[2] - *piece[0]) / 2;
  sum.wetted += area.norm();
  sum.plan += std::max(0., -area.z());
  sum.volume -= area.z() * (level - (piece[0]->z() + piece[1]->z() + piece[2]->z()) / 3);
}

}  // namespace

template <int d>
Immersion<d> Immersion<d>::of(const rigid::Surface<d>& hull, double level) {
  Immersion sum;
  Extents<d> box;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f) {
    const auto cut = cut_facet<d>(hull, f, level);
    for (int k = 0; k < cut.count; ++k) box.extend(cut.corner[static_cast<std::size_t>(k)]);
    for (int k = d - 1; k < cut.count; ++k) {
      std::array<const Vec<d>*, d> piece;
      piece[0] = &cut.corner[0];
      for (int j = 1; j < d; ++j)
        piece[static_cast<std::size_t>(j)] = &cut.corner[static_cast<std::size_t>(k - d + 1 + j)];
      add_piece(sum, piece, level);
    }
  }
  sum.volume = std::abs(sum.volume);
  if (!sum.dry()) sum.low = box.min(), sum.high = box.max();
  return sum;
}

template <int d>
ImmersionTable<d>::ImmersionTable(const rigid::Surface<d>& hull) {
  constexpr int depths = 48;
  constexpr double touch = 1e-6;  // a flat bottom is wet all at once
  const auto box = extents<d>(hull);
  height_ = box.sizes()[d - 1];
  at_depth_.reserve(depths + 1);
  for (int i = 0; i <= depths; ++i) {
    const double share = std::max(touch, std::pow(static_cast<double>(i) / depths, 2));
    at_depth_.push_back(Immersion<d>::of(hull, box.min()[d - 1] + share * height_));
  }
}

template <int d>
Immersion<d> ImmersionTable<d>::at(double depth) const {
  if (depth <= 0 || height_ == 0) return {};
  const double place = std::sqrt(std::min(1., depth / height_)) * static_cast<double>(at_depth_.size() - 1);
  const auto from = std::min(static_cast<std::size_t>(place), at_depth_.size() - 1),
             to = std::min(from + 1, at_depth_.size() - 1);
  const double share = place - static_cast<double>(from);
  const auto &a = at_depth_[from], &b = at_depth_[to];
  const auto between = [&](const auto& x, const auto& y) { return x + share * (y - x); };
  Immersion<d> mixed;
  mixed.wetted = between(a.wetted, b.wetted);
  mixed.plan = between(a.plan, b.plan);
  mixed.volume = between(a.volume, b.volume);
  mixed.low = a.low + share * (b.low - a.low);
  mixed.high = a.high + share * (b.high - a.high);
  return mixed;
}

template struct Immersion<2>;
template struct Immersion<3>;
template class ImmersionTable<2>;
template class ImmersionTable<3>;

}  // namespace splashdown::apps
