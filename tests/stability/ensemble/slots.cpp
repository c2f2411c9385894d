// Below resolution and beyond: what a mesh cannot hold has to be physical all the same, or refused with a cause.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

/// (x, height) as a point of the scene's dimension.
Point at(int dimension, double x, double height) { return dimension == 2 ? Point{x, height} : Point{x, 0, height}; }

std::string box_shape(int dimension, double width, double height) {
  if (dimension == 2) return fmt::format("{{type = \"box\", width = {:.6g}, height = {:.6g}}}", width, height);
  return "{type = \"box\", size = " + toml_of(Point{width, width, height}) + "}";
}

SceneText& add_box(SceneText& s, int dimension, const std::string& name, double width, double height, double x,
                   double z, double size) {
  s.list("body").word("name", name).toml("shape", box_shape(dimension, width, height));
  return s.set("position", at(dimension, x, z)).set("size", size);
}

/// Still water of depth H.
Basin pool(Random& random, const std::string& title, int dimension, double H) {
  const double h = rounded(H / random.uniform(dimension == 2 ? 12 : 5, dimension == 2 ? 30 : 8));
  return {.title = title,
          .end = rounded(5 * std::sqrt(H / g)),
          .half_width = 1.5 * H,
          .depth = H,
          .air = 0.7 * H,
          .surface = h,
          .far = 3 * h,
          .dimension = dimension};
}

/// What the still scenes of this class have in common: nothing drives them. A thousandth of free fall over the
/// depth is what a contact line may take to find its place between two nodes; growing motion passes it.
Laws still(const Basin& basin) {
  Laws laws;
  laws.speed = SpeedLaw{.nodes = 1e-3 * std::sqrt(g * basin.depth)};
  laws.energy = EnergyLaw{.bound = 1e-4, .scale = water * g * basin.water() * basin.depth};
  laws.volume = VolumeLaw{.bound = 0.005, .scale = basin.water()};
  laws.passes.reset();
  return laws;
}

void gap(Random& random, Member& m, int dimension, double H) {
  const std::string where = random.pick<const char*>({"piercing", "submerged", "over the floor", "beside the wall"});
  const Basin basin = pool(random, "Slot", dimension, H);
  const double width = random.log_uniform(1e-3, 2) * basin.surface, side = rounded(0.3 * H);
  m.what = fmt::format("slot of {:.3g} h {}, {}D", width / basin.surface, where, dimension);
  SceneText s = basin.scene();
  const auto fixed = [&](const char* name, double x, double z) {
    add_box(s, dimension, name, side, side, x, z, basin.surface).word("motion", "fixed");
  };
  if (where == "over the floor") {
    fixed("left", 0, -H + width + side / 2);
  } else if (where == "beside the wall") {
    fixed("left", -basin.half_width + width + side / 2, -0.1 * H);
  } else {
    const double z = where == "piercing" ? 0 : -0.5 * H;
    fixed("left", -(width + side) / 2, z), fixed("right", (width + side) / 2, z);
  }
  m.scene = s.text();
  m.laws = still(basin);
}

void squeezed(Random& random, Member& m, double H) {
  const Basin still_pool = pool(random, "Squeezed", 2, H);
  Basin basin = still_pool;
  const double side = rounded(0.3 * H), ratio = random.log_uniform(1e-2, 2), speed = random.log_uniform(0.1, 2);
  const double run = 0.5 * side;  // of each plate until it touches
  basin.end = rounded(random.uniform(0.9, 1.3) * run / speed);
  m.what = fmt::format("box of ratio {:.2g} squeezed by plates at {:.2g} m/s to {:.2g} of the way", ratio, speed,
                       basin.end * speed / run);
  SceneText s = basin.scene();
  add_box(s, 2, "box", side, side, 0, -0.5 * H, basin.surface).set("density", water * ratio);
  for (const double sign : {-1.0, 1.0}) {
    add_box(s, 2, sign < 0 ? "left" : "right", side / 2, 1.2 * side, sign * (run + 0.75 * side), -0.5 * H,
            basin.surface);
    s.word("motion", "prescribed").set("velocity", Point{-sign * speed, 0});
  }
  s.table("contact");
  m.scene = s.text();
  // Water leaves a gap of one element, side / h times as fast as the plates come; the box gets it from there. Plates that stop
  // short of the box leave a gap from whose ends it comes side / (2 gap) times as fast, by continuity.
  const double left = run - basin.end * speed, by_gap = left > 0 ? 0.5 * side / left : 0;
  const double lift = 2 * std::sqrt(g * H), jet = speed * std::max(2 * side / basin.surface, by_gap);
  m.laws.speed = SpeedLaw{.nodes = 3 * (lift + jet), .bodies = lift + jet};
  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * side * side * H};
  m.laws.volume = VolumeLaw{.bound = 0.01, .scale = side * side};
  m.laws.passes.reset();
}

void few_nodes(Random& random, Member& m, int dimension, double H) {
  const double side = rounded(H * random.uniform(0.05, 0.2)), h = rounded(side * random.uniform(0.45, 1));
  const double height = random.pick({0.0, 0.5, 2.0}) * side;
  m.what = fmt::format("drop of {:.2g} elements a side, {:.2g} sides over the floor, {}D", side / h, height / side,
                       dimension);
  SceneText s;
  s.word("title", "A drop of a few nodes");
  if (dimension == 3) s.set("dimension", 3.0);
  s.table("time").set("end", 4 * std::sqrt((height + side) / g));
  s.table("gravity");
  Point low = at(dimension, -H, 0), high = at(dimension, H, H), corner = at(dimension, -side / 2, height),
        end = at(dimension, side / 2, height + side);
  if (dimension == 3) low[1] = -H, high[1] = H, corner[1] = -side / 2, end[1] = side / 2;
  s.table("tank").set("min", low).set("max", high);
  s.table("fluid").set("density", water);
  s.table("fluid.size").set("surface", h);
  s.list("fluid.region").word("shape", "box").set("min", corner).set("max", end);
  m.scene = s.text();
  const double volume = std::pow(side, dimension);
  // A column that collapses runs at 2 sqrt(g side) (Ritter 1892), one that falls has that of the fall besides.
  m.laws.speed = SpeedLaw{.nodes = 2 * (2 * std::sqrt(g * side) + std::sqrt(2 * g * height))};
  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * volume * (height + side)};
  m.laws.volume = VolumeLaw{.bound = 0.02, .scale = volume};
  m.laws.passes.reset();
}

void enclosed(Random& random, Member& m, int dimension, double H) {
  const bool free = random.chance(0.5);
  Basin basin = pool(random, "Enclosed liquid", dimension, H);
  basin.air = 0;  // the tank ends where the liquid does
  const double side = rounded(0.3 * H), ratio = random.log_uniform(1e-3, 0.8);
  basin.end = rounded((free ? 0.5 : 5) * std::sqrt(H / g));
  m.what = fmt::format("full tank with a {} box, {}D", free ? fmt::format("free (ratio {:.2g})", ratio) : "fixed",
                       dimension);
  SceneText s = basin.scene();
  add_box(s, dimension, "box", side, side, 0, -0.7 * H, basin.surface);
  if (free)
    s.set("density", water * ratio);
  else
    s.word("motion", "fixed");
  m.scene = s.text();
  m.laws = still(basin);
  if (free) {
    // As the light solids: 8 g at most for the time of the run, thrice that round edges.
    const double lift = 8 * g * basin.end;
    m.laws.speed = SpeedLaw{.nodes = 3 * lift, .bodies = lift};
    m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * std::pow(side, dimension) * H};
  }
}

}  // namespace

Member slot(std::uint64_t seed) {
  Random random("slots", seed);
  Member m;
  const int kind = random.integer(0, 5), dimension = random.chance(0.3) ? 3 : 2;
  const double H = random.log_uniform(0.1, 3);
  if (kind <= 2)
    gap(random, m, dimension, H);
  else if (kind == 3)
    squeezed(random, m, H);
  else if (kind == 4)
    few_nodes(random, m, dimension, H);
  else
    enclosed(random, m, dimension, H);
  m.laws.refused.reset();  // it may try
  m.laws.may_be_refused = true;
  return m;
}

}  // namespace splashdown::ensemble
