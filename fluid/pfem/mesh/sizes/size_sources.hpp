// Points that ask for small elements, h = size + growth * distance, and the least that any of them asks for at a place.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace splashdown::fluid {

/// A point with an element size [m].
template <int d>
struct SizeSource {
  Vec<d> at;
  double size;
};

/// Many of them, in a tree.
template <int d>
class SizeSources {
 public:
  /// `growth`: dh/dx [-].
  explicit SizeSources(double growth) : growth_(growth) {}
  /// One more; before `plant`. It is asked for at once: hulls of many facets have thousands that others already imply.
  void add(const SizeSource<d>& source);
  /// Puts them into a tree: jets of a fine mesh have hundreds, and every node asks.
  void plant();
  /// h, or less if a source asks for less.
  double least(const Vec<d>& x, double h) const;

 private:
  /// Points in [first, last), their box and their least size. The left half follows in the list; right = 0: a leaf.
  struct Branch {
    Vec<d> low, high;
    double size;
    std::size_t first, last, right;
  };
  /// Those of which no tree knows, with trees that hold no more (Bentley and Saxe 1980): n points in n log^2 n steps.
  void gather();
  std::size_t grow(std::size_t first, std::size_t last);
  double squared_gap(const Branch& branch, const Vec<d>& x) const;
  void look(std::size_t first, std::size_t last, const Vec<d>& x, double& h) const;

  double growth_;
  std::vector<SizeSource<d>> points_;
  std::vector<Branch> branches_;
  std::vector<SizeSources> gathered_;  // before `plant`: trees of the first points
  std::size_t in_trees_ = 0;           // that many
};

extern template class SizeSources<2>;
extern template class SizeSources<3>;

}  // namespace splashdown::fluid
