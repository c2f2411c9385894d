#include "core/facet_tree.hpp"

#include <algorithm>
#include <limits>

#include "core/closest_point.hpp"

namespace splashdown {

template <int d>
Vec<d> FacetTree<d>::Piece::centre() const {
  Vec<d> sum = Vec<d>::Zero();
  for (const auto& c : corner) sum += c / d;
  return sum;
}

template <int d>
typename FacetTree<d>::Box FacetTree<d>::Piece::box() const {
  Box out(corner[0]);
  for (int k = 1; k < d; ++k) out.extend(corner[k]);
  return out;
}

namespace {
template <int d>
std::vector<std::array<Vec<d>, d>> corners_of(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
                                              const Eigen::Matrix<int, d, Eigen::Dynamic>& facets) {
  std::vector<std::array<Vec<d>, d>> out(static_cast<std::size_t>(facets.cols()));
  for (std::size_t f = 0; f < out.size(); ++f)
    for (int k = 0; k < d; ++k) out[f][k] = vertices.col(facets(k, static_cast<Eigen::Index>(f)));
  return out;
}
}  // namespace

template <int d>
FacetTree<d>::FacetTree(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
                        const Eigen::Matrix<int, d, Eigen::Dynamic>& facets)
    : FacetTree(corners_of<d>(vertices, facets)) {}

template <int d>
FacetTree<d>::FacetTree(const std::vector<std::array<Vec<d>, d>>& facets) {
  if (facets.empty()) return;
  constexpr double part = 1.0 / 64;  // of the whole surface: needles are not cut into shorter pieces
  Box whole;
  for (const auto& f : facets)
    for (const auto& corner : f) whole.extend(corner);
  const double size = whole.diagonal().norm();
  for (std::size_t f = 0; f < facets.size(); ++f) cut({facets[f], static_cast<int>(f)}, part * size);
  branches_.reserve(pieces_.size());
  branches_.emplace_back();
  build(0, 0, static_cast<int>(pieces_.size()));
}

template <int d>
void FacetTree<d>::cut(const Piece& piece, double shortest) {
  if constexpr (d == 3) {
    constexpr double slender = 4;  // longest edge over height
    const auto& c = piece.corner;
    int longest = 0;
    const auto edge = [&](int k) { return Vec<d>(c[(k + 1) % 3] - c[k]); };
    for (int k = 1; k < 3; ++k)
      if (edge(k).squaredNorm() > edge(longest).squaredNorm()) longest = k;
    const double length = edge(longest).norm(), height = edge(0).cross(edge(1)).norm() / length;
    if (length > shortest && length > slender * height) {
      const Vec<d> middle = 0.5 * (c[longest] + c[(longest + 1) % 3]);
      for (int end : {longest, (longest + 1) % 3}) {
        Piece half = piece;
        half.corner[end] = middle;
        cut(half, shortest);
      }
      return;
    }
  }
  pieces_.push_back(piece);
}

template <int d>
void FacetTree<d>::build(int branch, int first, int count) {
  Box box, centres;
  for (int i = first; i < first + count; ++i) {
    box.extend(pieces_[i].box());
    centres.extend(pieces_[i].centre());
  }
  constexpr int leaf_size = 4;
  if (count <= leaf_size) {
    branches_[branch] = {box, first, count};
    return;
  }
  int axis;
  centres.sizes().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(pieces_.begin() + first, pieces_.begin() + first + half, pieces_.begin() + first + count,
                   [&](const Piece& a, const Piece& b) { return a.centre()[axis] < b.centre()[axis]; });
  const int child = static_cast<int>(branches_.size());
  branches_.resize(branches_.size() + 2);
  branches_[branch] = {box, child, 0};
  build(child, first, half);
  build(child + 1, first + half, count - half);
}

template <int d>
typename FacetTree<d>::Hit FacetTree<d>::nearest(const Vec<d>& x, double reach, double slack) const {
  constexpr double surely = 1 - 1e-9;  // roundoff
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
        if (surely * pieces_[i].box().squaredExteriorDistance(x) > best.squared_distance) continue;
        const Vec<d> c = closest_on(pieces_[i].corner, x);
        const double r = (c - x).squaredNorm();
        if (r < best.squared_distance || (best.facet < 0 && r <= best.squared_distance))
          best = {pieces_[i].facet, c, r};
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

}  // namespace splashdown
