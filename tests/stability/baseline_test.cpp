// What a coupling without an interface term does where the rigid term needs one pass: the failing baseline of light
// bodies.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;

constexpr std::array steps{1e-3, 1e-3 / 4, 1e-3 / 16};
constexpr int most_passes = 100;

coupling::StepReport first_step(double ratio, double dt, double relaxation) {
  return scenes::coupled(scenes::submerged_circle(ratio), std::make_unique<coupling::NoTerm>(),
                         std::make_unique<coupling::ConstantRelaxation>(relaxation), {.max_passes = most_passes})
      ->attempt(dt);
}

int rigid_passes(double ratio, double dt) {
  const auto report = scenes::coupled(scenes::submerged_circle(ratio))->attempt(dt);
  EXPECT_TRUE(report.ok()) << report.cause;
  return report.passes;
}

// A pass amplifies by M_a / m, M_a = 0.95 of what the circle displaces and a tank's walls a little more, whatever dt.
TEST(Baseline, of_a_light_body_diverges_at_all_steps_and_the_rigid_term_takes_one_pass) {
  for (double ratio : {0.9, 1.0 / 3, 0.1, 0.01, 1e-3, 1e-6})
    for (double dt : steps) {
      EXPECT_FALSE(first_step(ratio, dt, 1).ok()) << ratio << ' ' << dt;
      EXPECT_EQ(rigid_passes(ratio, dt), 1) << ratio << ' ' << dt;
    }
}

// (M_a / m)^k = tolerance: passes grow without bound as m comes down to M_a.
TEST(Baseline, of_a_heavy_body_takes_more_passes_the_lighter_it_is_and_the_rigid_term_one) {
  for (double dt : steps) {
    int before = 1;
    for (double ratio : {8.0, 4.0, 2.0, 1.5}) {
      const auto report = first_step(ratio, dt, 1);
      ASSERT_TRUE(report.ok()) << ratio << ' ' << dt << ": " << report.cause;
      EXPECT_GT(report.passes, before) << ratio << ' ' << dt;
      before = report.passes;
      EXPECT_EQ(rigid_passes(ratio, dt), 1) << ratio << ' ' << dt;
    }
  }
}

// Relaxation by a constant w converges for w < 2 / (1 + M_a / m): below 0.52 for a third of water's density, below
// 0.19 for a tenth. A factor that does for one body fails for the next lighter one.
TEST(Baseline, with_relaxation_fails_for_the_next_lighter_body) {
  EXPECT_TRUE(first_step(1.0 / 3, 1e-3, 0.4).ok());
  EXPECT_FALSE(first_step(0.1, 1e-3, 0.4).ok());
}

// Dropped on water, the body gathers added mass as it dips in: passes converge until it exceeds the body's own, and no
// further. The lighter the sooner.
TEST(Baseline,
     of_a_light_body_dropped_on_water_fails_as_its_added_mass_exceeds_its_own_where_the_rigid_term_takes_one_pass) {
  constexpr double end = 0.012;
  double before = end;
  for (double ratio : {1.0 / 3, 0.1, 0.01, 1e-3}) {
    const double mass = ratio * 36;  // 36 kg/m: the wedge full of water
    const auto scene = scenes::wedge_drop(mass, 0.001, 0.02);
    const auto run = scenes::coupled(scene, std::make_unique<coupling::NoTerm>(),
                                     std::make_unique<coupling::ConstantRelaxation>(1.0), {.max_passes = most_passes});
    const auto report = scenes::go_on_to(*run, end);
    EXPECT_FALSE(report.ok()) << ratio;
    EXPECT_LE(run->time(), before) << ratio;
    // k passes come down to the tolerance while M_a / m < tolerance^(1/k) = 0.83; edges that meet the water add a little.
    const double added = run->fluid().added_mass(std::vector<std::size_t>{0})(1, 1);
    EXPECT_GT(added / mass, 0.8) << ratio;
    before = run->time();
    const auto rigid = scenes::coupled(scene);
    const auto whole = scenes::go_on_to(*rigid, end);
    EXPECT_TRUE(whole.ok()) << ratio << ": " << whole.cause;
    EXPECT_EQ(whole.passes, 1) << ratio;
  }
}

}  // namespace
}  // namespace splashdown
