#include "fluid/facet_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace splashdown::fluid {

Vec<2> closest_on(const std::array<Vec<2>, 2>& f, const Vec<2>& x) {
  const Vec<2> e = f[1] - f[0];
  const double t = std::clamp((x - f[0]).dot(e) / e.squaredNorm(), 0.0, 1.0);
  return f[0] + t * e;
}

namespace {
Vec<3> closest_on_edge(const Vec<3>& a, const Vec<3>& b, const Vec<3>& x) {
  const Vec<3> e = b - a;
  return a + std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
}
}  // namespace

Vec<3> closest_on(const std::array<Vec<3>, 3>& f, const Vec<3>& x) {
  const Vec<3> n = (f[1] - f[0]).cross(f[2] - f[0]);
  bool inside = true;
  for (int k = 0; k < 3; ++k) inside = inside && n.dot((f[(k + 1) % 3] - f[k]).cross(x - f[k])) >= 0;
  if (inside) return x - n * (n.dot(x - f[0]) / n.squaredNorm());
  Vec<3> best = f[0];
  for (int k = 0; k < 3; ++k) {
    const Vec<3> c = closest_on_edge(f[k], f[(k + 1) % 3], x);
    if ((c - x).squaredNorm() < (best - x).squaredNorm()) best = c;
  }
  return best;
}

template <int d>
FacetTree<d>::FacetTree(Eigen::Matrix<double, d, Eigen::Dynamic> vertices, Eigen::Matrix<int, d, Eigen::Dynamic> facets)
    : vertices_(std::move(vertices)), facets_(std::move(facets)), order_(facets_.cols()) {
  if (order_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec<d>> centre(order_.size());
  for (std::size_t f = 0; f < order_.size(); ++f) {
    centre[f].setZero();
    for (int k = 0; k < d; ++k) centre[f] += vertices_.col(facets_(k, f)) / d;
  }
  branches_.reserve(order_.size());
  branches_.emplace_back();
  build(0, 0, static_cast<int>(order_.size()), centre);
}

template <int d>
void FacetTree<d>::build(int branch, int first, int count, std::vector<Vec<d>>& centre) {
  Box box, centres;
  for (int i = first; i < first + count; ++i) {
    for (int k = 0; k < d; ++k) box.extend(vertices_.col(facets_(k, order_[i])));
    centres.extend(centre[order_[i]]);
  }
  constexpr int leaf_size = 4;
  if (count <= leaf_size) {
    branches_[branch] = {box, first, count};
    return;
  }
  int axis;
  centres.sizes().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](int a, int b) { return centre[a][axis] < centre[b][axis]; });
  const int child = static_cast<int>(branches_.size());
  branches_.resize(branches_.size() + 2);
  branches_[branch] = {box, child, 0};
  build(child, first, half, centre);
  build(child + 1, first + half, count - half, centre);
}

template <int d>
typename FacetTree<d>::Hit FacetTree<d>::nearest(const Vec<d>& x, double reach, double slack) const {
  const double loose = (1 + slack) * (1 + slack);
  Hit best;
  best.squared_distance = reach * reach;
  if (branches_.empty()) return best;
  std::array<std::pair<double, int>, 64> stack;
  int top = 0;
  stack[top++] = {branches_[0].box.squaredExteriorDistance(x), 0};
  while (top > 0) {
    const auto [lower, index] = stack[--top];
    if (lower * loose > best.squared_distance) continue;
    const Branch& b = branches_[index];
    if (b.count > 0) {
      for (int i = b.first; i < b.first + b.count; ++i) {
        std::array<Vec<d>, d> f;
        for (int k = 0; k < d; ++k) f[k] = vertices_.col(facets_(k, order_[i]));
        const Vec<d> c = closest_on(f, x);
        const double r = (c - x).squaredNorm();
        if (r < best.squared_distance || (best.facet < 0 && r <= best.squared_distance)) best = {order_[i], c, r};
      }
      continue;
    }
    std::pair<double, int> a{branches_[b.first].box.squaredExteriorDistance(x), b.first};
    std::pair<double, int> c{branches_[b.first + 1].box.squaredExteriorDistance(x), b.first + 1};
    if (a.first < c.first) std::swap(a, c);
    stack[top++] = a;  // the nearer one is looked at first
    stack[top++] = c;
  }
  return best;
}

template class FacetTree<2>;
template class FacetTree<3>;

}  // namespace splashdown::fluid
