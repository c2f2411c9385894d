// Where a wall is and has its surface, and what is nearest on it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/closest_point.hpp"
#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/geometry.hpp"

namespace splashdown::fluid {
namespace {

double angle_at(const std::array<Vec<2>, 2>&, int) { return 1; }
double angle_at(const std::array<Vec<3>, 3>& c, int k) {
  const Vec<3> a = c[(k + 1) % 3] - c[k], b = c[(k + 2) % 3] - c[k];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

template <int d>
WallPlace<d> Wall<d>::place() const {
  return spec_.deforms ? WallPlace<d>(made_) : WallPlace<d>(spec_.pose);
}

template <int d>
WallVelocity<d> Wall<d>::velocity() const {
  if (!spec_.deforms) return spec_.velocity;
  AtVertices<d> v = spec_.surface.vertices;
  for (auto column : v.colwise()) column = rigid_velocity<d>(spec_.velocity, Vec<d>(column));
  return WallVelocity<d>::at_vertices(std::move(v));
}

template <int d>
WallPlace<d> Wall<d>::moved(const WallPlace<d>& from, const WallVelocity<d>& s, double dt) const {
  if (!from.shape()) return fluid::moved<d>(from.pose(), s.rigid, dt);
  if (s.vertices.size() == 0) return from;
  return shaped(from.shape()->vertices + dt * s.vertices);
}

template <int d>
WallPlace<d> Wall<d>::shaped(AtVertices<d> vertices) const {
  return WallPlace<d>(shape_of(std::move(vertices)));
}

template <int d>
std::shared_ptr<WallShape<d>> Wall<d>::shape_of(AtVertices<d> vertices) const {
  auto shape = std::make_shared<WallShape<d>>();
  shape->facets = made_->facets;
  const auto& facets = *shape->facets;
  shape->vertices = std::move(vertices);
  shape->normal.resize(d, facets.cols());
  shape->vertex_normal.setZero(d, shape->vertices.cols());
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = shape->vertices.col(facets(k, f));
    shape->normal.col(f) = area_vector(corner).normalized();
    shape->spacing += (corner[0] - corner[1]).norm() / static_cast<double>(facets.cols());
    for (int k = 0; k < d; ++k) shape->vertex_normal.col(facets(k, f)) += angle_at(corner, k) * shape->normal.col(f);
  }
  shape->tree = made_->tree.moved(shape->vertices, facets);
  for (std::size_t k = 0; k < patch_facets_.size(); ++k) {
    const Eigen::Matrix<int, d, Eigen::Dynamic> members = facets(Eigen::all, patch_facets_[k]);
    shape->of_patch.push_back(k < made_->of_patch.size() ? made_->of_patch[k].moved(shape->vertices, members)
                                                         : FacetTree<d>(shape->vertices, members));
  }
  for (const auto vertex : shape->vertices.colwise()) shape->box.extend(vertex);
  return shape;
}

template <int d>
Vec<d> Wall<d>::carried(const WallPlace<d>& pose, const Vec<d>& made) const {
  if (!pose.shape()) return pose * made;
  return anchor_of<d>(*made_, made).interpolate(pose.shape()->vertices);
}

template <int d>
Vec<d> Wall<d>::carried(const WallPlace<d>& from, const WallPlace<d>& to, const Vec<d>& x) const {
  return from.shape() ? Vec<d>(x + centre_at(to) - centre_at(from)) : Vec<d>(to * (from.inverse() * x));
}

template <int d>
typename Wall<d>::Near Wall<d>::near_of(const WallPlace<d>& pose, const Vec<d>& local,
                                        const typename FacetTree<d>::Hit& hit, int facet) const {
  // The side is taken from the normals of all facets that meet at the closest point, by their angles there (Baerentzen,
  // Aanaes 2005).
  const WallShape<d>& surface = shape(pose);
  Vec<d> normal = surface.normal.col(facet);
  int vertex = -1, on_crease = -1;
  const auto at = [&](int k) { return Vec<d>(surface.vertices.col(spec_.surface.facets(k % d, facet))); };
  for (int k = 0; k < d && d == 3; ++k) {
    if (across_(k, facet) < 0 || (closest_on_segment<d>(at(k), at(k + 1), hit.point) - hit.point).norm() > tiny_)
      continue;
    normal = surface.normal.col(facet) + surface.normal.col(across_(k, facet));
    if (crease_of_(k, facet) >= 0) on_crease = crease_of_(k, facet);
  }
  for (int k = 0; k < d; ++k) {
    const int v = spec_.surface.facets(k, facet);
    if ((at(k) - hit.point).norm() > tiny_) continue;
    normal = surface.vertex_normal.col(v);
    if (is_corner_[v]) vertex = v;
  }
  const double side = (local - hit.point).dot(normal) < 0 ? -1.0 : 1.0;
  return {pose * hit.point,
          pose.linear() * Vec<d>(surface.normal.col(facet)),
          side * std::sqrt(hit.squared_distance),
          patch_of_[facet],
          vertex,
          vertex >= 0 ? -1 : on_crease};
}

template <int d>
typename Wall<d>::Near Wall<d>::nearest(const WallPlace<d>& pose, const Vec<d>& x, double reach) const {
  const Vec<d> local = pose.inverse() * x;
  const auto hit = shape(pose).tree.nearest(local, reach);
  if (hit.facet < 0) return {x, Vec<d>::Zero(), reach, -1, -1};
  return near_of(pose, local, hit, hit.facet);
}

template <int d>
typename Wall<d>::Near Wall<d>::nearest_on_patch(const WallPlace<d>& pose, const Vec<d>& x, int patch) const {
  const Vec<d> local = pose.inverse() * x;
  const auto hit = shape(pose).of_patch[patch].nearest(local, std::numeric_limits<double>::max());
  if (hit.facet < 0) return {x, Vec<d>::Zero(), std::numeric_limits<double>::quiet_NaN(), patch, -1};  // x not finite
  return near_of(pose, local, hit, patch_facets_[patch][hit.facet]);
}

template <int d>
typename Wall<d>::OnCrease Wall<d>::on_crease(const WallPlace<d>& pose, const Vec<d>& local, int crease) const {
  const AtVertices<d>& at = shape(pose).vertices;
  OnCrease best{Vec<d>::Constant(std::numeric_limits<double>::infinity()), Vec<d>::Zero()};
  for (const auto& [a, b] : creases_[crease]) {
    const Vec<d> from = at.col(a), to = at.col(b);
    const Vec<d> c = closest_on_segment<d>(from, to, local);
    if ((c - local).squaredNorm() < (best.point - local).squaredNorm()) best = {c, to - from};
  }
  return best;
}

template <int d>
Vec<d> Wall<d>::nearest_on_crease(const WallPlace<d>& pose, const Vec<d>& x, int crease) const {
  const Vec<d> point = pose * on_crease(pose, pose.inverse() * x, crease).point;
  return mirrored_crease_[crease] ? spec_.mirror->template onto<d>(point) : point;
}

template <int d>
typename Wall<d>::Crossing Wall<d>::nearest_in_mirror(const WallPlace<d>& pose, const Vec<d>& x) const {
  Crossing best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < creases_.size(); ++c) {
    if (!mirrored_crease_[c]) continue;
    const Vec<d> point = nearest_on_crease(pose, x, static_cast<int>(c));
    if (const double distance = (point - x).norm(); distance < best.distance)
      best = {static_cast<int>(c), point, distance, 0};
  }
  return best;
}

template <int d>
Vec<d> Wall<d>::crease_direction(const WallPlace<d>& pose, const Vec<d>& x, int crease) const {
  return pose.linear() * on_crease(pose, pose.inverse() * x, crease).along.normalized();
}

template <int d>
typename Wall<d>::Crossing Wall<d>::nearest_crease(const WallPlace<d>& pose, const Vec<d>& from,
                                                   const Vec<d>& to) const {
  const AtVertices<d>& places = shape(pose).vertices;
  const Vec<d> a = pose.inverse() * from, along = pose.inverse() * to - a;
  Crossing best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < creases_.size(); ++c)
    for (const auto& [i, j] : creases_[c]) {
      // Closest points of two segments (Ericson, Real-Time Collision Detection, 2005, 5.1.9).
      const Vec<d> b = places.col(i), edge = places.col(j) - places.col(i);
      const Vec<d> r = a - b;
      const double aa = along.squaredNorm(), ee = edge.squaredNorm(), ae = along.dot(edge);
      const double ar = along.dot(r), er = edge.dot(r), det = aa * ee - ae * ae;
      double s = det > 1e-12 * aa * ee ? std::clamp((ae * er - ar * ee) / det, 0.0, 1.0) : 0.0;
      const double t = std::clamp((ae * s + er) / ee, 0.0, 1.0);
      s = aa > 0 ? std::clamp((t * ae - ar) / aa, 0.0, 1.0) : 0.0;
      const Vec<d> on_crease = b + t * edge;
      const double distance = (a + s * along - on_crease).norm();
      if (distance < best.distance) best = {static_cast<int>(c), on_crease, distance, s};
    }
  best.point = pose * best.point;
  return best;
}

template <int d>
double Wall<d>::distance_unsigned(const WallPlace<d>& pose, const Vec<d>& x, double reach, double slack) const {
  return std::sqrt(shape(pose).tree.nearest(pose.inverse() * x, reach, slack).squared_distance);
}

template <int d>
double Wall<d>::distance_of_solid(const WallPlace<d>& pose, const Vec<d>& x, double reach, double slack) const {
  const auto& solid = solid_tree_.empty() ? shape(pose).tree : solid_tree_;
  return std::sqrt(solid.nearest(pose.inverse() * x, reach, slack).squared_distance);
}

template class Wall<2>;
template class Wall<3>;

}  // namespace splashdown::fluid
