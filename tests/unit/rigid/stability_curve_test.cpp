// Righting levers of drawn bodies at all heels: laws that every curve obeys.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "rigid/shapes/hydrostatics.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::stability_curve_test {
namespace {

using std::numbers::pi;

constexpr double rho = 1000, degree = pi / 180;
const Slope<3> ahead(1, 0);

struct Body {
  Surface<3> surface;
  double mass = 0, size = 0;
};

Body with_centre(const Shape<3>& shape, double ratio, const Vec<3>& off) {
  Body body{centred<3>(shape.surface, shape.at_unit_density.centre + off), ratio * rho * shape.at_unit_density.mass, 0};
  body.size = (shape.surface.vertices.rowwise().maxCoeff() - shape.surface.vertices.rowwise().minCoeff()).norm();
  return body;
}

Floating<3> rest_of(const Body& body, const Isometry<3>& pose = Isometry<3>::Identity()) {
  const auto f = floating_stable<3>(body.surface, pose, body.mass, rho, 0.);
  if (!f) throw std::runtime_error("sinks");
  return *f;
}

std::vector<Heeled> curve_of(const Body& body, const Floating<3>& rest, double step = 15 * degree) {
  std::vector<double> heels;
  for (int i = 0; i * step <= pi + 1e-9; ++i) heels.push_back(i * step);
  return righting_levers(body.surface, rest, body.mass, rho, 0., ahead, heels);
}

/// Height of the centre of mass over that of buoyancy at a heel and trim: the energy over the weight.
double height_at(const Body& body, const Floating<3>& rest, double heel, double trim) {
  Isometry<3> pose = rest.pose;
  pose.linear() = Eigen::AngleAxisd(-trim, Vec<3>::UnitY()).toRotationMatrix() *
                  Eigen::AngleAxisd(heel, Vec<3>::UnitX()).toRotationMatrix() * rest.pose.linear();
  pose.translation().z() = 2 * body.size;  // comes down on the water with a dry hollow
  const auto f = floating<3>(body.surface, pose, body.mass, rho, 0.);
  return f && f->hollow == Hollow::dry ? f->pose.translation().z() - f->submerged.centre.z() : std::nan("");
}

Body drawn(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double ratio = 0.15 + 0.7 * unit(random), size = std::pow(10, unit(random) - 0.5);
  const Vec<3> off = 0.1 * size * (Vec<3>(unit(random), unit(random), unit(random)) - Vec<3>(0.5, 0.5, 1));
  const int around = 48;
  switch (seed % 6) {
    case 0:
      return with_centre(box({size, size * (0.4 + unit(random)), size * (0.2 + unit(random))}), ratio, off);
    case 1:
      return with_centre(box({size, size, size}), ratio, off);
    case 2:
      return with_centre(cone(degree * (20 + 40 * unit(random)), size, around), ratio, off);
    case 3:
      return with_centre(capsule_of_revolution(0.3 * size, size, around), ratio, off);
    case 4:
      return with_centre(sphere(0.5 * size, around), ratio, off);
    default:  // an open pot, which swamps
      return with_centre(revolved(std::vector<Vec<2>>{{0, 0},
                                                      {size, 0},
                                                      {size, 0.8 * size},
                                                      {0.95 * size, 0.8 * size},
                                                      {0.95 * size, 0.05 * size},
                                                      {0, 0.05 * size}},
                                  around),
                         0.2 + 3 * unit(random), {off.x(), off.y(), 0});
  }
}

struct Worst {
  double lever = 0, balance = 0;  // over the size
};

/// GZ against the slope of the energy, and the balance in trim, at all heels of a curve.
Worst worst_of(unsigned first, unsigned count) {
  Worst worst;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const auto body = drawn(seed);
    const auto rest = rest_of(body);
    const double small = 0.02 * degree;
    for (const auto& at : curve_of(body, rest)) {
      const auto height = [&](double heel, double trim) { return height_at(body, rest, heel, trim); };
      const double lever = (height(at.heel + small, at.trim) - height(at.heel - small, at.trim)) / (2 * small);
      const double balance = (height(at.heel, at.trim + small) - height(at.heel, at.trim - small)) / (2 * small);
      if (std::isnan(lever) || std::isnan(balance) || at.floating.freeboard < 0.01 * body.size) continue;  // rims
      EXPECT_NEAR(at.lever, lever, 0.005 * body.size) << "seed " << seed << ", heel " << at.heel / degree;
      EXPECT_NEAR(balance, 0, 0.005 * body.size) << "seed " << seed << ", heel " << at.heel / degree;
      worst.lever = std::max(worst.lever, std::abs(at.lever - lever) / body.size);
      worst.balance = std::max(worst.balance, std::abs(balance) / body.size);
    }
  }
  return worst;
}

}  // namespace

TEST(StabilityCurve, is_the_derivative_of_potential_energy) { worst_of(0, 6); }

// ctest -L nightly
TEST(StabilityCurveNightly, is_the_derivative_of_potential_energy) {
  const auto worst = worst_of(100, 60);
  std::printf("worst of 60: GZ %.2g, balance in trim %.2g of the hull's size\n", worst.lever, worst.balance);
}

// Of any sphere GZ is the distance of its centre from that of mass times sin(heel), at 120 and 180 deg too.
TEST(StabilityCurve, of_a_sphere_is_a_sine) {
  const double low = 0.1, radius = 0.5;
  const auto body = with_centre(sphere(radius), 0.4, {0, 0, -low});
  const auto curve = curve_of(body, rest_of(body));
  ASSERT_EQ(curve.size(), 13u);
  // Facets of 360 deg / 128 lie (2 pi / 128)^2 / 8 radii inside.
  const double facets = std::pow(2 * pi / 128, 2) / 8 * radius;
  for (const auto& at : curve) {
    EXPECT_NEAR(at.lever, low * std::sin(at.heel), 3 * facets) << at.heel / degree;
    EXPECT_NEAR(at.trim_height, low * std::cos(at.heel), 10 * facets) << at.heel / degree;
    EXPECT_FALSE(at.jumped);
  }
}

// A cube upside down is its mirror image: in balance whatever its density.
TEST(StabilityCurve, of_a_cube_vanishes_at_180_degrees) {
  int followed = 0;
  for (const double ratio : {0.1, 0.25, 0.4, 0.5, 0.7, 0.9}) {
    const auto body = with_centre(box({1, 1, 1}), ratio, Vec<3>::Zero());
    const auto curve = curve_of(body, rest_of(body));
    ASSERT_EQ(curve.size(), 13u) << ratio;
    if (std::ranges::any_of(curve, &Heeled::jumped)) continue;  // to another of its balances
    ++followed;
    EXPECT_NEAR(curve.back().lever, 0, 1e-6) << ratio;
  }
  EXPECT_GE(followed, 4);
}

TEST(StabilityCurve, of_an_open_pot_ends_where_water_comes_over_its_rim) {
  const double radius = 1, height = 0.8, wall = 0.05;
  const auto shape = revolved(
      std::vector<Vec<2>>{
          {0, 0}, {radius, 0}, {radius, height}, {radius - wall, height}, {radius - wall, wall}, {0, wall}},
      64);
  const double draft = 0.4;
  Body body = with_centre(shape, 1, {0, 0, -0.1});
  body.mass = rho * pi * draft;
  const auto curve = curve_of(body, rest_of(body));
  // Wall-sided until then: the rim, and the bottom, come to the water at tan(heel) = 0.4.
  EXPECT_NEAR(curve.back().heel, std::atan((height - draft) / radius), 1 * degree);
  EXPECT_NEAR(curve.back().floating.freeboard, 0, 0.02 * radius);
}

}  // namespace splashdown::rigid::stability_curve_test
