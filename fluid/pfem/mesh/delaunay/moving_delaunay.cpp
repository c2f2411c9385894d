#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "fluid/pfem/mesh/delaunay/flips.hpp"
#include "fluid/pfem/mesh/delaunay/patch.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

template <int d>
class Update {
 public:
  Update(ClosedDelaunay<d>& mesh, std::span<const Vec<d>> points)
      : mesh_(mesh), moved_(mesh, points), budget_(2 * static_cast<std::ptrdiff_t>(points.size())) {}

  /// False: too much has changed.
  bool run(std::span<const int> before, std::size_t points_before) {
    constexpr std::size_t few = 4;  // cells to a facet that is wrong: with fewer, patches would join
    const auto starts = near_new_points(before);
    if (!renumber(before, points_before)) return false;
    std::vector<int> all(mesh_.cells.size());
    std::iota(all.begin(), all.end(), 0);
    auto wrong = scan(all);
    if constexpr (d == 2) wrong = left_by_flips(wrong);
    if (few * wrong.size() > mesh_.cells.size() || !mend(wrong)) return false;
    std::vector<FacetAt> to_split;
    for (auto [point, start] : starts) {
      while (gone(start)) start = (start + 1) % static_cast<int>(mesh_.cells.size());
      auto& points = moved_.to_insert[moved_.locate(point, start)];
      points.push_back(point);
    }
    for (const auto& [cell, points] : moved_.to_insert) to_split.push_back({cell, FacetAt::whole_cell});
    return mend(std::move(to_split));
  }

 private:
  using Cell = typename MovedCells<d>::Cell;
  static constexpr int far = ClosedDelaunay<d>::far;

  bool gone(int cell) const { return mesh_.cells[cell][0] == ClosedDelaunay<d>::gone; }

  // New points, and cells near them: cells are sorted by their corners, and points near each other have numbers that are.
  std::vector<std::pair<int, int>> near_new_points(std::span<const int> before) const {
    std::vector<std::pair<int, int>> out;
    const auto end = mesh_.cells.begin() + static_cast<std::ptrdiff_t>(mesh_.near);
    int known = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] >= 0) {
        known = before[i];
        continue;
      }
      const auto cell = std::lower_bound(mesh_.cells.begin(), end, Cell{known});
      out.emplace_back(static_cast<int>(i), static_cast<int>((cell == end ? end - 1 : cell) - mesh_.cells.begin()));
    }
    return out;
  }

  bool renumber(std::span<const int> before, std::size_t points_before) {
    constexpr int gone_point = -2;
    std::vector<int> now(points_before + far + 1, gone_point);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] < 0) continue;
      if (before[i] >= static_cast<int>(points_before) || now[before[i]] != gone_point) return false;
      now[before[i]] = static_cast<int>(i);
    }
    std::iota(now.begin() + static_cast<std::ptrdiff_t>(points_before), now.end(), static_cast<int>(before.size()));
    in_parallel(mesh_.cells.size(), [&](std::size_t c) {
      for (int& n : mesh_.cells[c]) n = now[n];
    });
    return true;
  }

  // All that is wrong with cells, in their order.
  std::vector<FacetAt> scan(const std::vector<int>& cells) const {
    PerThread<std::vector<FacetAt>> found;
    in_parallel(cells.size(), [&](std::size_t i) {
      const int c = cells[i];
      const Cell& cell = mesh_.cells[c];
      if (!moved_.finite(cell)) return;
      const bool lost = MovedCells<d>::lost_a_corner(cell), turned = !lost && !moved_.positive(cell);
      if (lost || turned) found.local().push_back({c, FacetAt::whole_cell});
      for (int k = 0; k <= d && !turned; ++k)
        // Cells around a point that is lost belong together.
        if (lost ? cell[k] >= 0 : c < mesh_.neighbours[c][k] && !moved_.locally_delaunay({c, k}))
          found.local().push_back({c, k});
    });
    std::vector<FacetAt> out;
    for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
    std::ranges::sort(out);
    return out;
  }

  // What flips cannot mend. It is with cells that were wrong or have been flipped, or beside them.
  std::vector<FacetAt> left_by_flips(const std::vector<FacetAt>& wrong) requires(d == 2) {
    std::vector<FacetAt> edges;
    std::ranges::copy_if(wrong, std::back_inserter(edges), [](auto& f) { return f.corner != FacetAt::whole_cell; });
    std::vector<int> cells = Flips(moved_).make_delaunay(std::move(edges));
    for (const FacetAt& f : wrong) cells.push_back(f.cell);
    for (std::size_t i = cells.size(); i-- > 0;)
      cells.insert(cells.end(), mesh_.neighbours[cells[i]].begin(), mesh_.neighbours[cells[i]].end());
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return scan(cells);
  }

  // Rounds of patches that do not overlap.
  bool mend(std::vector<FacetAt> wrong) {
    constexpr int most_rounds = 30;
    for (int round = 0; !wrong.empty(); ++round) {
      if (round == most_rounds) return false;
      Patches<d> patches(wrong, mesh_);
      in_pieces(patches.list.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) growers_.local().grow(patches, static_cast<int>(p), moved_, budget_);
      });
      wrong.clear();
      replaced_.assign(mesh_.cells.size(), 0);
      std::vector<FacetAt> rims;
      for (const Patch<d>& patch : patches.list) {
        if (*patch.state == Patch<d>::failed) return false;
        if (*patch.state == Patch<d>::found &&
            std::none_of(patch.old.begin(), patch.old.end(), [&](int c) { return replaced_[c]; }))
          replace(patch, rims);
      }
      // What nobody mended, and what lies beyond a rim and has been replaced since.
      for (const Patch<d>& patch : patches.list)
        for (const FacetAt& f : patch.seeds)
          if (!replaced_[f.cell] && (f.corner == FacetAt::whole_cell || !replaced_[moved_.beyond(f).cell]))
            wrong.push_back(f);
      for (const FacetAt& f : rims)
        if (!moved_.locally_delaunay(f)) wrong.push_back(f);
    }
    return true;
  }

  void replace(const Patch<d>& patch, std::vector<FacetAt>& rims) {
    std::vector<FacetAt> beyond;
    for (const FacetAt& f : patch.rim) beyond.push_back(moved_.beyond(f));
    std::vector<int> slot = patch.old;
    for (int c : patch.old) {
      replaced_[c] = 1;
      moved_.to_insert.erase(c);
      mesh_.cells[c][0] = ClosedDelaunay<d>::gone;
    }
    while (slot.size() < patch.cells.size()) {
      slot.push_back(static_cast<int>(mesh_.cells.size()));
      mesh_.cells.emplace_back();
      mesh_.neighbours.emplace_back();
      replaced_.push_back(1);
    }
    for (std::size_t i = 0; i < patch.cells.size(); ++i) {
      mesh_.cells[slot[i]] = patch.cells[i];
      for (int k = 0; k <= d; ++k) {
        const int n = patch.neighbours[i][k];
        if (n >= 0) {
          mesh_.neighbours[slot[i]][k] = slot[n];
          continue;
        }
        const FacetAt& outer = beyond[-1 - n];
        mesh_.neighbours[slot[i]][k] = outer.cell;
        mesh_.neighbours[outer.cell][outer.corner] = slot[i];
        rims.push_back({slot[i], k});
      }
    }
  }

  ClosedDelaunay<d>& mesh_;
  MovedCells<d> moved_;
  std::vector<char> replaced_;  // cells, in this round
  PerThread<PatchGrower<d>> growers_;
  std::atomic<std::ptrdiff_t> budget_;  // of points in patches: after that much in vain it costs half as much again
};

}  // namespace

template <int d>
Delaunay<d> MovingDelaunay<d>::follow(std::span<const Vec<d>> points, std::span<const int> before,
                                      const std::vector<Facet<d>>& facets, std::span<const Vec<d>> hubs) {
  std::vector<Vec<d>> all(points.begin(), points.end());
  all.insert(all.end(), hubs.begin(), hubs.end());
  std::vector<int> all_before(before.begin(), before.end());
  for (std::size_t k = 0; k < hubs.size(); ++k)
    all_before.push_back(hubs.size() == hubs_ ? static_cast<int>(points_ + k) : -1);
  ClosedDelaunay<d> mesh = std::exchange(last_, {});  // of a call that throws nothing is kept
  if (mesh.complete && mesh.extent == extent_of<d>(all) && Update<d>(mesh, all).run(all_before, points_ + hubs_)) {
    sort_cells<d>(mesh, all.size());
    ++followed_;
  } else {
    mesh = closed_delaunay<d>(all);
  }
  last_ = std::move(mesh);
  points_ = points.size();
  hubs_ = hubs.size();
  return near_part<d>(last_, all, facets, hubs_);
}

template class MovingDelaunay<2>;
template class MovingDelaunay<3>;

}  // namespace splashdown::fluid
