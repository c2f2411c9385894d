// Water at rest has to stay so for a long time, at the default step and at larger ones.
#include <fmt/format.h>

#include <cmath>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

Member still_tank(std::uint64_t seed) {
  Random random("still_tanks", seed);
  const double H = random.log_uniform(0.05, 20), W = rounded(H * random.uniform(0.7, 2));
  const double surface = rounded(H / random.uniform(4, 10)), far = rounded(surface * random.uniform(1, 2.5));
  const double cfl = random.pick({0.5, 0.5, 0.7, 1.0});
  const std::string body = random.pick<const char*>({"", "", "submerged", "piercing"});

  Member m;
  m.what = fmt::format("{:.3g} x {:.3g} m, h={:.2g}H far={:.2g}H cfl={}{}", 2 * W, H, surface / H, far / H, cfl,
                       body.empty() ? "" : ", a box " + body);
  // A thousand seconds of a metre of water.
  const Basin basin{.title = "Still water",
                    .end = rounded(3000 * std::sqrt(H / g)),
                    .cfl = cfl,
                    .half_width = W,
                    .depth = H,
                    .air = 0.5 * H,
                    .surface = surface,
                    .far = far};
  SceneText s = basin.scene();
  if (!body.empty()) {
    const double a = rounded(H * random.uniform(0.2, 0.4)), b = rounded(H * random.uniform(0.2, 0.4));
    s.list("body").word("name", "box").toml("shape", fmt::format("{{type = \"box\", width = {}, height = {}}}", a, b));
    s.word("motion", "fixed").set("position", Point{0.2 * W, body == "piercing" ? 0 : -0.5 * H}).set("size", surface);
  }
  // Rows of a thousandth of the run: nothing that grows fits in between.
  s.table("output").set("interval", basin.end / 1000);
  m.scene = s.text();

  // Roundoff, eps, times the condition of the pressure equation, below 1e4 for these meshes, leaves 1e-11; a growth
  // of no more than 1e5 in a thousand periods is none.
  m.laws.speed = SpeedLaw{.nodes = 1e-6 * std::sqrt(g * H)};
  m.laws.volume = VolumeLaw{.bound = 1e-8, .scale = basin.water()};
  m.laws.passes.reset();
  return m;
}

}  // namespace splashdown::ensemble
