// The flow in time: exact solutions, orders, mesh motion.
#include <gtest/gtest.h>

#include "flows.hpp"

namespace splashdown::ale::flow_test {
namespace {

using std::numbers::pi;
constexpr std::array<BoundaryKind, 4> all_given = {BoundaryKind::inflow, BoundaryKind::inflow, BoundaryKind::inflow,
                                                   BoundaryKind::inflow};

/// Of p at t_n, without its mean.
double pressure_error(const AleFlow& flow, const std::function<double(const Vec<2>&)>& exact) {
  const auto p = flow.pressure();
  double mean = 0, sum = 0;
  const auto corners = static_cast<std::size_t>(flow.mesh().corners);
  for (std::size_t k = 0; k < corners; ++k) mean += (p[k] - exact(flow.points()[k])) / static_cast<double>(corners);
  for (std::size_t k = 0; k < corners; ++k) sum += std::pow(p[k] - exact(flow.points()[k]) - mean, 2);
  return std::sqrt(sum / static_cast<double>(corners));
}

// A parabola is a quadratic element's own, its pressure a linear one's.
TEST(AleFlow, has_poiseuilles_flow_exactly) {
  const double mu = 0.3, rho = 2, height = 0.5, speed = 4;
  const auto exact = [&](const Vec<2>& x) {
    return Vec<2>(4 * speed * x.y() * (height - x.y()) / (height * height), 0);
  };
  for (const bool is_steady : {true, false}) {
    AleFlowSpec spec{.density = rho, .viscosity = mu, .min = {0, 0}, .max = {2, height}};
    spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::no_slip};
    spec.inflow = [&](const Vec<2>& x, double) { return exact(x); };
    if (!is_steady) spec.start = spec.inflow;
    spec.far = 0.2;
    spec.scheme.is_steady = is_steady;
    AleFlow flow(spec);
    double before = 0;
    for (int k = 0; k < 3; ++k) scenes::step(flow, 0.1, before);
    EXPECT_LT(scenes::error(flow.mesh(), flow.places(), flow.velocity(), exact), 1e-11 * speed);
    const double slope = -8 * mu * speed / (height * height);
    EXPECT_LT(pressure_error(flow, [&](const Vec<2>& x) { return slope * x.x(); }), 1e-9 * std::abs(slope));
  }
}

// v = (sin x cos y, -cos x sin y), p = sin x + cos y: what is left of the equation is a force.
struct Vortices {
  double rho = 1.5, mu = 0.05;
  static Vec<2> v(const Vec<2>& x) { return {std::sin(x.x()) * std::cos(x.y()), -std::cos(x.x()) * std::sin(x.y())}; }
  static double p(const Vec<2>& x) { return std::sin(x.x()) + std::cos(x.y()); }
  Vec<2> force(const Vec<2>& x) const {
    const Vec<2> convection(std::sin(x.x()) * std::cos(x.x()), std::sin(x.y()) * std::cos(x.y()));
    return convection + 2 * mu / rho * v(x) + Vec<2>(std::cos(x.x()), -std::sin(x.y())) / rho;
  }
};

TEST(AleFlow, is_of_third_order_in_space_and_second_in_pressure) {
  const Vortices flow_of;
  const double far[] = {0.2, 0.1, 0.06};
  double velocity[3], pressure[3], size[3];
  for (int k = 0; k < 3; ++k) {
    AleFlowSpec spec{.density = flow_of.rho, .viscosity = flow_of.mu, .min = {0, 0}, .max = {2, 2}};
    spec.sides = all_given;
    spec.inflow = [](const Vec<2>& x, double) { return Vortices::v(x); };
    spec.force = [&](const Vec<2>& x, double) { return flow_of.force(x); };
    spec.far = far[k];
    spec.scheme.is_steady = true;
    AleFlow flow(spec);
    double before = 0;
    scenes::step(flow, 1, before);
    size[k] =
        1 / std::sqrt(static_cast<double>(flow.mesh().cells.size()));  // meshes of halved edges are not quite similar
    velocity[k] = scenes::error(flow.mesh(), flow.places(), flow.velocity(), Vortices::v);
    pressure[k] = pressure_error(flow, Vortices::p);
  }
  const double finer = std::log(size[0] / size[2]);
  EXPECT_GT(std::log(velocity[0] / velocity[2]) / finer, 2.8) << velocity[0] << " " << velocity[2];
  EXPECT_GT(std::log(pressure[0] / pressure[2]) / finer, 1.8) << pressure[0] << " " << pressure[2];
}

// v = g(t) (y^2, x^2), p = h(t) x: space has no error, what is left is time's.
double error_in_time(double dt, double theta) {
  const double mu = 0.1, rho = 1;
  const auto g = [](double t) { return 1 + 0.5 * std::sin(3 * t); };
  const auto rate = [](double t) { return 1.5 * std::cos(3 * t); };
  const auto shape = [](const Vec<2>& x) { return Vec<2>(x.y() * x.y(), x.x() * x.x()); };
  AleFlowSpec spec{.density = rho, .viscosity = mu, .min = {-1, -1}, .max = {1, 1}};
  spec.sides = all_given;
  spec.inflow = [=](const Vec<2>& x, double t) { return Vec<2>(g(t) * shape(x)); };
  spec.start = spec.inflow;
  spec.force = [=](const Vec<2>& x, double t) {
    const Vec<2> convection(2 * x.y() * x.x() * x.x(), 2 * x.x() * x.y() * x.y());
    return Vec<2>(rate(t) * shape(x) + g(t) * g(t) * convection - 2 * mu / rho * g(t) * Vec<2>(1, 1) +
                  Vec<2>(std::cos(t), 0));
  };
  spec.far = 0.8;
  spec.scheme = {.theta = theta, .damped_steps = 0};
  AleFlow flow(spec);
  double before = 0;
  while (flow.time() < 0.8 - 1e-9) scenes::step(flow, dt, before);
  const double last = flow.time() - 0.5 * dt;
  return scenes::error(flow.mesh(), flow.places(), flow.velocity(),
                       [&](const Vec<2>& x) { return Vec<2>(g(last) * shape(x)); });
}

TEST(AleFlow, is_of_second_order_in_time_with_the_midpoint_rule_and_of_first_with_eulers) {
  const double dt = 0.1;
  EXPECT_NEAR(std::log2(error_in_time(dt, 0.5) / error_in_time(dt / 2, 0.5)), 2, 0.2);
  EXPECT_NEAR(std::log2(error_in_time(dt, 1) / error_in_time(dt / 2, 1)), 1, 0.2);
}

// A body that goes with the stream: nothing acts on it, wherever it takes the mesh.
TEST(AleFlow, does_not_feel_a_body_that_drifts_with_the_stream) {
  const Vec<2> stream(1, 0.25);
  AleFlowSpec spec{.density = 1000, .viscosity = 1, .min = {-1, -1}, .max = {1.5, 1}};
  spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::inflow, BoundaryKind::inflow};
  spec.inflow = [&](const Vec<2>&, double) { return stream; };
  spec.start = spec.inflow;
  spec.far = 0.3;
  Twist<2> twist(stream.x(), stream.y(), 0);
  spec.walls = {{.name = "body",
                 .surface = scenes::box(0.4, 0.2),
                 .pose = scenes::at(-0.2, 0, 0.3),
                 .velocity = twist,
                 .size = 0.1}};
  AleFlow flow(spec);
  double before = 0;
  auto pose = spec.walls[0].pose;
  for (int k = 0; k < 6; ++k) {
    const double dt = k % 2 == 0 ? 0.05 : 0.03;
    pose.translation() += dt * stream;
    scenes::step(flow, dt, before, twist, pose.matrix().topRows<2>().reshaped());
    const double inertia = 1000 * 0.08 * stream.norm() / dt;  // of the body's displacement, in a step
    EXPECT_LT(flow.loads()[0].physical.norm(), 1e-9 * inertia);
  }
  EXPECT_LT(scenes::error(flow.mesh(), flow.places(), flow.velocity(), [&](const Vec<2>&) { return stream; }), 1e-11);
  EXPECT_GT((flow.places() - flow.mesh().nodes).colwise().norm().maxCoeff(), 0.2);
}

// Archimedes: gravity is in the pressure alone.
TEST(AleFlow, lifts_a_body_at_rest_by_what_it_displaces) {
  AleFlowSpec spec{.density = 1000, .viscosity = 1, .min = {-1, -1}, .max = {1, 1}};
  spec.sides = {BoundaryKind::no_slip, BoundaryKind::no_slip, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.far = 0.4;
  spec.gravity = {0, -9.81};
  spec.walls = {{.name = "body", .surface = scenes::box(0.4, 0.2), .pose = scenes::at(0.2, 0, 0.3), .size = 0.1}};
  AleFlow flow(spec);
  double before = 0;
  scenes::step(flow, 0.1, before);
  const auto& load = flow.loads()[0].physical;
  EXPECT_NEAR(load[1], 1000 * 9.81 * 0.08, 1e-8 * 784.8);
  EXPECT_NEAR(load[0], 0, 1e-8 * 784.8);
  EXPECT_NEAR(load[2], 0, 1e-8 * 784.8);
  EXPECT_NEAR(*flow.pressure_at({0.5, -0.5}) - *flow.pressure_at({0.5, 0.5}), 9810, 1e-6);
  EXPECT_FALSE(flow.pressure_at({0.2, 0}));
}

// Nine tenths of the way to a side: no mesh of the same cells lies in what is left.
TEST(AleFlow, refuses_to_fold_its_mesh) {
  AleFlowSpec spec{.density = 1, .viscosity = 1, .min = {-1, -1}, .max = {1, 1}};
  spec.sides = {BoundaryKind::slip, BoundaryKind::outflow, BoundaryKind::slip, BoundaryKind::slip};
  spec.far = 0.4;
  spec.walls = {{.name = "body", .surface = scenes::box(0.4, 0.2), .size = 0.1}};
  AleFlow flow(spec);
  ASSERT_TRUE(flow.begin(0.5, 1).ok());
  ASSERT_TRUE(flow.solve(Twist<2>(0.1, 0, 0)).ok());
  EXPECT_TRUE(flow.acceptable().ok());
  ASSERT_TRUE(flow.solve(Twist<2>(0.9, 0, 0)).ok());
  EXPECT_NE(flow.acceptable().cause.find("folds"), std::string::npos);
}

}  // namespace
}  // namespace splashdown::ale::flow_test
