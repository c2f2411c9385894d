// Laws in space: rest, added mass of one and of two bodies, impact, a drop that strains.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "fluid/effects/gravity/gravity.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/coupling/scenes.hpp"
#include "tests/verification/order.hpp"

namespace splashdown::space_test {
namespace {

namespace fs = fluid::scenes;
using coupling::scenes::g;
using coupling::scenes::water;
using fluid::Fluid;
using Vec = Eigen::Vector3d;
using std::numbers::pi;

constexpr double instant = 1e-6;  // next to nothing moves in it

std::vector<std::unique_ptr<fluid::Effect<3>>> effects(double gravity) {
  std::vector<std::unique_ptr<fluid::Effect<3>>> list;
  if (gravity > 0) list.push_back(std::make_unique<fluid::Gravity<3>>(Vec(0, 0, -gravity)));
  return list;
}

// A polyhedron with the sphere's volume: its faces are as much too deep as its corners are too high.
fluid::Surface<3> ball(double radius, int around) {
  const auto shape = rigid::sphere(radius, around);
  const double volume = rigid::with_density<3>(shape.at_unit_density, 1).mass;
  double enclosed = 0;
  for (Eigen::Index f = 0; f < shape.surface.facets.cols(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = shape.surface.vertices.col(shape.surface.facets(k, f));
    enclosed += corners.determinant() / 6;
  }
  return {std::cbrt(volume / enclosed) * shape.surface.vertices, shape.surface.facets};
}

fluid::WallSpec<3> sphere(const Vec& centre, double radius, double h, int around) {
  auto wall = fs::wall<3>("sphere", ball(radius, around), h);
  wall.pose.translation() = centre;
  return wall;
}

// A tank of water from z = -depth to 0 under a lid.
fluid::FluidSpec<3> tank(double half, double depth, double lid, double h) {
  fluid::FluidSpec<3> spec;
  spec.size = {.surface = h, .far = h};
  spec.liquids.push_back({fs::block({-half, -half, -depth}, {half, half, 0}), {}});
  spec.walls.push_back(
      fs::wall<3>("tank", fs::turned_inside_out(fs::block({-half, -half, -depth}, {half, half, lid})), h));
  return spec;
}

// What a step makes of water at rest: the scatter of p + rho g z over rho g depth, and speed over (g depth)^1/2.
struct Rest {
  double pressure = 0, speed = 0;
  int unknowns = 0;
};
Rest a_step_at_rest(fluid::FluidSpec<3> spec, double depth) {
  coupling::scenes::Watched<3> stepper(std::make_unique<Fluid<3>>(std::move(spec), effects(g)));
  EXPECT_TRUE(stepper.attempt(0.01).ok());
  const auto& nodes = stepper.fluid().nodes();
  Rest rest;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double off = stepper.fluid().pressure()[n] + water * g * nodes.x[n].z();
    least = std::min(least, off), most = std::max(most, off);
    rest.unknowns += !nodes.surface[n];
  }
  rest.pressure = (most - least) / (water * g * depth);
  const double weight = water * g * stepper.fluid().ledger().volume;
  EXPECT_NEAR(stepper.fluid().result().loads[0].total()[2], -weight, rest.pressure * weight + 1e-10 * weight);
  stepper.commit();
  for (const auto& v : stepper.fluid().nodes().v) rest.speed = std::max(rest.speed, v.norm() / std::sqrt(g * depth));
  return rest;
}

TEST(InSpace, a_column_at_rest_has_a_linear_pressure_and_stays) {
  const Rest rest = a_step_at_rest(tank(0.5, 0.5, 0.25, 0.1), 0.5);
  EXPECT_LE(rest.pressure, 1e-10);
  EXPECT_LE(rest.speed, 1e-10);
}

TEST(InSpace, liquid_without_a_free_surface_rests_whichever_solver_it_takes) {
  // Its pressure is known but for a constant. Factored: roundoff over the shift of the diagonal by 1e-9, which makes it definite. By
  // multigrid: the residual that the pressure is solved to, 1e-4, a tenth of which each correction leaves.
  const Rest direct = a_step_at_rest(tank(0.5, 1, 0, 0.15), 1);
  ASSERT_LE(direct.unknowns, fluid::most_direct<3>);
  EXPECT_LE(direct.pressure, 1e-6);
  EXPECT_LE(direct.speed, 1e-6);
  const Rest iterated = a_step_at_rest(tank(0.5, 1, 0, 0.057), 1);
  ASSERT_GT(iterated.unknowns, fluid::most_direct<3>);
  EXPECT_LE(iterated.pressure, 1e-4);
  EXPECT_LE(iterated.speed, 1e-4);
}

// A sphere of radius a in a ball of liquid of radius b, p = 0 there:
//   p = rho A a^3 / (a^3 + 2 b^3) (b^3 / r^2 - r) cos(theta),   M_a = rho 4 pi / 3 a^3 (b^3 - a^3) / (2 b^3 + a^3)
TEST(InSpace, added_mass_of_a_sphere_is_met_better_than_with_second_order) {
  const double a = 0.5, b = 1, a3 = a * a * a, b3 = b * b * b;
  const double exact = water * 4 * pi / 3 * a3 * (b3 - a3) / (2 * b3 + a3);
  const std::array h{0.14, 0.1};
  std::array<double, 2> bound;
  for (std::size_t i = 0; i < h.size(); ++i) {
    fluid::FluidSpec<3> spec;
    spec.size = {.surface = h[i], .far = h[i]};
    spec.liquids.push_back({ball(b, 40), {}});
    spec.walls.push_back(sphere(Vec::Zero(), a, h[i], 40));
    Fluid<3> f(spec, effects(0));
    const std::array<std::size_t, 1> one{0};
    ASSERT_TRUE(f.begin(instant, instant, {}).ok());
    const Eigen::MatrixXd G = f.added_mass(one) / exact;
    // Linear elements without the corrections find a subspace of the flows, hence less energy than the exact one.
    bound[i] = 1 + f.interface_slope(one)(2, 2) / exact;
    EXPECT_GT(bound[i], 0);
    for (int axis : {0, 1, 2}) EXPECT_LE(std::abs(G(axis, axis) - 1), bound[i]) << h[i];
    EXPECT_LE((G - G.transpose()).norm(), 1e-10 * G.norm());
  }
  EXPECT_GE(order_of(h, bound), 2 - 0.2) << bound[0] << ' ' << bound[1];
}

// Liquid below z = 0 inside a half ball, p = 0 all around.
fluid::Surface<3> half_ball(double radius) {
  constexpr int rings = 24, around = 4 * rings, pole = rings * around, centre = pole + 1;
  fluid::Surface<3> s{Eigen::Matrix3Xd(3, centre + 1), Eigen::Matrix3Xi(3, 2 * pole)};
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double below = pi / 2 * i / rings, phi = 2 * pi * j / around;
      s.vertices.col(i * around + j) << std::cos(below) * std::cos(phi), std::cos(below) * std::sin(phi),
          -std::sin(below);
    }
  s.vertices.col(pole) = -Vec::UnitZ();
  s.vertices.col(centre).setZero();
  s.vertices *= radius;
  constexpr int last = pole - around;
  int facet = 0;
  for (int j = 0; j < around; ++j) {
    const int next = (j + 1) % around;
    s.facets.col(facet++) << centre, j, next;
    for (int upper = 0; upper < last; upper += around) {
      const int lower = upper + around;
      s.facets.col(facet++) << upper + j, lower + j, lower + next;
      s.facets.col(facet++) << upper + j, lower + next, upper + next;
    }
    s.facets.col(facet++) << last + j, pole, last + next;
  }
  return s;
}

// A half submerged sphere of radius a, p = 0 at z = 0 and at r = b. Heave is one mode, z; sway has P_n^1(cos theta) cos(phi) with even n:
//   heave  2/3 pi rho a^3 (b^3 - a^3) / (a^3 + 2 b^3)
//   sway   pi rho a^3 sum P_n(0)^2 n (n + 1) (2 n + 1) / ((n - 1) (n + 2))^2 (1 - q) / (n + 1 + n q), q = (a/b)^(2 n + 1);
// without a bound 1/2 and 0.2732 of 2/3 pi rho a^3 (Hulme, J. Fluid Mech. 121, 1982, at infinite frequency).
TEST(InSpace, added_mass_of_a_floating_hemisphere_is_of_second_order) {
  const double a = 0.5, b = 1.5, a3 = a * a * a, b3 = b * b * b;
  const double heave = water * 2 * pi / 3 * a3 * (b3 - a3) / (a3 + 2 * b3);
  double sway = 0, p = 1;              // p = P_n(0)
  for (int n = 2; n < 4000; n += 2) {  // what is left out falls like 1 / n^2
    p *= -(n - 1.) / n;
    const double q = std::pow(a / b, 2 * n + 1), ends = (n - 1.) * (n + 2.);
    sway += water * pi * a3 * p * p * n * (n + 1.) * (2 * n + 1) / (ends * ends) * (1 - q) / (n + 1 + n * q);
  }
  const std::array h{a / 8, a / 12, a / 16};
  std::array<double, 3> off_heave, off_sway;
  for (std::size_t i = 0; i < h.size(); ++i) {
    fluid::FluidSpec<3> spec;
    spec.size = {.surface = 4 * h[i], .far = 4 * h[i], .growth = 0.2};
    spec.liquids.push_back({half_ball(b), {}});
    spec.walls.push_back(sphere(Vec::Zero(), a, h[i], 96));
    Fluid<3> f(spec, effects(0));
    const std::array<std::size_t, 1> one{0};
    ASSERT_TRUE(f.begin(instant, instant, {}).ok());
    const Eigen::MatrixXd G = f.added_mass(one);
    off_heave[i] = G(2, 2) / heave - 1;
    off_sway[i] = (G(0, 0) + G(1, 1)) / (2 * sway) - 1;  // no mesh is round
    const std::string elements = std::to_string(std::lround(a / h[i])) + "_elements";
    RecordProperty("heave_" + elements, std::to_string(off_heave[i]));
    RecordProperty("sway_" + elements, std::to_string(off_sway[i]));
  }
  EXPECT_LE(std::abs(off_heave[1]), 0.01);
  EXPECT_LE(std::abs(off_sway[1]), 0.01);
  EXPECT_GE(order_of(h, off_heave), 2 - 0.2) << off_heave[0] << ' ' << off_heave[1] << ' ' << off_heave[2];
  EXPECT_GE(order_of(h, off_sway), 2 - 0.2) << off_sway[0] << ' ' << off_sway[1] << ' ' << off_sway[2];
}

// Two equal spheres, c between their centres, far from p = 0: what one of them is pushed with along the line of centres when the
// other one moves, over its own added mass alone, is - 3 (a / c)^3, across it half of that with the other sign (Lamb, Hydrodynamics, art.
// 138); its own added mass grows by 3 (a / c)^6.
TEST(InSpace, two_spheres_know_of_each_other_as_dipoles_do) {
  const double a = 0.5, c = 1.5, far = 5, h = 0.2;
  fluid::FluidSpec<3> spec;
  spec.size = {.surface = 0.4 * far, .far = 0.4 * far, .growth = 0.8};
  spec.liquids.push_back({ball(far, 12), {}});
  for (double side : {-1, 1}) spec.walls.push_back(sphere({0.5 * side * c, 0, 0}, a, h, 24));
  Fluid<3> f(spec, effects(0));
  ASSERT_TRUE(f.begin(instant, instant, {}).ok());
  const std::array<std::size_t, 2> both{0, 1};
  const Eigen::MatrixXd G = f.added_mass(both) / (water * 2 * pi / 3 * a * a * a);
  EXPECT_LE((G - G.transpose()).norm(), 1e-10 * G.norm()) << "reciprocity";
  // The surface is at a distance: (a / far)^3 of the added mass, and (c / far)^3 of what the spheres do to each other. Elements:
  // second order, (h / a)^2.
  const double mesh = h * h / (a * a), alone = 1 + 3 * std::pow(a / c, 6), other = 3 * std::pow(a / c, 3);
  EXPECT_NEAR(G(0, 0), alone, mesh);
  EXPECT_NEAR(G(6, 6), G(0, 0), 0.5 * mesh) << "mirrored";
  EXPECT_NEAR(G(0, 6), -other, (mesh + std::pow(c / far, 3)) * other);
  EXPECT_NEAR(G(1, 7), 0.5 * other, (mesh + std::pow(c / far, 3)) * 0.5 * other);
  EXPECT_NEAR(G(2, 8), 0.5 * other, (mesh + std::pow(c / far, 3)) * 0.5 * other);
}

// Hollow edges hold water that moves with the hull, their ends and convex edges do not. s_after = (M + G)^-1 M s, M of a hull that
// hardly weighs anything: 1 % of what moves with it. Four corrections leave a thousandth or two of either.
TEST(InSpace, added_mass_of_a_star_is_what_the_step_answers_with) {
  constexpr double outer = 0.5, h = 0.12, mass = 10;
  fluid::FluidSpec<3> spec;
  spec.size = {.surface = 0.8, .far = 0.8, .growth = 0.4};
  spec.liquids.push_back({ball(2, 12), {}});
  spec.walls.push_back(fs::wall<3>("star", fs::star(4, outer, 0.5 * outer, 0.4), h));
  Fluid<3> f(spec, effects(0));
  using Matrix = Eigen::Matrix<double, 6, 6>;
  const Matrix M = mass * Matrix::Identity();
  const fluid::Twist<3> s = (fluid::Twist<3>() << 0.3, 1, -0.5, 0.2, 0, 0.7).finished();
  const std::array<std::size_t, 1> star{0};
  ASSERT_TRUE(f.begin(instant, instant, {Matrix::Identity(), M, {}}).ok());
  const Eigen::MatrixXd G = f.added_mass(star);
  ASSERT_TRUE(f.solve(std::vector{s}).status.ok());
  const fluid::Twist<3> after = f.result().wall_velocities[0].rigid, expected = (M + G).ldlt().solve(M * s);
  EXPECT_LE((after - expected).norm(), 5e-3 * expected.norm()) << after.transpose() << '\n' << expected.transpose();
}

// A disc of radius c on the water: M_a = 4 rho c^3 / 3, half of Lamb's. Its pressure falls to zero at the edge like the root of the
// distance: the last element, h, carries (2 h / c)^(3/2) of the impulse.
TEST(InSpace, a_disc_that_hits_the_water_flat_stops_it_by_its_added_mass) {
  const double c = 0.5, h = 0.07, exact = 4 * water * c * c * c / 3;
  std::vector<double> found;
  for (double ratio : {0.1, 1.0, 10.0}) {
    auto spec = tank(10, 10, 1, 3);
    spec.size = {.surface = 3, .far = 3, .growth = 5 * h};
    const std::array<rigid::Vec<2>, 2> profile{{{c, 0}, {c, 0.1}}};
    const auto disc = rigid::revolved(profile, 64);
    auto wall = fs::wall<3>("disc", {disc.surface.vertices, disc.surface.facets}, h);
    wall.velocity[2] = -1;
    spec.walls.insert(spec.walls.begin(), wall);
    Fluid<3> f(spec, effects(0));
    const double mass = ratio * exact;
    const InterfaceModel response{.modal = {Eigen::VectorXd::Unit(12, 2), Eigen::MatrixXd::Constant(1, 1, mass)}};
    std::vector<fluid::Twist<3>> s(2, fluid::Twist<3>::Zero());
    s[0] = wall.velocity;
    ASSERT_TRUE(f.begin(instant, instant, response).ok());
    ASSERT_TRUE(f.solve(s).status.ok());
    const double after = f.result().wall_velocities[0].rigid[2], impulse = instant * f.result().loads[0].total()[2];
    EXPECT_NEAR(impulse, mass * (after + 1), 1e-6 * impulse) << "momentum";
    found.push_back(mass * (-1 / after - 1) / exact);
    EXPECT_NEAR(found.back(), 1, std::pow(2 * h / c, 1.5)) << ratio;
    EXPECT_NEAR(found.back(), found.front(), 0.01) << "the mass of the disc does not matter to the water";
  }
}

// Semi-axes a = (a, a, b) of a drop that an axial strain stretches: v_i = (a_i' / a_i) x_i, p = P (1 - sum (x_i / a_i)^2),
//   a_i'' = 2 P / (rho a_i),   2 P / rho = sum (a_i' / a_i)^2 / sum 1 / a_i^2
Vec exact_axes(double rate, double time) {
  struct State {
    Vec a, v;
  } now{Vec::Ones(), rate * Vec(-0.5, -0.5, 1)};
  const int steps = 2000;
  const double dt = time / steps;
  const auto slope = [](const State& s) {
    const double pull = s.v.cwiseQuotient(s.a).squaredNorm() / s.a.cwiseInverse().squaredNorm();
    return State{s.v, pull * s.a.cwiseInverse()};
  };
  for (int i = 0; i < steps; ++i) {  // midpoint rule
    const State k = slope(now), m = slope({now.a + 0.5 * dt * k.a, now.v + 0.5 * dt * k.v});
    now.a += dt * m.a, now.v += dt * m.v;
  }
  return now.a;
}

TEST(InSpace, axes_of_a_drop_follow_the_exact_solution_early) {
  const double rate = 10, end = 0.03, h = 0.25;
  const Vec exact = exact_axes(rate, end);
  ASSERT_NEAR(exact.prod(), 1, 1e-6) << "volume";
  fluid::FluidSpec<3> spec;
  spec.size = {.surface = h, .far = h};
  const auto shape = rigid::sphere(1, 32);
  spec.liquids.push_back({{shape.surface.vertices, shape.surface.facets},
                          [&](const Vec& x) { return Vec(-0.5 * rate * x.x(), -0.5 * rate * x.y(), rate * x.z()); }});
  coupling::scenes::Watched<3> drop(std::make_unique<Fluid<3>>(spec, effects(0)));
  while (drop.time() < end * (1 - 1e-9)) {
    ASSERT_TRUE(drop.attempt(std::min({drop.stable_dt(), 2e-3, end - drop.time()})).ok());
    drop.commit();
  }
  // The farthest nodes are some element from the axis, at most h / 2 where the surface is: they miss h^2 / 8 of it by its bend. What
  // the motion misses is of second order, too.
  Vec extent = Vec::Zero();
  for (const auto& x : drop.fluid().nodes().x) extent = extent.cwiseMax(x.cwiseAbs());
  for (int k : {0, 1, 2}) EXPECT_NEAR(extent[k], exact[k], 0.5 * h * h);
  const auto& ledger = drop.fluid().ledger();
  EXPECT_NEAR(ledger.volume, ledger.volume_initial, 0.01 * ledger.volume_initial);
}

}  // namespace
}  // namespace splashdown::space_test
