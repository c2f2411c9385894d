// Patches of a triangulation that is Delaunay but for a few cells: for moving_delaunay.cpp alone.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fluid/pfem/mesh/delaunay/moved_cells.hpp"

namespace splashdown::fluid {

/// Cells that are given up and those that take their place.
template <int d>
struct Patch {
  /// Numbers of corners.
  using Cell = typename MovedCells<d>::Cell;
  std::vector<FacetAt> seeds;    ///< what is wrong
  std::vector<int> seed_cells;   ///< with it
  std::vector<int> old;          ///< cells that are given up
  std::vector<FacetAt> rim;      ///< their outer facets
  std::vector<Cell> cells;       ///< new ones
  std::vector<Cell> neighbours;  ///< among the new ones, or -1 - number of a facet of the rim
  /// What patches that grow at the same time may see of each other.
  enum State { waiting, growing, found, yielded, failed };
  std::unique_ptr<std::atomic<State>> state = std::make_unique<std::atomic<State>>(waiting);
};

/// All patches of one triangulation.
template <int d>
struct Patches {
  std::vector<Patch<d>> list;
  std::unordered_map<int, int> of;  ///< patch by the cells of their seeds

  /// Seeds that share a cell belong together.
  Patches(const std::vector<FacetAt>& wrong, const ClosedDelaunay<d>& mesh);
};

/// Grows one patch at a time: each thread has its own.
template <int d>
class PatchGrower {
 public:
  /// Takes cells into the patch until the Delaunay triangulation of its points alone holds all facets of its rim, and finds
  /// the cells within. Takes in patches that have not begun; of two that grow into each other the later one yields. Points
  /// that it triangulates are taken from `budget`; it fails where nothing is left, or points coincide.
  void grow(Patches<d>& patches, int number, const MovedCells<d>& mesh, std::atomic<std::ptrdiff_t>& budget);

 private:
  using Triangulation = typename Cgal<d>::Triangulation;
  using Vertex = typename Triangulation::Vertex_handle;
  using Handle = typename Cgal<d>::Cell;
  using Cell = typename MovedCells<d>::Cell;
  struct Inner {
    Handle cell;
    int corner;
  };

  void begin(int number);
  void extend();
  bool goes_on() const { return *patch().state == Patch<d>::growing; }
  bool has(int cell) const { return cells_[cell] == stamp_; }
  Patch<d>& patch() const { return patches_->list[number_]; }
  void take_in(int cell);
  void meet(int cell);
  void insert(int point);
  std::optional<Inner> cell_at(const std::array<Vertex, d>& facet) const;
  std::optional<Inner> within(const FacetAt& f) const;
  bool holds(const FacetAt& f) const;
  bool cut_out();
  Cell corners_of(Handle cell) const;

  Patches<d>* patches_ = nullptr;
  const MovedCells<d>* mesh_ = nullptr;
  std::atomic<std::ptrdiff_t>* budget_ = nullptr;
  int number_ = 0;
  Triangulation t_;
  Handle hint_;
  int stamp_ = 0;                    // of the present patch
  std::vector<int> cells_, points_;  // stamp of the last patch that took them in
  std::vector<Vertex> vertex_of_;    // points
  std::vector<int> taken_;           // points of the present patch
};

}  // namespace splashdown::fluid
