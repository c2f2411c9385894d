// Steps that fail are refused, leave the present alone, and the next attempt is as if they had never been.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::saved;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// An effect that spoils one node's velocity while it is told to.
class Spoiler final : public fluid::Effect<2> {
 public:
  Spoiler(const double& value, bool on_wall) : value_(value), on_wall_(on_wall) {}
  std::string name() const override { return "spoiler"; }
  Status predict(const fluid::StepView<2>& step, const fluid::Carried<2>&,
                 const fluid::Predicted<2>& predicted) override {
    if (value_ == 0) return {};
    const auto& nodes = step.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if ((nodes.tie[i].wall >= 0) == on_wall_ && !nodes.surface[i]) {
        predicted.v[i].setConstant(value_);
        break;
      }
    return {};
  }

 private:
  const double& value_;
  bool on_wall_;
};

class BadForce final : public rigid::Force<2> {
 public:
  explicit BadForce(const double& value) : value_(value) {}
  std::string name() const override { return "bad"; }
  void add(const rigid::BodiesAt<2>&, std::span<rigid::Wrench<2>> wrenches) const override {
    for (auto& wrench : wrenches)
      if (value_ != 0) wrench.array() += value_;
  }

 private:
  const double& value_;
};

class Value : public testing::TestWithParam<double> {};

TEST_P(Value, in_the_fluid_refuses_the_step_and_leaves_no_trace) {
  for (bool on_wall : {false, true}) {
    double value = 0;
    auto effects = fluid::scenes::gravity({0, -scenes::g});
    effects.push_back(std::make_unique<Spoiler>(value, on_wall));
    coupling::scenes::Watched<2> stepper(
        std::make_unique<fluid::Fluid<2>>(fluid::scenes::still_water(1, 0.5, 0.1), std::move(effects)));
    ASSERT_GE(scenes::run(stepper, 2, 1e-3), 0);
    const auto before = saved(stepper);
    value = GetParam();
    EXPECT_FALSE(stepper.attempt(1e-3).ok()) << on_wall;
    EXPECT_EQ(saved(stepper), before);
    value = 0;
    ASSERT_TRUE(stepper.attempt(1e-3).ok());
    stepper.commit();
    for (const auto& x : stepper.fluid().nodes().x) EXPECT_TRUE(x.allFinite());
  }
}

TEST_P(Value, in_a_body_refuses_the_step_and_leaves_no_trace) {
  double value = 0;
  auto scene = scenes::submerged_circle(0.5);
  scene.extra_force = [&] { return std::make_unique<BadForce>(value); };
  const auto stepper = scenes::coupled(scene), undisturbed = scenes::coupled(scene);
  for (auto* s : {stepper.get(), undisturbed.get()}) ASSERT_GE(scenes::run(*s, 2, 1e-3), 0);
  const auto before = saved(*stepper);
  value = GetParam();
  const auto report = stepper->attempt(1e-3);
  EXPECT_FALSE(report.ok());
  EXPECT_FALSE(report.cause.empty());
  EXPECT_EQ(saved(*stepper), before);
  value = 0;
  for (auto* s : {stepper.get(), undisturbed.get()}) {
    ASSERT_TRUE(s->attempt(5e-4).ok());
    s->commit();
  }
  EXPECT_EQ(saved(*stepper), saved(*undisturbed));
}

INSTANTIATE_TEST_SUITE_P(NotFinite, Value, testing::Values(nan, std::numeric_limits<double>::infinity(), 1e300));

// Where a node of the surface has lost its way no step is short enough: it leaves as a drop, and the step is the one that was
// wanted. One within the water cannot.
TEST(Fragment, for_which_a_step_is_refused_flies_on_and_the_rest_goes_on) {
  class Runaway final : public fluid::Effect<2> {
   public:
    Runaway(const fluid::Vec<2>& at, const double& speed) : at_(at), speed_(speed) {}
    std::string name() const override { return "runaway"; }
    Status predict(const fluid::StepView<2>& step, const fluid::Carried<2>&,
                   const fluid::Predicted<2>& predicted) override {
      const auto& x = step.nodes.x;
      const auto nearest =
          std::ranges::min_element(x, {}, [&](const fluid::Vec<2>& place) { return (place - at_).squaredNorm(); });
      if (speed_ > 0) predicted.v[static_cast<std::size_t>(nearest - x.begin())] = {0, speed_};
      return {};
    }

   private:
    fluid::Vec<2> at_;
    const double& speed_;
  };
  const double dt = 1e-3;
  for (const double depth : {0., 0.25}) {
    double speed = 0;
    auto effects = fluid::scenes::gravity({0, -scenes::g});
    effects.push_back(std::make_unique<Runaway>(fluid::Vec<2>(0.3, -depth), speed));
    coupling::scenes::Watched<2> stepper(
        std::make_unique<fluid::Fluid<2>>(fluid::scenes::still_water(1, 0.5, 0.1), std::move(effects)));
    ASSERT_GE(scenes::run(stepper, 2, dt), 0);
    EXPECT_FALSE(stepper.release_fragment()) << "nothing was refused";
    const auto before = saved(stepper);
    const double volume = stepper.fluid().ledger().volume;
    speed = 1e6;  // four elements in 0.4 us
    for (double shorter = dt; shorter > dt / 500; shorter /= 2) ASSERT_FALSE(stepper.attempt(shorter).ok());
    ASSERT_EQ(stepper.release_fragment(), depth == 0);
    EXPECT_EQ(saved(stepper), before) << "the present is what it was";
    if (depth > 0) continue;
    const auto report = stepper.attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    const auto& nodes = stepper.fluid().nodes();
    EXPECT_EQ(std::ranges::count(nodes.spray, 1), 1);
    const auto& ledger = stepper.fluid().ledger();
    EXPECT_GT(ledger.spray, 0);
    EXPECT_NEAR(ledger.volume + ledger.spray, volume, 1e-12);
    stepper.commit();
    speed = 0;
    EXPECT_GE(scenes::run(stepper, 5, dt), 0);
  }
}

TEST(Wall, asked_about_a_point_that_is_not_finite_gives_an_answer) {
  const fluid::Wall<2> wall(fluid::scenes::wall("", fluid::scenes::rectangle({0, 0}, {1, 1}), 1));
  const auto home = fluid::Isometry<2>::Identity();
  EXPECT_FALSE(wall.nearest(home, {nan, 0}, 1).point.allFinite());
  EXPECT_FALSE(wall.nearest_on_patch(home, {nan, 0}, 0).point.allFinite());
}

TEST(LinearSolver, that_fails_refuses_the_step_and_the_next_attempt_is_undisturbed) {
  const auto spec = fluid::scenes::still_water(1, 0.5, 0.1);
  fluid::Fluid<2> f(spec, fluid::scenes::gravity({0, -scenes::g}));
  EXPECT_FALSE(f.begin(1e-3, 1e-3, {.interface_operators = {{.laplacian = -1e6}}}).ok());
  ASSERT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
  ASSERT_TRUE(f.solve(std::vector<fluid::Twist<2>>(1, fluid::Twist<2>::Zero())).status.ok());
  EXPECT_NEAR(f.result().loads[0].total()[1], -500 * scenes::g, 1e-6);
}

scenes::Scene without_load() {
  auto scene = scenes::submerged_circle(0.5);
  scene.gravity.setZero();
  return scene;
}

coupling::StepReport iterated_step_without_load(std::unique_ptr<coupling::InterfaceTerm> term) {
  return scenes::coupled(without_load(), std::move(term), std::make_unique<coupling::ConstantRelaxation>(0.3))
      ->attempt(1e-3);
}

TEST(Start, at_rest_without_any_load_needs_no_passes) {
  const auto report = scenes::coupled(without_load())->attempt(1e-3);
  EXPECT_TRUE(report.ok()) << report.cause;
  EXPECT_LE(report.passes, 2);
  EXPECT_TRUE(std::isfinite(report.residual));
}

TEST(Start, at_rest_without_any_load_converges_with_iterated_terms) {
  EXPECT_TRUE(iterated_step_without_load(std::make_unique<coupling::NoTerm>()).ok());
  EXPECT_TRUE(iterated_step_without_load(std::make_unique<coupling::LaplacianTerm>()).ok());
}

TEST(Start, of_a_body_in_the_air_far_from_water_is_free_fall) {
  const auto stepper = scenes::coupled(scenes::wedge_drop(20, 0.3, 0.02));
  ASSERT_GE(scenes::run(*stepper, 5, 1e-3), 0);
  EXPECT_EQ(stepper->fluid().result().loads[0].wetted, 0);
  const double fallen = 6.15 * stepper->time() + 0.5 * scenes::g * std::pow(stepper->time(), 2);
  const double start = 0.3 + rigid::wedge(std::numbers::pi / 6, 0.5, 0.1).at_unit_density.centre.y();
  EXPECT_NEAR(stepper->bodies().state(0).pose.translation().y(), start - fallen, 1e-12);
}

TEST(Liquid, that_is_a_single_droplet_flies) {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = 1, .far = 1};
  spec.liquids.push_back(
      {fluid::scenes::outline({{0, 0}, {0.1, 0}, {0.05, 0.08}}), [](const auto&) { return fluid::Vec<2>(1, 2); }});
  coupling::scenes::Watched<2> stepper(
      std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::gravity({0, -scenes::g})));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(stepper.attempt(1e-3).ok());
    stepper.commit();
  }
  for (const auto& v : stepper.fluid().nodes().v)
    EXPECT_LE((v - fluid::Vec<2>(1, 2 - scenes::g * 9.5e-3)).norm(), 1e-12);
}

TEST(Liquid, that_is_nowhere_is_an_error_at_the_start) {
  auto spec = fluid::scenes::still_water(1, 1, 0.1);
  spec.liquids[0].boundary = fluid::scenes::rectangle({5, 5}, {6, 6});
  EXPECT_THROW(fluid::Fluid<2>(spec, fluid::scenes::no_effects()), std::invalid_argument);
}

TEST(Velocity, that_is_not_finite_at_the_start_is_refused) {
  auto spec = fluid::scenes::still_water(1, 1, 0.2);
  spec.liquids[0].velocity = [](const auto&) { return fluid::Vec<2>(nan, 0); };
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  EXPECT_FALSE(stepper.attempt(1e-3).ok());
}

}  // namespace
}  // namespace splashdown
