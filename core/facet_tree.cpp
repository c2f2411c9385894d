#include "core/facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/closest_point.hpp"

namespace splashdown {

template <int d>
typename FacetTree<d>::Box FacetTree<d>::Piece::box() const {
  Box out(corner[0]);
  for (int k = 1; k < d; ++k) out.extend(corner[k]);
  return out;
}

namespace {
constexpr int leaf_size = 4;
constexpr float surely_in_floats = 1 - 1e-6F;  // roundoff of squares

/// Squared distances from [from, to] to four intervals.
Eigen::Array4f squared_gaps(const Eigen::Array4f& low, const Eigen::Array4f& high, const Eigen::Array4f& from,
                            const Eigen::Array4f& to) {
  return (low - to).max(from - high).max(0.0F).square();
}

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
  set_roundoff(whole);
  for (std::size_t f = 0; f < facets.size(); ++f) cut({facets[f], static_cast<int>(f)}, part * size);
  branches_.reserve(pieces_.size());
  branches_.emplace_back();
  auto order = keys();
  build(order, 0, 0, static_cast<int>(pieces_.size()));
  std::vector<Piece> sorted;
  sorted.reserve(pieces_.size());
  for (const Key& key : order) sorted.push_back(pieces_[key.piece]);
  pieces_ = std::move(sorted);
  set_boxes();
}

template <int d>
FacetTree<d> FacetTree<d>::moved(const Eigen::Matrix<double, d, Eigen::Dynamic>& vertices,
                                 const Eigen::Matrix<int, d, Eigen::Dynamic>& facets) const {
  if (d == 3 || empty()) return FacetTree(vertices, facets);
  FacetTree out = *this;
  Box whole;
  for (Piece& piece : out.pieces_)
    for (int k = 0; k < d; ++k) {
      piece.corner[k] = vertices.col(facets(k, piece.facet));
      whole.extend(piece.corner[k]);
    }
  for (Branch& branch : out.branches_) branch.box.setEmpty();
  out.set_roundoff(whole);
  out.set_boxes();
  return out;
}

template <int d>
void FacetTree<d>::set_roundoff(const Box& whole) {
  roundoff_ = 1e-12 * (whole.diagonal().norm() + whole.min().cwiseAbs().cwiseMax(whole.max().cwiseAbs()).norm());
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
std::vector<typename FacetTree<d>::Key> FacetTree<d>::keys() const {
  std::vector<Key> out;
  out.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    Vec<d> sum = Vec<d>::Zero();
    for (const auto& c : piece.corner) sum += c / d;
    out.push_back({sum, static_cast<int>(out.size())});
  }
  return out;
}

template <int d>
void FacetTree<d>::build(std::vector<Key>& keys, int branch, int first, int count) {
  if (count <= leaf_size) {
    branches_[branch] = {{}, first, count, -1};
    return;
  }
  Box centres;
  for (int i = first; i < first + count; ++i) centres.extend(keys[i].centre);
  int axis;
  centres.sizes().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(keys.begin() + first, keys.begin() + first + half, keys.begin() + first + count,
                   [axis](const Key& a, const Key& b) { return a.centre[axis] < b.centre[axis]; });
  const int child = static_cast<int>(branches_.size());
  branches_.resize(branches_.size() + 2);
  branches_[branch] = {{}, child, 0, -1};
  build(keys, child, first, half);
  build(keys, child + 1, first + half, count - half);
}

/// One axis along the normal, one along the longest edge.
template <int d>
typename FacetTree<d>::TightBox FacetTree<d>::tight_box(const Piece& piece) const {
  TightBox out;
  if constexpr (d == 3) {
    const auto& c = piece.corner;
    Vec<3> normal = (c[1] - c[0]).cross(c[2] - c[0]), along = Vec<3>::Zero();
    for (int k = 0; k < 3; ++k)
      if (const Vec<3> e = c[(k + 1) % 3] - c[k]; e.squaredNorm() > along.squaredNorm()) along = e;
    if (along.squaredNorm() > 0) along.normalize();
    normal -= normal.dot(along) * along;
    if (!(normal.squaredNorm() > 0)) normal = along.unitOrthogonal();
    normal.normalize();
    out.axes << normal.transpose(), along.transpose(), normal.cross(along).transpose();
    for (const auto& corner : c) out.box.extend(out.axes * corner);
    out.box.min().array() -= roundoff_;
    out.box.max().array() += roundoff_;
  }
  return out;
}

template <int d>
typename FacetTree<d>::Leaf FacetTree<d>::leaf_of(int first, int count) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Leaf leaf{.centre = pieces_[first].corner[0], .axes = {}, .low = {}, .high = {}};
  for (int k = 0; k < leaf_size; ++k) {
    const TightBox box =
        tight_box(pieces_[first + std::min(k, count - 1)]);  // places that are not in use repeat the last one
    const Vec<d> centre = box.axes * leaf.centre;
    for (int i = 0; i < d; ++i) {
      for (int j = 0; j < d; ++j) leaf.axes[i][j][k] = static_cast<float>(box.axes(i, j));
      leaf.low[i][k] = std::nextafter(static_cast<float>(box.box.min()[i] - centre[i]), -infinity);
      leaf.high[i][k] = std::nextafter(static_cast<float>(box.box.max()[i] - centre[i]), infinity);
    }
  }
  return leaf;
}

/// In single precision each product of an axis and a distance x is off by 1.5 eps |x| at most, their sums and what is added
/// to them by 1.5 eps more; with |x_1| + |x_2| + |x_3| in place of |x|.
template <int d>
Eigen::Array4f FacetTree<d>::Leaf::least_squared_distances(const Vec<d>& x) const {
  const Eigen::Matrix<float, d, 1> from = (x - centre).template cast<float>();
  const float off = 4 * std::numeric_limits<float>::epsilon() * from.template lpNorm<1>();
  Eigen::Array4f squared = Eigen::Array4f::Zero();
  for (int i = 0; i < d; ++i) {
    Eigen::Array4f along = axes[i][0] * from[0];
    for (int j = 1; j < d; ++j) along += axes[i][j] * from[j];
    squared += squared_gaps(low[i], high[i], along - off, along + off);
  }
  return surely_in_floats * squared;
}

template <int d>
void FacetTree<d>::set_boxes() {
  for (auto b = branches_.rbegin(); b != branches_.rend(); ++b)  // children stand behind their parents
    if (b->count > 0)
      for (int i = b->first; i < b->first + b->count; ++i) b->box.extend(pieces_[i].box());
    else
      b->box = branches_[b->first].box.merged(branches_[b->first + 1].box);
  if (d == 2) return;
  for (Branch& b : branches_) {
    if (b.count == 0) continue;
    b.leaf = static_cast<int>(leaves_.size());
    leaves_.push_back(leaf_of(b.first, b.count));
  }
  by_fours(0);
}

template <int d>
int FacetTree<d>::by_fours(int branch) {
  std::vector<int> below{branch};
  for (int level = 0; level < 2; ++level) {
    std::vector<int> next;
    for (int b : below)
      if (branches_[b].count > 0)
        next.push_back(b);
      else
        next.insert(next.end(), {branches_[b].first, branches_[b].first + 1});
    below = std::move(next);
  }
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Four four{};
  for (int b : below) {
    const Box& box = branches_[b].box;
    for (int i = 0; i < d; ++i) {
      four.low[i][four.count] = std::nextafter(static_cast<float>(box.min()[i]), -infinity);
      four.high[i][four.count] = std::nextafter(static_cast<float>(box.max()[i]), infinity);
    }
    four.to[four.count++] = b;
  }
  const std::size_t index = fours_.size();
  fours_.push_back(four);
  for (int k = 0; k < four.count; ++k) {
    const int to = branches_[four.to[k]].count > 0 ? ~four.to[k] : by_fours(four.to[k]);
    fours_[index].to[k] = to;
  }
  return static_cast<int>(index);
}

template <int d>
void FacetTree<d>::look_into(const Branch& leaf, const Vec<d>& x, double loose, Hit& best) const {
  constexpr double surely = 1 - 1e-9;  // roundoff
  Eigen::Array4f least = Eigen::Array4f::Zero();
  if constexpr (d == 3) {
    least = leaves_[leaf.leaf].least_squared_distances(x);
  }
  for (int k = 0; k < leaf.count; ++k) {
    const Piece& piece = pieces_[leaf.first + k];
    if (d == 2 && surely * loose * piece.box().squaredExteriorDistance(x) > best.squared_distance) continue;
    if (loose * least[k] > best.squared_distance) continue;
    const Vec<d> c = closest_on(piece.corner, x);
    const double r = (c - x).squaredNorm();
    const bool as_near = best.facet < 0 || (d == 3 && piece.facet < best.facet);
    if (r < best.squared_distance || (as_near && r <= best.squared_distance)) best = {piece.facet, c, r};
  }
}

template <int d>
void FacetTree<d>::search_fours(const Vec<d>& x, double loose, Hit& best) const {
  std::array<Eigen::Array4f, d> below, above;
  for (int i = 0; i < d; ++i) {
    const auto rounded = static_cast<float>(x[i]);
    const float off = std::numeric_limits<float>::epsilon() * std::abs(rounded);
    below[i].setConstant(rounded - off);
    above[i].setConstant(rounded + off);
  }
  const float least_share = surely_in_floats * static_cast<float>(loose);
  struct Entry {
    float lower;
    int to;
  };
  std::array<Entry, 128> stack;  // three more a level
  int top = 0;
  stack[top++] = {0.0F, 0};
  while (top > 0) {
    const auto [lower, index] = stack[--top];
    if (lower > best.squared_distance) continue;
    if (index < 0) {
      look_into(branches_[~index], x, loose, best);
      continue;
    }
    const Four& four = fours_[index];
    Eigen::Array4f squared = Eigen::Array4f::Zero();
    for (int i = 0; i < d; ++i) squared += squared_gaps(four.low[i], four.high[i], below[i], above[i]);
    squared *= least_share;
    const auto reach = static_cast<float>(best.squared_distance / surely_in_floats);
    const int first = top;
    for (int k = 0; k < four.count; ++k) {
      if (!(squared[k] <= reach)) continue;
      int at = top++;  // the nearest one is looked at first
      for (; at > first && stack[at - 1].lower < squared[k]; --at) stack[at] = stack[at - 1];
      stack[at] = {squared[k], four.to[k]};
    }
  }
}

template <int d>
typename FacetTree<d>::Hit FacetTree<d>::nearest(const Vec<d>& x, double reach, double slack) const {
  const double loose = (1 + slack) * (1 + slack);
  Hit best;
  best.squared_distance = reach * reach;
  if (branches_.empty()) return best;
  if constexpr (d == 3) {
    search_fours(x, loose, best);
    return best;
  }
  std::array<std::pair<double, int>, 64> stack;
  int top = 0;
  stack[top++] = {branches_[0].box.squaredExteriorDistance(x), 0};
  while (top > 0) {
    const auto [lower, index] = stack[--top];
    if (lower * loose > best.squared_distance) continue;
    const Branch& b = branches_[index];
    if (b.count > 0) {
      look_into(b, x, loose, best);
      continue;
    }
    std::pair<double, int> a{branches_[b.first].box.squaredExteriorDistance(x), b.first};
    std::pair<double, int> c{branches_[b.first + 1].box.squaredExteriorDistance(x), b.first + 1};
    if (a.first < c.first) std::swap(a, c);
    if (a.first * loose <= best.squared_distance) stack[top++] = a;  // the nearer one is looked at first
    if (c.first * loose <= best.squared_distance) stack[top++] = c;
  }
  return best;
}

template <int d>
std::vector<int> FacetTree<d>::meeting(const Box& box) const {
  // Corners of the pieces that needles are cut into are rounded.
  const Vec<d> margin = Vec<d>::Constant(roundoff_);
  const Box wide(box.min() - margin, box.max() + margin);
  std::vector<int> found, stack;
  if (!branches_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Branch& b = branches_[stack.back()];
    stack.pop_back();
    if (!b.box.intersects(wide)) continue;
    if (b.count == 0) stack.insert(stack.end(), {b.first, b.first + 1});
    for (int i = b.first; i < b.first + b.count; ++i)
      if (pieces_[i].box().intersects(wide)) found.push_back(pieces_[i].facet);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template class FacetTree<2>;
template class FacetTree<3>;

}  // namespace splashdown
