// Laws of lines: they only pull, add no energy at any stiffness and step, and give the loads of closed solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "rigid/lines/line.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::lines_test {
namespace {

using std::numbers::pi;

/// To a place of the world, or `other`.
template <int d>
LineSpec<d> straight(double length, double stiffness, const Vec<d>& to, std::optional<std::size_t> other = {}) {
  return {.name = "line", .from = {0, Vec<d>::Zero()}, .to = {other, to}, .length = length, .spring = {stiffness, 0}};
}

/// Bodies with one line, and gravity downwards along the last axis.
template <int d>
struct Tied {
  Line<d>* line;
  Bodies<d> bodies;

  static Tied make(std::vector<BodySpec<d>> specs, const LineSpec<d>& spec, double gravity = 0) {
    check(spec, specs.size());
    std::vector<std::unique_ptr<Force<d>>> forces = pull<d>(-gravity * Vec<d>::Unit(d - 1));
    auto line = std::make_unique<Line<d>>(spec);
    Line<d>* raw = line.get();
    forces.push_back(std::move(line));
    return {raw, Bodies<d>(std::move(specs), std::move(forces))};
  }
  /// Tension of the step, which is done.
  double step(double dt, bool first = false) {
    bodies.begin(first ? dt / 2 : dt, dt);
    bodies.solve(std::vector<Wrench<d>>(bodies.size(), Wrench<d>::Zero()));
    const double tension = bodies.diagnostics().at(0).second;
    bodies.commit();
    return tension;
  }
};

// A mass falls h and stretches its riser: T = m g (1 + sqrt(1 + 2 k h/(m g))).
TEST(Line, of_a_drop_snaps_with_the_load_of_its_energy) {
  const double m = 80, g = 9.81, length = 5, h = 4;
  for (const double EA : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
    const double k = EA / length, exact = m * g * (1 + std::sqrt(1 + 2 * k * h / (m * g)));
    const double dt = 0.02 * std::sqrt(m / k);
    auto tied = Tied<2>::make({lump<2>(m, {0, h - length})}, straight<2>(length, k, {0, 0}), g);
    const double falls = std::sqrt(2 * h / g), half_period = pi * std::sqrt(m / k);
    double most = 0, t = 0;
    for (const double step = falls / 1000; t < 0.97 * falls; t += step) tied.step(step, t == 0);
    for (; t < falls + half_period; t += dt) most = std::max(most, tied.step(dt));
    EXPECT_NEAR(most / exact, 1, 5e-3) << EA << " N";
  }
}

// Two lines of one stiffness, both taut: w^2 = 2 k/m along them; across, the tension T makes w^2 = 2 T/(m l).
TEST(Line, taut_on_both_sides_has_the_periods_of_its_stiffness_and_tension) {
  const double m = 50, length = 4, stretched = 4.02;
  for (const double EA : {1e3, 1e5, 1e8}) {
    const double k = EA / length, tension = k * (stretched - length);
    for (const int axis : {0, 1}) {
      const double w = axis == 0 ? std::sqrt(2 * k / m) : std::sqrt(2 * tension / (m * stretched)), dt = 0.05 / w;
      BodySpec<2> body = lump<2>(m, {0, 0});
      body.velocity[axis] = 1e-4 * stretched * w;
      body.free[2] = false;
      std::vector<std::unique_ptr<Force<2>>> forces;
      for (const double side : {-1.0, 1.0})
        forces.push_back(std::make_unique<Line<2>>(straight<2>(length, k, {side * stretched, 0})));
      Bodies<2> bodies({body}, std::move(forces));
      double before = 0, first = 0, last = 0;
      int crossings = 0;
      for (int i = 0; i < 2000; ++i) {
        run(bodies, 1, dt, i == 0);
        const double now = bodies.state(0).pose.translation()[axis];
        if (i > 0 && before < 0 && now >= 0) {
          const double crossed = bodies.time() - dt * now / (now - before);
          (crossings++ == 0 ? first : last) = crossed;
        }
        before = now;
      }
      EXPECT_NEAR((last - first) / (crossings - 1) * w / (2 * pi), 1, 5e-3) << EA << " N, axis " << axis;
    }
  }
}

// Let go level, a pendulum's thread carries 3 m g at the lowest point.
TEST(Line, of_a_pendulum_carries_three_weights) {
  const double m = 2, g = 9.81, length = 1.5;
  for (const double EA : {1e5, 1e8}) {
    BodySpec<2> body = lump<2>(m, {length, 0});
    body.free[2] = false;
    auto tied = Tied<2>::make({body}, straight<2>(length, EA / length, {0, 0}), g);
    double lowest = 0, at_lowest = 0;
    for (int i = 0; i < 1500; ++i) {
      const double tension = tied.step(1e-3, i == 0), y = tied.bodies.state(0).pose.translation().y();
      if (y < lowest) lowest = y, at_lowest = tension;
    }
    EXPECT_NEAR(at_lowest / (3 * m * g), 1, 5e-3) << EA;
    EXPECT_NEAR(lowest / -length, 1, 1e-3) << EA;
  }
}

TEST(Line, never_pushes_and_is_nothing_while_slack) {
  auto tied = Tied<3>::make({lump<3>(1, {0.3, 0, 0}), lump<3>(2, {0, 0, 0})}, straight<3>(1, 1e6, {0, 0, 0}, 1), 9.81);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(tied.step(1e-3, i == 0), 0) << "they fall together";
  EXPECT_NEAR(tied.bodies.state(0).velocity[2], -9.81 * 0.1995, 1e-9);
}

/// Random pairs or bodies on a place of the world, starting slack, without forces besides: kinetic energy and momenta.
template <int d>
void adds_no_energy(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  const auto decades = [&](double a, double b) { return std::pow(10, between(a, b)); };
  const auto vector = [&](double size) { return Vec<d>(size * Vec<d>::NullaryExpr([&] { return between(-1, 1); })); };
  std::vector<BodySpec<d>> specs;
  for (int i = 0; i < 2; ++i) {
    specs.push_back(lump<d>(decades(-2, 3), vector(1)));
    specs.back().velocity = Twist<d>::NullaryExpr([&] { return between(-5, 5); });
  }
  const bool world = between(0, 1) < 0.5;
  LineSpec<d> spec = straight<d>(1, decades(3, 8), vector(0.3), world ? std::nullopt : std::optional<std::size_t>(1));
  spec.from.point = vector(0.4);
  spec.spring.damping = between(0, 1) < 0.5 ? 0 : decades(0, 5);
  const Vec<d> end = world ? spec.to.point : Vec<d>(specs[1].pose * spec.to.point);
  spec.length = (specs[0].pose * spec.from.point - end).norm() * between(1.0, 1.3);
  const double dt = decades(-4, -1.5);
  auto tied = Tied<d>::make(specs, spec);
  const auto energy = [&](std::size_t i) {
    const auto& s = tied.bodies.state(i).velocity;
    return 0.5 * specs[i].mass *
           (s.template head<d>().squaredNorm() + 0.1 * s.template tail<rotations<d>>().squaredNorm());
  };
  const double start = energy(0) + energy(1);
  Vec<d> momentum = Vec<d>::Zero();
  for (const auto& s : specs) momentum += s.mass * s.velocity.template head<d>();
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(std::isfinite(tied.step(dt, i == 0)));
    ASSERT_LE(energy(0) + energy(1), start * (1 + 1e-12))
        << "step " << i << " of " << dt << " s, " << spec.spring.stiffness << " N/m, " << spec.spring.damping
        << " N s/m";
  }
  Vec<d> now = Vec<d>::Zero();
  for (std::size_t i : {0u, 1u}) now += specs[i].mass * tied.bodies.state(i).velocity.template head<d>();
  if (!world) {
    EXPECT_NEAR((now - momentum).norm(), 0, 1e-8 * (specs[0].mass + specs[1].mass));
  }
}

TEST(Line, adds_no_energy_at_any_stiffness_and_step) {
  std::mt19937 random(3);
  for (int i = 0; i < 30; ++i) {
    adds_no_energy<2>(random);
    adds_no_energy<3>(random);
  }
}

// ---- catenaries

const CatenarySpec chain{.length = 60, .axial_stiffness = 2e6, .weight = 150, .friction = 0};

LineSpec<2> moored(const CatenarySpec& catenary, const Vec<2>& anchor) {
  return {.name = "mooring", .from = {0, Vec<2>::Zero()}, .to = {{}, anchor}, .catenary = catenary};
}

// Small oscillations of a held freedom about balance: w^2 = (slope of the force)/m.
TEST(Mooring, swings_with_the_slope_of_its_catenary) {
  for (const double EA : {1e5, 1e6, 1e8})
    for (const double x : {50.0, 53.5}) {
      CatenarySpec catenary = chain;
      catenary.axial_stiffness = EA;
      const auto end = catenary_end(catenary, {x, 20});
      const double m = 400, w = std::sqrt(end.stiffness(0, 0) / m), dt = 0.04 / w;
      BodySpec<2> body = lump<2>(m, {0, 20});
      body.free = {true, false, false};
      body.velocity[0] = 1e-5 * w;
      auto tied = Tied<2>::make({body}, moored(catenary, {-x, 0}));
      double before = 0, first = 0, last = 0;
      int crossings = 0;
      for (int i = 0; i < 1600; ++i) {
        tied.bodies.begin(i == 0 ? dt / 2 : dt, dt);
        tied.bodies.solve(std::vector{Wrench<2>(end.force.x(), 0, 0)});
        tied.bodies.commit();
        const double now = tied.bodies.state(0).pose.translation().x();
        if (i > 0 && before < 0 && now >= 0) {
          const double crossed = tied.bodies.time() - dt * now / (now - before);
          (crossings++ == 0 ? first : last) = crossed;
        }
        before = now;
      }
      ASSERT_GT(crossings, 3);
      EXPECT_NEAR((last - first) / (crossings - 1) * w / (2 * pi), 1, 5e-3) << EA << " N at " << x << " m";
    }
}

TEST(Mooring, tells_tension_and_touchdown_of_its_catenary) {
  BodySpec<2> body = lump<2>(400, {0, 20});
  body.free = {false, false, false};
  auto tied = Tied<2>::make({body}, moored(chain, {-50, 0}));
  tied.step(1e-3, true);
  tied.bodies.begin(1e-3, 1e-3);
  tied.bodies.solve(std::vector{Wrench<2>(Wrench<2>::Zero())});
  const auto end = catenary_end(chain, {50, 20});
  const auto told = tied.bodies.diagnostics();
  ASSERT_EQ(told.size(), 4);
  EXPECT_EQ(told[0].first, "mooring_tension");
  EXPECT_NEAR(told[0].second / end.force.norm(), 1, 1e-9);
  EXPECT_NEAR(told[2].second, end.on_floor, 1e-9);
  EXPECT_NEAR(told[3].second, end.anchor_tension, 1e-9 * end.anchor_tension);
}

/// int of the force over the way, midpoint rule.
double stored(const CatenarySpec& line, const Vec<2>& from, const Vec<2>& to) {
  const int steps = 400;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const Vec<2> at = from + (i + 0.5) / steps * (to - from);
    const auto end = catenary_end(line, {std::abs(at.x()), at.y()});
    sum += Vec<2>((at.x() < 0 ? -1 : 1) * end.force.x(), end.force.y()).dot(to - from) / steps;
  }
  return sum;
}

// A drifting body stretches a slack chain and comes back, again and again; steps up to a hundred times those of the taut chain.
TEST(Mooring, adds_no_energy_at_any_stiffness_and_step) {
  std::mt19937 random(5);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int member = 0; member < 40; ++member) {
    CatenarySpec line = chain;
    line.axial_stiffness = std::pow(10, between(3, 8));
    line.weight = std::pow(10, between(0, 3));
    line.floor = between(0, 1) < 0.7;
    const double m = std::pow(10, between(0, 4)), dt = std::pow(10, between(-3, -0.7)), speed = between(0.5, 4);
    BodySpec<2> body = lump<2>(m, {0, 20});
    body.free = {true, false, false};
    body.velocity[0] = speed;
    auto tied = Tied<2>::make({body}, moored(line, {-50, 0}));
    const double start = 0.5 * m * speed * speed, at_start = stored(line, {0, 20}, {50, 20});
    double most = 0;
    for (int i = 0; i < 500; ++i) {
      tied.step(dt, i == 0);
      const double v = tied.bodies.state(0).velocity[0];
      ASSERT_TRUE(std::isfinite(v));
      most = std::max(most, 0.5 * m * v * v);
    }
    // What the chain stores at the start may come out as well.
    EXPECT_LE(most, (start + at_start) * 1.01) << member << ": EA " << line.axial_stiffness << " N, " << dt << " s";
  }
}

// ---- canopies

LineSpec<2> riser(double drag_area, double mass, double stiffness, const Vec<2>& to) {
  LineSpec<2> spec = straight<2>(4, stiffness, to);
  spec.name = "riser";
  spec.canopy = Canopy<2>{.mass = mass, .drag_area = drag_area, .gravity = {0, -9.81}};
  return spec;
}

TEST(Parachute, lets_down_with_its_terminal_speed) {
  const double m = 90, m_c = 5, area = 12;
  const double terminal = std::sqrt(2 * (m + m_c) * 9.81 / (1.225 * area));
  for (const double EA : {1e3, 1e5, 1e8})
    for (const double dt : {1e-3, 1e-2, 0.1}) {
      auto tied = Tied<2>::make({lump<2>(m, {0, 0})}, riser(area, m_c, EA / 4, {0, 4.0}), 9.81);
      double tension = 0;
      for (int i = 0; i * dt < 30; ++i) tension = tied.step(dt, i == 0);
      EXPECT_NEAR(tied.bodies.state(0).velocity[1] / -terminal, 1, 1e-6) << EA << " N, " << dt << " s";
      EXPECT_NEAR(tension / (m * 9.81), 1, 1e-5);
    }
}

// A load falls away from an open canopy at rest: two masses, a spring that only pulls and drag, solved by Runge and Kutta.
TEST(Parachute, snaps_like_two_masses_and_a_spring) {
  const double m = 90, m_c = 5, area = 12, length = 4, g = 9.81;
  for (const double EA : {1e4, 1e6}) {
    const double k = EA / length;
    using State = Eigen::Vector4d;  // y, y_c, v, v_c
    const auto tension = [&](const State& s) { return std::max(0.0, k * (s[1] - s[0] - length)); };
    const auto rate = [&](const State& s) {
      const double T = tension(s);
      return State(s[2], s[3], T / m - g, -T / m_c - g - 0.5 * 1.225 * area / m_c * std::abs(s[3]) * s[3]);
    };
    State s(0, 1, 0, 0);
    double exact = 0;
    const double fine = 2e-6, end = 1.2;
    for (double t = 0; t < end; t += fine) {
      const State a = rate(s), b = rate(s + fine / 2 * a), c = rate(s + fine / 2 * b), e = rate(s + fine * c);
      s += fine / 6 * (a + 2 * b + 2 * c + e);
      exact = std::max(exact, tension(s));
    }
    auto tied = Tied<2>::make({lump<2>(m, {0, 0})}, riser(area, m_c, k, {0, 1}), g);
    const double dt = 0.02 * std::sqrt(m_c / k);
    double most = 0;
    for (int i = 0; i * dt < end; ++i) most = std::max(most, tied.step(dt, i == 0));
    EXPECT_NEAR(most / exact, 1, 5e-3) << EA;
    EXPECT_NEAR(tied.bodies.state(0).pose.translation().y(), s[0], 5e-3 * std::abs(s[0])) << EA;
  }
}

TEST(Parachute, opens_as_the_square_of_time) {
  LineSpec<2> spec = riser(12, 5, 1e5, {0, 4});
  spec.canopy->start = 0.1;
  spec.canopy->inflation = 0.4;
  auto tied = Tied<2>::make({lump<2>(90, {0, 0})}, spec, 9.81);
  for (int i = 0; i < 30; ++i) tied.step(0.01, i == 0);
  const auto told = tied.bodies.diagnostics();
  EXPECT_EQ(told.back().first, "riser_drag_area");
  EXPECT_NEAR(told.back().second, 12 * 0.25, 1e-9);
}

TEST(Parachute, stays_lying_on_the_water) {
  LineSpec<2> spec = riser(12, 5, 1e5, {0, 4});
  spec.canopy->water_level = 1;
  BodySpec<2> body = lump<2>(90, {0, 0});
  body.motion = BodyMotion::fixed;
  auto tied = Tied<2>::make({body}, spec);
  for (int i = 0; i < 500; ++i) tied.step(0.01, i == 0);
  EXPECT_EQ(tied.line->canopy_place().y(), 1);
  EXPECT_EQ(tied.line->canopy_velocity().norm(), 0);
}

// ---- release, state, what cannot be

TEST(Line, lets_go_at_a_time_at_a_load_and_when_a_body_gets_wet) {
  const double m = 10, k = 1e4;
  for (const int cause : {0, 1, 2}) {
    LineSpec<2> spec = straight<2>(1, k, {0, 0});
    if (cause == 0) spec.release.time = 0.5;
    if (cause == 1) spec.release.load = 1.5 * m * 9.81;
    if (cause == 2) spec.release.wets = 0;
    auto tied = Tied<2>::make({of_shape<2>(box(0.5, 0.5), {0, -1}, m)}, spec, 9.81);
    double pulled = 0, time = -1;
    for (int i = 0; i < 1000; ++i) {
      if (cause == 2 && i == 300) tied.bodies.see_wetted(std::vector{0.2});
      pulled = tied.step(1e-3, i == 0);
      if (tied.line->released() && time < 0) time = tied.bodies.time();
    }
    EXPECT_EQ(pulled, 0);
    // T = m g (1 - cos w t) is 1.5 m g first at w t = 2 pi/3.
    const double exact[] = {0.5, 2 * pi / 3 / std::sqrt(k / m), 0.301};
    EXPECT_NEAR(time, exact[cause], 2e-3) << cause;
  }
}

TEST(Line, goes_on_bit_for_bit_after_a_resume) {
  LineSpec<2> spec = riser(12, 5, 1e4, {0, 2});
  spec.release.load = 1e7;
  const auto make = [&] { return Tied<2>::make({lump<2>(90, {0, 0})}, spec, 9.81); };
  auto tied = make(), again = make();
  for (int i = 0; i < 300; ++i) tied.step(2e-3, i == 0);
  std::stringstream stored_state;
  tied.bodies.save(stored_state);
  again.bodies.load(stored_state);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(tied.step(2e-3), again.step(2e-3));
  EXPECT_TRUE(identical<2>(tied.bodies.state(0), again.bodies.state(0)));
  std::stringstream damaged(stored_state.str().substr(0, stored_state.str().size() - 8));
  EXPECT_THROW(make().bodies.load(damaged), std::runtime_error);
}

TEST(Line, that_cannot_be_is_refused) {
  const auto why = [](LineSpec<2> spec) { return failure([&] { check(spec, 2); }); };
  EXPECT_TRUE(says(why(straight<2>(0, 1, {0, 0})), "length must be positive"));
  EXPECT_TRUE(says(why(straight<2>(1, 0, {0, 0})), "stiffness must be positive"));
  EXPECT_TRUE(says(why(straight<2>(1, 1, {0, 0}, 0)), "to itself"));
  EXPECT_TRUE(says(why(straight<2>(1, 1, {0, 0}, 2)), "ties body 2"));
  LineSpec<2> canopy = riser(1, 0, 1, {0, 0});
  EXPECT_TRUE(says(why(canopy), "mass of its canopy"));
  LineSpec<2> anchored = moored(chain, {0, 0});
  anchored.to.body = 1;
  EXPECT_TRUE(says(why(anchored), "ends at an anchor"));
}

}  // namespace
}  // namespace splashdown::rigid::lines_test
