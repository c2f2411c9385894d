#include "apps/report/replay/mesh_code.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace splashdown::apps {
namespace {

std::size_t as_index(int number) { return static_cast<std::size_t>(number); }

class MeshCoder {
 public:
  MeshCoder(const std::vector<int>& corners, std::size_t points)
      : corners_(corners),
        told_(corners.size() / 3, 0),
        left_(told_.size()),
        number_(points, -1),
        after_(points, -1),
        before_(points, -1),
        begin_(points + 1, 0),
        at_point_(corners.size()) {
    for (const int point : corners) ++begin_[as_index(point) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    auto end = begin_;
    for (std::size_t c = 0; c < corners.size(); ++c) at_point_[end[as_index(corners[c])]++] = c;
  }

  MeshCode code() && {
    for (std::size_t t = 0; t < told_.size(); ++t) {
      if (told_[t]) continue;
      begin_patch(t);
      while (left_ > 0 && first_ < open_.size()) follow(open_[first_++]);
      open_.clear();
      first_ = 0;
    }
    return std::move(code_);
  }

 private:
  using Corners = std::array<int, 3>;

  void begin_patch(std::size_t t) {
    take(t);
    const Corners corners{corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]};
    for (const int point : corners) {
      const int newest = static_cast<int>(code_.order.size()) - 1;
      if (number_[as_index(point)] < 0)
        add_point(point, {newest, newest, newest});
      else
        name(point);
    }
    add_edges(corners);
  }

  void follow(const Corners& edge) {
    const auto [u, w, o] = edge;
    if (after_[as_index(u)] != w) return;  // closed since, or run through twice
    const auto v = neighbour(u, w);
    if (!v) return step(MeshStep::none);
    if (number_[as_index(*v)] < 0)
      add_point(*v, {number_[as_index(u)], number_[as_index(w)], number_[as_index(o)]});
    else if (*v == after_[as_index(w)])
      step(MeshStep::next);
    else if (*v == before_[as_index(u)])
      step(MeshStep::last);
    else
      name(*v);
    add_edges({w, u, *v});
  }

  /// The third point of a triangle that is not told yet and has the edge w -> u.
  std::optional<int> neighbour(int u, int w) {
    for (std::size_t k = begin_[as_index(w)]; k < begin_[as_index(w) + 1]; ++k) {
      const std::size_t corner = at_point_[k], t = corner / 3;
      if (told_[t] || corners_[3 * t + (corner + 1) % 3] != u) continue;
      take(t);
      return corners_[3 * t + (corner + 2) % 3];
    }
    return {};
  }

  void take(std::size_t t) {
    told_[t] = 1;
    --left_;
  }
  void step(MeshStep what) { code_.steps.push_back(static_cast<std::uint8_t>(what)); }
  void add_point(int point, const Expected& expected) {
    step(MeshStep::fresh);
    number_[as_index(point)] = static_cast<int>(code_.order.size());
    code_.order.push_back(point);
    code_.expected.push_back(expected);
  }
  void name(int point) {
    step(MeshStep::named);
    const auto newest = code_.order.size() - 1;
    code_.references.push_back(static_cast<std::uint32_t>(newest - as_index(number_[as_index(point)])));
  }

  void add_edges(const Corners& corners) {
    for (std::size_t k = 0; k < 3; ++k) add_edge(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
  }
  /// Closes the open edge q -> p, or opens p -> q.
  void add_edge(int p, int q, int o) {
    if (after_[as_index(q)] == p) {
      after_[as_index(q)] = -1;
      if (before_[as_index(p)] == q) before_[as_index(p)] = -1;
      return;
    }
    after_[as_index(p)] = q;
    before_[as_index(q)] = p;
    open_.push_back({p, q, o});
  }

  const std::vector<int>& corners_;
  std::vector<char> told_;             // of the triangles
  std::size_t left_;                   // that are not told yet
  std::vector<int> number_;            // of the points, -1: not told yet
  std::vector<int> after_, before_;    // of a point: the ends of the open edges that begin and end there, -1: none
  std::vector<std::size_t> begin_;     // of each point, in at_point_
  std::vector<std::size_t> at_point_;  // corners at the points
  std::vector<Corners> open_;          // u, w, o
  std::size_t first_ = 0;              // of open_, not followed yet
  MeshCode code_;
};

}  // namespace

MeshCode mesh_code(const std::vector<int>& corners, std::size_t points) { return MeshCoder(corners, points).code(); }

}  // namespace splashdown::apps
