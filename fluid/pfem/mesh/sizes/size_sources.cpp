#include "fluid/pfem/mesh/sizes/size_sources.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splashdown::fluid {
namespace {
// A few points are looked at as fast as a box.
constexpr std::size_t leaf = 8;
// And a few dozen as fast as they are put into a tree.
constexpr std::size_t handful = 64;
// Halves of 2^64 points, and the other half at each level.
constexpr std::size_t deepest = 65;
}  // namespace

template <int d>
void SizeSources<d>::add(const SizeSource<d>& source) {
  points_.push_back(source);
  if (points_.size() - in_trees_ >= handful) gather();
}

template <int d>
void SizeSources<d>::gather() {
  SizeSources tree(growth_);
  tree.points_.assign(points_.begin() + static_cast<std::ptrdiff_t>(in_trees_), points_.end());
  in_trees_ = points_.size();
  for (; !gathered_.empty() && gathered_.back().points_.size() <= tree.points_.size(); gathered_.pop_back())
    tree.points_.insert(tree.points_.end(), gathered_.back().points_.begin(), gathered_.back().points_.end());
  tree.plant();
  gathered_.push_back(std::move(tree));
}

template <int d>
void SizeSources<d>::plant() {
  gathered_.clear();
  branches_.clear();
  if (points_.size() > leaf) grow(0, points_.size());
}

template <int d>
std::size_t SizeSources<d>::grow(std::size_t first, std::size_t last) {
  Branch branch{points_[first].at, points_[first].at, points_[first].size, first, last, 0};
  for (std::size_t i = first; i < last; ++i) {
    branch.low = branch.low.cwiseMin(points_[i].at);
    branch.high = branch.high.cwiseMax(points_[i].at);
    branch.size = std::min(branch.size, points_[i].size);
  }
  const std::size_t place = branches_.size();
  branches_.push_back(branch);
  if (last - first <= leaf) return place;
  Eigen::Index axis = 0;
  (branch.high - branch.low).maxCoeff(&axis);
  const std::size_t middle = (first + last) / 2;
  const auto begin = points_.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last),
                   [axis](const auto& a, const auto& b) { return a.at(axis) < b.at(axis); });
  grow(first, middle);
  const std::size_t right = grow(middle, last);
  branches_[place].right = right;
  return place;
}

template <int d>
double SizeSources<d>::squared_gap(const Branch& branch, const Vec<d>& x) const {
  return (x - x.cwiseMax(branch.low).cwiseMin(branch.high)).squaredNorm();
}

template <int d>
void SizeSources<d>::look(std::size_t first, std::size_t last, const Vec<d>& x, double& h) const {
  for (std::size_t i = first; i < last; ++i) {
    const auto& s = points_[i];
    const double reach = (h - s.size) / growth_;
    const double squared = (s.at - x).squaredNorm();
    if (reach > 0 && squared < reach * reach) h = s.size + growth_ * std::sqrt(squared);
  }
}

template <int d>
double SizeSources<d>::least(const Vec<d>& x, double h) const {
  if (branches_.empty()) {
    for (const auto& tree : gathered_) h = tree.least(x, h);
    look(gathered_.empty() ? 0 : in_trees_, points_.size(), x, h);
    return h;
  }
  std::array<std::size_t, deepest> open{0};
  for (std::size_t count = 1; count > 0;) {
    const std::size_t at = open[--count];
    const Branch& branch = branches_[at];
    const double reach = (h - branch.size) / growth_;
    if (reach <= 0 || squared_gap(branch, x) >= reach * reach) continue;
    if (branch.right == 0) {
      look(branch.first, branch.last, x, h);
      continue;
    }
    // The nearer half first: what it asks for rules out more of the other.
    const bool left_first = squared_gap(branches_[at + 1], x) <= squared_gap(branches_[branch.right], x);
    open[count++] = left_first ? branch.right : at + 1;
    open[count++] = left_first ? at + 1 : branch.right;
  }
  return h;
}

template class SizeSources<2>;
template class SizeSources<3>;

}  // namespace splashdown::fluid
