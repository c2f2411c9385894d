#include "coupling/schemes/steppers.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling::steppers_test {
namespace {

using scenes::eps;
using scenes::saved;

std::vector<std::string> names(const Stepper& stepper) {
  std::vector<std::string> out;
  for (const auto& phase : stepper.phase_seconds()) out.push_back(phase.first);
  return out;
}

TEST(LeapfrogClock, kicks_are_means_of_neighbouring_steps) {
  LeapfrogClock clock;
  EXPECT_EQ(clock.kick(0.2), 0.1) << "from t_0 to the first half step";
  clock.start(0.2);
  EXPECT_EQ(clock.kick(0.4), 0.2) << "a step that is not committed leaves no trace";
  clock.commit();
  EXPECT_EQ(clock.kick(0.4), 0.5 * (0.2 + 0.4));
  std::stringstream file;
  clock.save(file);
  LeapfrogClock other;
  other.load(file);
  EXPECT_EQ(other.kick(0.4), clock.kick(0.4));
}

TEST(StructureOnly, flies_straight_without_a_fluid) {
  auto scene = scenes::submerged_circle(1);
  scene.set_velocity(0, {3, 2, 5});
  scenes::Watched<2> stepper(
      std::make_unique<rigid::Bodies<2>>(scene.bodies, std::vector<std::unique_ptr<rigid::Force<2>>>{}), 0.01);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(stepper.attempt(stepper.stable_dt()).ok());
    stepper.commit();
  }
  const auto& state = stepper.bodies().state(0);
  EXPECT_NEAR(stepper.time(), 10, 1e3 * eps * 10);
  EXPECT_LE((state.pose.translation() - Eigen::Vector2d(30, 20 - 1.5)).norm(), 1e3 * eps * 40);
  EXPECT_EQ(state.velocity, rigid::Twist<2>(3, 2, 5)) << "no force: momentum and energy to the last bit";
}

TEST(Partitioned, fluid_and_body_agree_on_the_velocity) {
  for (double ratio : {3.0, 0.3, 0.03}) {
    const auto stepper = scenes::coupled(scenes::submerged_circle(ratio));
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(stepper->attempt(1e-3).ok());
      const auto& body = stepper->trial()[0].velocity;
      EXPECT_LE((stepper->fluid().result().wall_velocities[0] - body).norm(), 1e-8 * body.norm());
      stepper->commit();
      EXPECT_EQ(stepper->fluid().wall_poses()[0].matrix(), stepper->bodies().state(0).pose.matrix());
    }
  }
}

TEST(Partitioned, a_body_moves_as_its_load_says) {
  const auto stepper = scenes::coupled(scenes::submerged_circle(0.3));
  scenes::run(*stepper, 3);
  const auto before = stepper->bodies().state(0).velocity;
  const double dt = 1e-3;
  ASSERT_TRUE(stepper->attempt(dt).ok());
  const auto load = stepper->fluid().result().loads[0];
  const auto after = stepper->trial()[0].velocity;
  const double mass = stepper->bodies().spec(0).mass;
  // The kick's length follows from gravity, which both sides of the balance know.
  stepper->commit();
  ASSERT_TRUE(stepper->attempt(dt).ok());  // kick = dt now
  const auto next = stepper->trial()[0].velocity;
  const auto force = stepper->fluid().result().loads[0].total();
  EXPECT_LE((mass * (next - after).head<2>() - dt * (force.head<2>() + mass * Eigen::Vector2d(0, -scenes::g))).norm(),
            1e-8 * dt * force.norm());
  EXPECT_GT(load.physical.norm(), 0);
  EXPECT_NE(before, after);
}

TEST(Partitioned, a_fixed_body_stays_and_carries_its_buoyancy) {
  auto scene = scenes::submerged_circle(1);
  scene.bodies[0].motion = BodyMotion::fixed;
  const auto stepper = scenes::coupled(scene, std::make_unique<NoTerm>(), std::make_unique<ConstantRelaxation>(1.0),
                                       {.fixed_passes = 1});
  for (int i = 0; i < 3; ++i) {
    const auto report = stepper->attempt(1e-3);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report.passes, 1);
    // Archimedes on the hull's facets of the mesh: p is linear, its load exact.
    double hull = 0;
    for (const auto& f : stepper->fluid().mesh().boundary)
      if (f.wall == 0)
        hull -= stepper->fluid().nodes().x[f.nodes[0]].dot(fluid::area_vector_of<2>(f, stepper->fluid().nodes().x)) / 2;
    const auto load = stepper->fluid().result().loads[0].total();
    EXPECT_NEAR(load[1], scenes::water * scenes::g * hull, 1e-8 * load[1]);
    EXPECT_NEAR(load[0], 0, 1e-8 * load[1]);
    EXPECT_NEAR(load[2], 0, 1e-8 * load[1]);
    stepper->commit();
  }
  EXPECT_EQ(stepper->bodies().state(0).pose.matrix(), scene.bodies[0].pose.matrix());
}

// Velocity after a step from rest, relative to that with the exact term.
double departure(std::unique_ptr<InterfaceTerm> term, std::unique_ptr<Accelerator> accelerator, double dt) {
  const auto scene = scenes::submerged_circle(3);  // heavy enough for plain Dirichlet-Neumann
  const auto after_step = [&](const std::unique_ptr<scenes::Watched<2>>& stepper) {
    const auto report = stepper->attempt(dt);
    EXPECT_TRUE(report.ok()) << report.cause;
    return stepper->trial()[0].velocity;
  };
  const auto exact = after_step(scenes::coupled(scene));
  const auto found = after_step(scenes::coupled(scene, std::move(term), std::move(accelerator), {.tolerance = 1e-7}));
  return (found - exact).norm() / exact.norm();
}

// The deferred corrections of the pressure are truncated after two; what they leave depends on the term. With
// the interface Laplacian in the matrix each of them is a smaller one.
TEST(Partitioned, all_terms_and_accelerators_have_the_same_limit) {
  for (double dt : {1e-3, 5e-4}) {
    const double relaxed = departure(std::make_unique<NoTerm>(), std::make_unique<ConstantRelaxation>(0.5), dt);
    const double aitken = departure(std::make_unique<NoTerm>(), std::make_unique<Aitken>(0.5), dt);
    const double laplacian =
        departure(std::make_unique<LaplacianTerm>(), std::make_unique<ConstantRelaxation>(1.0), dt);
    EXPECT_LT(relaxed, 1e-5);
    EXPECT_NEAR(aitken, relaxed, 1e-6);
    EXPECT_LT(laplacian, 1e-3);
  }
}

TEST(Partitioned, refuses_a_step_without_agreement_and_leaves_the_present_alone) {
  const auto scene = scenes::submerged_circle(0.1);
  const auto bold = scenes::coupled(scene, std::make_unique<NoTerm>());
  const auto before = saved(*bold);
  EXPECT_FALSE(bold->attempt(1e-3).ok());
  EXPECT_EQ(saved(*bold), before);
  const auto patient =
      scenes::coupled(scene, std::make_unique<NoTerm>(), std::make_unique<ConstantRelaxation>(0.01), {.max_passes = 5});
  const auto report = patient->attempt(1e-3);
  EXPECT_EQ(report.passes, 5);
  EXPECT_NE(report.cause.find("did not converge"), std::string::npos) << report.cause;
  EXPECT_NE(report.cause.find("none"), std::string::npos) << "the cure is named: " << report.cause;
}

TEST(Partitioned, continues_bit_for_bit_with_what_its_accelerator_has_learnt) {
  const auto scene = scenes::submerged_circle(0.3);
  const auto fresh = [&] {
    return scenes::coupled(scene, std::make_unique<NoTerm>(), std::make_unique<IqnIls>(1.0, 2));
  };
  const auto straight = fresh(), resumed = fresh();
  ASSERT_GT(scenes::run(*straight, 3), 0);
  std::stringstream file(saved(*straight));
  resumed->load(file);
  ASSERT_TRUE(straight->attempt(2e-4).ok());  // and not committed: leaves no trace
  for (auto* stepper : {straight.get(), resumed.get()}) ASSERT_GT(scenes::run(*stepper, 2, 1e-3), 0);
  EXPECT_EQ(saved(*straight), saved(*resumed));
}

TEST(Partitioned, says_that_the_coupling_diverged) {
  const auto stepper = scenes::coupled(scenes::submerged_circle(0.1), std::make_unique<NoTerm>());
  const auto report = stepper->attempt(1e-3);
  EXPECT_NE(report.cause.find("diverged"), std::string::npos) << report.cause;
  EXPECT_NE(report.cause.find("interface_term = \"rigid\""), std::string::npos) << "the cure: " << report.cause;
  EXPECT_LT(report.passes, 20) << "1e6 at tenfold a pass";
}

/// Answers what it is told, whatever it is asked.
class Stuck final : public Accelerator {
 public:
  explicit Stuck(double factor) : factor_(factor) {}
  std::string name() const override { return "stuck"; }
  void begin_step() override {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd&) override { return factor_ * x; }

 private:
  double factor_;
};

TEST(Partitioned, names_a_cause_when_passes_stand_still_or_end_in_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double factor : {1.0, nan, infinity}) {
    auto scene = scenes::submerged_circle(0.1);
    scene.set_velocity(0, {0.1, 0, 0});  // a first guess that is not zero
    const auto stepper =
        scenes::coupled(scene, std::make_unique<NoTerm>(), std::make_unique<Stuck>(factor), {.max_passes = 7});
    const auto before = saved(*stepper);
    const auto report = stepper->attempt(1e-3);
    EXPECT_FALSE(report.ok()) << factor;
    EXPECT_EQ(report.passes, factor == 1 ? 7 : 2) << factor;
    EXPECT_NE(report.cause.find(factor == 1 ? "did not converge" : "not finite"), std::string::npos) << report.cause;
    EXPECT_EQ(saved(*stepper), before) << factor;
    const auto next = scenes::coupled(scene);
    EXPECT_TRUE(next->attempt(1e-3).ok()) << "the same scene has a solution";
  }
}

TEST(Phases, are_those_of_the_parts_and_effects_a_stepper_has) {
  auto scene = scenes::submerged_circle(1);
  const auto has = [](const Stepper& stepper, const std::string& phase) {
    const auto all = names(stepper);
    return std::find(all.begin(), all.end(), phase) != all.end();
  };
  const auto both = scenes::coupled(scene);
  EXPECT_TRUE(has(*both, "rigid") && has(*both, "coupling") && has(*both, "pressure"));
  const scenes::Watched<2> fluid(
      std::make_unique<fluid::Fluid<2>>(fluid::scenes::still_water(1, 1, 0.2), fluid::scenes::no_effects()));
  EXPECT_FALSE(has(fluid, "rigid") || has(fluid, "coupling"));
  EXPECT_FALSE(has(fluid, "gravity")) << "an absent effect has no timer";
  for (const auto& phase : both->phase_seconds()) EXPECT_EQ(phase.second, 0) << phase.first << " before the first step";
}

TEST(Gravity, that_a_scene_does_not_name_leaves_no_trace) {
  auto scene = scenes::submerged_circle(0.5);
  scene.gravity.setZero();
  const auto stepper = scenes::coupled(scene);
  EXPECT_TRUE(stepper->fluid().effects().empty());
  const auto x = stepper->fluid().nodes().x;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(stepper->attempt(1e-2).ok());
    stepper->commit();
  }
  // Nodes on walls are put back onto them: their positions' roundoff over dt.
  const double roundoff = 100 * eps * 5 / 1e-2;
  EXPECT_LE((stepper->bodies().state(0).pose.matrix() - scene.bodies[0].pose.matrix()).norm(), roundoff);
  for (const auto& v : stepper->fluid().nodes().v) EXPECT_LE(v.norm(), roundoff);
  EXPECT_EQ(stepper->fluid().ledger().potential_energy, 0);
}

}  // namespace
}  // namespace splashdown::coupling::steppers_test
