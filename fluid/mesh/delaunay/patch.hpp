// Patches of a triangulation in space that is Delaunay but for a few cells: for moving_delaunay.cpp alone.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fluid/mesh/delaunay/delaunay.hpp"
#include "fluid/mesh/delaunay/triangulation_3.hpp"

namespace splashdown::fluid {

/// Opens the predicates of CGAL's triangulation, which break ties as it does, to cells that it does not hold.
class Predicates : public TriangulationInSpace<CGAL::Sequential_tag> {
 public:
  using TriangulationInSpace<CGAL::Sequential_tag>::orientation;
  using TriangulationInSpace<CGAL::Sequential_tag>::side_of_oriented_sphere;
};

struct FacetAt {
  static constexpr int whole_cell = -1;
  int cell, corner;  ///< the corner opposite, or `whole_cell`
};

/// A triangulation whose points have moved: cells may have turned over, and points be gone (negative). Its hull, the points far
/// away, stays as it is. (Where the hull is the nodes' own, patches beside each other may fold it, and no local test tells.)
class MovedCells {
 public:
  using Cell = std::array<int, 4>;

  MovedCells(ClosedDelaunay& mesh, std::span<const Vec<3>> points);

  ClosedDelaunay& mesh;
  const int infinity;                                   ///< number of the vertex there
  std::vector<Kernel::Point_3> at;                      ///< points
  std::unordered_map<int, std::vector<int>> to_insert;  ///< new points by the cell that they lie in

  bool finite(const Cell& cell) const;
  static bool lost_a_corner(const Cell& cell);
  bool positive(const Cell& cell) const;  ///< of a finite one
  /// The point lies in the circumsphere of a positive cell.
  bool in_conflict(const Cell& cell, int point) const;
  /// No conflict across the facet of a positive cell. True where the cell beyond has lost a corner or is at infinity.
  bool locally_delaunay(const FacetAt& f) const;
  /// Cell and corner on the other side.
  FacetAt beyond(const FacetAt& f) const;
  /// Corners of the facet in the order that tells its sides apart: the other cell has them in another order.
  static std::array<int, 3> facet_of(const Cell& cell, int corner);
  /// Walks towards a point, in a triangulation that is Delaunay: the cell that holds it.
  int locate(int point, int start) const;

 private:
  Predicates is_;
};

/// Cells that are given up and those that take their place.
struct Patch {
  std::vector<FacetAt> seeds;                ///< what is wrong
  std::vector<int> seed_cells;               ///< with it
  std::vector<int> old;                      ///< cells that are given up
  std::vector<FacetAt> rim;                  ///< their outer facets
  std::vector<MovedCells::Cell> cells;       ///< new ones
  std::vector<MovedCells::Cell> neighbours;  ///< among the new ones, or -1 - number of a facet of the rim
  /// What patches that grow at the same time may see of each other.
  enum State { waiting, growing, found, yielded, failed };
  std::unique_ptr<std::atomic<State>> state = std::make_unique<std::atomic<State>>(waiting);
};

struct Patches {
  std::vector<Patch> list;
  std::unordered_map<int, int> of;  ///< patch by the cells of their seeds

  /// Seeds that share a cell belong together.
  Patches(const std::vector<FacetAt>& wrong, const ClosedDelaunay& mesh);
};

/// Grows one patch at a time: each thread has its own.
class PatchGrower {
 public:
  /// Takes cells into the patch until the Delaunay triangulation of its points alone holds all facets of its rim, and finds
  /// the cells within. Takes in patches that have not begun; of two that grow into each other the later one yields. Points
  /// that it triangulates are taken from `budget`; it fails where nothing is left, or points coincide.
  void grow(Patches& patches, int number, const MovedCells& mesh, std::atomic<std::ptrdiff_t>& budget);

 private:
  using Triangulation = TriangulationInSpace<CGAL::Sequential_tag>;
  using Handle = Triangulation::Cell_handle;
  using Cell = MovedCells::Cell;
  struct Inner {
    Handle cell;
    int corner;
  };

  void begin(int number);
  void extend();
  bool goes_on() const { return *patch().state == Patch::growing; }
  bool has(int cell) const { return cells_[cell] == stamp_; }
  Patch& patch() const { return patches_->list[number_]; }
  void take_in(int cell);
  void meet(int cell);
  void insert(int point);
  std::optional<Inner> within(const FacetAt& f) const;
  bool holds(const FacetAt& f) const;
  bool cut_out();
  Cell corners_of(Handle cell) const;

  Patches* patches_ = nullptr;
  const MovedCells* mesh_ = nullptr;
  std::atomic<std::ptrdiff_t>* budget_ = nullptr;
  int number_ = 0;
  Triangulation t_;
  Handle hint_;
  int stamp_ = 0;                                        // of the present patch
  std::vector<int> cells_, points_;                      // stamp of the last patch that took them in
  std::vector<Triangulation::Vertex_handle> vertex_of_;  // points
  std::vector<int> taken_;                               // points of the present patch
};

}  // namespace splashdown::fluid
