#include "fluid/ale/mesh/node_count.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "fluid/ale/mesh/wanted_size.hpp"

namespace splashdown::ale {
namespace {

/// The integral of 1/h^2 over the part of a rectangle that no hull holds. It is quartered until it is as small as the elements in
/// it, h growing by `growth` per unit distance at most; each quarter looks at those marks alone that may give the least h in it.
/// Where that makes too many, rectangles are four elements wide, or sixteen.
class Elements {
 public:
  Elements(const std::vector<HullLine>& lines, const WantedSize& wanted) : lines_(lines), wanted_(wanted) {}

  double in(const Vec<2>& middle, const Vec<2>& size) {
    std::vector<int> marks(wanted_.marks().size());
    std::iota(marks.begin(), marks.end(), 0);
    for (breadth_ = 1;; breadth_ *= 4) {
      count_ = 0;
      const double sum = in(middle, size, marks);
      if (count_ < most_) return sum;
    }
  }

 private:
  static constexpr int most_ = 100'000;  // rectangles that are looked at

  /// Of the places where h is told, those that may give the least one within a circle.
  std::vector<int> nearest(const std::vector<int>& marks, const Vec<2>& middle, double radius) const {
    const auto& all = wanted_.marks();
    const auto least_h = [&](int m, double farther) {
      const auto& mark = all[static_cast<std::size_t>(m)];
      return mark.size + wanted_.growth() * std::max(0., (middle - mark.at).norm() + farther);
    };
    double least = wanted_.far();
    for (const int m : marks) least = std::min(least, least_h(m, radius));
    std::vector<int> kept;
    for (const int m : marks)
      if (least_h(m, -radius) <= least) kept.push_back(m);
    return kept;
  }

  double in(const Vec<2>& middle, const Vec<2>& size, const std::vector<int>& of_parent) {
    if (++count_ >= most_) return 0;
    const double radius = 0.5 * size.norm();
    const auto marks = nearest(of_parent, middle, radius);
    const double h = wanted_.at(middle, marks);
    const double most = size.maxCoeff() / breadth_;
    if (most > h - wanted_.growth() * radius && most > 0.5 * h) {
      double sum = 0;
      for (const double x : {-0.25, 0.25})
        for (const double y : {-0.25, 0.25}) sum += in(middle + Vec<2>(x, y).cwiseProduct(size), 0.5 * size, marks);
      return sum;
    }
    if (std::ranges::any_of(lines_, [&](const HullLine& line) { return line.holds(middle); })) return 0;
    return size.prod() / (h * h);
  }

  const std::vector<HullLine>& lines_;
  const WantedSize& wanted_;
  double breadth_ = 1;  // of a rectangle, in elements
  int count_ = 0;
};

}  // namespace

double foreseen_nodes(const MeshSpec& spec) {
  // Of random meshes (FlowMesh.has_as_many_nodes_as_foreseen): their longest edges are as long as asked, the others shorter.
  constexpr double by_area = 10, by_edge = 2;
  const auto lines = divided_lines(spec);
  const WantedSize wanted(spec, lines);
  const Vec<2> size = spec.max - spec.min;
  double edges = 2 * size.sum() / spec.far;
  for (const auto& line : lines) edges += static_cast<double>(line.cuts().size());
  return by_area * Elements(lines, wanted).in(0.5 * (spec.min + spec.max), size) + by_edge * edges;
}

}  // namespace splashdown::ale
