// Gravity, the liquid, and whether tank and regions fit each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/check/questions/prepared_scene.hpp"
#include "apps/check/words.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

constexpr const char* axis_names[] = {"x", "y", "z"};

/// From the Moon, 1.62, to Jupiter, 24.8 m/s^2.
template <int d>
void about_gravity(const PreparedScene<d>& prepared, Questions& list) {
  const double least = 1.5, most = 30;
  if (!prepared.scene.gravity) return;
  const auto& pull = prepared.scene.gravity->acceleration;
  const double size = pull.norm(), aside = pull.head(d - 1).norm();
  const auto earth = axis_example(d, -9.81);
  if (size > 0 && aside > std::abs(pull[d - 1]))
    list.push_back(
        fmt::format("gravity.acceleration pulls along the horizontal ({:g} m/s^2): up is {}: did you mean {}?", aside,
                    axis_names[d - 1], axis_example(d, -size)));
  else if (size == 0)
    list.push_back(fmt::format("gravity.acceleration is zero: did you mean {}, or no [gravity] at all?", earth));
  else if (size < least || size > most)
    list.push_back(
        fmt::format("gravity.acceleration = {:g} m/s^2: {} (Moon 1.62, Earth 9.81, Jupiter 24.8): did you mean {}?",
                    size, size < least ? "less than on the Moon" : "more than on any planet", earth));
}

/// Between the heaviest organic liquids and salt solutions, 3300 to 3400, and mercury, 13500, there is none.
template <int d>
void about_density_of_liquid(const PreparedScene<d>& prepared, Questions& list) {
  const double solution = 3400, mercury = 13400, heaviest = 13600;
  const double density = prepared.scene.fluid->density;
  if (density <= solution || density >= mercury || density > heaviest) return;
  list.push_back(
      fmt::format("fluid.density = {:g}: between the heaviest solutions (3400) and mercury (13500 kg/m^3) there is "
                  "no liquid: did you mean 1000?",
                  density));
}

/// A wave that its elements show, that does not break (Michell 1893: height over length 0.142), and that fits between walls.
template <int d>
void about_wave(const PreparedScene<d>& prepared, Questions& list) {
  const double least_height = 0.01, breaking = 0.142, fewest = 8, mismatch = 0.05;
  for (std::size_t i = 0; i < prepared.scene.fluid->regions.size(); ++i) {
    const auto* box = std::get_if<BoxRegion>(&prepared.scene.fluid->regions[i].shape);
    if (!box || box->surface_amplitude == 0) continue;
    const double a = std::abs(box->surface_amplitude), length = box->surface_wavelength,
                 h = prepared.scene.fluid->size.surface;
    const std::string label = fmt::format("fluid.region[{}].", i);
    const double halves = 2 * (box->max.x() - box->min.x()) / length;
    if (a < least_height * h)
      list.push_back(
          fmt::format("{}surface_amplitude = {:g} m: a hundredth of an element ({:g} m) or less: did you mean {:g} m?",
                      label, box->surface_amplitude, h, a * 1000));
    if (2 * a > breaking * length)
      list.push_back(
          fmt::format("{}surface_amplitude = {:g} m: a wave of {:g} m breaks at {:.2g} m: did you mean {:g} m?", label,
                      box->surface_amplitude, length, breaking * length / 2, a / 1000));
    if (length < fewest * h)
      list.push_back(
          fmt::format("{}surface_wavelength = {:g} m: fewer than {:g} elements ({:g} m) a wave: did you mean {:g} m?",
                      label, length, fewest, h, length * 1000));
    else if (prepared.scene.tank && std::abs(halves - std::max(1., std::round(halves))) > mismatch)
      list.push_back(
          fmt::format("{}surface_wavelength = {:g} m: {:.3g} half waves between the walls, where standing waves have a "
                      "whole number: did you mean {:g} m?",
                      label, length, halves, 2 * (box->max.x() - box->min.x())));
  }
}

/// Something is above or in this liquid that moves.
template <int d>
bool is_landed_on(const PreparedScene<d>& prepared, const Extents<d>& liquid) {
  return std::ranges::any_of(prepared.bodies, [&](const PreparedBody<d>& of) {
    if (of.body->motion == Motion::fixed) return false;
    rigid::Vec<d> below = of.box.center();
    below[d - 1] = liquid.center()[d - 1];
    return liquid.contains(below);
  });
}

template <int d>
bool rests_on_another(const PreparedScene<d>& prepared, std::size_t region, const Extents<d>& box, double near) {
  for (std::size_t i = 0; i < prepared.scene.fluid->regions.size(); ++i) {
    if (i == region) continue;
    const auto other = extents<d>(outline<d>(prepared.scene.fluid->regions[i]));
    if (std::abs(other.max()[d - 1] - box.min()[d - 1]) <= near) return true;
  }
  return false;
}

/// Where the water that a body lands on ends before the tank does, or reaches beyond it: one of the two has a slip.
template <int d>
void about_fit(const PreparedScene<d>& prepared, Questions& list) {
  if (!prepared.scene.tank) return;
  const auto tank = extents<d>(*prepared.scene.tank);
  const double near = 1e-6 * tank.sizes().maxCoeff();
  for (std::size_t i = 0; i < prepared.scene.fluid->regions.size(); ++i) {
    const auto box = extents<d>(outline<d>(prepared.scene.fluid->regions[i]));
    const bool is_box = std::holds_alternative<BoxRegion>(prepared.scene.fluid->regions[i].shape);
    const bool landed_on = is_box && is_landed_on<d>(prepared, box);
    const bool fills = is_box && prepared.pull > 0 && box.sizes()[0] > tank.sizes()[0] / 2;
    for (int k = 0; k < d; ++k)
      for (const bool upper : {false, true}) {
        const double end = upper ? box.max()[k] : box.min()[k], wall = upper ? tank.max()[k] : tank.min()[k];
        const double beyond = upper ? end - wall : wall - end;
        const bool floor = k == d - 1 && !upper, top = k == d - 1 && upper;
        const std::string key = fmt::format("fluid.region[{}]", i);
        const char* of_tank = upper ? "max" : "min";
        if (beyond > near)
          list.push_back(
              fmt::format("{} reaches {:.3g} m beyond the tank along {}, where it is cut off: did you mean tank.{} to "
                          "be {:g} there, or the region's end {:g}?",
                          key, beyond, axis_names[k], of_tank, end, wall));
        else if (floor && beyond < -near && (landed_on || fills) && !rests_on_another<d>(prepared, i, box, near))
          list.push_back(
              fmt::format("{} begins {:.3g} m above the tank's floor: it falls: did you mean min = {:g} along {}?", key,
                          -beyond, wall, axis_names[k]));
        else if (!floor && !top && beyond < -near && landed_on)
          list.push_back(fmt::format(
              "{} ends {:.3g} m before the tank's wall along {}: nothing holds it there: did you mean {:g}?", key,
              -beyond, axis_names[k], wall));
      }
  }
}

/// As for bodies: at a twentieth of the speed of sound water is no longer incompressible where it hits. Without gravity speed is a mere
/// unit of time, and a slip of it changes nothing but that: then, as in bird strikes, only what comes near to sound is asked about.
template <int d>
void about_speed_of_liquid(const PreparedScene<d>& prepared, Questions& list) {
  const bool falls = prepared.scene.gravity.has_value();
  const double fastest = 1480. / (falls ? 20 : 3);
  for (std::size_t i = 0; i < prepared.scene.fluid->regions.size(); ++i) {
    const auto& region = prepared.scene.fluid->regions[i];
    const double reach = extents<d>(outline<d>(region)).sizes().norm() / 2;
    const double speed = region.velocity.norm(), sheared = region.velocity_gradient.norm() * reach;
    const double most = std::max(speed, sheared / std::sqrt(2.));
    if (most > 2 * fastest || speed > fastest)
      list.push_back(fmt::format(
          "fluid.region[{}].{}: {:.3g} m/s is above a {} of the speed of sound in water: did you mean {:.3g}?", i,
          speed > fastest ? "velocity" : "velocity_gradient", most, falls ? "twentieth" : "third", most / 1000));
  }
}

/// Full in every corner: no free surface, and air has no room.
template <int d>
void about_room_for_air(const PreparedScene<d>& prepared, Questions& list) {
  if (!prepared.scene.tank || !prepared.level || prepared.bodies.empty()) return;
  const double high = 100, room = prepared.scene.tank->max[d - 1] - *prepared.level;
  const double depth = *prepared.level - prepared.scene.tank->min[d - 1];
  if (room > high * depth)
    list.push_back(fmt::format("tank.max: {:.3g} m of room above {:.3g} m of water: did you mean {:.3g} m?", room,
                               depth, *prepared.level + room / 1000));
}

template <int d>
constexpr Question<d> questions_of_liquid[] = {about_density_of_liquid<d>, about_wave<d>, about_fit<d>,
                                               about_speed_of_liquid<d>, about_room_for_air<d>};

}  // namespace

template <int d>
void ask_about_liquid(const PreparedScene<d>& prepared, Questions& list) {
  about_gravity<d>(prepared, list);
  for (const auto* kind : effect_kinds())
    if (kind->present(prepared.scene)) kind->ask({prepared.scene, prepared.level, prepared.pull}, list);
  if (!prepared.scene.fluid) return;
  for (const auto question : questions_of_liquid<d>) question(prepared, list);
}

template void ask_about_liquid<2>(const PreparedScene<2>&, Questions&);
template void ask_about_liquid<3>(const PreparedScene<3>&, Questions&);

}  // namespace splashdown::apps
