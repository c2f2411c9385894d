#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/build.hpp"
#include "apps/closing.hpp"
#include "apps/commands.hpp"
#include "apps/cost.hpp"
#include "apps/progress.hpp"
#include "apps/scales.hpp"
#include "apps/scene_geometry.hpp"
#include "apps/scene_read.hpp"
#include "rigid/hydrostatics.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;
constexpr double degrees = 180 / pi;

void row(const std::string& head, const std::string& text) { fmt::print("  {:<22}{}\n", head, text); }

/// Two significant digits, without an exponent where people do not want one.
std::string rough(double value) {
  if (!(value >= 10 && value < 1e7)) return fmt::format("{:.2g}", value);
  const double step = std::pow(10., std::floor(std::log10(value)) - 1);
  return fmt::format("{:.0f}", std::round(value / step) * step);
}

std::string pair_text(const rigid::Vec<2>& x) { return fmt::format("({:.6g}, {:.6g}) m", x.x(), x.y()); }

std::string motion_text(const Body& body) {
  switch (body.motion) {
    case Motion::fixed:
      return "fixed";
    case Motion::prescribed:
      return body.path.empty() ? fmt::format("prescribed: velocity ({:g}, {:g}) m/s, spin {:g} deg/s",
                                             body.velocity.x(), body.velocity.y(), body.spin_deg)
                               : fmt::format("prescribed: path of {} points to {:g} s", body.path.size(),
                                             body.path.back().time);
    case Motion::free:
      break;
  }
  return fmt::format("free in {}; starts with ({:g}, {:g}) m/s, {:g} deg/s", fmt::join(body.free, ", "),
                     body.velocity.x(), body.velocity.y(), body.spin_deg);
}

/// Smallest angle between the water and the bottom beside the lowest point, at the initial pitch.
std::string deadrise_text(const Body& body, const rigid::Surface<2>& hull) {
  if (std::holds_alternative<CircleShape>(body.shape) || std::holds_alternative<EllipseShape>(body.shape) ||
      std::holds_alternative<CapsuleShape>(body.shape))
    return "0 deg at the lowest point of the round bottom, growing beside it";
  Eigen::Index lowest = 0;
  hull.vertices.row(1).minCoeff(&lowest);
  double least = 90;
  for (Eigen::Index i = 0; i < hull.facets.cols(); ++i) {
    if (hull.facets(0, i) != lowest && hull.facets(1, i) != lowest) continue;
    const rigid::Vec<2> edge = hull.vertices.col(hull.facets(1, i)) - hull.vertices.col(hull.facets(0, i));
    least = std::min(least, std::atan2(std::abs(edge.y()), std::abs(edge.x())) * degrees);
  }
  return fmt::format("{:.4g} deg beside the lowest point", least);
}

/// Round-off of an angle that is meant to be zero is not shown.
double shown_deg(double angle) { return std::abs(angle) * degrees < 1e-6 ? 0 : angle * degrees; }

void print_floating(const Scene& scene, const rigid::BodySpec<2>& spec) {
  const auto level = still_water_level(scene);
  if (!level || !scene.gravity) return;
  const auto rest = rigid::floating_stable(spec.surface, spec.pose, spec.mass, scene.fluid->density, *level);
  if (!rest) return row("at rest", "sinks: heavier than the water it can displace");
  const Eigen::Matrix2d& turn = rest->pose.linear();
  row("at rest", fmt::format("floats with a draft of {:.5g} m, pitch {:.4g} deg, GM {:.4g} m, centre of mass "
                             "{:.4g} m above the water",
                             rest->draft, shown_deg(std::atan2(turn(1, 0), turn(0, 0))),
                             rest->metacentric_height, rest->pose.translation().y() - *level));
}

/// Elements at the tightest curve of the hull, and whether they can follow it.
void print_curvature(const Scene& scene, const Body& body) {
  const auto bends = hull_bends(scene, body);
  if (bends.empty()) return;
  const auto& tight = *std::min_element(bends.begin(), bends.end(),
                                        [](const HullBend& a, const HullBend& b) { return a.radius < b.radius; });
  const double share = tight.size / tight.radius, rounded_up = 1 + 1e-6;
  std::string note;
  if (share > scene.fluid->size.curvature * rounded_up)
    note = fmt::format("; not resolved: use size = {:.2g} m or less, or a sharp edge",
                       4 * scene.fluid->size.curvature * tight.radius);
  else if (share > 0.25 * rounded_up)
    note = "; enough for loads; where a swing has to keep its energy set fluid.size.curvature = 0.25";
  row("curvature", fmt::format("radius {:.3g} m at ({:.3g}, {:.3g}) m, elements {:.3g} m there{}", tight.radius,
                               tight.at.x(), tight.at.y(), tight.size, note));
}

void print_body(const Scene& scene, const Body& body) {
  const auto spec = body_spec(body);
  const auto shape = shape_of(body.shape);
  const auto hull = outline(body);
  const auto box = extents(hull);
  fmt::print("body {}\n", body.name);
  row("motion", motion_text(body));
  row("extent", fmt::format("{:.6g} m x {:.6g} m, area {:.6g} m^2", box.sizes().x(), box.sizes().y(),
                            shape.at_unit_density.mass));
  if (body.mass || body.density) {
    row("mass", fmt::format("{:.6g} kg/m (mean density {:.5g} kg/m^3)", spec.mass,
                            spec.mass / shape.at_unit_density.mass));
    if (spec.mass > 0)
      row("inertia", fmt::format("{:.6g} kg m about the centre of mass (radius of gyration {:.5g} m)",
                                 spec.inertia(0, 0), std::sqrt(spec.inertia(0, 0) / spec.mass)));
  }
  row("centre of mass", fmt::format("{} now, {} in the shape's frame", pair_text(spec.pose.translation()),
                                    pair_text(mass_properties(body).centre)));
  if (!scene.fluid) return;
  row("deadrise", deadrise_text(body, hull));
  row("hull elements", fmt::format("{:g} m", body.size));
  print_curvature(scene, body);
  if (!body.mass && !body.density) return;
  const double added = scene.fluid->density * pi / 8 * box.sizes().x() * box.sizes().x();
  row("density ratio",
      fmt::format("{:.4g} of the liquid's", spec.mass / shape.at_unit_density.mass / scene.fluid->density));
  const std::string plate = fmt::format("about {:.4g} kg/m (flat plate of its breadth)", added);
  if (spec.mass == 0) return row("added mass", plate + ": all the inertia there is; the body has no mass");
  row("added mass", fmt::format("{}: {:.3g} times its mass{}", plate, added / spec.mass,
                                added > spec.mass ? "; needs interface_term rigid, or an accelerator" : ""));
  print_floating(scene, spec);
}

void print_ties(const Scene& scene) {
  for (const auto& joint : scene.joints) {
    const std::string other = joint.other ? scene.bodies[*joint.other].name : "the world";
    const std::string where = joint.type == "hinge"    ? fmt::format(" at ({:g}, {:g}) m", joint.point.x(), joint.point.y())
                              : joint.type == "slider" ? fmt::format(" along ({:g}, {:g})", joint.axis.x(), joint.axis.y())
                                                       : "";
    row(joint.type, fmt::format("{} to {}{}", scene.bodies[joint.body].name, other, where));
  }
  if (scene.contact)
    row("contact", fmt::format("bodies touch each other{}; no rebound, no friction", scene.tank ? " and the tank" : ""));
}

void print_liquid(const Scene& scene) {
  if (!scene.fluid) return;
  const auto& fluid = *scene.fluid;
  fmt::print("liquid\n");
  row("density", fmt::format("{:g} kg/m^3", fluid.density));
  row("regions", fmt::format("{}", fluid.regions.size()));
  if (scene.gravity) row("still water level", fmt::format("{:.6g} m", *still_water_level(scene)));
  row("element sizes", fmt::format("{:g} m at the surface, {:g} m at most, growing {:g} per metre",
                                   fluid.size.surface, fluid.size.far, fluid.size.growth));
  if (scene.tank)
    row("tank", fmt::format("[{:g}, {:g}] x [{:g}, {:g}] m", scene.tank->min.x(), scene.tank->max.x(),
                            scene.tank->min.y(), scene.tank->max.y()));
}

void print_effects(const Scene& scene) {
  fmt::print("effects\n");
  for (const auto& note : effect_notes(scene))
    row((note.active ? "on   " : "off  ") + note.name, note.reason);
  for (const auto& note : neglected(scene)) row("-    " + note.name, note.reason);
  if (!scene.coupling) return;
  const auto& c = *scene.coupling;
  std::string accelerator = fmt::format("accelerator {} from relaxation {:g}", c.accelerator, c.relaxation);
  if (c.accelerator == "anderson") accelerator += fmt::format(", depth {}", c.depth);
  if (c.accelerator == "iqn_ils") accelerator += fmt::format(", reuse {}", c.reuse);
  row("coupling", fmt::format("{}, interface term {}, {}, tolerance {:g}, at most {} passes", c.scheme,
                              c.interface_term, accelerator, c.tolerance, c.max_passes));
}

void print_cost(const Scene& scene) {
  const auto cost = predicted_cost(scene);
  fmt::print("cost (predicted)\n");
  row("steps", fmt::format("about {} to t = {:g} s; dt about {}, at most {}", rough(cost.steps),
                           scene.time.end, with_unit(cost.dt, "s"), with_unit(scene.time.dt_max, "s")));
  if (!scene.fluid) return;
  row("nodes", fmt::format("about {} at the start", rough(cost.nodes)));
  row("memory", fmt::format("about {}", with_unit(cost.bytes, "B")));
  row("a step", fmt::format("about {} on one core", with_unit(cost.seconds_per_step, "s")));
  row("the run", "about " + clock_text(cost.steps * cost.seconds_per_step));
  if (scene.fluid->size.hollow)
    row("not counted", "finer elements at hollows (hollow): more nodes, shorter steps and a longer run than said");
  if (scene.fluid->size.wetted_fraction > 0)
    row("not counted", "larger elements at wetted walls (wetted_fraction): fewer nodes and longer steps than said");
}

}  // namespace

int check_command(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  SceneFile file;
  try {
    file = read_scene(path, overrides);
  } catch (const SceneError& error) {
    return bad_input(error.what());
  }
  const auto& scene = file.scene;
  const auto s = scales(scene);
  fmt::print("{}: {}\n", path.string(), scene.title.empty() ? "(no title)" : scene.title);
  row("units", "SI; two-dimensional masses, loads and volumes are per metre of depth");
  row("scales", fmt::format("L = {:.4g} m, U = {:.4g} m/s, L/U = {}", s.length, s.speed,
                            s.speed > 0 ? with_unit(s.length / s.speed, "s") : "-"));
  print_liquid(scene);
  for (const auto& body : scene.bodies) print_body(scene, body);
  print_ties(scene);
  print_effects(scene);
  print_cost(scene);
  fmt::print("The scene is good. Run it with: splashdown run {}\n", path.string());
  return exit_code::done;
}

}  // namespace splashdown::apps
