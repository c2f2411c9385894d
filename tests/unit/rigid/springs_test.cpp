// Laws of joints with stops, springs and dampers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::springs_test {
namespace {

using std::numbers::pi;

const Eigen::Vector3d along_x = Eigen::Vector3d::UnitX();

TEST(Spring, swings_with_its_period_to_second_order) {
  const double mass = 2, stiffness = 50, exact = 2 * pi * std::sqrt(mass / stiffness);
  std::vector<double> error;
  for (double dt : {0.02, 0.01, 0.005}) {
    Bodies<2> bodies({lump<2>(mass, {0, 0})}, {},
                     {{.type = JointType::slider, .axis = along_x, .spring = Spring{stiffness, 0, 0.3}}});
    double before = 0, first = 0, last = 0, farthest = 0;
    int crossings = 0;
    for (int i = 0; bodies.time() < 20 * exact; ++i) {
      run(bodies, 1, dt, i == 0);
      const double now = bodies.state(0).pose.translation().x() - 0.3;
      farthest = std::max(farthest, now);
      if (i > 0 && before < 0 && now >= 0) {
        const double crossed = bodies.time() - dt * now / (now - before);
        (crossings++ == 0 ? first : last) = crossed;
      }
      before = now;
    }
    error.push_back((last - first) / (crossings - 1) / exact - 1);
    // beta = 1/4: tan(w' dt / 2) = w dt / 2, the period is longer by (w dt)^2 / 12.
    EXPECT_NEAR(error.back(), std::pow(2 * pi / exact * dt, 2) / 12, 0.1 * error.back());
    EXPECT_NEAR(farthest, 0.3, 0.3 * std::pow(2 * pi / exact * dt, 2)) << "it neither gains nor loses";
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.2);
}

TEST(Spring, however_stiff_is_stable_at_any_step) {
  for (const double stiffness : {1e3, 1e6, 1e12})
    for (const double mass : {2.0, 1e-6}) {
      BodySpec<2> spec = lump<2>(mass, {0, 0});
      spec.velocity[0] = 1;
      Bodies<2> bodies({spec}, {}, {{.type = JointType::slider, .axis = along_x, .spring = Spring{stiffness, 0, 0}}});
      double dt = 0.01;
      for (int i = 0; i < 2000; ++i) {
        bodies.begin(i == 0 ? dt / 2 : dt, dt);
        bodies.solve(std::vector{Wrench<2>(Wrench<2>::Zero())});
        bodies.commit();
        ASSERT_LE(std::abs(bodies.state(0).velocity[0]), 1 + 1e-6)
            << stiffness << " N/m, " << mass << " kg, step " << i;
      }
    }
}

TEST(Damper, slows_as_exp_minus_c_t_over_m) {
  BodySpec<2> spec = lump<2>(2, {0, 0});
  spec.velocity[0] = 1;
  const double c = 3, dt = 1e-3;
  Bodies<2> bodies({spec}, {}, {{.type = JointType::slider, .axis = along_x, .spring = Spring{0, c, 0}}});
  run(bodies, 1000, dt);
  EXPECT_NEAR(bodies.state(0).velocity[0], std::exp(-c * (1 - dt / 2) / 2), 1e-9) << "exact for a mass alone";
}

TEST(Damper, however_strong_holds_and_does_not_throw_back) {
  for (const double c : {1e2, 1e4, 1e12}) {
    BodySpec<2> spec = lump<2>(2, {0, 0});
    spec.velocity[0] = 1;
    Bodies<2> bodies({spec}, {}, {{.type = JointType::slider, .axis = along_x, .spring = Spring{0, c, 0}}});
    for (int i = 0; i < 10; ++i) {
      const double before = bodies.state(0).velocity[0];
      run(bodies, 1, 0.01, i == 0);
      EXPECT_GE(bodies.state(0).velocity[0], 0) << c;
      EXPECT_LE(bodies.state(0).velocity[0], before * std::exp(-c * 0.005 / 2) * (1 + 1e-9) + 1e-15) << c;
    }
  }
}

TEST(Spring, of_a_hinge_turns_the_body_towards_its_rest) {
  // Overdamped: at rest where the spring is relaxed, counterclockwise of where it was.
  Bodies<2> bodies({lump<2>(1, {0.3, 0})}, {}, {{.spring = Spring{5, 5, 0.4}}});
  run(bodies, 20000, 1e-3);
  EXPECT_NEAR(angle(bodies.state(0).pose), 0.4, 1e-6);
}

// theta(t) = (v/w) sin(w t), w^2 = k/I: four turns to each side.
TEST(Spring, of_a_hinge_counts_turns_also_after_a_resume) {
  BodySpec<2> spec = lump<2>(1, {0, 0});  // I = 0.1 kg m
  const double stiffness = 0.1, spin = 8 * pi;
  spec.velocity[2] = spin;
  const auto make = [&] { return Bodies<2>({spec}, {}, {{.spring = Spring{stiffness, 0, 0}}}); };
  Bodies<2> bodies = make();
  run(bodies, 3000, 1e-3);
  EXPECT_NEAR(bodies.state(0).velocity[2], spin * std::cos(3 - 0.5e-3), 1e-5 * spin);
  std::stringstream stored;
  bodies.save(stored);
  Bodies<2> again = make();
  again.load(stored);
  run(bodies, 3000, 1e-3, false);
  run(again, 3000, 1e-3, false);
  EXPECT_EQ(bodies.state(0).velocity, again.state(0).velocity);
  EXPECT_NEAR(bodies.state(0).velocity[2], spin * std::cos(6 - 0.5e-3), 1e-5 * spin);
}

TEST(Stop, of_a_hinge_may_lie_beyond_whole_turns) {
  BodySpec<2> spec = lump<2>(1, {0, 0});
  spec.velocity[2] = 9;
  Bodies<2> bodies({spec}, {}, {{.stops = {-1, 7}}});
  run(bodies, 2000, 1e-3);
  EXPECT_NEAR(angle(bodies.state(0).pose), 7 - 2 * pi, 1e-6);
}

TEST(Spring, between_bodies_in_flight_keeps_their_momenta) {
  for (const JointType type : {JointType::slider, JointType::hinge}) {
    BodySpec<3> a = lump<3>(2, {0.2, 0.3, -0.1}), b = lump<3>(0.7, {-0.6, 0.1, 0.4});
    a.velocity << 0.1, 0.2, -0.1, 0.3, -0.2, 0.4;
    Bodies<3> bodies({a, b}, {},
                     {{.type = type,
                       .body = 0,
                       .other = 1,
                       .point = {0.1, 0.1, 0.1},
                       .axis = {1, 2, -1},
                       .spring = Spring{20, 1, 0.3}}});
    const auto momenta = [&] {
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (std::size_t i : {0u, 1u}) {
        const auto& spec = bodies.spec(i);
        const auto& [pose, s] = bodies.state(i);
        const Vec<3> p = spec.mass * s.head<3>();
        sum.head<3>() += p;
        sum.tail<3>() += pose.translation().cross(p) + 0.1 * spec.mass * s.tail<3>();
      }
      return sum;
    };
    run(bodies, 1, 1e-3);
    const auto before = momenta();
    run(bodies, 3000, 1e-3, false);
    EXPECT_NEAR((momenta() - before).norm(), 0, 1e-9) << static_cast<int>(type);
  }
}

TEST(Stop, ends_a_swing_there_and_lets_it_go_back) {
  for (const double way : {1.0, -1.0}) {
    BodySpec<2> spec = lump<2>(1, {0.3, 0});
    const double spin = 2 * way;
    spec.velocity << 0, 0.3 * spin, spin;
    Bodies<2> bodies({spec}, {}, {{.stops = {-0.5, 0.3}}});
    double farthest = 0;
    for (int i = 0; i < 1000; ++i) {
      run(bodies, 1, 1e-3, i == 0);
      farthest = std::max(farthest, way * angle(bodies.state(0).pose));
    }
    const double stop = way > 0 ? 0.3 : 0.5;
    EXPECT_NEAR(farthest, stop, 1e-6);
    EXPECT_NEAR(way * angle(bodies.state(0).pose), stop, 1e-6) << "plastic";
    // What positions do not resolve, 1e-10 of the body's length, over a step.
    EXPECT_NEAR(bodies.state(0).velocity.norm(), 0, 1e-6);
    bodies.begin(1e-3, 1e-3);
    bodies.solve(std::vector{Wrench<2>(0, 0, -10 * way)});
    EXPECT_LT(way * bodies.trials()[0].velocity[2], 0) << "it only pushes";
    bodies.solve(std::vector{Wrench<2>(0, 0, 10 * way)});
    EXPECT_NEAR(bodies.trials()[0].velocity.norm(), 0, 1e-3) << "no more than the last micrometre within the step";
  }
}

TEST(Stop, of_a_slider_holds_in_space) {
  BodySpec<3> a = lump<3>(2, {0, 0, 0}), b = lump<3>(3, {1, 0, 0});
  a.velocity << 1, 1, 0, 0, 0, 0;
  b.velocity << 0, 0, 0, 0, 0, 0;
  b.free = {true, true, true, false, false, false};
  a.free = b.free;
  Bodies<3> bodies({a, b}, {},
                   {{.type = JointType::slider, .body = 0, .other = 1, .axis = {1, 1, 0}, .stops = {-0.1, 0.25}}});
  run(bodies, 2000, 1e-3);
  const Vec<3> apart = bodies.state(0).pose.translation() - bodies.state(1).pose.translation() - Vec<3>(-1, 0, 0);
  EXPECT_NEAR((apart - 0.25 * Vec<3>(1, 1, 0).normalized()).norm(), 0, 1e-9);
  EXPECT_NEAR(bodies.state(0).velocity[0], 2. / 5, 1e-9) << "plastic: they go on together";
}

TEST(Joint, with_a_stop_or_spring_that_makes_no_sense_is_refused) {
  const auto why = [](const JointSpec& joint) {
    return failure([&] { Bodies<2>({lump<2>(1, {0, 0}), lump<2>(1, {1, 0})}, {}, {joint}); });
  };
  EXPECT_TRUE(says(why({.type = JointType::weld, .spring = Spring{1, 0, 0}}), "weld"));
  EXPECT_TRUE(says(why({.stops = {0.1, 0.2}}), "beyond its stops"));
  EXPECT_TRUE(says(why({.spring = Spring{-1, 0, 0}}), "gives energy"));
  EXPECT_TRUE(says(why({.spring = Spring{1, 0, NAN}}), "not finite"));
}

}  // namespace
}  // namespace splashdown::rigid::springs_test
