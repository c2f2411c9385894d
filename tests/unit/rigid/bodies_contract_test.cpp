#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "rigid/forces/gravity.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::bodies_contract_test {

namespace {

BodySpec<3> tumbling() {
  BodySpec<3> spec = skew_body();
  spec.pose.linear() = Eigen::AngleAxisd(0.9, Eigen::Vector3d(0, 1, 1).normalized()).toRotationMatrix();
  spec.velocity << 1, 2, 3, 0.7, 1.8, -0.3;
  return spec;
}

Wrench<3> some_load(int i) {
  Wrench<3> load;
  for (int k = 0; k < 6; ++k) load(k) = std::sin(1. + 3 * i + k);
  return load;
}

std::string body_failure(const BodySpec<2>& spec) {
  return failure([&] { alone(spec); });
}

}  // namespace

TEST(Solve, gives_the_same_bits_again_whatever_was_tried_between) {
  Bodies<3> bodies = alone(tumbling());
  for (int i = 0; i < 20; ++i) {
    bodies.begin(1e-2, 1e-2);
    const BodyState<3> first = bodies.solve(std::vector{some_load(i)})[0];
    bodies.solve(std::vector<Wrench<3>>{1e6 * some_load(i + 1)});
    EXPECT_TRUE(identical(first, bodies.solve(std::vector{some_load(i)})[0]));
    bodies.commit();
    EXPECT_TRUE(identical(first, bodies.state(0)));
  }
}

TEST(Solve, leaves_the_present_alone_until_commit) {
  Bodies<3> bodies = alone(tumbling());
  const BodyState<3> before = bodies.state(0);
  bodies.begin(1e-2, 1e-2);
  bodies.solve(std::vector{some_load(1)});
  EXPECT_TRUE(identical(before, bodies.state(0)));
  EXPECT_EQ(bodies.time(), 0);
  bodies.begin(5e-3, 5e-3);  // a refused step is begun anew
  bodies.solve(std::vector{some_load(1)});
  bodies.commit();
  EXPECT_EQ(bodies.time(), 5e-3);
}

TEST(Solve, is_affine_in_the_load_with_slope_kick_times_compliance) {
  for (const bool hold : {false, true}) {
    BodySpec<3> spec = tumbling();
    if (hold) spec.free = {true, false, true, true, false, true};
    Bodies<3> bodies = alone(spec);
    for (int i = 0; i < 3; ++i) step(bodies, 2e-2, 2e-2, some_load(i));
    const double kick = 0.03;
    bodies.begin(kick, 0.04);
    const Eigen::MatrixXd c = compliance(bodies);
    EXPECT_TRUE(c.isApprox(c.transpose(), 10 * eps));
    const Twist<3> base = bodies.solve(std::vector<Wrench<3>>{Wrench<3>::Zero()})[0].velocity;
    for (int k = 0; k < 6; ++k) {
      const Wrench<3> load = 100 * Wrench<3>::Unit(k);
      const Twist<3> change = bodies.solve(std::vector{load})[0].velocity - base;
      EXPECT_NEAR((change - kick * c * load).norm(), 0, 100 * eps);
    }
  }
}

TEST(Compliance, of_a_turned_body_is_the_turned_inverse_mass_matrix) {
  const BodySpec<3> spec = tumbling();
  Bodies<3> bodies = alone(spec);
  const double instant = 1e-12;
  bodies.begin(instant, instant);
  const Eigen::Matrix3d r = spec.pose.linear();
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  expected.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / spec.mass;
  expected.bottomRightCorner<3, 3>() = r * spec.inertia.inverse() * r.transpose();
  EXPECT_NEAR((compliance(bodies) - expected).norm(), 0, 100 * eps + instant * spec.velocity.norm());
}

TEST(Compliance, of_held_fixed_and_prescribed_is_zero) {
  BodySpec<2> heaving = planar_body(), fixed = planar_body(), driven = planar_body();
  heaving.free = {false, true, false};
  fixed.motion = BodyMotion::fixed;
  driven.motion = BodyMotion::prescribed;
  driven.path = [](double) { return Isometry<2>::Identity(); };
  Bodies<2> bodies({heaving, fixed, driven}, {});
  bodies.begin(1e-3, 1e-3);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(9, 9);
  expected(1, 1) = 1. / 3;
  EXPECT_NEAR((compliance(bodies) - expected).norm(), 0, 10 * eps);
}

TEST(Compliance, with_one_free_axis_is_the_inverse_moment_about_it) {
  BodySpec<3> spec = tumbling();
  spec.free = {false, false, false, false, true, false};
  const Eigen::Matrix3d j = spec.pose.linear() * spec.inertia * spec.pose.linear().transpose();
  Bodies<3> bodies = alone(spec);
  const double instant = 1e-12;
  bodies.begin(instant, instant);
  EXPECT_NEAR(compliance(bodies)(4, 4), 1 / j(1, 1), 10 * eps + instant * spec.velocity.norm());
}

TEST(Checkpoint, continues_bit_for_bit) {
  BodySpec<3> driven = tumbling();
  driven.motion = BodyMotion::prescribed;
  driven.path = [](double t) {
    Isometry<3> pose = Isometry<3>::Identity();
    pose.rotate(Eigen::AngleAxisd(t * t, Eigen::Vector3d::UnitY()));
    pose.translation().x() = std::sin(t);
    return pose;
  };
  const auto scene = [&] {
    std::vector<std::unique_ptr<Force<3>>> forces;
    forces.push_back(std::make_unique<Gravity<3>>(Vec<3>(0, 0, -9.81)));
    return Bodies<3>({tumbling(), driven}, std::move(forces));
  };
  const auto advance = [](Bodies<3>& bodies, int from, int to) {
    for (int i = from; i < to; ++i) {
      const double dt = i % 3 == 0 ? 1e-2 : 7e-3;
      bodies.begin(dt, dt);
      bodies.solve(std::vector{some_load(i), some_load(i + 5)});
      bodies.commit();
    }
  };
  Bodies<3> undisturbed = scene(), resumed = scene();
  advance(undisturbed, 0, 30);
  std::stringstream file;
  undisturbed.save(file);
  resumed.load(file);
  advance(undisturbed, 30, 60);
  advance(resumed, 30, 60);
  EXPECT_EQ(undisturbed.time(), resumed.time());
  for (const std::size_t body : {0u, 1u}) EXPECT_TRUE(identical(undisturbed.state(body), resumed.state(body)));
}

TEST(Checkpoint, of_another_scene_or_cut_short_is_refused) {
  Bodies<2> one = alone(planar_body()), two({planar_body(), planar_body()}, {});
  std::stringstream file;
  one.save(file);
  EXPECT_THROW(two.load(file), std::runtime_error);
  std::stringstream cut(file.str().substr(0, file.str().size() - 3));
  EXPECT_THROW(one.load(cut), std::runtime_error);
}

TEST(Solve, answers_a_load_that_is_not_finite_by_a_state_that_is_not_and_recovers) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Bodies<2> bodies = alone(planar_body()), calm = alone(planar_body());
    bodies.begin(1e-2, 1e-2);
    EXPECT_FALSE(bodies.solve(std::vector<Wrench<2>>{Wrench<2>(bad, 0, 0)})[0].velocity.allFinite());
    bodies.solve(std::vector<Wrench<2>>{Wrench<2>::Constant(1e300)});
    bodies.solve(std::vector<Wrench<2>>{Wrench<2>(1, 2, 3)});
    bodies.commit();
    step<2>(calm, 1e-2, 1e-2, Wrench<2>(1, 2, 3));
    EXPECT_TRUE(identical(bodies.state(0), calm.state(0)));
  }
}

TEST(Verbs, out_of_order_are_refused) {
  Bodies<2> bodies = alone(planar_body());
  const std::vector<Wrench<2>> load{Wrench<2>::Zero()}, loads(2, Wrench<2>::Zero());
  EXPECT_THROW(bodies.solve(load), std::logic_error);
  EXPECT_THROW(bodies.commit(), std::logic_error);
  EXPECT_THROW(bodies.begin(1e-3, 0), std::invalid_argument);
  bodies.begin(1e-3, 1e-3);
  EXPECT_THROW(bodies.commit(), std::logic_error);
  EXPECT_THROW(bodies.solve(loads), std::invalid_argument);
}

TEST(BadBody, is_refused_with_name_rule_and_value) {
  BodySpec<2> spec = planar_body();
  EXPECT_EQ(body_failure(spec), "");
  spec.mass = 0;
  EXPECT_EQ(body_failure(spec), "body \"hull\": it has a moment of inertia and no mass");
  spec.motion = BodyMotion::fixed;
  EXPECT_EQ(body_failure(spec), "");
  spec.motion = BodyMotion::prescribed;
  EXPECT_EQ(body_failure(spec), "body \"hull\": prescribed motion needs a path");
  spec = planar_body();
  spec.inertia(0, 0) = -1;
  EXPECT_TRUE(says(body_failure(spec), "smallest moment of inertia is -1"));
  spec = planar_body();
  spec.pose.linear() *= 2;
  EXPECT_TRUE(says(body_failure(spec), "not a rotation"));
  spec = planar_body();
  spec.velocity(1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(body_failure(spec), "velocity is not finite"));
}

}  // namespace splashdown::rigid::bodies_contract_test
