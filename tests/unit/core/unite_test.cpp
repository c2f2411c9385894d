#include "core/surface/unite.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>

#include "rigid/shapes/mass_properties.hpp"
#include "rigid/shapes/solids.hpp"

namespace splashdown::unite_test {
namespace {

template <int d>
Surface<d> moved(Surface<d> surface, const Vec<d>& by) {
  surface.vertices.colwise() += by;
  return surface;
}
template <int d>
double enclosed(const Surface<d>& surface) {
  return rigid::mass_properties<d>(surface).mass;
}

// |A or B| = |A| + |B| - |A and B|: what two boxes share is a box.
template <int d, class Box>
void expect_sum_of_boxes(const Box& box) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.7, 0.7), length(0.3, 1.5);
  for (int drawn = 0; drawn < 30; ++drawn) {
    std::array<Surface<d>, 2> parts;
    std::array<Vec<d>, 2> centre, size;
    for (std::size_t i = 0; i < 2; ++i) {
      for (int k = 0; k < d; ++k) {
        centre[i][k] = place(random);
        size[i][k] = length(random);
      }
      parts[i] = moved<d>(box(size[i]), centre[i]);
    }
    const Vec<d> low = (centre[0] - size[0] / 2).cwiseMax(centre[1] - size[1] / 2),
                 high = (centre[0] + size[0] / 2).cwiseMin(centre[1] + size[1] / 2);
    const double shared = (high - low).cwiseMax(0).prod();
    EXPECT_NEAR(enclosed<d>(united<d>(parts)), size[0].prod() + size[1].prod() - shared, 1e-9);
  }
}

TEST(Union, of_two_boxes_has_the_area_of_both_less_what_they_share) {
  expect_sum_of_boxes<2>([](const Vec<2>& size) { return rigid::box(size.x(), size.y()).surface; });
}
TEST(Union, of_two_boxes_in_space_has_the_volume_of_both_less_what_they_share) {
  expect_sum_of_boxes<3>([](const Vec<3>& size) { return rigid::box(size).surface; });
}

TEST(Union, of_frames_keeps_the_hole) {
  const std::array<Surface<2>, 4> sides{
      moved<2>(rigid::box(3, 1).surface, {0, -1}), moved<2>(rigid::box(3, 1).surface, {0, 1}),
      moved<2>(rigid::box(1, 3).surface, {-1, 0}), moved<2>(rigid::box(1, 3).surface, {1, 0})};
  const auto frame = united<2>(sides);
  EXPECT_EQ(frame.vertices.cols(), 8);
  EXPECT_NEAR(enclosed<2>(frame), 8, 1e-12);
}

TEST(Union, of_parts_apart_keeps_both) {
  const std::array<Surface<2>, 2> apart{rigid::circle(1).surface, moved<2>(rigid::circle(1).surface, {3, 0})};
  EXPECT_NEAR(enclosed<2>(united<2>(apart)), 2 * enclosed<2>(apart[0]), 1e-12);
}

// A bird with a hemispherical face: half a sphere beside its cylinder.
TEST(Union, of_a_cylinder_and_a_sphere_at_its_end_is_a_bird) {
  const std::array<Vec<2>, 2> side{Vec<2>(1, 0), {1, 2}};
  const std::array<Surface<3>, 2> parts{rigid::revolved(side).surface, rigid::sphere(1).surface};
  const double exact = std::numbers::pi * (2 + 2. / 3);
  EXPECT_NEAR(enclosed<3>(united<3>(parts)), exact, 1e-3 * exact);  // facets: 0.05 %
}

}  // namespace
}  // namespace splashdown::unite_test
