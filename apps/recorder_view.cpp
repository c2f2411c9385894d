#include "apps/recorder_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace splashdown::apps {

namespace {

template <int d>
NodeKind kind_of(const fluid::Nodes<d>& nodes, std::size_t i, bool has_cell) {
  if (!has_cell) return NodeKind::drop;
  const auto& tie = nodes.tie[i];
  if (tie.wall < 0) return nodes.surface[i] ? NodeKind::free_surface : NodeKind::interior;
  if (tie.vertex >= 0) return NodeKind::wall_vertex;
  return nodes.surface[i] ? NodeKind::contact : NodeKind::wall;
}

template <int d>
void take_fluid(const fluid::Fluid<d>& fluid, Frame<d>& frame) {
  const auto& nodes = fluid.nodes();
  frame.x = nodes.x;
  frame.p = nodes.p;
  frame.cells = fluid.mesh().cells;
  std::vector<char> has_cell(nodes.size(), 0);
  for (const auto& cell : frame.cells)
    for (const int node : cell) has_cell[static_cast<std::size_t>(node)] = 1;
  frame.v.reserve(nodes.size());
  frame.kind.reserve(nodes.size());
  frame.wall.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    frame.v.push_back(fluid.velocity_n(i));
    frame.kind.push_back(kind_of(nodes, i, has_cell[i] != 0));
    frame.wall.push_back(nodes.tie[i].wall);
  }
}

template <int d, class Surface>
Outline<d> outline_at(const std::string& name, const Surface& surface, const fluid::Isometry<d>& pose) {
  return {name, {pose * surface.vertices, surface.facets}, pose.linear().col(0)};
}

}  // namespace

template <int d>
Frame<d> take_frame(const RecordInput<d>& input) {
  Frame<d> frame;
  frame.time = input.time;
  if (input.fluid) {
    take_fluid(*input.fluid, frame);
    const auto& walls = input.fluid->spec().walls;
    for (std::size_t w = 0; w < walls.size(); ++w)
      frame.outlines.push_back(outline_at<d>(walls[w].name, walls[w].surface, input.fluid->wall_poses()[w]));
  }
  for (std::size_t b = 0; input.bodies && b < input.bodies->size(); ++b) {
    const auto& spec = input.bodies->spec(b);
    if (std::ranges::find(frame.outlines, spec.name, &Outline<d>::name) == frame.outlines.end())
      frame.outlines.push_back(outline_at<d>(spec.name, spec.surface, input.bodies->state(b).pose));
  }
  return frame;
}

template <int d>
int wall_index(const fluid::Fluid<d>& fluid, const std::string& name) {
  const auto& walls = fluid.spec().walls;
  const auto found = std::ranges::find(walls, name, &fluid::WallSpec<d>::name);
  return found == walls.end() ? -1 : static_cast<int>(found - walls.begin());
}

template <int d>
int wall_called(const fluid::Fluid<d>& fluid, const std::string& name) {
  const int wall = wall_index(fluid, name);
  if (wall < 0) throw std::invalid_argument("a record names the wall \"" + name + "\", which does not exist");
  return wall;
}

template <int d>
std::size_t body_index(const rigid::Bodies<d>& bodies, const std::string& name) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.spec(b).name == name) return b;
  throw std::invalid_argument("a record names the body \"" + name + "\", which does not exist");
}

template <int d>
rigid::Vec<d> acceleration_at(const rigid::Vec<d>& r, const rigid::Twist<d>& velocity,
                              const rigid::Twist<d>& acceleration) {
  if constexpr (d == 2) {
    const double alpha = acceleration(2), w = velocity(2);
    return rigid::Vec<2>(acceleration(0) - alpha * r.y() - w * w * r.x(),
                         acceleration(1) + alpha * r.x() - w * w * r.y());
  } else {
    const Eigen::Vector3d alpha = acceleration.template tail<3>(), w = velocity.template tail<3>();
    return acceleration.template head<3>() + alpha.cross(r) + w.cross(w.cross(r));
  }
}

template <int d>
EffectColumns effect_columns(const fluid::Fluid<d>& fluid) {
  const auto& nodes = fluid.nodes();
  std::vector<double> lumped_mass(nodes.size(), 0);
  double factorial = 1;
  for (int k = 2; k <= d; ++k) factorial *= k;
  for (const auto& cell : fluid.mesh().cells) {
    fluid::Mat<d> edges;
    const auto& origin = nodes.x[static_cast<std::size_t>(cell[0])];
    for (std::size_t k = 1; k < cell.size(); ++k)
      edges.col(static_cast<Eigen::Index>(k) - 1) = nodes.x[static_cast<std::size_t>(cell[k])] - origin;
    const double share = fluid.spec().density * edges.determinant() / factorial / (d + 1);
    for (const int node : cell) lumped_mass[static_cast<std::size_t>(node)] += share;
  }
  EffectColumns columns;
  for (const auto& term : fluid.terms())
    for (const auto& [name, value] : term->diagnostics(nodes, lumped_mass)) {
      columns.names.push_back(term->name() + "_" + name);
      columns.values.push_back(value);
    }
  return columns;
}

template <int d>
double max_speed(const fluid::Fluid<d>& fluid) {
  double squared = 0;
  for (std::size_t i = 0; i < fluid.nodes().size(); ++i) squared = std::max(squared, fluid.velocity_n(i).squaredNorm());
  return std::sqrt(squared);
}

template <int d>
double water_level(const fluid::Fluid<d>& fluid) {
  const auto& nodes = fluid.nodes();
  double level = std::numeric_limits<double>::quiet_NaN();
  for (const auto& facet : fluid.mesh().boundary) {
    if (facet.wall >= 0) continue;
    for (const int node : facet.nodes) level = std::fmax(level, nodes.x[static_cast<std::size_t>(node)](d - 1));
  }
  return level;
}

#define SPLASHDOWN_INSTANTIATE(d)                                                                                  \
  template Frame<d> take_frame<d>(const RecordInput<d>&);                                                          \
  template int wall_index<d>(const fluid::Fluid<d>&, const std::string&);                                          \
  template int wall_called<d>(const fluid::Fluid<d>&, const std::string&);                                         \
  template std::size_t body_index<d>(const rigid::Bodies<d>&, const std::string&);                                 \
  template rigid::Vec<d> acceleration_at<d>(const rigid::Vec<d>&, const rigid::Twist<d>&, const rigid::Twist<d>&); \
  template EffectColumns effect_columns<d>(const fluid::Fluid<d>&);                                                \
  template double max_speed<d>(const fluid::Fluid<d>&);                                                            \
  template double water_level<d>(const fluid::Fluid<d>&);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::apps
