// Motion in stages: prescribed first and free later.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/geometry.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::release_test {
namespace {

constexpr double g = 9.81;

/// Goes its way with constant velocity and spin until it is let go.
template <int d>
BodySpec<d> carried(const Twist<d>& velocity, const Release& release) {
  auto spec = free_body<d>(2, Inertia<d>::Identity());
  spec.motion = BodyMotion::prescribed;
  spec.release = release;
  spec.velocity = velocity;
  spec.path = [velocity](double t) {
    Isometry<d> pose = Isometry<d>::Identity();
    pose.linear() = splashdown::rotation(Rotation<d>(velocity.template tail<rotations<d>>() * t));
    pose.translation() = velocity.template head<d>() * t;
    return pose;
  };
  return spec;
}

/// As a run chooses its steps. `before`: the last one; returned is that of this stretch.
template <int d>
double run_until(Bodies<d>& bodies, double end, double dt_max, double before = 0) {
  while (bodies.time() < end - 1e-12) {
    const double dt = std::min({dt_max, bodies.stable_dt(), end - bodies.time()});
    bodies.begin((before + dt) / 2, dt);
    bodies.solve(std::vector<Wrench<d>>(bodies.size(), Wrench<d>::Zero()));
    bodies.commit();
    before = dt;
  }
  return before;
}

}  // namespace

TEST(Release, at_a_time_goes_on_with_the_velocity_of_the_path) {
  for (const double let_go : {0.2, 0.2037, 0.31}) {
    auto bodies = alone<2>(carried<2>({3, 1, 0.7}, {.time = let_go}), pull<2>({0, -g}));
    const double last = run_until(bodies, let_go, 0.01);
    ASSERT_TRUE(bodies.answers(0));
    EXPECT_NEAR(bodies.time(), let_go, 1e-12) << "a step ends there";
    const Vec<2> there = bodies.state(0).pose.translation();
    const double turned = angle(bodies.state(0).pose), t = 0.5;
    run_until(bodies, let_go + t, 0.01, last);
    // Leapfrog is exact on a parabola.
    EXPECT_NEAR(bodies.state(0).pose.translation().y() - there.y(), t - g * t * t / 2, 1e-9);
    EXPECT_NEAR(bodies.state(0).pose.translation().x() - there.x(), 3 * t, 1e-9);
    EXPECT_NEAR(angle(bodies.state(0).pose) - turned, 0.7 * t, 1e-9);
  }
}

TEST(Release, from_a_path_that_accelerates_goes_on_with_the_velocity_of_that_instant) {
  auto spec = carried<2>({0, 0, 0}, {.time = 0.2});
  spec.path = [](double t) {
    Isometry<2> pose = Isometry<2>::Identity();
    pose.translation() = Vec<2>(0, 4 * t * t);
    return pose;
  };
  auto bodies = alone<2>(spec, pull<2>({0, -g}));
  run_until(bodies, 0.7, 0.01);
  EXPECT_NEAR(bodies.state(0).pose.translation().y(), 0.16 + 1.6 * 0.5 - g * 0.125, 1e-4);
}

TEST(Release, no_step_towards_it_is_a_sliver) {
  auto bodies = alone<2>(carried<2>({1, 0, 0}, {.time = 0.1000001}), pull<2>({0, -g}));
  double before = 0, least = 1;
  while (!bodies.answers(0)) {
    const double dt = std::min({0.01, bodies.stable_dt(), before > 0 ? 1.5 * before : 1.0});
    bodies.begin((before + dt) / 2, dt);
    bodies.solve(std::vector<Wrench<2>>(1, Wrench<2>::Zero()));
    bodies.commit();
    least = std::min(least, before = dt);
  }
  EXPECT_GT(least, 0.004);
  EXPECT_NEAR(bodies.time(), 0.1000001, 1e-12);
}

TEST(Release, at_contact_and_at_load_wait_for_the_water) {
  auto wet = alone<2>(carried<2>({0, -1, 0}, {.at_contact = true}), pull<2>({0, -g}));
  run(wet, 10);
  EXPECT_FALSE(wet.answers(0));
  BodySpec<2> hull = carried<2>({0, -1, 0}, {.at_contact = true});
  hull.surface = box(1, 1).surface;
  auto bodies = alone<2>(hull, pull<2>({0, -g}));
  bodies.begin(1e-3, 1e-3);
  bodies.solve(std::vector<Wrench<2>>(1, Wrench<2>::Zero()));
  bodies.see_wetted(std::vector{0.1});
  bodies.commit();
  EXPECT_TRUE(bodies.answers(0));

  auto loaded = alone<2>(carried<2>({0, -1, 0}, {.load = 50}), pull<2>({0, -g}));
  step<2>(loaded, 1e-3, 1e-3, {30, 39, 0});
  EXPECT_FALSE(loaded.answers(0)) << "a load of 49.2";
  EXPECT_EQ(loaded.state(0).velocity, Twist<2>(0, -1, 0)) << "which does not move it";
  step<2>(loaded, 1e-3, 1e-3, {30, 41, 0});
  EXPECT_TRUE(loaded.answers(0));
  step<2>(loaded, 1e-3, 1e-3, {0, 0, 0});
  // Half a kick of the load that let it go is in its velocity, for it has gone on with -1 m/s at that instant.
  EXPECT_NEAR(loaded.state(0).velocity[1], -1 - g * 0.5e-3 - 0.5e-3 * 41 / 2, 1e-9);
}

TEST(Release, at_contact_waits_for_a_body_that_touches) {
  BodySpec<2> shelf = carried<2>({0, 0, 0}, {.at_contact = true});
  shelf.surface = box(1, 0.2).surface;
  const auto ball = of_shape(circle(0.1), {0, 0.3});  // 0.1 m above the shelf
  for (const bool falls : {false, true}) {
    Bodies<2> bodies({shelf, ball}, falls ? pull<2>({0, -g}) : pull<2>({0, 0}), {}, ContactSpec<2>{});
    const double contact = std::sqrt(2 * 0.1 / g), dt = 1e-3;
    while (bodies.time() < 2 * contact && !bodies.answers(0)) run(bodies, 1, dt, bodies.time() == 0);
    EXPECT_EQ(bodies.answers(0), falls);
    if (falls) EXPECT_NEAR(bodies.time(), contact, 2 * dt);
  }
}

TEST(Release, keeps_the_spin_of_a_body_with_three_moments) {
  auto spec = skew_body();
  const auto on_path = carried<3>((Twist<3>() << 0, 0, 0, 1, 0.5, -0.3).finished(), {.time = 0.1});
  spec.motion = on_path.motion, spec.release = on_path.release, spec.path = on_path.path;
  auto bodies = alone<3>(spec);
  run_until(bodies, 0.1, 0.01);
  const Eigen::Matrix3d turned = bodies.state(0).pose.linear();
  const Eigen::Vector3d momentum = turned * spec.inertia * turned.transpose() * Eigen::Vector3d(1, 0.5, -0.3);
  run_until(bodies, 2.1, 0.01);
  const Eigen::Matrix3d at_end = bodies.state(0).pose.linear();
  const Eigen::Vector3d after = at_end * spec.inertia * at_end.transpose() * bodies.state(0).velocity.tail<3>();
  EXPECT_LT((after - momentum).norm(), 1e-2 * momentum.norm());
}

TEST(Release, is_part_of_the_state) {
  const auto spec = carried<2>({3, 1, 0.2}, {.time = 0.055});
  for (const double saved_at : {0.03, 0.08}) {
    auto whole = alone<2>(spec, pull<2>({0, -g})), resumed = alone<2>(spec, pull<2>({0, -g}));
    run_until(whole, saved_at, 0.01);
    std::stringstream state;
    whole.save(state);
    resumed.load(state);
    EXPECT_EQ(resumed.answers(0), saved_at > 0.055);
    run(whole, 5, 0.005, false), run(resumed, 5, 0.005, false);
    EXPECT_EQ(resumed.state(0).velocity, whole.state(0).velocity);
    EXPECT_EQ(resumed.state(0).pose.matrix(), whole.state(0).pose.matrix());
  }
}

TEST(Release, a_carried_body_passes_what_it_would_touch_when_free) {
  BodySpec<2> hull = carried<2>({0, -1, 0}, {.time = 10});
  hull.surface = box(1, 1).surface;
  ContactSpec<2> contacts;
  contacts.planes.push_back({{0, -0.6}, {0, 1}});
  Bodies<2> bodies({hull}, pull<2>({0, -g}), {}, contacts);
  run(bodies, 299);
  bodies.begin(1e-3, 1e-3);
  bodies.solve(std::vector<Wrench<2>>(1, Wrench<2>::Zero()));
  EXPECT_TRUE(bodies.acceptable().ok());
  bodies.commit();
  EXPECT_NEAR(bodies.state(0).pose.translation().y(), -0.3, 1e-9);
}

TEST(Release, belongs_to_prescribed_motion) {
  auto spec = planar_body();
  spec.release = Release{.time = 1};
  EXPECT_THROW(alone<2>(spec), std::invalid_argument);
}

}  // namespace splashdown::rigid::release_test
