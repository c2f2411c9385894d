// Laws of bodies that rub and rebound.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "rigid/message.hpp"
#include "rigid/shapes/shapes.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::friction_test {
namespace {

constexpr double g = 9.81;

template <int d>
ContactSpec<d> floor_with(double friction, double restitution = 0) {
  return {{{Vec<d>::Zero(), Vec<d>::Unit(d - 1)}}, {}, friction, restitution};
}

template <int d>
ContactSpec<d> hulls_with(double friction, double restitution = 0) {
  return {{}, {}, friction, restitution};
}

template <int d>
double kinetic(const Bodies<d>& bodies) {
  double sum = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& spec = bodies.spec(b);
    const auto& [pose, s] = bodies.state(b);
    sum += 0.5 * spec.mass * s.template head<d>().squaredNorm();
    const Rotation<d> w = s.template tail<rotations<d>>();
    if constexpr (d == 2)
      sum += 0.5 * spec.inertia(0, 0) * w[0] * w[0];
    else
      sum += 0.5 * w.dot(pose.linear() * spec.inertia * pose.linear().transpose() * w);
  }
  return sum;
}

// tan(0.3) = 0.309: less friction lets it slide with g (sin - mu cos), more holds it.
TEST(Friction, holds_a_box_on_a_slope_or_slows_it_as_coulomb_says) {
  const double slope = 0.3;
  const Vec<2> down(std::sin(slope), -std::cos(slope));
  for (const double mu : {0.1, 0.25, 0.3, 0.32, 0.8}) {
    Bodies<2> bodies({of_shape<2>(box(0.4, 0.2), {0, 0.1})}, pull<2>(g * down), {}, floor_with<2>(mu));
    run(bodies, 1000);
    const double a = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
    // Of the normal force, friction is found to a thousandth.
    EXPECT_NEAR(bodies.state(0).pose.translation().x(), 0.5 * a, 0.5e-3 * mu * g + 1e-6) << mu;
    EXPECT_NEAR(bodies.state(0).pose.translation().y(), 0.1, 1e-9) << mu;
    EXPECT_NEAR(bodies.state(0).velocity[2], 0, 1e-6) << mu;
  }
}

TEST(Friction, acts_against_the_motion_whatever_its_direction) {
  for (const double heading : {0.0, 0.4, 1.1, 2.9, 4.5}) {
    BodySpec<3> spec = of_shape<3>(box(Vec<3>(0.4, 0.4, 0.1)), {0, 0, 0.05});
    const Vec<3> along(std::cos(heading), std::sin(heading), 0);
    spec.velocity.head<3>() = 2 * along;
    const double mu = 0.3;
    Bodies<3> bodies({spec}, pull<3>({0, 0, -g}), {}, floor_with<3>(mu));
    run(bodies, 400);
    const double t = 0.4;
    EXPECT_NEAR((bodies.state(0).velocity.head<3>() - (2 - mu * g * t) * along).norm(), 0,
                2e-3 * mu * g * t + 0.5e-3 * mu * g)
        << heading;
    run(bodies, 600, 1e-3, false);
    EXPECT_NEAR(bodies.state(0).velocity.norm(), 0, 1e-9) << "it has come to rest";
    EXPECT_NEAR(bodies.state(0).pose.translation().head<2>().norm(), 2 * 2 / (2 * mu * g),
                0.003 * 2 * 2 / (2 * mu * g) + 2e-3);
  }
}

// A ball that slides begins to roll: with I = m r^2 / 2 a disc keeps two thirds of its speed.
TEST(Friction, makes_a_sliding_disc_roll) {
  Shape<2> disc = circle(0.25);
  BodySpec<2> spec = of_shape<2>(disc, {0, 0.25});
  const double lowest = spec.surface.vertices.row(1).minCoeff();
  spec.pose.translation().y() = -lowest;
  spec.velocity << 1, 0, 0;
  const double mu = 0.5, slides = 1 / (3 * mu * g);  // [s] until it rolls
  Bodies<2> bodies({spec}, pull<2>({0, -g}), {}, floor_with<2>(mu));
  run(bodies, static_cast<int>(1.5 * slides / 1e-4), 1e-4);
  const auto& s = bodies.state(0).velocity;
  EXPECT_NEAR(s[0], 2. / 3, 0.02);
  EXPECT_NEAR(s[2] * 0.25, -s[0], 0.03) << "no slip";
}

// A disc that rolls down a slope has 2/3 g sin a, a ball 5/7; one that slips g (sin a - mu cos a) while mu m g cos a r spins it.
// The hull's own moment of inertia is that of its polygon, 2 pi^2/3N^2 = 1e-4 off for a disc.
template <int d>
void rolls_down_a_slope(const Shape<d>& shape, double radius, double slope, double mu, double dt, bool on_a_hull) {
  const Vec<d> up = Vec<d>::Unit(d - 1), along = Vec<d>::Unit(0);
  std::vector<BodySpec<d>> all{of_shape<d>(shape, radius * up)};
  all[0].pose.translation() = -all[0].surface.vertices.row(d - 1).minCoeff() * up;
  ContactSpec<d> contacts = hulls_with<d>(mu);
  if (on_a_hull) {
    Vec<d> size = Vec<d>::Constant(20);
    if constexpr (d == 2)
      all.push_back(of_shape<2>(box(size.x(), size.y()), -10 * up));
    else
      all.push_back(of_shape<3>(box(size), Vec<3>(0.3, 0.2, -10)));
    all[1].free.fill(false);
  } else {
    contacts = floor_with<d>(mu);
  }
  const double inertia = all[0].inertia(0, 0) / (all[0].mass * radius * radius);
  Bodies<d> bodies(all, pull<d>(g * (std::sin(slope) * along - std::cos(slope) * up)), {}, contacts);
  const int steps = static_cast<int>(std::lround(1 / dt));
  run(bodies, steps, dt);
  const double sticking = std::sin(slope) * inertia / (1 + inertia);  // friction that rolling takes, over m g
  const double friction = std::min(sticking, mu * std::cos(slope));
  const double a = g * (std::sin(slope) - friction), t = dt * steps;
  const auto& state = bodies.state(0);
  const double spin = state.velocity.template tail<rotations<d>>().norm();
  const std::string what = message(d, "D, slope ", slope, ", mu ", mu, ", dt ", dt, on_a_hull ? ", on a hull" : "");
  EXPECT_NEAR(state.pose.translation()[0], 0.5 * a * t * t, 1e-3 * a) << what;
  EXPECT_NEAR(state.velocity[0], a * (t - dt / 2), 1e-3 * a) << what;  // velocities are those of the middle of steps
  EXPECT_NEAR(spin * radius, friction / inertia * g * (t - dt / 2), 1e-3 * a) << what;
  EXPECT_NEAR(state.pose.translation()[d - 1], radius, 1e-9) << what;
}

TEST(Rolling, down_a_slope_goes_as_galileo_says_with_any_step) {
  const double radius = 0.1;
  for (const bool on_a_hull : {false, true})
    for (const double dt : {1e-2, 1e-3})
      for (const auto& [slope, mu] : {std::pair(0.05, 0.03), {0.2, 0.5}, {0.2, 0.03}}) {
        rolls_down_a_slope<2>(circle(radius), radius, slope, mu, dt, on_a_hull);
        if (dt == 1e-2) rolls_down_a_slope<3>(sphere(radius), radius, slope, mu, dt, on_a_hull);
      }
}

// A polygon of 256 sides would lose an eighth on this way of 8 rad; what is left is the step's (w dt)^2.
TEST(Rolling, of_an_ellipse_keeps_its_energy) {
  BodySpec<2> spec = of_shape<2>(ellipse(0.25, 0.2), {0, 0.2});
  spec.velocity << 1, 0, -5;  // rolls on its short axis
  Bodies<2> bodies({spec}, pull<2>({0, -g}), {}, floor_with<2>(0.8));
  const auto energy = [&] { return kinetic<2>(bodies) + spec.mass * g * bodies.state(0).pose.translation().y(); };
  run(bodies, 1);
  const double before = energy();
  run(bodies, 2000, 1e-3, false);
  EXPECT_NEAR(energy(), before, 1e-3 * before);
  EXPECT_GT(bodies.state(0).pose.translation().x(), 1.5);
}

TEST(Friction, between_bodies_keeps_both_momenta_and_gives_no_energy) {
  for (int k = 0; k < 30; ++k) {
    std::mt19937 random(static_cast<unsigned>(k));
    std::uniform_real_distribution<double> u(-1, 1);
    BodySpec<2> a = of_shape<2>(box(0.3, 0.2), {0, 0}), b = of_shape<2>(box(0.25, 0.3), {0.45, 0.1 * u(random)}, 0.5);
    a.pose.rotate(u(random)), b.pose.rotate(u(random));
    a.velocity << 1, u(random), 3 * u(random);
    b.velocity << -1, u(random), 3 * u(random);
    Bodies<2> bodies({a, b}, {}, {}, hulls_with<2>(0.5));
    double energy = kinetic<2>(bodies);
    for (int i = 0; i < 400; ++i) {
      const auto before = std::vector(bodies.states().begin(), bodies.states().end());
      run(bodies, 1);
      Eigen::Vector3d given = Eigen::Vector3d::Zero();  // impulses and their moments, at x_n
      for (std::size_t b : {0u, 1u}) {
        const Twist<2> change = bodies.state(b).velocity - before[b].velocity;
        const Vec<2> x = before[b].pose.translation(), p = bodies.spec(b).mass * change.head<2>();
        given +=
            Eigen::Vector3d(p.x(), p.y(), x.x() * p.y() - x.y() * p.x() + bodies.spec(b).inertia(0, 0) * change[2]);
      }
      ASSERT_NEAR(given.norm(), 0, 1e-12) << "pair " << k << ", step " << i;
      ASSERT_LE(kinetic<2>(bodies), energy * (1 + 1e-9)) << "pair " << k << ", step " << i;
      energy = kinetic<2>(bodies);
    }
  }
}

TEST(Friction, holds_a_stack_on_a_slope) {
  const double slope = 0.15;
  std::vector<BodySpec<2>> stack;
  for (int i = 0; i < 4; ++i) stack.push_back(of_shape<2>(box(1, 0.2), {0, 0.1 + 0.2 * i}, i % 2 == 0 ? 1 : 100));
  Bodies<2> bodies(stack, pull<2>({g * std::sin(slope), -g * std::cos(slope)}), {}, floor_with<2>(0.3));
  run(bodies, 500);
  for (std::size_t i = 0; i < stack.size(); ++i)
    EXPECT_NEAR((bodies.state(i).pose.matrix() - stack[i].pose.matrix()).norm(), 0, 1e-6) << i;
}

/// Boxes of 0.01 to 100 kg, turned at random, one above the other.
Bodies<3> falling_pile(unsigned seed, double friction) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<BodySpec<3>> specs;
  for (int i = 0; i < 4; ++i) {
    const Vec<3> size(0.3 + 0.15 * u(random), 0.3 + 0.15 * u(random), 0.2 + 0.1 * u(random));
    specs.push_back(
        of_shape<3>(box(size), {0.1 * u(random), 0.1 * u(random), 0.4 + 0.6 * i}, std::pow(10, 2 * u(random))));
    specs.back().pose.rotate(Eigen::AngleAxisd(3 * u(random), Vec<3>(u(random), u(random), u(random)).normalized()));
    specs.back().velocity << u(random), u(random), 0, u(random), u(random), u(random);
  }
  return Bodies<3>(specs, pull<3>({0, 0, -g}), {}, floor_with<3>(friction));
}

TEST(Friction, brings_random_piles_in_space_to_rest) {
  for (unsigned seed : {2u, 3u, 4u, 6u}) {
    Bodies<3> bodies = falling_pile(seed, 0.5);
    const auto energy = [&] {
      double sum = kinetic<3>(bodies);
      for (std::size_t b = 0; b < bodies.size(); ++b)
        sum += bodies.spec(b).mass * g * bodies.state(b).pose.translation().z();
      return sum;
    };
    run(bodies, 1);
    const double first = energy();
    double now = first, gained = 0;
    for (int i = 0; i < 2500; ++i) {
      run(bodies, 1, 1e-3, false);
      const double before = std::exchange(now, energy());
      gained += std::max(now - before, 0.0);
    }
    // Overlaps part by moves, which lift: edges that turn in a step by w dt leave the tangent by r (w dt)^2 / 2, 1e-5 m.
    EXPECT_LE(gained, 1e-3 * first) << "pile " << seed;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      EXPECT_LE(bodies.state(b).velocity.norm(), 1e-6) << "pile " << seed << ", box " << b;
  }
}

// v_n = e^n v_0; the impact is taken at the step's beginning, up to v dt above the floor.
TEST(Restitution, returns_a_share_of_the_speed) {
  for (const double e : {0.0, 0.3, 0.8, 1.0}) {
    Bodies<2> bodies({of_shape<2>(box(0.4, 0.2), {0, 0.6})}, pull<2>({0, -g}), {}, floor_with<2>(0, e));
    const double height = 0.5, fall = std::sqrt(2 * height / g), dt = 1e-4;
    double highest = 0;
    run(bodies, static_cast<int>(1.001 * fall / dt), dt);
    for (int i = 0; i < static_cast<int>(2 * e * fall / dt); ++i) {
      run(bodies, 1, dt, false);
      highest = std::max(highest, bodies.state(0).pose.translation().y() - 0.1);
    }
    const double way = std::sqrt(2 * g * height) * dt;  // of a step at the impact
    EXPECT_NEAR(highest, e * e * height, 2 * way + 1e-9) << e;
  }
}

TEST(Restitution, of_two_bodies_keeps_their_momentum) {
  for (const double e : {0.2, 0.7, 1.0}) {
    BodySpec<2> a = of_shape<2>(box(1, 1), {0, 0}), b = of_shape<2>(box(1, 1), {1.5, 0}, 3);
    a.velocity << 4, 0, 0;
    b.velocity << -1, 0, 0;
    Bodies<2> bodies({a, b}, {}, {}, hulls_with<2>(0, e));
    run(bodies, 200);
    const double va = bodies.state(0).velocity[0], vb = bodies.state(1).velocity[0];
    EXPECT_NEAR(vb - va, e * 5, 1e-9);
    EXPECT_NEAR(2 * va + 3 * vb, 5, 1e-9);
  }
}

TEST(Restitution, comes_to_rest_in_the_end) {
  Bodies<2> bodies({of_shape<2>(box(0.4, 0.2), {0, 0.2})}, pull<2>({0, -g}), {}, floor_with<2>(0.4, 0.6));
  run(bodies, 3000);
  EXPECT_NEAR(bodies.state(0).pose.translation().y(), 0.1, 1e-4);
  EXPECT_LE(bodies.state(0).velocity.norm(), g * 1e-3) << "what gravity gives in a step";
}

}  // namespace
}  // namespace splashdown::rigid::friction_test
