// Masses, moments of inertia, speeds and sizes of bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/check/questions/prepared_scene.hpp"
#include "apps/check/words.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {
namespace {

template <int d>
using QuestionOfBody = void (*)(const PreparedScene<d>&, const PreparedBody<d>&, Questions&);

/// A shell has at most three times the moment of a full body (two masses at the ends of a rod against the rod), a core
/// within a light hull a tenth.
constexpr double most_inertia = 3, least_inertia = 0.1;

template <int d>
void about_inertia(const PreparedScene<d>&, const PreparedBody<d>& of, Questions& list) {
  const auto& body = *of.body;
  if (!body.inertia || body.without_mass || (!body.mass && !body.density)) return;
  const auto given = mass_properties<d>(body);
  const auto full = rigid::with_mass(of.uniform, given.mass).inertia;
  const auto ratios = (given.inertia.diagonal().array() / full.diagonal().array()).eval();
  const double most = ratios.maxCoeff(), least = ratios.minCoeff();
  if (most <= most_inertia && least >= least_inertia) return;
  const double ratio = most > most_inertia ? most : least;
  const double gyration = std::sqrt(given.inertia.diagonal().maxCoeff() / given.mass);
  const double in_mm = 1e-6 * ratio;  // kg mm^2 and kg m^2
  list.push_back(fmt::format(
      "body.{}.inertia is {:.3g} times that of uniform density (radius of gyration {:.3g} m, hull {:.3g} m long): {}: "
      "did you mean {}?",
      body.name, ratio, gyration, of.box.sizes().maxCoeff(),
      most > most_inertia ? "more than a shell has" : "less than a core has",
      in_mm <= most_inertia && in_mm >= least_inertia
          ? fmt::format("kg m^2 instead of kg mm^2, {:.3g} for {:.3g}", 1e-6 * given.inertia.diagonal().maxCoeff(),
                        given.inertia.diagonal().maxCoeff())
          : fmt::format("about {:.3g}, that of uniform density", full.diagonal().maxCoeff())));
}

template <int d>
void about_centre_of_mass(const PreparedScene<d>&, const PreparedBody<d>& of, Questions& list) {
  const auto& body = *of.body;
  if (!body.centre_of_mass) return;
  const rigid::Vec<d> centre = vec<d>(*body.centre_of_mass);
  const auto box = extents<d>(shape_of<d>(body.shape).surface);
  if (box.contains(centre)) return;
  list.push_back(fmt::format(
      "body.{}.centre_of_mass = {} m lies outside the hull, which spans {} m in its own frame: did you "
      "mean {} m?",
      body.name, text<d>(centre), text<d>(box),
      text<d>(box.contains(rigid::Vec<d>(centre / 1000)) ? rigid::Vec<d>(centre / 1000) : of.uniform.centre, 3)));
}

/// Foam has 10 to 30 kg/m^3, lead 11340. Who gives a density below foam's means air, 1.2, or nothing.
constexpr double foam = 5, lead = 11400;
// What ask_about_mass of questions.cpp asks about already.
constexpr double air = 1, osmium = 22600;

template <int d>
void about_density_of_body(const PreparedScene<d>&, const PreparedBody<d>& of, Questions& list) {
  const auto& body = *of.body;
  if (body.motion != Motion::free || body.without_mass) return;
  const double density = mass_properties<d>(body).mass / of.uniform.mass;
  if (density <= lead && (density >= foam || !body.mass)) return;
  if (density < air || density > osmium) return;
  list.push_back(
      fmt::format("body.{} has a mean density of {:.3g} kg/m^3: {} than {}: are {} and lengths in kilograms "
                  "and metres, did you mean another one?",
                  body.name, density, density < foam ? "lighter" : "heavier",
                  density < foam ? "any foam (10 to 30)" : "lead (11340)", body.mass ? "mass" : "density"));
}

/// A body that starts at rest in the surface and is neither near its equilibrium nor thrown: its weight against buoyancy.
template <int d>
void about_weight(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  const auto& body = *of.body;
  const double most = 3;  // a body that is lifted out to a third of its draft, or pressed under to three times
  const bool pierces = of.wet > 0.02 && of.wet < 0.98;
  const bool tied = std::ranges::any_of(prepared.scene.joints, [&](const Joint& joint) {
    const auto index = static_cast<std::size_t>(&body - prepared.scene.bodies.data());
    return joint.body == index || joint.other == index;
  });
  const bool held_up = std::ranges::find(body.free, d == 2 ? "y" : "z") == body.free.end();
  if (body.motion != Motion::free || body.without_mass || !pierces || tied || held_up || prepared.pull <= 0) return;
  if (!body.velocity.isZero(0)) return;
  const double displaced = prepared.scene.fluid->density * of.wet * of.uniform.mass,
               mass = mass_properties<d>(body).mass;
  if (mass <= most * displaced && displaced <= most * mass) return;
  list.push_back(fmt::format(
      "body.{} starts at rest in the surface, weighs {} times the water that it displaces and {}: did you mean another "
      "{}, or another position? At that position {:.4g} {} float",
      body.name, rough(mass / displaced), mass > displaced ? "drops" : "leaps", body.mass ? "mass" : "density",
      displaced, d == 2 ? "kg/m" : "kg"));
}

/// Dropped from more than twenty times its length and more than seven metres, V = 12 m/s.
template <int d>
void about_drop_speed(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  const double g = 9.81, fast = 12, many = 20;
  const auto& body = *of.body;
  // Without gravity nothing falls: such scenes are of impacts alone.
  if (body.motion == Motion::fixed || !body.path.empty() || !prepared.level || prepared.pull <= 0) return;
  const double down = -body.velocity[d - 1], height = down * down / (2 * g), length = of.box.sizes().maxCoeff();
  if (down <= fast || height <= many * length) return;
  list.push_back(
      fmt::format("body.{}.velocity: {:.4g} m/s downward is a fall from {:.3g} m, {} times its length: is it in km/h? "
                  "Did you mean {:.3g} m/s?",
                  body.name, down, height, rough(height / length), down / 3.6));
}

/// At a twentieth of the speed of sound in water loads of flat parts are those of compression, which is not here.
template <int d>
void about_speed_of_sound(const PreparedScene<d>&, const PreparedBody<d>& of, Questions& list) {
  const double fastest = 1480. / 20;
  const auto& body = *of.body;
  const double tip = of.box.sizes().norm() / 2 * body.spin_deg.norm() * radians, speed = body.velocity.norm();
  if (std::max(tip, speed) <= fastest) return;
  list.push_back(
      fmt::format("body.{}.{} = {:.3g} m/s{}: above a twentieth of the speed of sound in water (1480 m/s): "
                  "did you mean {:.3g} m/s?",
                  body.name, speed > fastest ? "velocity" : "spin_deg", std::max(tip, speed),
                  speed > fastest ? "" : " at its ends", std::max(tip, speed) / 1000));
}

/// Froude number along the water of planing hulls: seldom above six.
template <int d>
void about_forward_speed(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  const double most = 8, fast = 30;  // [-], [m/s]
  const auto& body = *of.body;
  if (prepared.pull <= 0 || body.motion == Motion::fixed) return;
  const double speed = body.velocity.head(d - 1).norm(),
               froude = speed / std::sqrt(prepared.pull * of.box.sizes().maxCoeff());
  if (froude <= most || speed <= fast || speed > 1480. / 20) return;
  list.push_back(
      fmt::format("body.{}.velocity: {:.3g} m/s along the water, Fr = {:.2g}: faster than anything alights: is "
                  "it in km/h? Did you mean {:.3g} m/s?",
                  body.name, speed, froude, speed / 3.6));
}

/// The first step would throw the water aside: a start that no experiment has.
template <int d>
void about_wet_start(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  const double share = 0.1, slow = 0.2;  // of the volume; of sqrt(g L)
  const auto& body = *of.body;
  const double down = -body.velocity[d - 1], length = of.box.sizes().maxCoeff();
  const double gravity = prepared.pull > 0 ? prepared.pull : 9.81;
  if (body.motion == Motion::fixed || !body.path.empty() || of.wet <= share) return;
  if (down <= slow * std::sqrt(gravity * length)) return;
  const double up = *prepared.level - of.box.min()[d - 1];
  list.push_back(fmt::format(
      "body.{} starts {} under water with {:.3g} m/s downward, which throws the water aside in one step: did you mean "
      "to "
      "begin it at the water, {:.4g} m higher?",
      body.name, of.wet > 0.999 ? "all" : fmt::format("by {:.0f} % of its volume", 100 * of.wet), down, up));
}

template <int d>
void about_thin_hull(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  if (!prepared.scene.fluid) return;
  const auto& body = *of.body;
  const double thin = extents<d>(shape_of<d>(body.shape).surface).sizes().minCoeff();
  if (body.size <= thin) return;
  list.push_back(
      fmt::format("body.{}.size = {:.3g} m: elements larger than the hull is thick, {:.3g} m: did you mean "
                  "{:.2g} m?",
                  body.name, body.size, thin, thin / 4));
}

/// Faces of less than a degree: air decides, not the deadrise (Chuang 1967: below three). Steeper than 85: a side.
template <int d>
void about_faces(const PreparedScene<d>&, const PreparedBody<d>& of, Questions& list) {
  const double least = 1, most = 85;
  std::optional<double> angle;
  if (const auto* wedge = std::get_if<WedgeShape>(&of.body->shape)) angle = wedge->deadrise_deg;
  if (const auto* cone = std::get_if<ConeShape>(&of.body->shape)) angle = cone->deadrise_deg;
  if (!angle || (*angle >= least && *angle <= most)) return;
  list.push_back(fmt::format("body.{}.shape.deadrise_deg = {:g}: {}: is it in radians? Did you mean {:.3g}?",
                             of.body->name, *angle,
                             *angle < least ? "as good as flat, where trapped air decides" : "almost upright",
                             *angle < least ? *angle / radians : 90 - *angle));
}

/// A tank of five hundred hulls' lengths, or a hull that fills it.
template <int d>
void about_room(const PreparedScene<d>& prepared, const PreparedBody<d>& of, Questions& list) {
  const double most = 500;
  if (!prepared.scene.tank) return;
  const double tank = extents<d>(*prepared.scene.tank).sizes().maxCoeff(), length = of.box.sizes().maxCoeff();
  if (tank <= most * length) return;
  list.push_back(
      fmt::format("body.{} is {:.3g} m long in a tank of {:.3g} m, {} times its length: are both in metres? Did "
                  "you mean {:.3g} m?",
                  of.body->name, length, tank, rough(tank / length), length * 1000));
}

template <int d>
constexpr QuestionOfBody<d> questions_of_bodies[] = {about_inertia<d>,
                                                     about_centre_of_mass<d>,
                                                     about_density_of_body<d>,
                                                     about_weight<d>,
                                                     about_drop_speed<d>,
                                                     about_speed_of_sound<d>,
                                                     about_wet_start<d>,
                                                     about_thin_hull<d>,
                                                     about_forward_speed<d>,
                                                     about_faces<d>,
                                                     about_room<d>};

}  // namespace

template <int d>
void ask_about_bodies(const PreparedScene<d>& prepared, Questions& list) {
  for (const auto& body : prepared.bodies)
    for (const auto question : questions_of_bodies<d>) question(prepared, body, list);
}

template void ask_about_bodies<2>(const PreparedScene<2>&, Questions&);
template void ask_about_bodies<3>(const PreparedScene<3>&, Questions&);

}  // namespace splashdown::apps
