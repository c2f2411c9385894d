// Water only: drops and jets of 3 to 1000 elements at 1 to 100 m/s into pools, at each other, on a wall.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

void add_drop(SceneText& s, const Point& centre, double radius, const Point& velocity) {
  s.list("fluid.region").word("shape", "circle").set("centre", centre).set("radius", radius).set("velocity", velocity);
}

void add_jet(SceneText& s, const Point& low, const Point& high, const Point& velocity) {
  s.list("fluid.region").word("shape", "box").set("min", low).set("max", high).set("velocity", velocity);
}

}  // namespace

Member drop_or_jet(std::uint64_t seed) {
  Random random("drops_and_jets", seed);
  const std::string kind = random.pick<const char*>(
      {"drop into a pool", "jet into a pool", "drops that meet", "jets that meet", "drop on a wall", "jet on a wall"});
  const bool is_jet = kind.starts_with("jet"), pool = kind.ends_with("pool"), meet = kind.ends_with("meet");
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const int elements = static_cast<int>(random.log_uniform(3, 1000));
  // Of equal sides h: sqrt(3) h^2 / 4 each. A jet is six times as long as it is wide, but no thinner than an element.
  const double area = elements * std::numbers::sqrt3 / 4 * h * h;
  const double radius = rounded(std::sqrt(area / std::numbers::pi)),
               width = rounded(std::max(1.02 * h, std::sqrt(area / 6)));
  const double length = is_jet ? area / width : 2 * radius, half = is_jet ? width / 2 : radius;
  const double offset = meet ? random.uniform(0, 1.5) * half : 0;
  const bool weighs = pool || (!meet && random.chance(0.5));

  Member m;
  m.what =
      fmt::format("{} of {} elements at {:.3g} m/s, h={:.2g}{}", kind, elements, V, h, weighs ? "" : ", no gravity");
  const double end = 2 * (length + 2 * half) / V, gap = 0.5 * h;
  SceneText s;
  s.word("title", kind);
  s.table("time").set("end", end);
  if (weighs) s.table("gravity");
  const double depth = std::max(6 * half, 5 * h);
  // A jet turned by a wall keeps its speed (Bernoulli); two that meet slantwise, thrice that at most. The front of
  // a drop of radius r throws a sheet at 4 r V / c, c the half length on which it meets what it falls on (Wagner
  // 1932, as for the round drops), two elements at least. And all may fall to the floor.
  const double sheet = std::max(3 * V, is_jet ? 0.0 : 2 * radius / h * V);
  const double fastest = std::sqrt(sheet * sheet + 2 * g * (length + depth));
  // The front of a jet on a wall keeps clear of the tank's sides, which would turn it once more.
  const double reach = is_jet && !pool && !meet ? fastest * end : 0.0;
  const double W = std::max({8 * half, 10 * h, reach});
  if (!meet) s.table("tank").set("min", Point{-W, -depth}).set("max", Point{W, 2 * length + W});
  s.table("fluid").set("density", water);
  s.table("fluid.size").set("surface", h).set("far", 2 * h).set("growth", 0.2);
  if (pool) s.list("fluid.region").word("shape", "box").set("min", Point{-W, -depth}).set("max", Point{W, 0});
  // A wall is the bottom of the tank.
  const double floor = pool ? 0 : meet ? gap / 2 : -depth;
  const Point down{0, -V}, up{0, V};
  if (is_jet) {
    add_jet(s, {offset - half, floor + gap}, {offset + half, floor + gap + length}, down);
    if (meet) add_jet(s, {-half, -gap - length}, {half, -gap}, up);
  } else {
    add_drop(s, {offset, floor + gap + radius}, radius, down);
    if (meet) add_drop(s, {0, -gap - radius}, radius, up);
  }
  m.scene = s.text();

  const double brought = (meet ? 2 : 1) * (is_jet ? width * length : std::numbers::pi * radius * radius);
  // No walls move and nothing else acts: the first energy is all there is. A thousandth for the second order of the
  // leapfrog, (dt V / h)^2 / 24 at the default cfl of a half being ten times that in a single element.
  m.laws.energy = EnergyLaw{.bound = 1e-3, .scale = 0.5 * water * V * V * brought};
  m.laws.speed = SpeedLaw{.nodes = fastest};
  m.laws.volume = VolumeLaw{.bound = 0.005, .scale = brought};
  m.laws.passes.reset();
  return m;
}

}  // namespace splashdown::ensemble
