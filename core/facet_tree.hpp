// Nearest facet of a simplicial surface: a bounding-box tree, O(log n) a query, O(n log n) to build.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

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
    Vec<d> centre() const;
    Box box() const;
  };
  void cut(const Piece& piece, double shortest);
  void build(int branch, int first, int count);

  std::vector<Piece> pieces_;  // needles come in several: boxes around whole ones hardly tell them apart
  std::vector<Branch> branches_;
};

extern template class FacetTree<2>;
extern template class FacetTree<3>;

}  // namespace splashdown
