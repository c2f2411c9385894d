#include "apps/scene/outlook/impact_theory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

/// A hull that meets the water with its lowest point: half of its width at a depth, and what the rise of the water makes of the depth.
struct EnteringShape {
  double tangent = 0;  ///< of the deadrise of straight sides
  double radius = 0;   ///< of round ones
  double widest = 0;   ///< half of its full width [m]
  double rise = 1;     ///< Wagner's

  double half_width(double depth) const {
    if (radius > 0) return std::sqrt(std::max(0., depth * (2 * radius - depth)));
    return depth / tangent;
  }
  double deepest() const { return radius > 0 ? radius : widest * tangent; }
};

/// Straight sides that stand as in their shape's frame: the scene has the deadrise beside the lowest point.
std::optional<EnteringShape> straight(double deadrise_deg, double widest, double rise, const Entry& entry) {
  constexpr double upright = 0.01;
  const double angle = deadrise_deg * radians;
  if (!entry.deadrise || std::abs(*entry.deadrise - angle) > upright * angle) return {};
  return EnteringShape{.tangent = std::tan(angle), .widest = widest, .rise = rise};
}

std::optional<EnteringShape> entering_shape(const Shape& shape, const Entry& entry) {
  if (const auto* wedge = std::get_if<WedgeShape>(&shape))
    return straight(wedge->deadrise_deg, wedge->breadth / 2, pi / 2, entry);
  if (const auto* cone = std::get_if<ConeShape>(&shape))
    return straight(cone->deadrise_deg, cone->radius, 4 / pi, entry);
  if (const auto* circle = std::get_if<CircleShape>(&shape))
    return EnteringShape{.radius = circle->radius, .widest = circle->radius, .rise = 2};
  if (const auto* sphere = std::get_if<SphereShape>(&shape))
    return EnteringShape{.radius = sphere->radius, .widest = sphere->radius, .rise = 1.5};
  return {};
}

struct TheoryCurve {
  std::vector<double> time, load;

  double at(double t) const {
    const auto above = std::ranges::upper_bound(time, t);
    if (above == time.begin()) return load.front();
    if (above == time.end()) return load.back();
    const auto i = static_cast<std::size_t>(above - time.begin());
    return load[i - 1] + (load[i] - load[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
  }
};

TheoryCurve curve_of(const EnteringShape& shape, double rise, const Outlook& look, double mass) {
  constexpr int steps = 200;
  const double density = look.scene.fluid->density, speed = look.entry->speed;
  const auto added = [&](double depth) {
    const double c = std::min(shape.half_width(rise * depth), shape.widest);
    return look.dimension() == 2 ? pi / 2 * density * c * c : 4. / 3 * density * c * c * c;
  };
  const double step = shape.deepest() / rise / steps;
  TheoryCurve curve;
  double time = look.entry->time, before = 0;
  for (int i = 0; i < steps; ++i) {
    const double after = added((i + 1) * step), share = 1 + 0.5 * (before + after) / mass, takes = step * share / speed;
    curve.time.push_back(time + 0.5 * takes);
    curve.load.push_back(speed * speed * (after - before) / step / (share * share * share));
    time += takes;
    before = after;
  }
  return curve;
}

double entering_mass(const Scene& scene, const Body& body) {
  if (body.motion != Motion::free) return std::numeric_limits<double>::infinity();
  return scene.dimension == 2 ? mass_properties<2>(body).mass : mass_properties<3>(body).mass;
}

}  // namespace

std::optional<ImpactTheory> impact_theory(const Outlook& look) {
  if (!look.entry || !look.scene.fluid) return {};
  const auto& body = look.scene.bodies[look.entry->body];
  const auto shape = entering_shape(body.shape, *look.entry);
  if (!shape || look.entry->flat()) return {};
  const double mass = entering_mass(look.scene, body);
  const auto karman = curve_of(*shape, 1, look, mass), wagner = curve_of(*shape, shape->rise, look, mass);
  ImpactTheory theory;
  for (const double t : wagner.time) {
    if (t > look.scene.time.end) break;
    theory.time.push_back(t);
    theory.karman.push_back(karman.at(t));
    theory.wagner.push_back(wagner.at(t));
  }
  if (theory.time.size() < 2) return {};
  return theory;
}

}  // namespace splashdown::apps
