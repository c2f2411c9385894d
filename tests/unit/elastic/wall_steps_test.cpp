// Walls that deform, in flight and under given forces: rigid limits, momenta, and vibrations that steps do not resolve.
#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry.hpp"
#include "elastic/modes/modes.hpp"
#include "rigid/bodies.hpp"
#include "walls.hpp"

namespace splashdown::elastic::wall_steps_test {
namespace {

/// Forces on the vertices in the world frame, from rest: places of the centre and turns at the end.
struct Pushed {
  Vec<2> centre;
  double angle, farthest;
};
const auto push = [](const Vec<2>& X) { return Vec<2>(0.004 + 0.002 * X.y(), 0.003 * (X.x() - 1)); };

Pushed pushed(const Made<2>& made, int steps, double end) {
  const auto body = made.part();
  const auto& rest = body->surface(0).vertices;
  Vector force(rest.size());
  for (Eigen::Index k = 0; k < rest.cols(); ++k) force.segment<2>(2 * k) = push(rest.col(k));
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    const double kick = k == 0 ? dt / 2 : dt;
    body->begin({.kick = kick, .dt = dt});
    body->solve(kick * force);
    EXPECT_TRUE(body->acceptable().ok()) << body->acceptable().cause;
    body->commit();
  }
  const auto& pose = body->state(0).pose;
  return {pose.translation(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)),
          body->motion(0).u.cwiseAbs().maxCoeff()};
}

/// The same of a rigid body.
Pushed pushed_rigid(const Made<2>& made, int steps, double end) {
  const auto part = made.part();
  const auto rest = part->surface(0).vertices;
  rigid::BodySpec<2> spec;
  const Vec<2> centre(2, 0.5);
  spec.surface = part->surface(0);
  spec.surface.vertices.colwise() -= centre;
  spec.mass = 4;
  spec.inertia << 4 * (16. + 1) / 12;
  spec.free.fill(true);
  spec.pose.translation() = centre;
  rigid::Bodies<2> body({spec}, {});
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    Wrench<2> load = Wrench<2>::Zero();
    for (Eigen::Index v = 0; v < rest.cols(); ++v)
      load += wrench_of<2>(body.state(0).pose.linear() * spec.surface.vertices.col(v), push(rest.col(v)));
    body.begin(k == 0 ? dt / 2 : dt, dt);
    body.solve(std::array{load});
    body.commit();
  }
  const auto& pose = body.state(0).pose;
  return {pose.translation(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)), 0};
}

double apart(const Pushed& one, const Pushed& other) {
  return (one.centre - other.centre).norm() + std::abs(one.angle - other.angle);
}

TEST(ElasticWall, with_rigid_modes_alone_is_the_rigid_body) {
  const Made<2> made{.modes = 3};
  constexpr double end = 10;
  const double coarse = apart(pushed(made, 20, end), pushed_rigid(made, 20, end)),
               fine = apart(pushed(made, 80, end), pushed_rigid(made, 80, end));
  EXPECT_GT(std::abs(pushed(made, 80, end).angle), 0.3) << "it turns";
  EXPECT_LT(fine, 1e-3);
  // Both are of second order: turns by the chord and by the arc.
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.3) << coarse << ' ' << fine;
}

TEST(ElasticWall, is_rigid_in_the_limit_of_stiffness) {
  constexpr double end = 4;
  constexpr int steps = 400;
  const auto limit = pushed({.modes = 3}, steps, end);
  double last = 0;
  for (const double young_modulus : {10., 100., 1000.}) {
    const double away = apart(pushed({.young_modulus = young_modulus}, steps, end), limit) * young_modulus;
    EXPECT_LT(away, last > 0 ? 3 * last : 1e9) << "as 1/E, with vibrations in any phase";
    EXPECT_GT(away, 0);
    last = away;
  }
  EXPECT_LT(last / 1000, 1e-4 * limit.farthest);
}

template <int d>
void keeps_its_momenta(const Made<d>& made, double revolution, int revolutions) {
  constexpr int steps = 100;  // a turn
  double energy_before = 0;
  const auto body = made.part();
  const auto before = body->momenta(0);
  energy_before = body->energy(0);
  const double dt = revolution / steps;
  const Vector none = Vector::Zero(body->scales().size());
  for (int k = 0; k < steps * revolutions; ++k) {
    body->begin({.kick = k == 0 ? dt / 2 : dt, .dt = dt});
    body->solve(none);
    ASSERT_TRUE(body->acceptable().ok()) << k << ": " << body->acceptable().cause;
    body->commit();
  }
  const auto after = body->momenta(0);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-9 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-8 * before.angular.norm()) << made.modes;
  // Exact with all nodes; in modes the frame's rotation is that of a variational integrator, whose energy swings. Vibrations begin
  // because the body is not stretched by its spin yet: rho v^2/E of the energy at most is theirs, and may be damped.
  const double vibrations =
      made.unresolved > 0 ? std::pow(2 * made.velocity.template tail<rotations<d>>().norm(), 2) : 0;
  const double kept = body->energy(0) / energy_before;
  EXPECT_LT(kept, 1 + (made.modes == all_nodes ? 1e-6 : 0.01));
  EXPECT_GT(kept, 1 - (made.modes == all_nodes ? 1e-6 : 0.01) - vibrations);
}

TEST(ElasticWall, in_free_flight_keeps_its_momenta_over_many_turns) {
  constexpr double spin = 0.04;
  for (const double unresolved : {0., 0.1})
    for (const int modes : {all_nodes, 8}) {
      Made<2> made{.modes = modes, .unresolved = unresolved};
      made.velocity << 0.1, 0.05, spin;
      keeps_its_momenta(made, 2 * std::numbers::pi / spin, 20);
      Made<3> in_space{.modes = modes == all_nodes ? all_nodes : 10, .unresolved = unresolved};
      in_space.velocity << 0.1, 0.05, -0.02, spin, 0.4 * spin, -0.3 * spin;
      keeps_its_momenta(in_space, 2 * std::numbers::pi / spin, 5);
    }
}

/// A clamped linear body in free vibration after a blow along its lowest mode, steps of x over its angular frequency: what strain
/// and motion of that mode have after each step.
std::vector<double> energies_after_a_blow(Made<2> made, double unresolved, const std::function<double(int)>& x,
                                          int steps) {
  made.linear = made.clamped = true;
  made.unresolved = unresolved;
  const auto solid = made.solid();
  const auto mode = lowest_modes(*solid, 1, Field::Zero(solid->size()));
  const double w = mode.angular_frequencies[0];
  const Field in_mode = solid->mass() * mode.shapes.col(0);
  const auto body = made.part();
  Vector push(body->scales().size());
  Eigen::Index at = 0;
  for (const int a : boundary_of<2>(solid->mesh()).nodes)
    push.segment<2>(2 * at++) = mode.shapes.col(0).segment<2>(2 * a);
  std::vector<double> all;
  Field last = Field::Zero(solid->size());
  for (int k = 0; k < steps; ++k) {
    const double dt = x(k) / w;
    body->begin({.kick = dt, .dt = dt});
    body->solve(k == 0 ? push : Vector::Zero(push.size()));
    body->commit();
    const Field& u = body->motion(0).u;
    const double q = in_mode.dot(u + last) / 2, rate = in_mode.dot(u - last) / dt;
    all.push_back(0.5 * (w * w * q * q + rate * rate));
    last = u;
  }
  return all;
}

TEST(ElasticWall, damps_vibrations_that_steps_do_not_resolve) {
  constexpr int steps = 40;
  for (const int modes : {all_nodes, 1}) {
    const auto far = [](int) { return 1000.; };
    const auto without = energies_after_a_blow({.modes = modes}, 0, far, steps),
               with = energies_after_a_blow({.modes = modes}, 0.1, far, steps);
    EXPECT_GT(without.back(), 0.9 * without.front()) << "the midpoint rule turns momenta round";
    // 0.717 is the spectral radius as w dt goes to infinity.
    for (int k = 0; k < steps; ++k)
      EXPECT_LT(with[static_cast<std::size_t>(k)], 10 * std::pow(0.717, 2 * k) * with.front()) << modes << ' ' << k;
  }
}

TEST(ElasticWall, whose_unresolved_vibrations_are_damped_shows_none_to_shorter_steps) {
  const auto shorter = [](int k) { return k < 20 ? 1000. : 100.; };
  for (const int modes : {all_nodes, 1}) {
    const auto without = energies_after_a_blow({.modes = modes}, 0, shorter, 30),
               with = energies_after_a_blow({.modes = modes}, 0.1, shorter, 30);
    EXPECT_GT(without.back(), 50 * without.front()) << "as (dt/dt_new)^2";
    EXPECT_LT(with.back(), 1e-3 * with.front());
  }
}

TEST(ElasticWall, leaves_vibrations_that_steps_resolve_but_for_the_cube_of_the_step) {
  constexpr double c = 0.1;
  for (const int modes : {all_nodes, 1})
    for (const auto& [a_period, periods] : {std::pair(20, 60), {40, 200}}) {
      const double x = 2 * std::numbers::pi / a_period;
      const auto found = energies_after_a_blow(
          {.modes = modes}, c, [&](int) { return x; }, a_period * periods);
      const int from = a_period, steps = a_period * (periods - 1);
      // Of the critical damping it has c x^3/4, and the series goes on with x^2; q and rate are those of a circle to x^2 of a turn.
      const double damping = -std::log(found.back() / found[static_cast<std::size_t>(from) - 1]) / (2 * x * steps);
      const double turn = x * x / (c * x * x * x / 2 * x * steps);
      EXPECT_NEAR(damping / (c * x * x * x / 4), 1, x * x + turn) << modes << ' ' << a_period;
    }
}

}  // namespace
}  // namespace splashdown::elastic::wall_steps_test
