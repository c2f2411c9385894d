#include "apps/record/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/closest_point.hpp"
#include "core/facet_tree.hpp"

namespace splashdown::apps {

namespace {

NodeKind kind_of(const PointPlace& place) {
  if (place.wall < 0) return place.on_free_surface ? NodeKind::free_surface : NodeKind::interior;
  if (place.at_corner) return NodeKind::wall_vertex;
  return place.on_free_surface ? NodeKind::contact : NodeKind::wall;
}

/// Of the disc or ball of a volume.
template <int d>
double diameter(double volume) {
  return d == 2 ? std::sqrt(4 * volume / std::numbers::pi) : std::cbrt(6 * volume / std::numbers::pi);
}

/// The wetted facets of a wall and the pressure on them.
template <int d>
class WettedWall {
 public:
  WettedWall(const FluidView<d>& fluid, int wall) : pressure_(fluid.pressure()) {
    const auto points = fluid.points();
    for (const auto& facet : fluid.boundary())
      if (facet.wall == wall) facets_.push_back(facet.nodes);
    surface_.facets.resize(d, static_cast<Eigen::Index>(facets_.size()));
    surface_.vertices.resize(d, d * static_cast<Eigen::Index>(facets_.size()));
    Eigen::Index corner = 0;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (int k = 0; k < d; ++k, ++corner) {
        surface_.vertices.col(corner) = points[static_cast<std::size_t>(facets_[f][static_cast<std::size_t>(k)])];
        surface_.facets(k, static_cast<Eigen::Index>(f)) = static_cast<int>(corner);
      }
    tree_ = FacetTree<d>(surface_.vertices, surface_.facets);
  }

  /// At the nearest wetted facet that is not farther away than its half; 0: dry.
  double pressure(const Vec<d>& at) const {
    if (facets_.empty()) return 0;
    const auto nearest = tree_.nearest(at, std::numeric_limits<double>::max());
    std::array<Vec<d>, d> corners;
    for (std::size_t k = 0; k < d; ++k)
      corners[k] = surface_.vertices.col(surface_.facets(static_cast<Eigen::Index>(k), nearest.facet));
    double longest = 0;
    for (std::size_t k = 0; k < d; ++k) longest = std::max(longest, (corners[(k + 1) % d] - corners[k]).norm());
    if (nearest.squared_distance > 0.25 * longest * longest) return 0;
    const Vec<d - 1> weights = weights_in(corners, nearest.point);
    const auto& nodes = facets_[static_cast<std::size_t>(nearest.facet)];
    double p = (1 - weights.sum()) * pressure_[static_cast<std::size_t>(nodes[0])];
    for (int k = 1; k < d; ++k)
      p += weights(k - 1) * pressure_[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
    return p;
  }

 private:
  std::span<const double> pressure_;
  std::vector<std::array<int, static_cast<std::size_t>(d)>> facets_;
  Surface<d> surface_;
  FacetTree<d> tree_;
};

/// Velocity of a point of a body at `r` from its centre of mass.
template <int d>
Vec<d> velocity_at(const Vec<d>& r, const Twist<d>& velocity) {
  if constexpr (d == 2)
    return {velocity(0) - velocity(2) * r.y(), velocity(1) + velocity(2) * r.x()};
  else
    return velocity.template head<3>() + Eigen::Vector3d(velocity.template tail<3>()).cross(r);
}

template <int d>
void take_fluid(const FluidView<d>& fluid, Frame<d>& frame) {
  const auto points = fluid.points();
  const auto cells = fluid.cells();
  const auto pressure = fluid.pressure();
  frame.x.assign(points.begin(), points.end());
  frame.p.assign(pressure.begin(), pressure.end());
  frame.cells.assign(cells.begin(), cells.end());
  frame.v.reserve(points.size());
  frame.kind.reserve(points.size());
  frame.wall.reserve(points.size());
  frame.drop_diameter.assign(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    frame.v.push_back(fluid.velocity_n(i));
    const PointPlace place = fluid.place(i);
    const auto drop = fluid.drop_volume(i);
    frame.kind.push_back(drop ? NodeKind::drop : kind_of(place));
    frame.wall.push_back(place.wall);
    if (drop) frame.drop_diameter[i] = diameter<d>(*drop);
  }
}

template <int d, class Surface>
Outline<d> outline_at(const std::string& name, const Surface& surface, const Isometry<d>& pose) {
  return {name, {pose * surface.vertices, surface.facets}, pose.linear().col(0)};
}

}  // namespace

template <int d>
Frame<d> take_frame(const RecordInput<d>& input) {
  Frame<d> frame;
  frame.time = input.time;
  if (input.fluid) {
    take_fluid(*input.fluid, frame);
    const auto walls = input.fluid->walls();
    for (std::size_t w = 0; w < walls.size(); ++w) {
      frame.outlines.push_back(outline_at<d>(walls[w].name, walls[w].surface, input.fluid->wall_poses()[w]));
      if (const auto* vertices = input.fluid->wall_vertices(w)) frame.outlines.back().surface.vertices = *vertices;
    }
  }
  for (std::size_t w = 0; w < frame.outlines.size(); ++w) {
    auto& outline = frame.outlines[w];
    const WettedWall<d> wetted(*input.fluid, static_cast<int>(w));
    const auto& vertices = outline.surface.vertices;
    const auto& mirror = input.fluid->walls()[w].mirror;
    for (Eigen::Index i = 0; i < vertices.cols(); ++i) {
      const Vec<d> x = vertices.col(i);
      const bool beyond = mirror && mirror->template distance<d>(x) < 0;
      outline.p.push_back(wetted.pressure(beyond ? mirror->template image<d>(x) : x));
    }
    outline.v.assign(outline.p.size(), Vec<d>::Zero());
  }
  for (std::size_t b = 0; input.bodies && b < input.bodies->size(); ++b) {
    const auto& spec = input.bodies->spec(b);
    const auto& pose = input.bodies->state(b).pose;
    if (std::ranges::find(frame.outlines, spec.name, &Outline<d>::name) == frame.outlines.end())
      frame.outlines.push_back(outline_at<d>(spec.name, spec.surface, pose));
    auto& outline = *std::ranges::find(frame.outlines, spec.name, &Outline<d>::name);
    outline.v.clear();
    for (Eigen::Index i = 0; i < outline.surface.vertices.cols(); ++i)
      outline.v.push_back(
          velocity_at<d>(outline.surface.vertices.col(i) - pose.translation(), input.body_velocity_n[b]));
  }
  for (std::size_t b = 0; input.solids && b < input.solids->size(); ++b) {
    auto& outline = *std::ranges::find(frame.outlines, input.solids->spec(b).name, &Outline<d>::name);
    auto deformed = input.solids->deformed(b);
    if (outline.surface.vertices.cols() != deformed.surface.vertices.cols()) outline.p.clear();  // of other vertices
    outline.surface = std::move(deformed.surface);
    outline.v = std::move(deformed.v);
    outline.u = std::move(deformed.displacement);
    outline.stress = std::move(deformed.stress);
    outline.von_mises = std::move(deformed.von_mises);
  }
  return frame;
}

template <int d>
int wall_index(const FluidView<d>& fluid, const std::string& name) {
  const auto walls = fluid.walls();
  const auto found = std::ranges::find(walls, name, &WallSpec<d>::name);
  return found == walls.end() ? -1 : static_cast<int>(found - walls.begin());
}

template <int d>
int wall_called(const FluidView<d>& fluid, const std::string& name) {
  const int wall = wall_index(fluid, name);
  if (wall < 0) throw std::invalid_argument("a record names the wall \"" + name + "\", which does not exist");
  return wall;
}

template <int d>
std::size_t body_index(const BodiesView<d>& bodies, const std::string& name) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.spec(b).name == name) return b;
  throw std::invalid_argument("a record names the body \"" + name + "\", which does not exist");
}

template <int d>
double water_level(const FluidView<d>& fluid) {
  const auto points = fluid.points();
  double level = std::numeric_limits<double>::quiet_NaN();
  for (const auto& facet : fluid.boundary()) {
    if (facet.wall >= 0) continue;
    for (const int point : facet.nodes) level = std::fmax(level, points[static_cast<std::size_t>(point)](d - 1));
  }
  return level;
}

#define SPLASHDOWN_INSTANTIATE(d)                                               \
  template Frame<d> take_frame<d>(const RecordInput<d>&);                       \
  template int wall_index<d>(const FluidView<d>&, const std::string&);          \
  template int wall_called<d>(const FluidView<d>&, const std::string&);         \
  template std::size_t body_index<d>(const BodiesView<d>&, const std::string&); \
  template double water_level<d>(const FluidView<d>&);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::apps
