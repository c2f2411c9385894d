#include "rigid/shapes/hollows.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/geometry.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

std::size_t index(int vertex) { return static_cast<std::size_t>(vertex); }

/// What lies below a level, in components that grow and join as it rises.
class RisingLevel {
 public:
  RisingLevel(const std::vector<int>& ascending, double shallow)
      : shallow_(shallow),
        parent_(ascending.size()),
        parts_(ascending.size()),
        rank_(ascending.size()),
        reached_(ascending.size(), std::numeric_limits<double>::lowest()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t i = 0; i < ascending.size(); ++i) rank_[index(ascending[i])] = i;
  }

  bool is_below(int vertex, int other) const { return rank_[index(vertex)] < rank_[index(other)]; }
  /// The level comes to the bottom of a new component.
  void begin(int vertex, double height, bool hollow) { parts_[index(vertex)] = {vertex, height, hollow, {vertex}}; }
  /// It comes to a vertex, at this height, that joins the components of lower ones.
  void join(int vertex, const std::vector<int>& lower, double height);
  std::vector<double> reached() && { return std::move(reached_); }

 private:
  struct Part {
    int bottom = -1;
    double height = 0;  // of the bottom
    bool hollow = false;
    std::vector<int> members;
  };
  Part& part(int root) { return parts_[index(root)]; }
  int root(int v) {
    while (parent_[index(v)] != v) v = parent_[index(v)] = parent_[index(parent_[index(v)])];
    return v;
  }

  double shallow_;  // depth of hollows that do not count
  std::vector<int> parent_;
  std::vector<Part> parts_;        // of roots
  std::vector<std::size_t> rank_;  // of vertices, in ascending order
  std::vector<double> reached_;
};

void RisingLevel::join(int vertex, const std::vector<int>& lower, double height) {
  std::vector<int> roots;
  for (const int v : lower) roots.push_back(root(v));
  std::ranges::sort(roots);
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  const int deepest = *std::ranges::min_element(roots, {}, [&](int r) { return rank_[index(part(r).bottom)]; });
  const int largest = *std::ranges::max_element(roots, {}, [&](int r) { return part(r).members.size(); });
  const int bottom = part(deepest).bottom;
  const double depth = part(deepest).height;
  const bool hollow = part(deepest).hollow;
  for (const int r : roots)
    if (part(r).hollow && !hollow && height - part(r).height > shallow_)
      for (const int v : part(r).members) reached_[index(v)] = height;
  auto& members = part(largest).members;
  for (const int r : roots) {
    if (r == largest) continue;
    members.insert(members.end(), part(r).members.begin(), part(r).members.end());
    part(r).members = {};
    parent_[index(r)] = largest;
  }
  members.push_back(vertex);
  parent_[index(vertex)] = largest;
  part(largest).bottom = bottom;
  part(largest).height = depth;
  part(largest).hollow = hollow;
}

/// An edge or corner between two facets at which the solid is not convex.
template <int d>
bool is_concave(const Surface<d>& surface, int facet, int other) {
  const FacetCorners<d> a = facet_corners<d>(surface, facet), b = facet_corners<d>(surface, other);
  const Vec<d> normal = area_vector(a);
  const double scale = normal.norm() * (b[0] - a[0]).norm();
  constexpr double flat = 1e-12;
  return std::ranges::any_of(b, [&](const Vec<d>& x) { return normal.dot(x - a[0]) > flat * scale; });
}

}  // namespace

template <int d>
Hollows<d>::Hollows(const Surface<d>& surface) : surface_(&surface) {
  const auto count = static_cast<std::size_t>(surface.vertices.cols());
  neighbours_.resize(count);
  facets_.resize(count);
  for (int f = 0; f < surface.facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const int v = surface.facets(k, f);
      facets_[index(v)].push_back(f);
      for (int j = 1; j < d; ++j) neighbours_[index(v)].push_back(surface.facets((k + j) % d, f));
    }
  for (std::size_t v = 0; v < count; ++v) {
    const auto& around = facets_[v];
    const bool concave = std::ranges::any_of(around, [&](int f) {
      return std::ranges::any_of(around, [&](int g) { return f != g && is_concave<d>(surface, f, g); });
    });
    if (concave) concave_.push_back(static_cast<int>(v));
  }
}

template <int d>
bool Hollows<d>::is_bottom(const Corners& turned, int v) const {
  const double height = turned(d - 1, v);
  return std::ranges::all_of(neighbours_[index(v)],
                             [&](int w) { return turned(d - 1, w) > height || (turned(d - 1, w) == height && w > v); });
}

template <int d>
bool Hollows<d>::opens_upward(const Corners& turned, int v) const {
  const Vec<d> bottom = turned.col(v);
  double longest = 0;
  for (const int w : neighbours_[index(v)]) longest = std::max(longest, (turned.col(w) - bottom).norm());
  // Facets cut off at one height enclose a polygon: its area has the sign. Level ones are cut off far away.
  constexpr double level = 1e-9;
  double area = 0;
  for (const int f : facets_[index(v)]) {
    FacetCorners<d> cut = facet_corners<d>(*surface_, f);
    for (int k = 0; k < d; ++k) {
      const int w = surface_->facets(k, f);
      Vec<d> x = turned.col(w) - bottom;
      if (w != v) x /= std::max(x(d - 1) / longest, level);
      cut[static_cast<std::size_t>(k)] = x;
    }
    area += area_vector(cut)(d - 1);
  }
  return area > 0;
}

template <int d>
std::vector<int> Hollows<d>::bottoms(const Corners& turned) const {
  std::vector<int> found;
  std::ranges::copy_if(concave_, std::back_inserter(found),
                       [&](int v) { return is_bottom(turned, v) && opens_upward(turned, v); });
  return found;
}

template <int d>
std::vector<double> Hollows<d>::rims(const Corners& turned) const {
  if (bottoms(turned).empty()) return {};
  std::vector<int> ascending(neighbours_.size());
  std::iota(ascending.begin(), ascending.end(), 0);
  std::ranges::sort(ascending, {}, [&](int v) { return std::pair(turned(d - 1, v), v); });
  constexpr double roughness = 1e-3;  // of the hull's height: dents of facets and of files' digits
  const auto heights = turned.row(d - 1);
  RisingLevel level(ascending, roughness * (heights.maxCoeff() - heights.minCoeff()));
  std::vector<int> lower;
  for (const int v : ascending) {
    lower.clear();
    for (const int w : neighbours_[index(v)])
      if (level.is_below(w, v)) lower.push_back(w);
    if (lower.empty())
      level.begin(v, heights(v), opens_upward(turned, v));
    else
      level.join(v, lower, heights(v));
  }
  auto reached = std::move(level).reached();
  if (std::ranges::max(reached) == std::numeric_limits<double>::lowest()) reached.clear();
  return reached;
}

template class Hollows<2>;
template class Hollows<3>;

}  // namespace splashdown::rigid
