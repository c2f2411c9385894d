// Nearest facet of a simplicial surface: a bounding-box tree, O(log n) a query, O(n log n) to build.
#pragma once

#include <array>
#include <vector>

#include "fluid/types.hpp"

namespace splashdown::fluid {

/// Closest point of a facet.
Vec<2> closest_on(const std::array<Vec<2>, 2>& facet, const Vec<2>& x);
Vec<3> closest_on(const std::array<Vec<3>, 3>& facet, const Vec<3>& x);

template <int d>
class FacetTree {
 public:
  struct Hit {
    int facet = -1;
    Vec<d> point = Vec<d>::Zero();  ///< closest point on the surface
    double squared_distance = 0;
  };

  FacetTree() = default;
  explicit FacetTree(const std::vector<std::array<Vec<d>, d>>& facets);
  FacetTree(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
            const Eigen::Matrix<int, d, Eigen::Dynamic>& facets);

  bool empty() const { return pieces_.empty(); }
  /// Closest point nearer than `reach`; facet = -1 if there is none. Its distance may exceed the least one by `slack`,
  /// relative: far from a curved surface all facets are about as near, and telling which one is takes long.
  Hit nearest(const Vec<d>& x, double reach, double slack = 0) const;

 private:
  using Box = Eigen::AlignedBox<double, d>;
  struct Branch {
    Box box;
    int first, count;  // leaf: pieces [first, first + count); else count = 0, children first, first + 1
  };
  struct Piece {
    std::array<Vec<d>, d> corner;
    int facet;
    Box box() const;
  };
  /// What a piece is sorted by.
  struct Key {
    Vec<d> centre;
    int piece;
  };
  void cut(const Piece& piece, double shortest);
  std::vector<Key> keys() const;
  void build(std::vector<Key>& keys, int branch, int first, int count);
  void set_boxes();

  std::vector<Piece> pieces_;  // needles come in several: boxes around whole ones hardly tell them apart
  std::vector<Branch> branches_;
};

extern template class FacetTree<2>;
extern template class FacetTree<3>;

}  // namespace splashdown::fluid
