#include "apps/new/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/effects/symmetry/symmetry.hpp"
#include "apps/new/measures.hpp"
#include "apps/new/numbers.hpp"
#include "apps/new/records.hpp"
#include "apps/new/tank.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/outlook.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

constexpr double gravity = 9.81;                                        // [m/s^2]
constexpr double sinking_time = 0.01, nearest = 0.005, highest = 0.02;  // [s]; of the length
constexpr double peaks = 4, swings = 2, before_waves = 0.98;
constexpr double cfc_60 = 0.0016;  // 600 samples a second [s]

template <int d>
Point point_of(const std::vector<double>& numbers) {
  Point point = Point::Zero();
  for (int k = 0; k < d; ++k) point[k] = numbers[static_cast<std::size_t>(k)];
  return point;
}

void refuse(bool wrong, const std::string& text) {
  if (wrong) throw NewError(text);
}

template <int d>
Body body_of(const NewOptions& options, const NewHull& hull) {
  Body body;
  body.name = hull.name;
  body.shape = hull.shape;
  body.mass = options.mass;
  body.free = freedom_names(d);
  body.attitude.pitch_deg = options.pitch;
  body.attitude.roll_deg = options.roll;
  body.velocity[0] = options.forward;
  body.velocity[d - 1] = -*options.sink;
  if (!options.centre.empty()) body.centre_of_mass = point_of<d>(numbers_of_list("--centre", options.centre, d));
  if (!options.inertia.empty()) {
    const auto moments = numbers_of_list("--inertia", options.inertia, d == 2 ? 1 : 3);
    refuse(std::ranges::any_of(moments, [](double m) { return !(m > 0); }),
           fmt::format("--inertia {}: all moments must be positive (kg m^2)", options.inertia));
    Point diagonal = Point::Zero();
    if (d == 2) diagonal[2] = moments[0];
    if (d == 3) diagonal = point_of<3>(moments);
    body.inertia = diagonal.asDiagonal();
  }
  return body;
}

/// Above still water, in the middle of the tank's breadth.
template <int d>
void place(LandingPlan& plan, const Measures<d>& m) {
  auto& body = plan.scene.bodies.front();
  const double length = m.box.sizes().maxCoeff(), sink = -body.velocity[d - 1];
  const double gap = rounded(std::clamp(sinking_time * sink, nearest * length, highest * length), 2);
  const double digits = 1e-5 * length, step = std::pow(10., std::floor(std::log10(digits)));
  const double many = std::max(1., std::round(1 / step));  // whole
  const auto written = [&](double x) { return std::abs(x) < digits ? 0 : std::round(x * many) / many; };
  for (int k = 0; k < d - 1; ++k) body.position[k] = written(-m.box.center()[k]);
  body.position[d - 1] = std::ceil((gap - m.box.min()[d - 1]) * many) / many;
  plan.told.push_back({"start", fmt::format("the lowest point is {} above still water, at 0 m{}", with_unit(gap, "m"),
                                            d == 3 ? "; the middle of the hull is over x = y = 0"
                                                   : "; the middle of the hull is over x = 0")});
  plan.told.push_back(
      {"motion",
       fmt::format("{:g} m/s forward along +x, {:g} m/s down, pitch {:g} deg{}; free in all directions",
                   body.velocity[0], sink, body.attitude.pitch_deg,
                   body.attitude.roll_deg == 0 ? "" : fmt::format(", roll {:g} deg", body.attitude.roll_deg))});
}

template <int d>
double draft_of(const Scene& scene, const Measures<d>& m) {
  const double mass = *scene.bodies.front().mass, density = scene.fluid->density;
  return mass >= density * m.volume ? m.height : mass / (density * m.plan);
}

/// The scene is complete but for its end and its tank.
template <int d>
Entry first_entry(Scene scene, const Measures<d>& m) {
  const double longest = 4 * (m.height + m.length), down = -scene.bodies.front().velocity[d - 1];
  scene.time.end = longest / std::max(down, std::sqrt(gravity * m.height));
  const auto look = outlook<d>(scene);
  if (!look.entry)
    throw NewError("the hull does not reach the water within four times its own height. Use another --sink");
  return *look.entry;
}

template <int d>
void choose_end(const NewOptions& options, const Measures<d>& m, const Entry& entry, LandingPlan& plan) {
  auto& scene = plan.scene;
  const double sunk = m.height / entry.speed, swing = pi * std::sqrt(draft_of<d>(scene, m) / gravity);
  const double peak = peaks * entry.peak_time();
  double after = std::max(peak, swings * std::min(sunk, swing));
  const double width = std::pow(m.box.sizes().template head<d - 1>().prod(), 1. / (d - 1));
  const double calm = before_waves * pi * std::sqrt(width / gravity) - entry.time;
  const bool cut = after > calm && calm > peak;
  if (cut) after = calm;
  scene.time.end = options.end.value_or(cut ? entry.time + after : rounded_up(entry.time + after));
  if (cut && !options.end) scene.time.end = std::floor(scene.time.end * 1e3) / 1e3;
  scene.time.dt_max = cfc_60;
  scene.output.frames = rounded_up(scene.time.end / 50, 2);
  const std::string contact = fmt::format("the hull touches the water at {}", with_unit(entry.time, "s"));
  const std::string why =
      options.end     ? "by --end"
      : cut           ? "half a swing of its breadth, from which on its waves matter"
      : after == peak ? fmt::format("four times the {} to the largest load by von Karman's formula",
                                    with_unit(entry.peak_time(), "s"))
      : sunk < swing  ? fmt::format("twice the {} in which it sinks by its own height", with_unit(sunk, "s"))
                      : fmt::format("twice half a swing in heave, {}: a rebound is in it", with_unit(swing, "s"));
  plan.told.push_back(
      {"end", fmt::format("{:g} s: {}{} (--end)", scene.time.end, options.end ? "" : contact + "; then ", why)});
  if (entry.time >= scene.time.end)
    throw NewError(fmt::format("--end {:g}: {}, and nothing is wetted before. Use {:g} s or more", scene.time.end,
                               contact, rounded_up(entry.time + after)));
}

template <int d>
void choose_symmetry(LandingPlan& plan) {
  const Mirror mirror{d == 3 ? 1 : 0, 0};
  const auto found = asymmetries<d>(plan.scene, mirror);
  plan.symmetric = found.empty();
  // What the hull or its motion breaks is the cause; that the tank is longer ahead follows from it.
  const auto of_body = std::ranges::find_if(found, [](const Asymmetric& a) { return a.key.starts_with("body."); });
  const std::string rule = found.empty() ? "" : (of_body == found.end() ? found.front() : *of_body).rule;
  plan.told.push_back(
      {"symmetry",
       plan.symmetric
           ? fmt::format("half of the water is simulated, about {} = 0: hull, mass and motion are their own "
                         "mirror image. What breaks it (roll, yaw, drift) is not seen; remove the table then",
                         d == 3 ? "y" : "x")
           : fmt::format("the whole water is simulated: {}", rule.substr(rule.find(": ") + 2))});
}

/// Zeros for what roundoff has left of them.
template <int d>
rigid::Vec<d> plain(rigid::Vec<d> x, double length) {
  const double roundoff = 1e-8;  // of sums over facets
  for (auto& entry : x) entry = std::abs(entry) < roundoff * length ? 0 : entry;
  return x;
}

template <int d>
void tell_mass(const NewOptions& options, const Measures<d>& m, LandingPlan& plan) {
  const auto& body = plan.scene.bodies.front();
  const auto properties = mass_properties<d>(body);
  const double mean = *body.mass / m.volume;
  plan.told.push_back(
      {"mass", fmt::format("{:g} {}, {:.3g} of the water's density; centre of mass at {} m of the hull's frame{}; "
                           "moments of inertia {}",
                           *body.mass, d == 2 ? "kg/m" : "kg", mean / plan.scene.fluid->density,
                           text<d>(plain<d>(properties.centre, m.length), 4),
                           body.centre_of_mass ? "" : ", that of uniform density (--centre)",
                           body.inertia ? "as given" : "of uniform density (--inertia)")});
  if (mean >= plan.scene.fluid->density)
    plan.told.push_back({"mass",
                         "QUESTION: the hull is heavier than the water that it can displace and sinks: are mass and "
                         "unit right?"});
  plan.told.push_back(
      {"water", fmt::format("{:g} kg/m^3 (--water 1025 for the sea), still, with gravity", options.density)});
}

}  // namespace

void check_numbers(const NewOptions& o) {
  refuse(
      !o.mass,
      "--mass is missing: no load follows without it. Use kilograms, in the plane kilograms a metre, e.g. --mass 12");
  refuse(!(*o.mass > 0) || !std::isfinite(*o.mass),
         fmt::format("--mass {:g}: must be positive (kg). Use e.g. --mass 12", *o.mass));
  refuse(!o.sink,
         "--sink is missing: the speed downward at the water. Use metres per second, e.g. --sink 3; 0 lets go of the "
         "hull there");
  refuse(!(*o.sink >= 0) || !std::isfinite(*o.sink),
         fmt::format("--sink {:g}: must not be negative (m/s), downward is positive. Use e.g. --sink {:g}", *o.sink,
                     std::isfinite(*o.sink) ? -*o.sink : 3));
  refuse(!std::isfinite(o.forward) || o.forward < 0,
         fmt::format("--forward {:g}: must not be negative (m/s). Turn the hull with --nose -x instead", o.forward));
  refuse(!(std::abs(o.pitch) <= 90),
         fmt::format("--pitch {:g}: must be from -90 to 90 (deg), nose up is positive", o.pitch));
  refuse(!(std::abs(o.roll) <= 180), fmt::format("--roll {:g}: must be from -180 to 180 (deg)", o.roll));
  refuse(o.plane && o.roll != 0, "--roll: a plane scene has none. Leave it out, or leave out --plane");
  refuse(!(o.density > 0) || !std::isfinite(o.density),
         fmt::format("--water {:g}: must be positive (kg/m^3)", o.density));
  refuse(!(o.accuracy > 0 && o.accuracy < 100),
         fmt::format("--accuracy {:g}: must be between 0 and 100 (%)", o.accuracy));
  refuse(o.end && (!(*o.end > 0) || !std::isfinite(*o.end)),
         fmt::format("--end {:g}: must be positive (s)", o.end.value_or(0)));
  refuse(o.depth && (!(*o.depth > 0) || !std::isfinite(*o.depth)),
         fmt::format("--depth {:g}: must be positive (m)", o.depth.value_or(0)));
}

template <int d>
LandingPlan landing_plan(const NewOptions& options, const NewHull& hull) {
  LandingPlan plan;
  plan.told = hull.told;
  auto& scene = plan.scene;
  scene.dimension = d;
  scene.title = fmt::format("{} lands: {:g} m/s forward, {:g} m/s down, pitch {:g} deg", hull.name, options.forward,
                            *options.sink, options.pitch);
  scene.gravity.emplace();
  scene.gravity->acceleration = Point::Zero();
  scene.gravity->acceleration[d - 1] = -gravity;
  scene.fluid.emplace().density = options.density;
  scene.bodies.push_back(body_of<d>(options, hull));
  const auto m = measures_of<d>(scene.bodies.front());
  tell_mass<d>(options, m, plan);
  place<d>(plan, m);
  // Water for the outlook, wide enough for any tank.
  BoxRegion sea{.min = Point::Constant(-1e3 * m.box.sizes().maxCoeff()),
                .max = Point::Constant(1e3 * m.box.sizes().maxCoeff())};
  sea.max[d - 1] = 0;
  scene.fluid->regions = {{.shape = sea}};
  const auto entry = first_entry<d>(scene, m);
  choose_end<d>(options, m, entry, plan);
  choose_tank<d>(options, m, entry, plan);
  choose_symmetry<d>(plan);
  add_records<d>(options, plan);
  return plan;
}

template LandingPlan landing_plan<2>(const NewOptions&, const NewHull&);
template LandingPlan landing_plan<3>(const NewOptions&, const NewHull&);

}  // namespace splashdown::apps
