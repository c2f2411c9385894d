// Which straight piece of a mesh a point lies in: every quadratic triangle is four of them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/simplices/quadratic.hpp"

namespace splashdown {

/// Straight triangles between corners and middles, positively oriented.
std::vector<std::array<int, 3>> straight_pieces(std::span<const std::array<int, cell_nodes<2>>> cells);

/// Buckets of triangles for points.
class PieceFinder {
 public:
  /// Where triangles are now [m].
  void place(std::span<const std::array<int, 3>> pieces, std::span<const Vec<2>> points);
  /// A place in a straight triangle.
  struct Place {
    std::size_t piece;  ///< its number
    Barycentric<2> at;  ///< where in it
  };
  /// The triangle around a point, nothing outside of all.
  std::optional<Place> find(const Vec<2>& point) const;

 private:
  std::span<const std::array<int, 3>> pieces_;
  std::span<const Vec<2>> points_;
  Vec<2> min_ = Vec<2>::Zero();
  double width_ = 1;
  int nx_ = 0, ny_ = 0;
  std::vector<std::vector<int>> buckets_;
};

}  // namespace splashdown
