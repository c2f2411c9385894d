#include "core/simplices/piece_finder.hpp"

#include <algorithm>
#include <cmath>

#include "core/simplices/split.hpp"

namespace splashdown {

std::vector<std::array<int, 3>> straight_pieces(std::span<const std::array<int, cell_nodes<2>>> cells) {
  std::vector<std::array<int, 3>> pieces;
  for (const auto& cell : cells)
    for (const auto& [a, b, c] : cell_parts<2>())
      pieces.push_back(
          {cell[static_cast<std::size_t>(a)], cell[static_cast<std::size_t>(b)], cell[static_cast<std::size_t>(c)]});
  return pieces;
}

void PieceFinder::place(std::span<const std::array<int, 3>> pieces, std::span<const Vec<2>> points) {
  pieces_ = pieces;
  points_ = points;
  Vec<2> max = points[0];
  min_ = points[0];
  for (const auto& x : points) {
    min_ = min_.cwiseMin(x);
    max = max.cwiseMax(x);
  }
  const Vec<2> size = max - min_;
  width_ = std::sqrt(size.prod() / static_cast<double>(pieces.size()));
  nx_ = static_cast<int>(size.x() / width_) + 1;
  ny_ = static_cast<int>(size.y() / width_) + 1;
  buckets_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), {});
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    Vec<2> low = points[static_cast<std::size_t>(pieces[t][0])], high = low;
    for (const int a : pieces[t]) {
      low = low.cwiseMin(points[static_cast<std::size_t>(a)]);
      high = high.cwiseMax(points[static_cast<std::size_t>(a)]);
    }
    const Eigen::Array2i from = ((low - min_) / width_).array().floor().cast<int>(),
                         to = ((high - min_) / width_).array().floor().cast<int>();
    for (int j = from.y(); j <= to.y(); ++j)
      for (int i = from.x(); i <= to.x(); ++i)
        buckets_[static_cast<std::size_t>(j * nx_ + i)].push_back(static_cast<int>(t));
  }
}

std::optional<PieceFinder::Place> PieceFinder::find(const Vec<2>& point) const {
  constexpr double roundoff = 1e-9;
  const Eigen::Array2d bucket = ((point - min_) / width_).array().floor();
  if ((bucket < 0).any() || bucket.x() >= nx_ || bucket.y() >= ny_) return {};
  for (const int t : buckets_[static_cast<std::size_t>(bucket.y()) * static_cast<std::size_t>(nx_) +
                              static_cast<std::size_t>(bucket.x())]) {
    const auto& piece = pieces_[static_cast<std::size_t>(t)];
    const Vec<2>& a = points_[static_cast<std::size_t>(piece[0])];
    const Vec<2> ab = points_[static_cast<std::size_t>(piece[1])] - a,
                 ac = points_[static_cast<std::size_t>(piece[2])] - a, ap = point - a;
    const double det = ab.x() * ac.y() - ab.y() * ac.x();
    const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / det, w = (ab.x() * ap.y() - ab.y() * ap.x()) / det;
    const Barycentric<2> at(1 - v - w, v, w);
    if (at.minCoeff() >= -roundoff) return Place{static_cast<std::size_t>(t), at};
  }
  return {};
}

}  // namespace splashdown
