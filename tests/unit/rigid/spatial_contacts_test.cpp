// Laws of bodies that touch in space: edges that cross edges, and a search that grows with what is near.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::spatial_contacts_test {
namespace {

constexpr double g = 9.81;

// A beam along x or y that stands on an edge.
BodySpec<3> beam(int along, double height) {
  const double thick = 0.1;
  Vec<3> size = Vec<3>::Constant(thick);
  size[along] = 1;
  BodySpec<3> spec = of_shape(box(size), {0, 0, height});
  spec.pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 4, Vec<3>::Unit(along)));
  return spec;
}

TEST(SpatialContact, lays_an_edge_across_an_edge) {
  BodySpec<3> below = beam(0, 0), above = beam(1, 0.25);
  below.motion = BodyMotion::fixed;
  above.free = {false, false, true, false, false, false};
  Bodies<3> bodies({below, above}, pull<3>({0, 0, -g}), {}, ContactSpec<3>{});
  run(bodies, 600);
  EXPECT_NEAR(bodies.state(1).pose.translation().z(), 0.1 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(bodies.state(1).velocity.norm(), 0, 1e-9);
}

TEST(SpatialContact, of_edges_is_a_plastic_impact_that_keeps_both_momenta) {
  BodySpec<3> below = beam(0, 0), above = beam(1, 0.2);
  above.pose.translation().x() = 0.2;  // off the middle: both turn
  above.velocity << 0, 0, -1, 0, 0, 0;
  Bodies<3> bodies({below, above}, {}, {}, ContactSpec<3>{});
  const auto momenta = [&] {
    Wrench<3> sum = Wrench<3>::Zero();
    for (std::size_t i : {0u, 1u}) {
      const auto& [pose, s] = bodies.state(i);
      const Vec<3> linear = bodies.spec(i).mass * s.head<3>();
      const Mat<3> inertia = pose.linear() * bodies.spec(i).inertia * pose.linear().transpose();
      sum.head<3>() += linear;
      sum.tail<3>() += pose.translation().cross(linear) + inertia * s.tail<3>();
    }
    return sum;
  };
  const Wrench<3> before = momenta();
  run(bodies, 61);  // the gap of 0.2 - 0.1 sqrt(2) closes in 58.6 steps
  const auto &a = bodies.state(0), &b = bodies.state(1);
  const double lower = a.velocity[2] + a.velocity[4] * -0.2, upper = b.velocity[2];
  EXPECT_LT(a.velocity[2], 0);
  EXPECT_NEAR(upper, lower, 0.01) << "no rebound; the place of the touch moves by dt";
  // An axis turns by w dt in the step; its inertia is taken at the middle.
  EXPECT_LE((momenta() - before).norm(), 1e-3 * before.norm());
}

// Points of an edge that are farthest inside a box of this half width.
double depth(const BodyState<3>& state, const Surface<3>& surface, const BodyState<3>& other, double half) {
  double deepest = 0;
  const Isometry<3> seen = other.pose.inverse() * state.pose;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec<3> p = seen * Vec<3>(surface.vertices.col(surface.facets(k, f)));
      const Vec<3> q = seen * Vec<3>(surface.vertices.col(surface.facets((k + 1) % 3, f)));
      for (int i = 0; i <= 20; ++i) deepest = std::max(deepest, half - (p + i / 20.0 * (q - p)).cwiseAbs().maxCoeff());
    }
  return deepest;
}

TEST(SpatialContact, keeps_turned_boxes_apart_however_they_meet) {
  for (int k = 0; k < 30; ++k) {
    BodySpec<3> a = of_shape(box({0.3, 0.3, 0.3}), {0, 0, 0});
    BodySpec<3> b = of_shape(box({0.3, 0.3, 0.3}), {0.55, 0.01 * k - 0.15, 0.1 - 0.007 * k});
    a.pose.rotate(Eigen::AngleAxisd(0.13 * k, Vec<3>(1, 2, -1).normalized()));
    b.pose.rotate(Eigen::AngleAxisd(-0.37 * k, Vec<3>(-1, 1, 3).normalized()));
    a.velocity << 0.5, 0, 0, 0.1 * k, 0, 0.05 * k;
    b.velocity << -0.5, 0, 0, 0, 0.07 * k, 0;
    Bodies<3> bodies({a, b}, {}, {}, ContactSpec<3>{});
    for (int i = 0; i < 500; ++i) {
      run(bodies, 1);
      // A corner that turns on a face leaves the tangent by v^2 dt^2 / (2 r) a step: 1e-6 m here.
      for (std::size_t one : {0u, 1u})
        ASSERT_LE(depth(bodies.state(one), a.surface, bodies.state(1 - one), 0.15), 1e-4)
            << "pair " << k << ", step " << i;
    }
  }
}

TEST(SpatialContact, is_sought_where_it_is) {
  // Of two balls one above the other the vertices that face each other are found, and the least gap is that of the balls.
  const auto shape = sphere(0.5, 64);
  const Vec<3> apart(0.01, -0.02, 1.01);
  const std::vector specs{of_shape(shape, {0, 0, 0}), of_shape(shape, apart)};
  const Contacts<3> contacts({}, specs);
  const auto found = contacts.within_reach(
      std::vector<BodyState<3>>{{specs[0].pose, Twist<3>::Zero()}, {specs[1].pose, Twist<3>::Zero()}}, 1);
  const auto& x = shape.surface.vertices;
  const double reach = 0.05 * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  double least = std::numeric_limits<double>::infinity();
  std::size_t few = 0;
  for (Eigen::Index v = 0; v < x.cols(); ++v)
    for (const double side : {-1, 1}) {
      const double facing = x.col(v).normalized().dot(-side * apart.normalized());
      const double gap = (x.col(v) + side * apart).norm() - 0.5;  // of the ball; its facets are deeper
      // A vertex rests on what its edges dip into by a slope of 0.2 at most; they have a slope of their own.
      few += gap < 0.9 * reach && std::acos(facing) < 0.1;
    }
  for (const auto& c : found) least = std::min(least, -c.rate);
  EXPECT_GE(found.size(), few);
  EXPECT_LE(least, apart.norm() - 1 + 2 * 0.5 * 0.05 * 0.05) << "facets of 0.05 lie h^2 / 8 R below the ball";
  EXPECT_GE(least, apart.norm() - 1);
}

}  // namespace
}  // namespace splashdown::rigid::spatial_contacts_test
