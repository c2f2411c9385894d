// Hollows: what stays dry below the water level until water comes over a rim.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rigid/shapes/hydrostatics.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::hollows_test {
namespace {

constexpr double rho = 1000;

/// A trough of breadth b and height h with walls of thickness t, about its centre of mass if it is uniform.
struct Trough {
  double breadth = 2, height = 1, wall = 0.1;

  double solid() const { return breadth * height - hollow(); }
  double hollow() const { return (breadth - 2 * wall) * (height - wall); }
  Shape<2> shape() const {
    const double b = 0.5 * breadth, i = b - wall;
    return polygon(std::vector<Vec<2>>{
        {-b, 0}, {b, 0}, {b, height}, {i, height}, {i, wall}, {-i, wall}, {-i, height}, {-b, height}});
  }
  Surface<2> surface() const {
    const auto s = shape();
    return centred<2>(s.surface, s.at_unit_density.centre);
  }
};

Isometry<2> at(double y, double turn = 0) {
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translate(Vec<2>(0, y)).rotate(turn);
  return pose;
}

/// A bowl: a thick hemispherical shell, or the profile of a pot, as a body of revolution.
Shape<3> pot(double radius, double height, double wall) {
  return revolved(
      std::vector<Vec<2>>{
          {0, 0}, {radius, 0}, {radius, height}, {radius - wall, height}, {radius - wall, wall}, {0, wall}},
      32);
}

}  // namespace

TEST(Hollows, trough_of_steel_floats_on_its_outer_breadth) {
  const Trough trough;
  for (const double share : {0.2, 0.5, 0.9}) {  // of the draft at which water comes over the rims
    const double mass = rho * trough.breadth * trough.height * share;
    const auto f = floating(trough.surface(), at(3), mass, rho, 0.);
    ASSERT_TRUE(f) << share;
    EXPECT_NEAR(f->draft, share * trough.height, 1e-12);
    EXPECT_NEAR(f->freeboard, (1 - share) * trough.height, 1e-12);
    EXPECT_NEAR(f->submerged.waterline, trough.breadth, 1e-12);
    EXPECT_NEAR(f->submerged.waterline_moment(0, 0), std::pow(trough.breadth, 3) / 12, 1e-12);
    EXPECT_EQ(f->hollow, Hollow::dry);
  }
}

TEST(Hollows, trough_goes_under_when_its_rims_do) {
  const Trough trough;
  EXPECT_FALSE(floating(trough.surface(), at(3), 1.01 * rho * trough.breadth * trough.height, rho, 0.));
  // Its solid alone would carry so much, flooded: it sinks until it does.
  const double mass = 0.9 * rho * trough.solid();
  EXPECT_NEAR(floating(trough.surface(), at(3), mass, rho, 0.)->freeboard, trough.height - mass / rho / trough.breadth,
              1e-12);
  const auto flooded = floating(trough.surface(), at(3), mass, rho, 0., Hollow::flooded);
  ASSERT_TRUE(flooded);
  EXPECT_NEAR(flooded->submerged.volume, mass / rho, 1e-12);
  EXPECT_LT(flooded->submerged.waterline, trough.breadth);
  EXPECT_EQ(flooded->freeboard, std::numeric_limits<double>::infinity());
}

TEST(Hollows, below_water_they_are_flooded_from_the_beginning) {
  const Trough trough;
  const double steel = 1.2 * rho * trough.solid();
  EXPECT_TRUE(floating(trough.surface(), at(0.5), steel, rho, 0.));
  EXPECT_FALSE(floating(trough.surface(), at(-2), steel, rho, 0.)) << "it lies under water, full";
}

TEST(Hollows, heel_brings_the_rim_to_the_water) {
  const Trough trough;
  const double mass = rho * trough.breadth * trough.height * 0.5,
               rim = std::atan(0.5 * trough.height / (0.5 * trough.breadth - trough.wall));
  // Half immersed: the water stays at the middle, and comes over the inner corner of the rim.
  EXPECT_EQ(floating(trough.surface(), at(3, 0.98 * rim), mass, rho, 0.)->hollow, Hollow::dry);
  const auto over = floating(trough.surface(), at(3, 1.02 * rim), mass, rho, 0.);
  EXPECT_TRUE(!over || over->hollow == Hollow::flooded);
}

TEST(Hollows, upside_down_there_is_none) {
  const Trough trough;
  const auto s = submerged(trough.surface(), at(0, std::numbers::pi), 0.);
  EXPECT_LT(s.waterline, 2 * trough.wall + 1e-9) << "air leaves it";
}

TEST(Hollows, two_beside_each_other_flood_one_by_one) {
  // The bulkhead in the middle is higher than the left rim, the right rim than both.
  const std::vector<Vec<2>> outline{{-2, 0},    {2, 0},      {2, 1.5},    {1.9, 1.5},  {1.9, 0.1}, {0.1, 0.1},
                                    {0.1, 1.2}, {-0.1, 1.2}, {-0.1, 0.1}, {-1.9, 0.1}, {-1.9, 1},  {-2, 1}};
  const auto shape = polygon(outline);
  const Surface<2> s = centred<2>(shape.surface, shape.at_unit_density.centre);
  const auto volume = [&](double draft) { return submerged(s, at(shape.at_unit_density.centre.y()), draft).volume; };
  EXPECT_NEAR(volume(0.99), 4 * 0.99, 1e-12);
  const double left = 1.8 * 0.9, above_left = 1.8 * 0.05;  // what the water takes of the left hollow at 1.05
  EXPECT_NEAR(volume(1.05), 4 * 1.05 - left - above_left - 0.1 * 0.05, 1e-12);
  EXPECT_NEAR(volume(2.), shape.at_unit_density.mass, 1e-12);
}

TEST(Hollows, pot_in_space_floats_as_the_cylinder_around_it) {
  const double radius = 1, height = 0.8;
  const auto shape = pot(radius, height, 0.05);
  const Surface<3> s = centred<3>(shape.surface, shape.at_unit_density.centre);
  const double plan = 16 * std::sin(2 * std::numbers::pi / 32) * radius * radius, draft = 0.5;
  Isometry<3> pose = Isometry<3>::Identity();
  pose.translation().z() = 2;
  const auto f = floating(s, pose, rho * plan * draft, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->draft, draft, 1e-2) << "the polygon of 32 edges may be of another phase";
  EXPECT_NEAR(f->freeboard, height - f->draft, 1e-9);
  EXPECT_FALSE(floating(s, pose, rho * plan * draft, rho, 0., Hollow::flooded)) << "steel";
}

TEST(Hollows, have_their_bottoms_where_liquid_would_gather) {
  const Trough trough;
  const auto bottoms = hollow_bottoms<2>(trough.surface(), at(0));
  ASSERT_EQ(bottoms.size(), 1u);
  EXPECT_NEAR(bottoms[0].y(), trough.wall - trough.shape().at_unit_density.centre.y(), 1e-12);
  EXPECT_TRUE(hollow_bottoms<2>(box(1, 1).surface, at(0)).empty());
  EXPECT_TRUE(hollow_bottoms<2>(trough.surface(), at(0, std::numbers::pi)).empty());
}

}  // namespace splashdown::rigid::hollows_test
