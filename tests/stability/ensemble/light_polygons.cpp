// Light convex polygons and boxes in the plane: free, hinged, in piles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/release.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

struct Polygon {
  std::vector<Point> points;
  double area = 0, shortest = 0;  ///< shortest: least width over directions [m]
  Point centroid{0, 0};
};

/// Corners on an ellipse, in order: convex by construction. An eighth of the circle at least between neighbours.
Polygon polygon(Random& random, double L) {
  Polygon p;
  const bool is_box = random.chance(0.3);
  const double slender = random.uniform(0.35, 1), turn = random.uniform(0, 2 * std::numbers::pi);
  const int corners = is_box ? 4 : random.integer(3, 7);
  std::vector<double> share(static_cast<std::size_t>(corners));
  double sum = 0;
  for (double& x : share) sum += x = is_box ? 1 : random.uniform(0.5, 1);
  double angle = is_box ? std::numbers::pi / 4 : turn;
  for (const double x : share) {
    p.points.push_back({rounded(0.5 * L * std::cos(angle)), rounded(0.5 * L * slender * std::sin(angle))});
    angle += 2 * std::numbers::pi * x / sum;
  }
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const Point &a = p.points[i], &b = p.points[(i + 1) % p.points.size()];
    const double twice = a[0] * b[1] - a[1] * b[0];
    p.area += twice / 2;
    p.centroid[0] += twice * (a[0] + b[0]) / 6, p.centroid[1] += twice * (a[1] + b[1]) / 6;
  }
  p.centroid[0] /= p.area, p.centroid[1] /= p.area;
  // Width across each side: the least of them is the least of all for a convex outline.
  p.shortest = L;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const Point &a = p.points[i], &b = p.points[(i + 1) % p.points.size()];
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    double width = 0;
    for (const Point& x : p.points) width = std::max(width, std::abs(dx * (x[1] - a[1]) - dy * (x[0] - a[0])) / length);
    p.shortest = std::min(p.shortest, width);
  }
  return p;
}

}  // namespace

Member light_polygon(std::uint64_t seed) {
  Random random("light_polygons", seed);
  const double L = random.log_uniform(0.1, 3);
  const std::string tie = random.pick<const char*>({"free", "free", "free", "hinged", "pile"});
  std::string start = random.pick<const char*>({"under water", "under water", "at the surface", "dropped"});
  if (tie == "hinged" && start == "dropped") start = "at the surface";  // it would swing in the air
  const int bodies = tie == "pile" ? random.integer(2, 3) : 1;
  const std::string walls = random.pick<const char*>({"", "", "slip", "no_slip"});
  const double viscosity = random.log_uniform(1e-6, 1e3), V = rounded(random.uniform(0.5, 2) * std::sqrt(g * L));
  const bool under = start == "under water", dropped = start == "dropped";

  Member m;
  m.what = fmt::format("{} {}{} L={:.3g}", start, tie, bodies > 1 ? fmt::format(" of {}", bodies) : "", L);
  if (!walls.empty()) m.what += fmt::format(" {} {:.1g} Pa s", walls, viscosity);
  const double end = dropped ? L / V : 0.6 * std::sqrt(L / g);
  const Basin basin{.title = "Light polygons",
                    .end = end,
                    .half_width = 4 * L,
                    .depth = 5 * L,
                    .air = 5 * L,
                    .surface = L / 6,
                    .far = L / 2};
  SceneText s = basin.scene();
  if (!walls.empty()) s.table("fluid.viscosity").set("dynamic", viscosity).word("walls", walls);
  // Reference points are the ellipses' centres: no corner is farther away than L / 2, and under water the highest
  // one is L deep at least. Piles go up by a thousandth of L from corner to corner.
  const double first = under ? -(bodies + 1) * L : dropped ? 0.01 * L : -0.5 * L;
  double displaced = 0, finest = L, floor = first;
  for (int b = 0; b < bodies; ++b) {
    const Polygon p = polygon(random, L);
    // Between 0.8 and 1.25 there is next to no lift to be within 5 % of.
    double ratio = random.log_uniform(1e-6, 2);
    if (ratio > 0.8 && ratio < 1.25) ratio = 0.5;
    const double pitch = random.uniform(0, 360), size = p.shortest / random.pick({2, 3, 4, 6, 10});
    const double c = std::cos(pitch * std::numbers::pi / 180), n = std::sin(pitch * std::numbers::pi / 180);
    double low = 0, high = 0;
    for (const Point& x : p.points)
      low = std::min(low, n * x[0] + c * x[1]), high = std::max(high, n * x[0] + c * x[1]);
    const double height = floor - low;
    floor = height + high + 1e-3 * L;
    m.what += fmt::format(", {} corners ratio={:.2g} h={:.2g}L", p.points.size(), ratio, size / L);
    s.list("body").word("name", fmt::format("body{}", b));
    s.toml("shape", "{type = \"polygon\", points = " + toml_of(p.points) + "}").set("density", rounded(water * ratio));
    s.set("position", Point{0, height}).set("pitch_deg", pitch).set("size", size);
    if (dropped) s.set("velocity", Point{0, -V});
    displaced += p.area, finest = std::min(finest, size);
    if (tie == "hinged") {
      const Point& at = p.points[0];
      s.list("joint").word("type", "hinge").word("body", "body0");
      s.set("point", Point{c * at[0] - n * at[1], height + n * at[0] + c * at[1]});
    }
  }
  if (bodies > 1) s.table("contact");
  const bool release = under && tie == "free";
  if (release) s.list("record").word("kind", "added_mass").word("body", "body0").set("times", Point{0});
  m.scene = s.text();

  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * displaced * L};
  // Lamb 1932, art. 71: the least added mass, of an ellipse of 3 : 1 along its axis, is a third of what it
  // displaces: 3 g at most, to 0.6 sqrt(L/g), and a corner of a body that turns is as much faster again. Round
  // edges see the solids' law.
  const double height = bodies * L;
  const double lift = 3 * 0.6 * std::sqrt(g * L),
               fall = std::sqrt((dropped ? V * V : 0) + (under ? 0 : 2 * g * height));
  m.laws.speed = SpeedLaw{.nodes = 6 * lift + 10 * fall, .bodies = 2 * lift + fall};
  // Where contacts open and close there is more than one pass.
  if (bodies > 1) m.laws.passes.reset();
  if (release) m.laws.release = release_law(walls.empty() ? 0 : viscosity, finest, finest, basin.water());
  return m;
}

}  // namespace splashdown::ensemble
