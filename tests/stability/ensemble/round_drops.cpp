// Round bodies that drop on still water, in the plane and in space: sheets, spray, films, from 6 cm to 2 m.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

struct Round {
  std::string shape;
  double length;     ///< longest [m]
  double low;        ///< from the centre down to the lowest point, pitched [m]
  double curvature;  ///< largest radius of curvature that can meet the water [m]
};

Round round_shape(const std::string& kind, double R, double pitch) {
  const double s = std::abs(std::sin(pitch)), c = std::cos(pitch);
  if (kind == "circle") return {fmt::format("{{type = \"circle\", radius = {:.6g}}}", R), 2 * R, R, R};
  if (kind == "capsule")
    // Its flat side counts as an arc as long as the water that meets it at once.
    return {fmt::format("{{type = \"capsule\", radius = {:.6g}, length = {:.6g}}}", R, 2 * R), 4 * R, R + R * s, 2 * R};
  const double a = 1.5 * R;
  return {fmt::format("{{type = \"ellipse\", semi_axes = [{:.6g}, {:.6g}]}}", a, R), 2 * a, std::hypot(a * s, R * c),
          a * a / R};
}

/// Circles, ellipses and capsules turned about their long axis.
Round round_solid(const std::string& kind, double R, double pitch) {
  Round body = round_shape(kind == "sphere" ? "circle" : kind, R, pitch);
  if (kind == "sphere") body.shape = fmt::format("{{type = \"sphere\", radius = {:.6g}}}", R);
  return body;
}

/// Its laws: the hull's work on the water is all that it gets, and that is what the body loses.
Laws laws_of(const Round& body, int dimension, double speed, double h, double fall) {
  Laws laws;
  // Over the work of the hull on the water, and nothing else: no other energy is about.
  laws.energy = EnergyLaw{.bound = 0.05, .in_most = 0.02};
  // Wagner 1932: the wetted half length c of an arc of radius r is sqrt(4 r V t) in the plane and sqrt(3 r V t) in
  // space; it grows with 2 r V / c or (3/2) r V / c, and the jet leaves at twice that. Below c = 2 h there is no
  // element between contact line and middle, hence no jet. The last term: free fall over the height of the scene.
  const double jet = (dimension == 2 ? 4.0 : 3.0) * body.curvature * speed / (2 * h);
  // A body has the energy of its fall, 1.5 lengths at most, and gets none from the water.
  laws.speed = SpeedLaw{.nodes = std::sqrt(jet * jet + 2 * g * fall),
                        .bodies = 1.02 * std::sqrt(speed * speed + 2 * g * 1.5 * body.length)};
  return laws;
}

/// What both classes draw, in this order.
struct Drop {
  Drop(Random& random, std::initializer_list<const char*> kinds, std::initializer_list<int> resolutions)
      : D(random.log_uniform(0.06, 2)),
        ratio(random.pick({0.2, 0.3, 0.5, 0.8, 1.0})),
        froude(random.log_uniform(0.8, 6)),
        kind(random.pick(kinds)),
        pitch_deg(random.pick({0.0, 0.0, 10.0, 25.0})),
        elements(random.pick(resolutions)),
        oblique(random.chance(1.0 / 3)) {}

  double radius() const { return rounded(D / 2); }
  double pitch() const { return pitch_deg * std::numbers::pi / 180; }
  double V() const { return rounded(froude * std::sqrt(g * D)); }  ///< downward, and forward if oblique [m/s]
  double speed() const { return (oblique ? std::numbers::sqrt2 : 1) * V(); }
  double h() const { return rounded(D / elements); }
  std::string what() const {
    return fmt::format("{} {} D={:.3g} ratio={} Fr={:.2g} pitch={} D/{}", oblique ? "oblique" : "plumb", kind, D, ratio,
                       froude, pitch_deg, elements);
  }
  void describe(const Round& body, SceneText& s) const {
    s.list("body").word("name", "body").toml("shape", body.shape).set("density", water * ratio);
  }

  double D, ratio, froude;  ///< size [m], density over water's, V over sqrt(g D)
  std::string kind;
  double pitch_deg;
  int elements;
  bool oblique;
};

}  // namespace

Member round_drop(std::uint64_t seed) {
  Random random("round_drops", seed);
  const Drop drop(random, {"circle", "circle", "capsule", "ellipse"}, {40, 60, 90});
  const Round body = round_shape(drop.kind, drop.radius(), drop.pitch());
  const double L = body.length, V = drop.V();

  Member m;
  m.what = drop.what();
  const Basin basin{.title = "Round drop",
                    .end = 1.5 * L / V,  // 1.5 lengths deep, were it not stopped
                    .half_width = 6 * L,
                    .depth = 6 * L,
                    .air = 4 * L,
                    .surface = L / 8,
                    .far = L / 2,
                    .growth = 0.12,
                    .wetted_fraction = 0.008};
  SceneText s = basin.scene();
  drop.describe(body, s);
  // Half a thousandth of it above the water.
  s.set("position", Point{0, 1.0005 * body.low}).set("pitch_deg", drop.pitch_deg);
  s.set("velocity", Point{drop.oblique ? V : 0, -V}).set("size", drop.h());
  s.table("contact");
  m.scene = s.text();

  m.laws = laws_of(body, 2, drop.speed(), drop.h(), basin.air);
  return m;
}

Member round_drop_in_space(std::uint64_t seed) {
  Random random("round_drops_3d", seed);
  const Drop drop(random, {"sphere", "sphere", "capsule"}, {8, 12, 16});
  const Round body = round_solid(drop.kind, drop.radius(), drop.pitch());
  const double L = body.length, V = drop.V();

  Member m;
  m.what = drop.what();
  const Basin basin{.title = "Round drop in space",
                    .end = 0.75 * L / V,
                    .half_width = 2.5 * L,
                    .depth = 2.5 * L,
                    .air = 3 * L,
                    .surface = L / 6,
                    .far = L / 2,
                    .growth = 0.25,
                    .wetted_fraction = 0.03,
                    .dimension = 3};
  SceneText s = basin.scene();
  drop.describe(body, s);
  s.set("position", Point{0, 0, 1.0005 * body.low}).set("pitch_deg", drop.pitch_deg);
  s.set("velocity", Point{drop.oblique ? V : 0, 0, -V}).set("size", drop.h());
  s.table("contact");
  m.scene = s.text();
  m.laws = laws_of(body, 3, drop.speed(), drop.h(), basin.air);
  return m;
}

}  // namespace splashdown::ensemble
