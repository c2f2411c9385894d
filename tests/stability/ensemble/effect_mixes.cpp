// Three to six effects at a time around a body that falls into the water or floats on it, in the plane and in space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

using Names = std::vector<std::string>;

// A sea has its own zones, wind acts through the air's loads, and what blows from one side has no mirror image. Lines have one:
// in space they lie in the plane, in the plane they come in pairs.
const Names anywhere{"waves",         "wind and air loads", "thrust",    "mooring", "catenary", "parachute",
                     "skin friction", "form drag",          "viscosity", "beach",   "release"};
const Names mirrored{"mooring", "catenary", "parachute", "skin friction", "form drag", "viscosity", "beach", "release"};

Names drawn(Random& random, Names from, int count) {
  Names names;
  while (static_cast<int>(names.size()) < count && !from.empty()) {
    const auto at = from.begin() + random.integer(0, static_cast<int>(from.size()) - 1);
    const std::string name = *at;
    from.erase(at);
    if (name == "waves") std::erase(from, "beach");
    if (name == "beach") std::erase(from, "waves");
    names.push_back(name);
  }
  return names;
}

struct Hull {
  const char* name;
  std::string shape;             ///< TOML
  double volume, below, height;  ///< [m^d]; of its lowest point under the reference point, and of it all [m]
};

Hull hull(Random& random, int d, double L) {
  const double flat = random.uniform(0.3, 1);
  if (d == 3) {
    const double r = 0.5 * L;
    if (random.chance(0.5))
      return {"sphere", fmt::format("{{type = \"sphere\", radius = {}}}", r), 4 * std::numbers::pi / 3 * r * r * r, r,
              L};
    return {"box", fmt::format("{{type = \"box\", size = {}}}", toml_of(Point{L, L, flat * L})), flat * L * L * L,
            0.5 * flat * L, flat * L};
  }
  const auto kind = random.pick<const char*>({"box", "circle", "wedge", "capsule"});
  if (kind == std::string("circle"))
    return {kind, fmt::format("{{type = \"circle\", radius = {}}}", 0.5 * L), std::numbers::pi * L * L / 4, 0.5 * L, L};
  if (kind == std::string("wedge")) {
    const double degrees = random.uniform(15, 40), rise = 0.5 * L * std::tan(degrees * std::numbers::pi / 180),
                 height = rounded(rise + flat * L);
    return {kind, fmt::format("{{type = \"wedge\", deadrise_deg = {}, breadth = {}, height = {}}}", degrees, L, height),
            L * (height - 0.5 * rise), 0, height};
  }
  if (kind == std::string("capsule")) {
    const double r = rounded(0.25 * L);
    return {kind, fmt::format("{{type = \"capsule\", radius = {}, length = {}}}", r, rounded(L - 2 * r)),
            std::numbers::pi * r * r + 2 * r * (L - 2 * r), r, 2 * r};
  }
  return {kind, fmt::format("{{type = \"box\", width = {}, height = {}}}", L, flat * L), flat * L * L, 0.5 * flat * L,
          flat * L};
}

}  // namespace

Member effect_mix(std::uint64_t seed) {
  Random random("effect_mixes", seed);
  const int d = random.chance(0.15) ? 3 : 2;
  const bool mirror = random.chance(0.2);
  Names names = drawn(random, mirror && d == 2 ? mirrored : anywhere, random.integer(3, 6) - (mirror ? 1 : 0));
  const auto has = [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const double L = random.log_uniform(0.1, 3), ratio = random.log_uniform(0.03, 0.9),
               V = rounded(random.uniform(0.3, 3) * std::sqrt(g * L)),
               sideways = mirror ? 0 : random.uniform(-0.5, 0.5);
  const bool dropped = random.chance(0.6) || has("release");
  const double steepness = random.uniform(0.01, 0.08), lambda = rounded(random.uniform(3, 6) * L),
               depth = rounded(random.uniform(1.5, 4) * L);
  const Hull body = hull(random, d, L);
  const double wave = has("waves") ? steepness * lambda * std::tanh(2 * std::numbers::pi * depth / lambda) : 0,
               period = std::sqrt(2 * std::numbers::pi * lambda / g);

  Member m;
  m.what = fmt::format("{} {}D {} L={:.3g} ratio={:.2g}: {}{}", dropped ? "dropped" : "afloat", d, body.name, L, ratio,
                       mirror ? "symmetry; " : "", fmt::join(names, "; "));
  const double end = rounded(has("waves") ? 2 * period / (d - 1) : 8 * std::sqrt(L / g) / (d - 1));
  // Zones of 1.5 wavelengths at both ends, a beach as wide as two bodies.
  const Basin basin{.title = "Mixed effects",
                    .end = end,
                    .half_width = has("waves") ? 2 * lambda + 2 * L : 6 * L,
                    .half_breadth = 2 * L,
                    .depth = depth,
                    .air = 12 * L,
                    .surface = d == 3 ? L / 4 : L / 7,
                    .far = L,
                    .dimension = d};
  SceneText s = basin.scene();
  const auto at = [&](double x, double z) {
    return d == 3 ? Point{rounded(x), 0, rounded(z)} : Point{rounded(x), rounded(z)};
  };
  const double height =
      dropped ? body.below + 0.05 * L + wave : body.below - ratio * body.height;  // of the reference point
  const double mass = water * ratio * body.volume, weight = mass * g, area = std::pow(L, d - 1);

  s.table("contact");
  if (mirror) s.table("symmetry");
  if (has("viscosity"))
    s.table("fluid.viscosity")
        .set("dynamic", random.log_uniform(1e-3, 10))
        .word("walls", has("skin friction") ? "slip" : "no_slip");
  if (has("skin friction")) s.table("fluid.skin_friction");
  if (has("form drag")) s.table("fluid.form_drag");
  if (has("beach")) s.table("fluid.absorber").set("width", 2 * L).set("rate", rounded(std::sqrt(g / L)));
  if (has("waves")) {
    s.table("waves").word("type", "regular").set("height", rounded(wave)).set("length", lambda);
    const double phase = random.uniform(0, 360);
    const std::string shape = body.name;
    const bool has_flat_bottom = shape == "box" || shape == "capsule";  // which has no point that is first
    if (dropped && !has("release") && !has_flat_bottom)
      s.table("waves.touchdown").word("body", "hull").set("phase_deg", phase);
    else
      s.set("phase_deg", phase);
  }
  // The air pushes with up to twice the weight, the thrust with up to its half.
  const double density = 1.225, drag = 1,
               wind = rounded(std::min(random.log_uniform(1, 20) * std::sqrt(g * L),
                                       std::sqrt(4 * weight / (density * drag * area))));
  if (has("wind and air loads")) {
    s.table("wind").set("velocity", at(wind, 0));
    if (random.chance(0.5)) s.word("profile", "log");
  }
  s.list("body").word("name", "hull").toml("shape", body.shape).set("density", rounded(water * ratio));
  s.set("position", at(0, height)).set("size", L / (d == 3 ? random.pick({6, 8}) : random.pick({8, 12, 20})));
  if (dropped) s.set("velocity", at(sideways * V, -V));
  if (has("release")) {
    s.word("motion", "prescribed").table("body.release");
    const int cause = random.integer(0, 2);
    s.word("at", cause == 0 ? "time" : cause == 1 ? "contact" : "load");
    // Before it is half way down to the floor; at a part of its buoyancy, which it has when it is under water.
    if (cause == 0) s.set("time", rounded(random.uniform(0.05, 1) * (height - body.below + 0.5 * depth) / V));
    if (cause == 2) s.set("load", rounded(random.uniform(0.2, 0.8) * weight / ratio));
  }
  if (has("wind and air loads")) {
    s.table("body.aero").set("area", rounded(area)).set("length", L).set("drag", drag);
    s.toml("lift", "[[-15, -1], [15, 1]]").toml("moment", "[[-20, 0.2], [20, -0.2]]").set("pitch_damping", -2);
  }
  if (has("thrust")) {
    const double push = random.uniform(-0.5, 0.5) * weight;
    s.list("body.force").set("force", at(push, 0)).word("axes", random.pick<const char*>({"body", "world"}));
  }
  const auto line = [&](const char* name, double stiffness) -> SceneText& {
    return s.list("line").word("name", name).word("body", "hull").set("axial_stiffness", rounded(weight * stiffness));
  };
  const double x = 2 * L, reach = std::hypot(x, height + depth);  // of anchors on the floor
  const std::vector<double> sides = mirror && d == 2 ? std::vector{1.0, -1.0} : std::vector{1.0};
  if (has("mooring")) {
    const double stiffness = random.log_uniform(1, 1e6), length = rounded(reach * random.uniform(1, 1.2));
    for (const double side : sides)
      line(side > 0 ? "mooring" : "second_mooring", stiffness)
          .set("anchor", at(-side * x, -depth))
          .set("length", length);
  }
  if (has("catenary")) {
    const double stiffness = random.log_uniform(10, 1e5), length = rounded(reach * random.uniform(1.02, 1.3)),
                 heavy = rounded(random.uniform(0.02, 0.3) * weight / depth);
    for (const double side : sides)
      line(side > 0 ? "chain" : "second_chain", stiffness)
          .set("anchor", at(side * x, -depth))
          .set("length", length)
          .toml("catenary", fmt::format("{{weight = {}}}", toml_of(heavy)));
  }
  if (has("parachute"))
    line("riser", random.log_uniform(10, 1e5))
        .set("length", 3 * L)
        .toml("canopy", fmt::format("{{position = {}, mass = {}, drag_area = {}}}", toml_of(at(0, height + 3 * L)),
                                    toml_of(rounded(0.03 * mass)), toml_of(rounded(2 * weight / (density * V * V)))));
  m.scene = s.text();

  // Work on the hull and on the water: the fall, the air, the thrust, and what the sea holds (Lamb 1932, art. 230: rho g H^2 / 8 for
  // each metre of length and breadth).
  const double breadth = d == 3 ? 4 * L : 1, sea = water * g * wave * wave / 8 * 2 * basin.half_width * breadth;
  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * body.volume * L + 0.5 * mass * V * V + sea};
  // Buoyancy gives what was a body's length under water at most sqrt(2 g L / (ratio + 1/3)) of speed: the added mass is a third of what
  // is displaced at least (Lamb 1932, art. 71). The air pushes no faster than it moves, the thrust with g/2, and no crest carries
  // faster than the wave. Jets as of polygons.
  const double crest = has("waves") ? lambda / period : 0, blown = has("wind and air loads") ? wind : 0;
  const double lift = std::sqrt(6 * g * L), fall = std::sqrt(V * V * (1 + sideways * sideways) + 2 * g * (height + L)) +
                                                   blown + 0.5 * g * end + crest;
  m.laws.speed = SpeedLaw{.nodes = 6 * lift + 10 * fall, .bodies = lift + fall};
  m.laws.volume = VolumeLaw{.bound = 0.01, .scale = body.volume};
  m.laws.passes.reset();  // lines and contacts become taut and open within a step
  return m;
}

}  // namespace splashdown::ensemble
