// The same input gives the same bits: solved twice, resumed, after a refused step, with more threads.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_parallel();

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::saved;

scenes::Scene light_wedge() { return scenes::wedge_drop(20, 0.004, 0.02); }

TEST(Solve, twice_gives_the_same_bits) {
  const auto scene = scenes::submerged_circle(0.3);
  fluid::Fluid<2> f(scene.fluid, fluid::scenes::gravity(scene.gravity));
  ASSERT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
  std::vector<fluid::Twist<2>> walls(2, fluid::Twist<2>::Zero()), other = walls;
  walls[0] << 0.1, 0.2, 0.3;
  other[0] << -5, 7, 1;
  ASSERT_TRUE(f.solve(walls).status.ok());
  const auto load = f.result().loads[0];
  const auto p = f.result().pressure;
  ASSERT_TRUE(f.solve(other).status.ok());
  EXPECT_NE(f.result().loads[0].physical, load.physical);
  ASSERT_TRUE(f.solve(walls).status.ok());
  EXPECT_EQ(f.result().loads[0].physical, load.physical);
  EXPECT_EQ(f.result().loads[0].repair, load.repair);
  EXPECT_EQ(f.result().pressure, p);
}

TEST(Attempt, again_with_a_smaller_step_is_as_if_never_tried) {
  const auto tried = scenes::coupled(light_wedge()), untried = scenes::coupled(light_wedge());
  for (int i = 0; i < 12; ++i) {
    const double dt = 0.7 * std::min(tried->stable_dt(), 3e-4);
    tried->attempt(20 * dt);
    tried->attempt(dt * 1.3);
    ASSERT_TRUE(tried->attempt(dt).ok());
    ASSERT_TRUE(untried->attempt(dt).ok());
    tried->commit(), untried->commit();
    ASSERT_EQ(saved(*tried), saved(*untried)) << i;
    ASSERT_EQ(tried->stable_dt(), untried->stable_dt());
  }
}

TEST(Saving, between_attempt_and_commit_saves_the_present) {
  const auto stepper = scenes::coupled(light_wedge());
  scenes::run(*stepper, 3);
  const auto present = saved(*stepper);
  ASSERT_TRUE(stepper->attempt(1e-4).ok());
  EXPECT_EQ(saved(*stepper), present);
}

// Instants: the first steps, in flight, first contact of the keel, after remeshes, deep in the water.
TEST(Resumed, a_run_continues_bit_for_bit) {
  const int steps = 40;
  const auto whole = scenes::coupled(light_wedge());
  std::vector<std::string> at{saved(*whole)};
  std::vector<double> dts;
  int contact = -1;
  double dt = 1e-4;
  for (int i = 0; i < steps; ++i) {
    dt = std::min(whole->stable_dt(), i == 0 ? 1e-4 : 1.5 * dt);
    dts.push_back(dt);
    ASSERT_TRUE(whole->attempt(dt).ok());
    if (contact < 0 && whole->fluid().result().loads[0].wetted > 0) contact = i;
    whole->commit();
    at.push_back(saved(*whole));
  }
  ASSERT_GT(contact, 0) << "the wedge starts above the water and reaches it";
  ASSERT_LT(contact, steps - 5);
  for (int from : {0, 1, contact - 1, contact, contact + 1, steps - 4}) {
    const auto resumed = scenes::coupled(light_wedge());
    std::istringstream file(at[from]);
    resumed->load(file);
    EXPECT_EQ(saved(*resumed), at[from]);
    for (int i = from; i < std::min(from + 8, steps); ++i) {
      const double expected = i == 0 ? 1e-4 : 1.5 * dts[i - 1];
      EXPECT_EQ(std::min(resumed->stable_dt(), expected), dts[i]) << "the criterion is part of the state";
      ASSERT_TRUE(resumed->attempt(dts[i]).ok());
      resumed->commit();
      ASSERT_EQ(saved(*resumed), at[i + 1]) << "from " << from << " at " << i;
    }
  }
}

TEST(Resumed, with_passes_and_accelerators_continues_bit_for_bit) {
  const auto make = [] {
    return scenes::coupled(scenes::submerged_circle(0.5), std::make_unique<coupling::NoTerm>(),
                           std::make_unique<coupling::Aitken>(0.3));
  };
  const auto whole = make();
  ASSERT_GT(scenes::run(*whole, 3, 1e-3), 1);
  const auto resumed = make();
  EXPECT_TRUE(scenes::go_on_alike(*whole, *resumed, 4, 1e-3));
}

std::string after_steps_with(int threads, const scenes::Scene& scene, int steps) {
  openblas_set_num_threads(threads);
  const auto stepper = scenes::coupled(scene);
  EXPECT_GE(scenes::run(*stepper, steps), 0);
  openblas_set_num_threads(1);
  return saved(*stepper);
}

TEST(Threads, one_or_two_give_the_same_bits) {
  if (openblas_get_parallel() == 0) GTEST_SKIP() << "this OpenBLAS has one thread";
  // Large enough for the supernodal factorisation, whose dense blocks go through the threaded BLAS.
  auto scene = scenes::submerged_circle(0.3, 0.02);
  EXPECT_TRUE(after_steps_with(1, scene, 2) == after_steps_with(2, scene, 2));
}

TEST(Runs, two_of_the_same_scene_are_the_same) {
  const auto one = scenes::coupled(light_wedge()), two = scenes::coupled(light_wedge());
  scenes::run(*one, 25), scenes::run(*two, 25);
  EXPECT_EQ(saved(*one), saved(*two));
}

}  // namespace
}  // namespace splashdown
