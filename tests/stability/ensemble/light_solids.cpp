// Light bodies in space: with edges and without, under water, afloat and dropped, in water that slips and that
// sticks.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/release.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

/// A ring about the z axis, or a sphere: what a hull is the convex hull of.
struct Part {
  Eigen::Vector3d centre;     ///< in the shape's frame [m]
  double ring = 0, ball = 0;  ///< radii [m]
};

struct Solid {
  std::string kind, shape;
  double shortest;  ///< side [m]
  double volume;    ///< [m^3]
  double centre;    ///< height of the centroid over the reference point, upright [m]
  std::vector<Part> parts;

  /// From the reference point down to the lowest point; `up`: the world's up in the shape's frame.
  double low(const Eigen::Vector3d& up) const {
    double lowest = 0;
    for (const Part& part : parts)
      lowest = std::min(lowest, up.dot(part.centre) - part.ring * std::hypot(up.x(), up.y()) - part.ball);
    return -lowest;
  }
};

Solid box(Random& random, double L) {
  const double a = rounded(random.uniform(0.5, 1) * L), b = rounded(random.uniform(0.35, 0.8) * L);
  Solid s{"box", "{type = \"box\", size = " + toml_of(Point{L, a, b}) + "}", std::min(a, b), L * a * b, 0, {}};
  for (int corner = 0; corner < 8; ++corner)
    s.parts.push_back({0.5 * Eigen::Vector3d(corner & 1 ? L : -L, corner & 2 ? a : -a, corner & 4 ? b : -b)});
  return s;
}

Solid cone(Random& random, double L) {
  const double deadrise = random.pick({30.0, 45.0, 60.0}), R = rounded(0.5 * L);
  const double height = R * std::tan(deadrise * std::numbers::pi / 180);
  return {"cone",
          fmt::format("{{type = \"cone\", deadrise_deg = {}, radius = {:.6g}}}", deadrise, R),
          std::min(height, L),
          std::numbers::pi * R * R * height / 3,
          0.75 * height,
          {{Eigen::Vector3d::Zero()}, {{0, 0, height}, R}}};
}

Solid capsule(Random& random, double L) {
  const double R = rounded(random.uniform(0.15, 0.3) * L), straight = rounded(L - 2 * R);
  return {"capsule", fmt::format("{{type = \"capsule\", radius = {:.6g}, length = {:.6g}}}", R, straight),
          2 * R,     std::numbers::pi * R * R * (straight + 4 * R / 3),
          0,         {{{-straight / 2, 0, 0}, 0, R}, {{straight / 2, 0, 0}, 0, R}}};
}

/// Its narrow end is down.
Solid frustum(Random& random, double L) {
  const double b = rounded(random.uniform(0.35, 0.8) * L), low = rounded(0.4 * L), high = rounded(0.5 * L);
  const double sum = low * low + low * high + high * high;
  return {"frustum",
          "{type = \"revolved\", profile = " +
              toml_of({{0, -0.5 * b}, {low, -0.5 * b}, {high, 0.5 * b}, {0, 0.5 * b}}) + "}",
          b,
          std::numbers::pi * b * sum / 3,
          b * ((low * low + 2 * low * high + 3 * high * high) / (4 * sum) - 0.5),
          {{{0, 0, -0.5 * b}, low}, {{0, 0, 0.5 * b}, high}}};
}

}  // namespace

Member light_solid(std::uint64_t seed) {
  Random random("light_solids", seed);
  const double L = random.log_uniform(0.1, 3);
  Solid (*const shapes[])(Random&, double) = {box, box, cone, capsule, frustum};
  const Solid body = shapes[random.integer(0, 4)](random, L);
  const std::string start = random.pick<const char*>({"under water", "under water", "afloat", "dropped"});
  const double density = start == "dropped" ? random.pick({500.0, 100.0, 10.0, 1.0, 1e-3})
                                            : random.pick({500.0, 100.0, 10.0, 1.0, 1e-3, 0.0});
  // Fine hulls cost ten times the rest of the class together: one in sixteen each.
  const int elements = random.pick({2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 6, 10});
  const double pitch = random.pick({0.0, 10.0, 30.0}), roll = random.pick({0.0, 5.0});
  const std::string walls = random.pick<const char*>({"", "", "slip", "no_slip"});
  const double viscosity = random.log_uniform(1e-6, 1e3), V = rounded(random.uniform(0.5, 2) * std::sqrt(g * L));

  Member m;
  m.what = fmt::format("{} {} L={:.3g} density={:g} {}/short pitch={:g} roll={:g}", start, body.kind, L, density,
                       elements, pitch, roll);
  if (!walls.empty()) m.what += fmt::format(" {} {:.1g} Pa s", walls, viscosity);
  const bool under = start == "under water", dropped = start == "dropped";
  // The time in which a body without inertia but that of the water goes up by half its own length, or falls by it.
  const double end = dropped ? 0.5 * L / V : 0.35 * std::sqrt(L / g);
  const Basin basin{.title = "Light solid",
                    .end = end,
                    .half_width = 2.5 * L,
                    .depth = 3.5 * L,
                    .air = 3 * L,
                    .surface = 0.5 * L,
                    .far = 0.7 * L,
                    .dimension = 3};
  // Third row of R_y(-pitch) R_x(roll).
  const double p = pitch * std::numbers::pi / 180, r = roll * std::numbers::pi / 180;
  const Eigen::Vector3d up(std::sin(p), std::cos(p) * std::sin(r), std::cos(p) * std::cos(r));
  // Under water the highest point is L deep. Dropped, the lowest one is a hundredth of L above the surface. Afloat, the
  // centroid is at the surface: not at rest, the body goes to its own draft.
  const double height = under ? -L - body.low(-up) : dropped ? 0.01 * L + body.low(up) : -body.centre * up.z();
  SceneText s = basin.scene();
  if (!walls.empty()) s.table("fluid.viscosity").set("dynamic", viscosity).word("walls", walls);
  s.list("body").word("name", "body").toml("shape", body.shape).set("density", density);
  s.set("position", Point{0, 0, height}).set("pitch_deg", pitch).set("roll_deg", roll);
  if (dropped) s.set("velocity", Point{0, 0, -V});
  s.set("size", body.shortest / elements);
  if (under) s.list("record").word("kind", "added_mass").word("body", "body").set("times", Point{0});
  m.scene = s.text();

  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * body.volume * L};
  // Lamb 1932, art. 114: the least added mass, of a spheroid of 3 : 1 along its axis, is 0.12 of what it displaces,
  // so no body is accelerated by more than 8 g; the fastest end is at 0.35 sqrt(L/g). A dropped one has its fall
  // besides. Round an edge of 90 degrees the flow is faster by (L / h)^(1/3), 3 at most for h > L / 30; sheets
  // between a flat bottom and the water leave at several times the impact: at 10 times where the round drops' law
  // has r = 5 c.
  const double lift = 8 * 0.35 * std::sqrt(g * L), fall = dropped ? std::sqrt(V * V + 2 * g * (height + L)) : 0;
  m.laws.speed = SpeedLaw{.nodes = 3 * lift + 10 * fall, .bodies = lift + fall};
  if (under)
    m.laws.release = release_law(walls.empty() ? 0 : viscosity, body.shortest / elements, body.shortest, basin.water());
  return m;
}

}  // namespace splashdown::ensemble
