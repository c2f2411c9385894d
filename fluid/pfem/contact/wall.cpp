// What is found once of a wall's surface: its sides, creases, corners, patches and bends.
#include "fluid/pfem/contact/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/closest_point.hpp"
#include "fluid/pfem/geometry.hpp"

namespace splashdown::fluid {
template <int d>
Wall<d>::Wall(const WallSpec<d>& spec)
    : spec_(spec),
      made_(std::make_shared<WallShape<d>>()),
      facets_of_(spec.surface.vertices.cols()),
      is_corner_(spec.surface.vertices.cols(), 0),
      is_sharp_(spec.surface.vertices.cols(), 0) {
  made_->facets = std::make_shared<const Eigen::Matrix<int, d, Eigen::Dynamic>>(spec.surface.facets);
  made_ = shape_of(spec.surface.vertices);
  tiny_ = 1e-9 * diameter();
  find_sides();
  find_sides_of_mirror();
  find_creases();
  find_corners();
  find_patches();
  find_bends();
  find_convexity();
  find_basin();
  find_centre();
}

template <int d>
void Wall<d>::find_sides() {
  const auto& [vertices, facets] = spec_.surface;
  double enclosed = 0;
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = vertices.col(facets(k, f)), facets_of_[facets(k, f)].push_back(f);
    enclosed += corner[0].dot(area_vector(corner));
  }
  turned_inside_out_ = enclosed < 0;
}

// A hull that reaches across the plane of symmetry has its facets on one side of it or on the other.
template <int d>
void Wall<d>::find_sides_of_mirror() {
  const auto& [vertices, facets] = spec_.surface;
  side_.assign(facets.cols(), 0);
  in_mirror_.assign(vertices.cols(), 0);
  if (!spec_.mirror) return;
  std::vector<double> distance(vertices.cols());
  for (int v = 0; v < vertices.cols(); ++v) {
    distance[v] = spec_.mirror->template distance<d>(spec_.pose * Vec<d>(vertices.col(v)));
    in_mirror_[v] = std::abs(distance[v]) <= tiny_;
  }
  if (turned_inside_out_) {
    std::vector<int> solid;
    for (int f = 0; f < facets.cols(); ++f)
      if (!lies_in_mirror(f)) solid.push_back(f);
    solid_tree_ = FacetTree<d>(vertices, facets(Eigen::all, solid));
    return;
  }
  for (int f = 0; f < facets.cols(); ++f) {
    double sum = 0;
    for (int k = 0; k < d; ++k) sum += distance[facets(k, f)];
    side_[f] = sum < 0 ? -1 : 1;
  }
}

template <int d>
bool Wall<d>::lies_in_mirror(int f) const {
  const auto corners = spec_.surface.facets.col(f);
  return std::all_of(corners.begin(), corners.end(), [&](int v) { return in_mirror_[v] != 0; });
}

template <int d>
bool Wall<d>::is_crease(int f, int g) const {
  return made_->normal.col(f).dot(made_->normal.col(g)) < least_smooth_cosine;
}

// Whether a neighbour across an edge lies in front of a facet, with its own corners apart from the edge.
template <int d>
bool Wall<d>::is_hollow(int f, int g) const {
  const auto& facets = spec_.surface.facets;
  const auto from = spec_.surface.vertices.col(facets(0, f));
  for (int k = 0; k < d; ++k)
    if ((spec_.surface.vertices.col(facets(k, g)) - from).dot(made_->normal.col(f)) > tiny_) return true;
  return false;
}

// Edges between facets, and chains of those that are creases.
template <int d>
void Wall<d>::find_creases() {
  const auto& facets = spec_.surface.facets;
  across_.setConstant(d, facets.cols(), -1);
  crease_of_.setConstant(d, facets.cols(), -1);
  if constexpr (d == 3) {
    std::vector<std::vector<std::array<int, 2>>> of_vertex(spec_.surface.vertices.cols());  // facet, edge
    for (int f = 0; f < facets.cols(); ++f)
      for (int k = 0; k < d; ++k) {
        const int a = facets(k, f), b = facets((k + 1) % d, f);
        for (int g : facets_of_[a])
          for (int j = 0; j < d; ++j)
            if (facets(j, g) == b && facets((j + 1) % d, g) == a) across_(k, f) = g;
        if (across_(k, f) >= 0 && ends_patch(f, across_(k, f))) of_vertex[a].push_back({f, k});
      }
    // A crease ends where it branches or turns sharply, and where a hollow one becomes convex.
    auto other_end = [&](const std::array<int, 2>& e) { return facets((e[1] + 1) % d, e[0]); };
    auto along = [&](int from, int to) {
      return Vec<d>((spec_.surface.vertices.col(to) - spec_.surface.vertices.col(from)).normalized());
    };
    auto hollow = [&](const std::array<int, 2>& e) { return is_hollow(e[0], across_(e[1], e[0])); };
    for (std::size_t v = 0; v < of_vertex.size(); ++v) {
      const auto& edges = of_vertex[v];
      const int at = static_cast<int>(v);
      is_sharp_[v] = !edges.empty();
      auto ends = [&] {
        return hollow(edges[0]) != hollow(edges[1]) ||
               along(other_end(edges[0]), at).dot(along(at, other_end(edges[1]))) < least_smooth_cosine;
      };
      is_corner_[v] = !edges.empty() && (edges.size() != 2 || ends());
    }
    auto follow = [&](int from, int index) {
      for (auto edge = of_vertex[from][index];;) {
        const int to = other_end(edge), number = static_cast<int>(creases_.size()) - 1;
        const int beyond = across_(edge[1], edge[0]);
        crease_of_(edge[1], edge[0]) = number;
        for (int j = 0; j < d; ++j)
          if (facets(j, beyond) == to && facets((j + 1) % d, beyond) == from) crease_of_(j, beyond) = number;
        creases_.back().push_back({from, to});
        if (is_corner_[to]) return;
        const auto& next = of_vertex[to];
        edge = other_end(next[0]) == from ? next[1] : next[0];
        if (crease_of_(edge[1], edge[0]) >= 0) return;  // a ring
        from = to;
      }
    };
    for (bool corners_first : {true, false})
      for (std::size_t v = 0; v < of_vertex.size(); ++v)
        for (std::size_t e = 0; e < of_vertex[v].size(); ++e) {
          const auto [f, k] = of_vertex[v][e];
          if (crease_of_(k, f) >= 0 || (corners_first && !is_corner_[v])) continue;
          creases_.emplace_back();
          follow(static_cast<int>(v), static_cast<int>(e));
        }
  }
}

// Besides the ends of creases: vertices around which the normal turns, as at the tip of a cone.
template <int d>
void Wall<d>::find_corners() {
  smooth_corner_.assign(spec_.surface.vertices.cols(), 0);
  for (int v = 0; v < spec_.surface.vertices.cols(); ++v) {
    if (!is_sharp_[v])
      for (int f : facets_of_[v])
        for (int g : facets_of_[v])
          if (ends_patch(f, g)) is_corner_[v] = 1;
    is_sharp_[v] = is_sharp_[v] || is_corner_[v];
    if (!is_corner_[v]) continue;
    corners_.push_back(v);
    smooth_corner_[v] = std::ranges::none_of(facets_of_[v], [&](int f) {
      return std::ranges::any_of(facets_of_[v], [&](int g) { return is_crease(f, g); });
    });
  }
}

// Facets that share an edge without a crease belong together.
template <int d>
void Wall<d>::find_patches() {
  const auto& facets = spec_.surface.facets;
  auto neighbours = [&](int f, int g) {
    int shared = 0;
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) shared += facets(a, f) == facets(b, g);
    return shared == d - 1 && !ends_patch(f, g);
  };
  patch_of_.assign(facets.cols(), -1);
  for (int seed = 0; seed < facets.cols(); ++seed) {
    if (patch_of_[seed] >= 0) continue;
    const int patch = static_cast<int>(patch_facets_.size());
    if (turned_inside_out_ && lies_in_mirror(seed)) mirror_patch_ = patch;
    std::vector<int> members{seed};
    patch_of_[seed] = patch;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (int k = 0; k < d; ++k)
        for (int g : facets_of_[facets(k, members[i])])
          if (patch_of_[g] < 0 && neighbours(members[i], g)) patch_of_[g] = patch, members.push_back(g);
    Eigen::Matrix<int, d, Eigen::Dynamic> own(d, members.size());
    for (std::size_t i = 0; i < members.size(); ++i) own.col(i) = facets.col(members[i]);
    made_->of_patch.emplace_back(spec_.surface.vertices, std::move(own));
    constexpr double roundoff = 1e-12;
    is_flat_.push_back(std::all_of(members.begin(), members.end(), [&](int f) {
      return (made_->normal.col(f) - made_->normal.col(seed)).squaredNorm() < roundoff;
    }));
    patch_facets_.push_back(std::move(members));
  }
}

// Curvature along an edge from the normals at its ends, |(n_j - n_i).(x_j - x_i)| / |x_j - x_i|^2. A sharp vertex has no
// normal, so edges that end at one are no curve.
template <int d>
void Wall<d>::find_bends() {
  const auto& vertices = spec_.surface.vertices;
  const auto& facets = spec_.surface.facets;
  std::vector<double> curvature(vertices.cols(), 0.0);
  for (int f = 0; f < facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const int i = facets(k, f), j = facets((k + 1) % d, f);
      if (is_sharp_[i] || is_sharp_[j]) continue;
      const Vec<d> e = vertices.col(j) - vertices.col(i);
      const double along = (made_->vertex_normal.col(j).normalized() - made_->vertex_normal.col(i).normalized()).dot(e);
      for (int v : {i, j}) curvature[v] = std::max(curvature[v], std::abs(along) / e.squaredNorm());
    }
  const double straight = 1e-6 / diameter();  // roundoff of outlines that are subdivided
  for (int v = 0; v < vertices.cols(); ++v)
    if (curvature[v] > straight) bends_.push_back({vertices.col(v), 1 / curvature[v]});
}

// Where a convex crease ends water flows around the corner, whatever else meets there. Without creases: where the neighbours lie
// behind it. Across a plane of symmetry no water flows: along such a crease it goes with the hull, and in the plane such a
// vertex is a point where it stands.
template <int d>
void Wall<d>::find_convexity() {
  const auto& vertices = spec_.surface.vertices;
  const auto& facets = spec_.surface.facets;
  convex_crease_.assign(creases_.size(), 1);
  mirrored_crease_.assign(creases_.size(), 0);
  // One surface that is convex along all of its edges is convex as a whole (Tietze 1928, Nakajima 1928).
  is_convex_ = d == 3 && !turned_inside_out_ && is_in_one_piece();
  for (int f = 0; f < facets.cols() && d == 3; ++f)
    for (int k = 0; k < d; ++k) {
      if (across_(k, f) < 0) continue;
      const int crease = crease_of_(k, f);
      const bool divided = side_[f] * side_[across_(k, f)] < 0, hollow = is_hollow(f, across_(k, f));
      if (divided) mirrored_crease_[crease] = 1;
      if (crease >= 0 && (divided || hollow)) convex_crease_[crease] = 0;
      is_convex_ = is_convex_ && !hollow;
    }
  convex_corner_.assign(vertices.cols(), 1);
  for (int v : corners_) {
    bool ends = false, ends_convex = false;
    double in_front = 0;
    for (int f : facets_of_[v])
      for (int k = 0; k < d; ++k) {
        in_front += (vertices.col(facets(k, f)) - vertices.col(v)).dot(made_->vertex_normal.col(v));
        const int crease = crease_of_(k, f);
        if (crease < 0 || mirrored_crease_[crease] || (facets(k, f) != v && facets((k + 1) % d, f) != v)) continue;
        ends = true;
        ends_convex = ends_convex || convex_crease_[crease] != 0;
      }
    convex_corner_[v] = ends ? ends_convex : in_front < 0;
    if (d == 2 && in_mirror_[v] && !turned_inside_out_) convex_corner_[v] = 0;
  }
}

// All facets hang together across edges, and none of these is open.
template <int d>
bool Wall<d>::is_in_one_piece() const {
  if (across_.minCoeff() < 0) return false;
  std::vector<char> reached(across_.cols(), 0);
  std::vector<int> next{0};
  reached[0] = 1;
  for (std::size_t i = 0; i < next.size(); ++i)
    for (int k = 0; k < d; ++k)
      if (const int g = across_(k, next[i]); !reached[g]) reached[g] = 1, next.push_back(g);
  return next.size() == reached.size();
}

template <int d>
void Wall<d>::find_basin() {
  constexpr std::size_t few = 4 * d;  // more are not cheap to look at
  const auto& vertices = spec_.surface.vertices;
  const auto& facets = spec_.surface.facets;
  for (int f = 0; f < facets.cols() && turned_inside_out_; ++f) {
    const Plane plane{made_->normal.col(f), made_->normal.col(f).dot(vertices.col(facets(0, f)))};
    const Eigen::VectorXd above = (plane.normal.transpose() * vertices).transpose().array() - plane.offset;
    const bool known = std::any_of(basin_.begin(), basin_.end(), [&](const Plane& p) {
      return (p.normal - plane.normal).norm() * diameter() + std::abs(p.offset - plane.offset) < tiny_;
    });
    if (above.minCoeff() < -tiny_ || (!known && basin_.size() == few)) return basin_.clear();
    if (!known) basin_.push_back(plane);
  }
}

// From cones with their tip in the middle of the box: V = sum v, V x = sum v (mean of corners), v = A.(x - tip) / d.
template <int d>
void Wall<d>::find_centre() {
  centre_ = centre_of(*made_);
  depth_of_centre_ = -nearest(spec_.deforms ? place() : WallPlace<d>(), centre_, 2 * diameter()).distance;
}

template <int d>
Vec<d> Wall<d>::centre_of(const WallShape<d>& shape) const {
  const Vec<d> tip = shape.box.center();
  const auto& facets = spec_.surface.facets;
  Vec<d> sum = Vec<d>::Zero();
  double enclosed = 0;
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    Vec<d> mean = Vec<d>::Zero();
    for (int k = 0; k < d; ++k) {
      corner[k] = shape.vertices.col(facets(k, f)) - tip;
      mean += corner[k] / (d + 1);
    }
    const double cone = area_vector(corner).dot(corner[0]) / d;
    sum += cone * mean;
    enclosed += cone;
  }
  return enclosed != 0 ? Vec<d>(tip + sum / enclosed) : tip;
}

template class Wall<2>;
template class Wall<3>;

}  // namespace splashdown::fluid
