// Laws of catenaries: closed solutions, the line's own equations integrated, seeded random members.
#include "rigid/lines/catenary.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace splashdown::rigid::catenary_test {
namespace {

constexpr double inextensible = 1e19;

/// The end that the line's own equations lead to from its anchor: dx/ds = (H/T)(1 + T/EA), dz/ds = (V/T)(1 + T/EA), dV/ds = w,
/// on the floor dx/ds = 1 + T/EA, dT/ds = mu w. Midpoint rule, second order.
Eigen::Vector2d integrated(const CatenarySpec& line, const CatenaryEnd& end) {
  const int steps = 200000;
  const double w = line.weight, ds = line.length / steps, H = end.force.x();
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) * ds;
    if (s < end.on_floor) {
      const double T = std::max(H - line.friction * w * (end.on_floor - s), 0.0);
      at.x() += ds * (1 + T / line.axial_stiffness);
      continue;
    }
    const double V = end.force.y() - w * (line.length - s), T = std::hypot(H, V);
    at += ds * (1 / T + 1 / line.axial_stiffness) * Eigen::Vector2d(H, V);
  }
  return at;
}

// Irvine (1981), section 2.2: w x/(2 H) = asinh(w L/(2 H)) between supports of one height.
TEST(Catenary, without_stretch_between_two_supports_is_that_of_leibniz) {
  for (const double half_span_over_a : {0.01, 0.3, 1.0, 3.0}) {
    const double H = 40, w = 7, a = H / w, x = 2 * a * half_span_over_a, L = 2 * a * std::sinh(half_span_over_a);
    const auto end = catenary_end({.length = L, .axial_stiffness = inextensible, .weight = w, .floor = false}, {x, 0});
    const double tolerance = half_span_over_a < 0.1 ? 1e-6 : 1e-9;  // flat ones: H ~ (L - x)^-1/2
    EXPECT_NEAR(end.force.x() / H, 1, tolerance);
    EXPECT_NEAR(end.force.y() / (w * L / 2), 1, 1e-9);
    EXPECT_NEAR(end.anchor_tension, end.force.norm(), 1e-9 * H / tolerance * 1e-6);
  }
}

// Tension at the top is H + w z, the suspended length sqrt(z^2 + 2 z H/w); what is left lies.
TEST(Catenary, touches_down_where_its_closed_form_says) {
  const double w = 1000, H = 5e5, z = 200, hung = std::sqrt(z * z + 2 * z * H / w), rest = 120;
  const double x = rest + H / w * std::asinh(w * hung / H);
  const auto end = catenary_end({.length = hung + rest, .axial_stiffness = inextensible, .weight = w}, {x, z});
  EXPECT_NEAR(end.force.norm() / (H + w * z), 1, 1e-9);
  EXPECT_NEAR(end.force.x() / H, 1, 1e-9);
  EXPECT_NEAR(end.on_floor, rest, 1e-8 * rest);
  EXPECT_NEAR(end.anchor_tension / H, 1, 1e-9);
}

// Figures of another program: MoorPy (National Renewable Energy Laboratory), tests of its catenary. Its iteration ends at 1e-6.
TEST(Catenary, agrees_with_moorpy) {
  struct Case {
    CatenarySpec line;
    Eigen::Vector2d span, end;
    double anchor, on_floor;
  };
  const Case cases[] = {
      {{500, 7.51e12, 800, true, 5.0}, {400, 200}, {96643.43501616362, 237751.75997440016}, 0, 202.81030003199982},
      {{500, 7.51e12, 800, true, 0.0},
       {400, 200},
       {96643.42815934008, 237751.75535996316},
       96643.42815934008,
       202.81030580004602},
      {{500, 7.51e12, 800, true, 0.1},
       {400, 200},
       {96643.42877136687, 237751.75577183915},
       80418.60434855078,
       202.81030528520108},
      {{500, 7.51e12, 200, false, 0},
       {400, 200},
       {43694.580989249596, 77634.40064978378},
       std::hypot(43694.580989249596, 22365.599350216216),
       0},
      {{130, 7.51e8, 881.05, false, 0},
       {89.9, 59.2},
       {31373.229006023103, 87886.15872988368},
       std::hypot(31373.229006023103, 26650.341270116318),
       0}};
  for (const auto& [line, span, force, anchor, on_floor] : cases) {
    const auto end = catenary_end(line, span);
    EXPECT_NEAR((end.force - force).norm() / force.norm(), 0, 1e-6);
    EXPECT_NEAR(end.anchor_tension, anchor, 1e-6 * force.norm());
    EXPECT_NEAR(end.on_floor, on_floor, 1e-6 * line.length);
  }
}

TEST(Catenary, hangs_straight_down_onto_its_floor) {
  const CatenarySpec line{.length = 50, .axial_stiffness = 1e4, .weight = 100};
  const auto end = catenary_end(line, {10, 30});
  const double hangs = line.length - end.on_floor;
  EXPECT_EQ(end.force.x(), 0);
  EXPECT_NEAR(end.force.y(), line.weight * hangs, 1e-9);
  EXPECT_NEAR(hangs + line.weight * hangs * hangs / (2 * line.axial_stiffness), 30, 1e-9);
  EXPECT_EQ(catenary_end(line, {40, -1}).force.norm(), 0) << "all of it lies";
}

TEST(Catenary, without_weight_is_a_spring) {
  for (const double EA : {1e3, 1e5, 1e8}) {
    const auto end = catenary_end({.length = 10, .axial_stiffness = EA, .weight = 1e-6, .floor = false}, {6, 8.4});
    const double chord = std::hypot(6, 8.4);
    EXPECT_NEAR(end.force.norm() / (EA * (chord / 10 - 1)), 1, 1e-6);
    EXPECT_NEAR(end.force.x() / end.force.norm(), 6 / chord, 1e-6);
  }
}

TEST(Catenary, stretched_out_on_its_floor_pulls_through_friction) {
  const CatenarySpec line{.length = 100, .axial_stiffness = 1e5, .weight = 50, .friction = 0.5};
  const double friction = 0.5 * 50 * 100;
  // T(s) = H - mu w (L - s): the stretch is (H - mu w L/2) L/EA while all of it slips.
  const auto end = catenary_end(line, {108, 0});
  EXPECT_NEAR(end.force.x(), 0.08 * 1e5 + friction / 2, 1e-6);
  EXPECT_NEAR(end.anchor_tension, 0.08 * 1e5 - friction / 2, 1e-6);
}

/// Members of the class: EA/(wL) from 1 to 1e8, slack and taut, with a floor and without, friction or none.
struct Member {
  CatenarySpec line;
  Eigen::Vector2d span;
};
Member drawn(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  Member m;
  m.line.length = std::pow(10, between(-1, 3));
  m.line.weight = std::pow(10, between(-1, 4));
  m.line.axial_stiffness = m.line.weight * m.line.length * std::pow(10, between(0.5, 7));
  m.line.floor = between(0, 1) < 0.6;
  m.line.friction = m.line.floor && between(0, 1) < 0.5 ? between(0, 1) : 0;
  const double angle = between(m.line.floor ? 0.02 : -1.5, 1.5), chord = m.line.length * between(0.5, 1.05);
  m.span = chord * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  return m;
}

TEST(Catenary, of_random_members_obeys_its_own_equations) {
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    const auto [line, span] = drawn(random);
    const auto end = catenary_end(line, span);
    ASSERT_TRUE(end.force.allFinite() && end.stiffness.allFinite()) << i;
    if (end.force.x() == 0) continue;                       // the heap is no curve
    if (end.force.x() < 1e-6 * end.force.norm()) continue;  // hangs back on itself: steps are too long for the bend
    EXPECT_NEAR((integrated(line, end) - span).norm() / line.length, 0, 1e-6)
        << "member " << i << ": EA " << line.axial_stiffness << " w " << line.weight << " L " << line.length
        << " floor " << line.floor << " mu " << line.friction << " at " << span.transpose() << ", H, V "
        << end.force.transpose();
  }
}

TEST(Catenary, stiffness_is_the_slope_of_its_force) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const auto [line, span] = drawn(random);
    const auto end = catenary_end(line, span);
    if (end.force.x() < 1e-3 * end.force.norm()) continue;
    const double step =
        1e-5 * line.length * std::min(1.0, end.force.norm() / (end.stiffness.norm() * line.length) + 1e-3);
    Eigen::Matrix2d slope;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d by = step * Eigen::Vector2d::Unit(k);
      slope.col(k) = (catenary_end(line, span + by).force - catenary_end(line, span - by).force) / (2 * step);
    }
    EXPECT_NEAR((slope - end.stiffness).norm() / end.stiffness.norm(), 0, 2e-3) << "member " << i;
    const Eigen::Matrix2d symmetric = 0.5 * (end.stiffness + end.stiffness.transpose());
    EXPECT_GE(symmetric.trace(), 0) << i;
    if (line.friction == 0) {
      EXPECT_GE(end.stiffness.determinant(), -1e-9 * end.stiffness.squaredNorm()) << i;
    }
  }
}

TEST(Catenary, pulls_more_the_farther_its_end_goes) {
  const CatenarySpec line{.length = 100, .axial_stiffness = 1e8, .weight = 200, .friction = 0.3};
  double before = -1;
  for (double x = 60; x < 96; x += 0.25) {
    const auto end = catenary_end(line, {x, 30});
    EXPECT_GE(end.force.x(), before) << x;
    EXPECT_LE(end.anchor_tension, end.force.norm() + 1e-9);
    before = end.force.x();
  }
}

TEST(Catenary, that_cannot_be_is_refused) {
  EXPECT_THROW(check(CatenarySpec{.length = 0, .axial_stiffness = 1, .weight = 1}), std::invalid_argument);
  EXPECT_THROW(check(CatenarySpec{.length = 1, .axial_stiffness = 0, .weight = 1}), std::invalid_argument);
  EXPECT_THROW(check(CatenarySpec{.length = 1, .axial_stiffness = 1, .weight = 0}), std::invalid_argument);
  EXPECT_THROW(check(CatenarySpec{.length = 1, .axial_stiffness = 1, .weight = 1, .friction = -1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::rigid::catenary_test
