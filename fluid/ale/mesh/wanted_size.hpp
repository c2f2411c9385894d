// Longest edges that a mesh around hulls is asked for.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "fluid/ale/mesh/hull_line.hpp"

namespace splashdown::ale {

/// min(far, edge on a hull + growth times the distance), and `MeshSpec::size` besides.
class WantedSize {
 public:
  /// A place where an edge of a hull tells the size.
  struct Mark {
    Vec<2> at;
    double size;
  };

  /// `lines`: of the hulls, divided.
  WantedSize(const MeshSpec& spec, const std::vector<HullLine>& lines)
      : far_(spec.far), growth_(spec.growth), size_(spec.size) {
    for (const auto& line : lines)
      for (std::size_t k = 0; k < line.cuts().size(); ++k) {
        const double from = line.cuts()[k],
                     to = k + 1 < line.cuts().size() ? line.cuts()[k + 1] : line.length() + line.cuts()[0];
        marks_.push_back({line.at(from), to - from});
        marks_.push_back({line.at(0.5 * (from + to)), to - from});
      }
  }
  /// At a place [m].
  double at(const Vec<2>& x) const {
    double least = bound_at(x);
    for (const auto& mark : marks_) least = std::min(least, of(mark, x));
    return least;
  }
  /// The same by some of the marks.
  double at(const Vec<2>& x, std::span<const int> marks) const {
    double least = bound_at(x);
    for (const int m : marks) least = std::min(least, of(marks_[static_cast<std::size_t>(m)], x));
    return least;
  }
  const std::vector<Mark>& marks() const { return marks_; }  ///< ends and middles of the edges of hulls
  double far() const { return far_; }                        ///< [m]
  double growth() const { return growth_; }                  ///< dh/dx

 private:
  double bound_at(const Vec<2>& x) const { return size_ ? std::min(far_, size_(x)) : far_; }
  double of(const Mark& mark, const Vec<2>& x) const { return mark.size + growth_ * (x - mark.at).norm(); }

  double far_, growth_;
  std::function<double(const Vec<2>&)> size_;
  std::vector<Mark> marks_;
};

}  // namespace splashdown::ale
