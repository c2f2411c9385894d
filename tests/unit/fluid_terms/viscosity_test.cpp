// Laws of the viscous predictor on a block of fluid, without pressure.
#include "fluid/effects/viscosity/viscosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "block_of_fluid.hpp"

namespace splashdown::fluid::viscosity_test {
namespace {

using testing::Block;
constexpr double pi = std::numbers::pi;
constexpr double mu = 3.0;
// Roundoff of a direct solve whose matrix has a condition number of about 1e3.
constexpr double roundoff = 1e-12;

template <int d>
Block<d> block() {
  return Block<d>(Block<d>::Lattice::Constant(d == 2 ? 8 : 4), 0.1, 0.15);
}

template <int d>
double largest_change(const Block<d>& fluid, std::span<const Vec<d>> v) {
  double largest = 0;
  for (std::size_t i = 0; i < v.size(); ++i) largest = std::max(largest, (v[i] - fluid.nodes.v[i]).norm());
  return largest;
}

template <class Dimension>
class ViscosityIn : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ViscosityIn, Dimensions);

TYPED_TEST(ViscosityIn, rigid_motion_creates_no_force) {
  constexpr int d = TypeParam::value;
  auto fluid = block<d>();
  Twist<d> s;
  for (int k = 0; k < freedoms<d>; ++k) s[k] = 1.0 + 0.3 * k;
  fluid.set_velocity([&](const Vec<d>& x) { return rigid_velocity<d>(s, x); });
  Viscosity<d> viscosity(1e3 * mu);
  EXPECT_LT(largest_change<d>(fluid, fluid.predict(viscosity)), roundoff * s.norm());
}

// Patch test: constant stress has no divergence. The kick is so short that the boundary, which is free and
// loses its traction, reaches inner nodes through the lumped mass alone.
TYPED_TEST(ViscosityIn, linear_velocity_creates_no_force_inside) {
  constexpr int d = TypeParam::value;
  auto fluid = block<d>();
  Mat<d> gradient;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) gradient(i, j) = 1.0 + i - 0.7 * j;
  fluid.set_velocity([&](const Vec<d>& x) -> Vec<d> { return gradient * x; });
  fluid.kick = 1e-9;
  Viscosity<d> viscosity(mu);
  const auto v = fluid.predict(viscosity);
  double inside = 0, boundary = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto at = fluid.place(static_cast<int>(i));
    const bool inner = (at.array() > 0).all() && (at.array() < fluid.count.array()).all();
    (inner ? inside : boundary) = std::max(inner ? inside : boundary, (v[i] - fluid.nodes.v[i]).norm());
  }
  EXPECT_GT(boundary, 0);
  // Second order in kick * nu / h^2 = 3e-10, and roundoff of v over the change.
  EXPECT_LT(inside, 1e-5 * boundary);
}

TYPED_TEST(ViscosityIn, free_fluid_keeps_momentum_and_angular_momentum) {
  constexpr int d = TypeParam::value;
  auto fluid = block<d>();
  fluid.set_velocity([&](const Vec<d>& x) -> Vec<d> { return (7 * x).array().sin() + x.prod(); });
  Viscosity<d> viscosity(1e3 * mu);
  const auto v = fluid.predict(viscosity);
  EXPECT_GT(largest_change<d>(fluid, v), 0.01);
  const auto before = fluid.momentum(fluid.nodes.v);
  EXPECT_LT((fluid.momentum(v) - before).norm(), 10 * roundoff * before.norm());
}

TYPED_TEST(ViscosityIn, energy_decreases_at_any_kick) {
  constexpr int d = TypeParam::value;
  auto fluid = block<d>();
  fluid.set_velocity([&](const Vec<d>& x) -> Vec<d> { return (7 * x).array().sin() + x.prod(); });
  const double before = fluid.kinetic_energy(fluid.nodes.v);
  double last = before;
  for (double kick : {1e-4, 1e-2, 1.0, 1e4}) {
    fluid.kick = kick;
    Viscosity<d> viscosity(mu);
    const auto v = fluid.predict(viscosity);
    const double after = fluid.kinetic_energy(v);
    EXPECT_LT(after, last) << kick;
    EXPECT_NEAR(viscosity.diagnostics(fluid.nodes, {}).at(0).second * kick, after - before, 1e-10 * before);
    last = after;
  }
}

TEST(Viscosity, the_same_input_gives_the_same_bits) {
  auto fluid = block<2>();
  fluid.set_velocity([&](const Vec<2>& x) -> Vec<2> { return (7 * x).array().sin(); });
  Viscosity<2> viscosity(mu);
  const auto once = fluid.predict(viscosity), again = fluid.predict(viscosity);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i], again[i]);
}

TEST(Viscosity, without_any_the_velocity_stays) {
  auto fluid = block<2>();
  fluid.add_wall(1, false, false);
  fluid.set_velocity([&](const Vec<2>& x) -> Vec<2> { return (7 * x).array().sin(); });
  Viscosity<2> viscosity(0);
  EXPECT_EQ(largest_change<2>(fluid, fluid.predict(viscosity)), 0);
}

TEST(Viscosity, a_slip_wall_takes_no_shear_and_stops_no_flow_along_it) {
  auto fluid = block<2>();
  fluid.add_wall(1, false, false);
  fluid.set_velocity([](const Vec<2>& x) { return Vec<2>(std::sin(5 * x.x()), std::cos(4 * x.y())); });
  Viscosity<2> viscosity(mu);
  std::vector<Wrench<2>> impulses;
  const auto v = fluid.predict(viscosity, &impulses);
  for (std::size_t i = 0; i < v.size(); ++i)
    EXPECT_NEAR(fluid.nodes.tie[i].wall == 0 ? v[i].y() - fluid.nodes.v[i].y() : 0.0, 0, roundoff);
  EXPECT_NEAR(impulses[0][0], 0, roundoff * std::abs(impulses[0][1]));
  EXPECT_GT(std::abs(impulses[0][1]), 0);
}

TEST(Viscosity, fluid_and_walls_together_keep_momentum) {
  auto fluid = block<2>();
  fluid.add_wall(1, false, true, Twist<2>(0.4, -0.2, 0.3));
  fluid.add_wall(1, true, false);
  fluid.set_velocity([](const Vec<2>& x) { return Vec<2>(std::sin(5 * x.x()), std::cos(4 * x.y())); });
  Viscosity<2> viscosity(mu);
  std::vector<Wrench<2>> impulses;
  const auto v = fluid.predict(viscosity, &impulses);
  const Wrench<2> before = fluid.momentum(fluid.nodes.v);
  const Wrench<2> after = fluid.momentum(v) + impulses[0] + impulses[1];
  EXPECT_LT((after - before).norm(), 10 * roundoff * before.norm());
}

// u(y, t) of a layer of height H on a wall that starts to move with speed 1, free above: odd cosines.
double started_layer(double y, double nu_t, double height) {
  double u = 1;
  for (int n = 0; n < 200; ++n) {
    const double k = (n + 0.5) * pi / height;
    u -= 2 / (k * height) * std::sin(k * y) * std::exp(-k * k * nu_t);
  }
  return u;
}

// Plane Couette start-up of a layer that is free on top, in a channel so long that its ends do not matter.
double start_up_error(int across) {
  const double height = 1, nu = 0.05, end = 4.0;
  Block<2> fluid({6 * across, across}, height / across, 0);
  fluid.density = 1;
  fluid.add_wall(1, false, true, Twist<2>(1, 0, 0));
  Viscosity<2> viscosity(nu * fluid.density);
  const int steps = across * across;  // first order in time, second in space
  fluid.kick = end / steps;
  for (int k = 0; k < steps; ++k) fluid.nodes.v = fluid.predict(viscosity);
  double squared = 0;
  for (int j = 0; j <= across; ++j) {
    const int i = fluid.index({3 * across, j});
    squared += std::pow(fluid.nodes.v[i].x() - started_layer(fluid.nodes.x[i].y(), nu * end, height), 2);
  }
  return std::sqrt(squared / (across + 1));
}

TEST(Viscosity, couette_flow_starts_as_the_exact_series_to_second_order) {
  const double coarse = start_up_error(4), fine = start_up_error(8);
  EXPECT_LT(fine, 4e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

TEST(Viscosity, the_wall_feels_the_shear_stress_of_couette_flow) {
  const double height = 1, length = 6;
  Block<2> fluid({48, 8}, height / 8, 0);
  fluid.add_wall(1, false, true, Twist<2>(1, 0, 0));
  fluid.add_wall(1, true, true);
  fluid.set_velocity([&](const Vec<2>& x) { return Vec<2>(1 - x.y() / height, 0); });
  Viscosity<2> viscosity(mu);
  fluid.kick = 1e-6;  // before the free ends are felt
  std::vector<Wrench<2>> impulses;
  fluid.predict(viscosity, &impulses);
  const double stress = mu / height;
  // Shorter than a kick's diffusion the ends cannot reach; roundoff of M dv is 1e-16 M v / (kick stress).
  EXPECT_NEAR(impulses[0][0] / fluid.kick, -stress * length, 1e-5 * stress * length);
  EXPECT_NEAR(impulses[1][0] / fluid.kick, stress * length, 1e-5 * stress * length);
}

// A shear wave between slip walls, u = cos(k y): its amplitude decays as exp(-nu k^2 t).
TEST(Viscosity, a_shear_wave_decays_at_its_rate) {
  const int across = 16;
  Block<2> fluid({4 * across, across}, 1.0 / across, 0);
  fluid.density = 1;
  fluid.add_wall(1, false, false);
  fluid.add_wall(1, true, false);
  const double nu = 0.02, k = pi, decay_time = 1 / (nu * k * k);
  fluid.set_velocity([&](const Vec<2>& x) { return Vec<2>(std::cos(k * x.y()), 0); });
  Viscosity<2> viscosity(nu * fluid.density);
  const int steps = 100;
  fluid.kick = 0.5 * decay_time / steps;
  for (int n = 0; n < steps; ++n) fluid.nodes.v = fluid.predict(viscosity);
  const double amplitude = fluid.nodes.v[fluid.index({2 * across, 0})].x();
  // Euler's error over T: T kick (nu k^2)^2 / 2 = 12e-4; lumped second differences: T nu k^2 (k h)^2 / 12 = 16e-4.
  EXPECT_NEAR(amplitude / std::exp(-0.5), 1, 3e-3);
}

}  // namespace
}  // namespace splashdown::fluid::viscosity_test
