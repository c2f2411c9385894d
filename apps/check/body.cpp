#include "apps/check/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/build/build.hpp"
#include "apps/check/floating.hpp"
#include "apps/check/words.hpp"
#include "apps/effects/elastic/elastic.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;
constexpr double degrees = 180 / pi;

template <int d>
std::string spin_text(const Body& body) {
  if constexpr (d == 2)
    return fmt::format("{:g}", body.spin_deg.z());
  else
    return text<d>(vec<d>(body.spin_deg));
}

std::string release_text(const Body& body, int dimension) {
  if (!body.release) return {};
  const auto& of = *body.release;
  const auto at = of.time   ? fmt::format("at {:g} s", *of.time)
                  : of.load ? fmt::format("at a load of {:g} {}", *of.load, dimension == 2 ? "N/m" : "N")
                            : std::string("at contact with the water or a body that moves");
  return fmt::format("; {} let go in {}", at, fmt::join(body.free, ", "));
}

template <int d>
std::string motion_text(const Scene& scene, const Body& body) {
  const auto start = [&](const char* spin) {
    return fmt::format("{} m/s, {}{} deg/s", text<d>(vec<d>(body.velocity)), spin, spin_text<d>(body));
  };
  switch (body.motion) {
    case Motion::fixed:
      return "fixed";
    case Motion::prescribed:
      return (body.oscillation ? fmt::format("prescribed: oscillates with {:g} Hz", body.oscillation->frequency)
              : body.path.empty()
                  ? "prescribed: velocity " + start("spin ")
                  : fmt::format("prescribed: path of {} points to {:g} s", body.path.size(), body.path.back().time)) +
             release_text(body, d);
    case Motion::free:
      break;
  }
  const auto* tables = scene.effects.find<ElasticTables>();
  for (std::size_t k = 0; tables && k < tables->of_bodies.size(); ++k) {
    const auto& table = tables->of_bodies[k];
    if (&scene.bodies[table.body] != &body) continue;
    return table.clamps.empty() ? "deforms and flies; starts with " + start("")
                                : std::string("deforms; held by its clamps");
  }
  return fmt::format("free in {}; starts with {}", fmt::join(body.free, ", "), start(""));
}

template <int d>
std::string deadrise_text(const Body& body) {
  const auto angle = deadrise<d>(body);
  if (!angle) return "0 deg at the lowest point of the round bottom, growing beside it";
  return fmt::format("{:.4g} deg beside the lowest point", *angle * degrees);
}

/// Elements at the tightest curve of the hull, and whether they can follow it.
template <int d>
void print_curvature(const Scene& scene, const Body& body) {
  const auto bends = hull_bends<d>(scene, body);
  if (bends.empty()) return;
  const auto& tight =
      *std::min_element(bends.begin(), bends.end(), [](const auto& a, const auto& b) { return a.radius < b.radius; });
  const double share = tight.size / tight.radius, rounded_up = 1 + 1e-6;
  std::string note;
  if (share > scene.fluid->size.curvature * rounded_up)
    note = fmt::format("; not resolved: use size = {:.2g} m or less, or a sharp edge",
                       4 * scene.fluid->size.curvature * tight.radius);
  else if (share > 0.25 * rounded_up)
    note = "; enough for loads; where a swing has to keep its energy set fluid.size.curvature = 0.25";
  row("curvature", fmt::format("radius {:.3g} m at {} m, elements {:.3g} m there{}", tight.radius, text<d>(tight.at, 3),
                               tight.size, note));
}

const char* plate(const rigid::Surface<2>&) { return "flat plate of its breadth"; }
const char* plate(const rigid::Surface<3>&) { return "disc of its plan area"; }

void print_inertia(const rigid::BodySpec<2>& spec) {
  row("inertia", fmt::format("{:.6g} kg m about the centre of mass (radius of gyration {:.5g} m)", spec.inertia(0, 0),
                             std::sqrt(spec.inertia(0, 0) / spec.mass)));
}

void print_inertia(const rigid::BodySpec<3>& spec) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spec.inertia);  // in closed form: for six digits
  row("inertia", fmt::format("{} kg m^2 about the centre of mass (radii of gyration {} m)",
                             text<3>(rigid::Vec<3>(spec.inertia.diagonal())),
                             text<3>(rigid::Vec<3>((spec.inertia.diagonal() / spec.mass).cwiseSqrt()), 5)));
  const Eigen::Vector3d principal = solver.eigenvalues();
  const double off = (spec.inertia - Eigen::Matrix3d(spec.inertia.diagonal().asDiagonal())).norm();
  if (off < 1e-9 * principal.norm()) return;
  const Eigen::Matrix3d axes = solver.eigenvectors();
  row("principal inertia", fmt::format("{} kg m^2 about {}, {}, {}", text<3>(principal), text<3>(axes.col(0), 3),
                                       text<3>(axes.col(1), 3), text<3>(axes.col(2), 3)));
}

/// Where a hull from a file comes from.
void print_file(const Shape& shape) {
  const auto* file = std::get_if<SurfaceShape>(&shape);
  if (!file || !file->read) return;
  row("surface", fmt::format("{} facets{} from {}, 1 unit = {:g} m", file->read->surface.facets.cols(),
                             file->parts > 1 ? fmt::format(" in {} parts", file->parts) : "", file->file, file->scale));
}

template <int d>
std::string sizes_text(const Extents<d>& box) {
  std::string list;
  for (int k = 0; k < d; ++k) list += fmt::format("{}{:.6g} m", k > 0 ? " x " : "", box.sizes()[k]);
  return list;
}

}  // namespace

template <int d>
void print_body(const Scene& scene, std::size_t number, const std::optional<Resting<d>>& resting) {
  const Body& body = scene.bodies[number];
  const auto spec = body_spec<d>(body);
  const double volume = shape_of<d>(body.shape).at_unit_density.mass;
  const auto hull = outline<d>(body);
  fmt::print("body {}\n", body.name);
  row("motion", motion_text<d>(scene, body));
  row("extent", fmt::format("{}, {} {:.6g} {}", sizes_text<d>(extents<d>(hull)), Units<d>::volume_name, volume,
                            Units<d>::volume));
  print_file(body.shape);
  if (body.mass || body.density) {
    row("mass", fmt::format("{:.6g} {} (mean density {:.5g} kg/m^3{})", spec.mass, Units<d>::mass, spec.mass / volume,
                            body.without_mass && spec.mass > 0 ? "; the scene gives none: the least there is" : ""));
    if (spec.mass > 0) print_inertia(spec);
  }
  row("centre of mass",
      fmt::format("{} m now, {} m in the shape's frame", text<d>(rigid::Vec<d>(spec.pose.translation())),
                  text<d>(mass_properties<d>(body).centre)));
  if ((scene.vortex || scene.ale) && spec.mass > 0 && (body.mass || body.density))
    row("density ratio", fmt::format("{:.4g} of the fluid's", spec.mass / volume / scene.fluid_density()));
  if (!scene.fluid) return;
  row("deadrise", deadrise_text<d>(body));
  const double corner = scene.fluid->size.corner;
  row("hull elements", fmt::format("{:g} m", body.size) +
                           (corner < 1 ? fmt::format(", {:.3g} m at corners", corner * body.size) : std::string()));
  print_curvature<d>(scene, body);
  if (!body.mass && !body.density) return;
  const double added = impact_mass(scene.fluid->density, hull);
  row("density ratio", fmt::format("{:.4g} of the liquid's", spec.mass / volume / scene.fluid->density));
  const std::string about = fmt::format("about {:.4g} {} ({})", added, Units<d>::mass, plate(hull));
  if (body.without_mass) return row("added mass", about + ": all the inertia that counts");
  row("added mass", fmt::format("{}: {:.3g} times its mass{}", about, added / spec.mass,
                                added > spec.mass ? "; needs interface_term rigid, or an accelerator" : ""));
  if (resting) print_floating<d>(scene, number, *resting);
}

template void print_body<2>(const Scene&, std::size_t, const std::optional<Resting<2>>&);
template void print_body<3>(const Scene&, std::size_t, const std::optional<Resting<3>>&);

}  // namespace splashdown::apps
