// What the water does that the equations leave out: surface tension, compressibility, cavitation, turbulence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/effects/form_drag/shape_classes.hpp"
#include "apps/effects/lines/lines.hpp"
#include "apps/effects/theory/theory.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

/// Length of the water line round a wetted breadth or area; in the plane of both sides, for each metre of depth.
double water_line(const Outlook& look, double wetted) { return look.dimension() == 2 ? 2 : 2 * std::sqrt(pi * wetted); }

/// What of its speed a body loses to a constant coefficient of drag over an area on its way.
double lost_speed(const Outlook& look, double coefficient, double area, double way) {
  const double inertia = look.mover->mass + look.mover->added;
  return 1 - std::exp(-coefficient * look.scales.density * area * way / (2 * inertia));
}

/// Of the faces of a hull that falls into the water, at its peak load [N, N/m]: V sin(deadrise) along a face, as long as the peak's depth
/// over sin(deadrise).
double friction_of_faces(const Outlook& look) {
  const auto& entry = *look.entry;
  if (!entry.deadrise) return 0;
  const double steep = std::sin(*entry.deadrise), along = entry.speed * steep;
  const bool plane = look.dimension() == 2;
  const double half = plane ? 0.5 * entry.wetted : std::sqrt(entry.wetted / pi),
               length = half / std::cos(*entry.deadrise);
  const double friction = turbulent_friction(look.scales.density * along * length / water_viscosity);
  return friction * dynamic_pressure(look.scales.density, along) * (plane ? 2 * length : pi * half * length) * steep;
}

/// The body that the mover is.
const Body& moving_body(const Outlook& look) {
  if (look.entry) return look.scene.bodies[look.entry->body];
  return *std::ranges::find(look.scene.bodies, false, &Body::makes_waves);
}

/// Whether it is lighter than water.
bool rises(const Outlook& look) {
  const auto& shape = moving_body(look).shape;
  const double volume =
      look.dimension() == 2 ? shape_of<2>(shape).at_unit_density.mass : shape_of<3>(shape).at_unit_density.mass;
  return look.mover->mass < look.scales.density * volume;
}

/// The share of its way that a body which starts at rest under water goes, up or down, before a taut line stops it.
double share_on_lines(const Outlook& look) {
  const auto* lines = look.scene.effects.find<Lines>();
  double share = 1;
  if (!lines || look.entry || !look.starts_at_rest() || look.mover->way == 0) return share;
  const double climb = rises(look) ? look.mover->way : -look.mover->way;
  for (const auto& line : lines->all) {
    if (&look.scene.bodies[line.body] != &moving_body(look) || !line.anchor || line.catenary) continue;
    const auto ends = ends_at_start(look.scene, line);
    const auto apart = [&](double gone) {
      return (ends.from + gone * climb * Point::Unit(look.dimension() - 1) - ends.to).norm();
    };
    double loose = 0, taut = 1;
    if (apart(taut) <= line.length) continue;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (loose + taut);
      (apart(middle) <= line.length ? loose : taut) = middle;
    }
    share = std::min(share, loose);
  }
  return share;
}

/// Off the edges of boxes, wedges and plates the flow of the fluid leaves by itself (fluid/effects/form_drag).
bool has_edges_alone(const Shape& shape) {
  return !shape_drag(shape).round && !std::holds_alternative<SurfaceShape>(shape) &&
         !std::holds_alternative<RevolvedShape>(shape);
}

}  // namespace

Advice advise_surface_tension(const Outlook& look) {
  const auto& s = look.scales;
  const double sigma = water_surface_tension, inertia = s.density * s.speed * s.speed * s.length,
               weight = s.density * look.pull * s.length * s.length;
  Advice advice;
  advice.numbers.push_back({"We = rho U^2 L/sigma", inertia / sigma});
  if (look.pull > 0) advice.numbers.push_back({"Bo = rho g L^2/sigma", weight / sigma});
  if (look.has_load()) advice.change.peak = water_line(look, look.entry->wetted) * sigma / look.entry->peak_load;
  // A wave is the slower of the two restoring forces' (Lamb 1932, article 267).
  const double wave = 2 * pi / look.wave_length;
  if (look.pull > 0)
    advice.change.motion = sigma * wave * wave / (s.density * look.pull) / 2;
  else if (inertia > 0)
    advice.change.motion = sigma / inertia;
  advice.advised = judged(advice.change);
  advice.reason = advice.advised == Advised::off
                      ? "forces at the water line are small beside the load and the weight"
                      : "so small a scene has a skin: films and drops are not those of water";
  advice.source = "Young and Laplace; capillary waves, Lamb 1932, article 267";
  return advice;
}

Advice advise_compressibility(const Outlook& look) {
  const double c = water_sound_speed;
  Advice advice;
  advice.numbers.push_back({"Ma = U/c", look.scales.speed / c});
  advice.source =
      "Prandtl and Glauert: loads change by the square of the water line's Mach number; Korobkin and Pukhnachov 1988";
  if (!look.entry) {
    const double mach = look.scales.speed / c;
    advice.change.motion = mach * mach;
    advice.advised = judged(advice.change);
    advice.reason = "nothing enters the water: all is far below the speed of sound";
    return advice;
  }
  const auto& entry = *look.entry;
  const double hammer = look.scales.density * c * entry.speed;
  advice.numbers.push_back({"rho c V", hammer, "Pa"});
  if (entry.flat()) {
    advice.advised = Advised::on;
    advice.reason =
        "a flat bottom meets the water all at once: the pressure is at most rho c V, here the load is an impulse";
    advice.source = "von Karman 1929";
    return advice;
  }
  const double mach = entry.contact_speed / c, peak = dynamic_pressure(look.scales.density, entry.contact_speed);
  advice.numbers.push_back({"peak pressure over rho c V", peak / hammer});
  advice.numbers.push_back({"water line's speed over c", mach});
  advice.change.peak = mach * mach;
  advice.advised = entry.deadrise && peak >= hammer ? Advised::on : judged(advice.change);
  advice.reason = advice.advised == Advised::off ? "the water line runs along the hull far below the speed of sound"
                                                 : "the water line runs along the hull nearly as fast as sound";
  return advice;
}

Advice advise_cavitation(const Outlook& look) {
  const double atmosphere = 101325, vapour = 2340;  // at 20 C [Pa]
  const double speed = std::max(look.scales.speed, look.mover ? look.mover->forward : 0);
  const double number = (atmosphere - vapour) / dynamic_pressure(look.scales.density, speed);
  const double blunt = 1, plain = 0.5;  // - c_p beside blunt and slender noses
  Advice advice;
  advice.numbers.push_back({"cavitation number", number});
  advice.source = "- c_p of 0.5 to 1 at shoulders, Knapp, Daily and Hammitt 1970";
  if (!look.mover) {
    advice.reason = "there is no hull whose suction could boil water";
    return advice;
  }
  advice.change.peak = look.entry ? std::optional(0.) : std::nullopt;
  advice.advised = number < plain ? Advised::on : number < 2 * blunt ? Advised::doubtful : Advised::off;
  advice.reason =
      advice.advised == Advised::off
          ? "no suction reaches the pressure of vapour"
          : "suction at edges and behind the hull boils the water; the first peak is one of pressure and stays";
  return advice;
}

Advice advise_turbulence(const Outlook& look) {
  const double transition = 5e5, reynolds = reynolds_number(look, water_viscosity);
  Advice advice;
  advice.numbers.push_back({"Re over transition", reynolds / transition});
  advice.source = "a plate's friction, Blasius 1908 and ITTC 1957; transition, Schlichting 1979";
  const double more = std::max(0., turbulent_friction(reynolds) - laminar_friction(reynolds));
  if (look.has_load()) advice.change.peak = 0;
  if (reynolds < transition || !look.mover || !look.mover->moves) {
    advice.change.motion = 0;
    advice.reason = reynolds < transition ? "boundary layers are laminar" : "no body moves through the water";
    return advice;
  }
  advice.change.motion =
      std::isfinite(look.mover->mass) ? lost_speed(look, more, 2 * look.mover->plan, look.mover->way) : more;
  advice.advised = judged(advice.change);
  advice.reason = advice.advised == Advised::off
                      ? "boundary layers are turbulent, and too thin to change the motion within the run"
                      : "friction of turbulent boundary layers slows what slides; skin friction is the model of it";
  return advice;
}

Advice advise_form_drag(const Outlook& look) {
  Advice advice;
  advice.source =
      "drag of a plate, 2 in the plane and 1.2 in space (Hoerner 1965); off edges the fluid has most of it by itself";
  if (look.has_load()) advice.change.peak = 0;
  if (!look.mover || !look.mover->moves) {
    advice.change.motion = 0;
    advice.reason = "no body moves through the water";
    return advice;
  }
  const auto& mover = *look.mover;
  const bool edges = has_edges_alone(moving_body(look).shape);
  // Round hulls shed a wake after a way of about half a diameter from rest (Sarpkaya and Isaacson 1981), edges at once: there an
  // inviscid fluid lacks about an eighth of the drag.
  const double plate = look.dimension() == 2 ? 2 : 1.2, coefficient = edges ? plate / 8 : plate;
  // What falls into the water is dry behind until it is under.
  const double begins = look.entry ? mover.height + 0.5 * mover.length : edges ? 0 : 0.5 * mover.length;
  const double way = share_on_lines(look) * mover.way;
  const double wake = std::max(0., way - begins);
  advice.numbers.push_back({"KC = way/L", way / mover.length});
  advice.change.motion = std::isfinite(mover.mass) ? lost_speed(look, coefficient, mover.facing, wake)
                                                   : coefficient * wake / (mover.length + wake);
  advice.advised = judged(advice.change);
  advice.reason =
      advice.advised == Advised::off
          ? "the body does not go far enough in the water to shed a wake; a first impact has none"
          : "a wake slows dive, heave and roll, which an inviscid fluid does not know; a first impact has none";
  return advice;
}

Advice advise_skin_friction(const Outlook& look) {
  Advice advice;
  advice.source = "ITTC 1957; drag of planing at a trim of 4 degrees, 0.07 of the weight";
  if (look.has_load()) advice.change.peak = friction_of_faces(look) / look.entry->peak_load;
  if (!look.mover || !look.mover->moves || look.mover->forward == 0) {
    advice.change.motion = 0;
    advice.advised = judged(advice.change);
    advice.reason = advice.advised == Advised::off ? "nothing slides along the water"
                                                   : "the faces are so steep that the water slides along them";
    return advice;
  }
  const auto& mover = *look.mover;
  const double reynolds = look.scales.density * mover.forward * mover.length / water_viscosity;
  const double friction =
      turbulent_friction(reynolds) * dynamic_pressure(look.scales.density, mover.forward) * mover.plan;
  const double planing = 0.07 * (std::isfinite(mover.mass) ? mover.mass * look.pull : 0);
  advice.numbers.push_back({"C_F", turbulent_friction(reynolds)});
  advice.numbers.push_back({"friction share of drag", friction / (friction + planing)});
  advice.change.motion = std::isfinite(mover.mass)
                             ? std::min(1., friction * mover.time_in_water / (mover.mass * mover.forward))
                             : friction / (friction + planing);
  advice.advised = judged(advice.change);
  advice.reason = "friction slows what slides, and trims the nose down";
  return advice;
}

}  // namespace splashdown::apps
