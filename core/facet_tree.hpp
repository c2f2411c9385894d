// Nearest facet of a simplicial surface: a bounding-box tree, O(log n) a query, O(n log n) to build.
// In 3D pieces and leaves have tight boxes, too, with an axis along the normal (Gottschalk, Lin, Manocha 1996): upright boxes
// of slanted facets overlap so much that a query at a cone of needles would look at two hundred of them.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// Facets of one surface, or any others, to be searched. Const calls may come from all threads.
template <int d>
class FacetTree {
 public:
  /// What `nearest` has found.
  struct Hit {
    int facet = -1;                 ///< its number; -1: none within reach
    Vec<d> point = Vec<d>::Zero();  ///< closest point on the surface
    double squared_distance = 0;    ///< [m^2]
  };

  FacetTree() = default;
  /// Of facets given by their corners [m], one frame for all; they are copied.
  explicit FacetTree(const std::vector<std::array<Vec<d>, d>>& facets);
  /// Of the facets of a `Surface`: vertices [m], d x n, and vertex indices, d x m.
  FacetTree(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
            const Eigen::Matrix<int, d, Eigen::Dynamic>& facets);

  /// The same facets where their vertices are now. In 2D with the same branches, O(n): boxes overlap more as the surface is
  /// deformed.
  FacetTree moved(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
                  const Eigen::Matrix<int, d, Eigen::Dynamic>& facets) const;

  /// Whether there are no facets.
  bool empty() const { return pieces_.empty(); }
  /// Closest point nearer than `reach`; facet = -1 if there is none. Its distance may exceed the least one by `slack`,
  /// relative: far from a curved surface all facets are about as near, and telling which one is takes long. In 3D the first of
  /// facets that are equally near.
  Hit nearest(const Vec<d>& x, double reach, double slack = 0) const;
  /// An upright box: corners `min` and `max` [m].
  using Box = Eigen::AlignedBox<double, d>;
  /// All facets that meet an upright box, and some that pass near it, in ascending order.
  std::vector<int> meeting(const Box& box) const;

 private:
  /// A box that is turned: rows of `axes` are its directions.
  struct TightBox {
    Eigen::Matrix<double, d, d> axes;
    Box box;
  };
  struct Branch {
    Box box;
    int first, count;  // leaf: pieces [first, first + count); else count = 0, children first, first + 1
    int leaf = -1;     // of leaves_
  };
  struct Piece {
    std::array<Vec<d>, d> corner;
    int facet;
    Box box() const;
  };
  /// In 3D branches are looked at by fours: single precision, rounded outwards.
  struct Four {
    std::array<Eigen::Array4f, d> low, high;
    std::array<int, 4> to;  // a four, or ~ a leaf of branches_
    int count = 0;          // in use
  };
  /// The tight boxes of a leaf's pieces, side by side, as `Four` has them; about a centre, which keeps their digits.
  struct Leaf {
    Vec<d> centre;
    std::array<std::array<Eigen::Array4f, d>, d> axes;
    std::array<Eigen::Array4f, d> low, high;
    /// Not above the squares of the distances.
    Eigen::Array4f least_squared_distances(const Vec<d>& x) const;
  };
  /// What a piece is sorted by.
  struct Key {
    Vec<d> centre;
    int piece;
  };
  void cut(const Piece& piece, double shortest);
  std::vector<Key> keys() const;
  void build(std::vector<Key>& keys, int branch, int first, int count);
  void set_roundoff(const Box& whole);
  void set_boxes();
  TightBox tight_box(const Piece& piece) const;
  Leaf leaf_of(int first, int count) const;
  int by_fours(int branch);
  void look_into(const Branch& leaf, const Vec<d>& x, double loose, Hit& best) const;
  void search_fours(const Vec<d>& x, double loose, Hit& best) const;

  std::vector<Piece> pieces_;  // needles come in several: boxes around whole ones hardly tell them apart
  std::vector<Branch> branches_;
  std::vector<Four> fours_;
  std::vector<Leaf> leaves_;  // none in 2D
  double roundoff_ = 0;       // of coordinates [m]
};

extern template class FacetTree<2>;
extern template class FacetTree<3>;

}  // namespace splashdown
