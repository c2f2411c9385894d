#include "apps/record/probes.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace splashdown::apps::probes_test {
namespace {

Surface<2> polygon(const std::vector<Vec<2>>& points) {
  Surface<2> surface;
  const auto count = static_cast<Eigen::Index>(points.size());
  surface.vertices.resize(2, count);
  surface.facets.resize(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    surface.vertices.col(i) = points[static_cast<std::size_t>(i)];
    surface.facets.col(i) << static_cast<int>(i), static_cast<int>((i + 1) % count);
  }
  return surface;
}

const Isometry<2> at_rest = Isometry<2>::Identity();

TEST(Elevation, is_the_highest_crossing_of_the_free_surface) {
  const std::vector<Vec<2>> x{{0, 1}, {1, 2}, {2, 2}, {0.5, 3}, {1.5, 3}};
  std::vector<Facet<2>> boundary{{{1, 0}, -1}, {{2, 1}, -1}};
  using At = Eigen::Matrix<double, 1, 1>;
  EXPECT_DOUBLE_EQ(*surface_elevation<2>(x, boundary, At(0.25)), 1.25);
  EXPECT_DOUBLE_EQ(*surface_elevation<2>(x, boundary, At(1.0)), 2);  // at a node
  EXPECT_FALSE(surface_elevation<2>(x, boundary, At(2.5)));
  boundary.push_back({{4, 3}, -1});  // a jet above
  EXPECT_DOUBLE_EQ(*surface_elevation<2>(x, boundary, At(1.0)), 3);
  boundary.back().wall = 0;  // a hull above
  EXPECT_DOUBLE_EQ(*surface_elevation<2>(x, boundary, At(1.0)), 2);
}

TEST(Elevation, of_a_tilted_plane_in_space_is_exact) {
  const std::vector<Vec<3>> x{{0, 0, 1}, {1, 0, 3}, {0, 1, 4}};
  const std::vector<Facet<3>> boundary{{{0, 1, 2}, -1}};
  EXPECT_NEAR(*surface_elevation<3>(x, boundary, Eigen::Vector2d(0.25, 0.5)), 1 + 2 * 0.25 + 3 * 0.5, 1e-14);
  EXPECT_FALSE(surface_elevation<3>(x, boundary, Eigen::Vector2d(0.75, 0.5)));
}

TEST(WallPressure, is_interpolated_at_the_nearest_wetted_facet_and_absent_far_away) {
  const std::vector<Vec<2>> x{{0, 0}, {1, 0}, {1, 1}};
  const std::vector<double> p{10, 20, 40};
  const std::vector<Facet<2>> boundary{{{0, 1}, 0}, {{1, 2}, 1}, {{2, 0}, -1}};
  EXPECT_NEAR(*wall_pressure<2>(x, boundary, p, {0.3, -0.01}), 13, 1e-12);
  EXPECT_NEAR(*wall_pressure<2>(x, boundary, p, {1.01, 0.5}), 30, 1e-12);
  EXPECT_FALSE(wall_pressure<2>(x, boundary, p, {0.3, -0.6}));
}

TEST(Ruler, measures_a_wedge_from_its_keel_with_opposite_signs_on_its_faces) {
  const SurfaceRuler<2> ruler(polygon({{0, 0}, {3, 4}, {-3, 4}}), at_rest);
  EXPECT_NEAR(ruler.distance({0, 0}), 0, 1e-14);
  EXPECT_NEAR(ruler.distance({1.5, 2}), 2.5, 1e-14);
  EXPECT_NEAR(ruler.distance({-1.5, 2}), -2.5, 1e-14);
}

TEST(Ruler, begins_in_the_middle_of_a_level_bottom) {
  const SurfaceRuler<2> ruler(polygon({{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}), at_rest);
  EXPECT_NEAR(ruler.distance({0, 0}), 0, 1e-14);
  EXPECT_NEAR(ruler.distance({0.5, 0}), 0.5, 1e-14);
  EXPECT_NEAR(ruler.distance({-1, 0.25}), -1.25, 1e-14);
}

TEST(Ruler, the_keel_is_what_is_lowest_in_the_first_pose) {
  Isometry<2> upside_down = at_rest;
  upside_down.rotate(Eigen::Rotation2Dd(std::numbers::pi));
  const SurfaceRuler<2> ruler(polygon({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}), upside_down);
  EXPECT_NEAR(ruler.distance({0, 1}), 0, 1e-14);
}

TEST(SurfacePressure, has_the_wetted_points_of_one_wall_in_order) {
  const std::vector<Vec<2>> x{{0, 0}, {0.6, 0.8}, {-0.6, 0.8}, {2, 0}};
  const std::vector<double> p{5, 6, 7, 8};
  const std::vector<Facet<2>> boundary{{{0, 1}, 0}, {{2, 0}, 0}, {{1, 3}, -1}};
  const SurfaceRuler<2> ruler(polygon({{0, 0}, {3, 4}, {-3, 4}}), at_rest);
  const std::vector<double> repair{1, 2, 3, 4};
  const auto points = surface_pressure<2>({x, boundary, 0}, p, repair, ruler);
  ASSERT_EQ(points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(points[i].s, static_cast<double>(i) - 1, 1e-14);
  EXPECT_EQ(points[0].p, 7);
  EXPECT_EQ(points[1].p, 5);
  EXPECT_EQ(points[2].p, 6);
  EXPECT_EQ(points[0].p_repair, 3);
  EXPECT_EQ(surface_pressure<2>({x, boundary, 0}, p, {}, ruler)[0].p_repair, 0) << "none was made";
}

TEST(SurfacePressure, of_a_wall_that_deforms_is_measured_along_what_it_was) {
  const std::vector<Vec<2>> at_start{{0, 0}, {0.6, 0.8}, {-0.6, 0.8}, {2, 0}};
  std::vector<Vec<2>> x;
  for (const auto& from : at_start)
    x.emplace_back(from + Vec<2>(7, 0.3 * from.x() * from.x()));  // carried off and bent
  const std::vector<double> p{5, 6, 7, 8};
  const std::vector<Facet<2>> boundary{{{0, 1}, 0}, {{2, 0}, 0}, {{1, 3}, -1}};
  const SurfaceRuler<2> ruler(polygon({{0, 0}, {3, 4}, {-3, 4}}), at_rest);
  const auto points = surface_pressure<2>({x, boundary, 0}, p, {}, ruler, at_start);
  ASSERT_EQ(points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(points[i].s, static_cast<double>(i) - 1, 1e-14);
  EXPECT_EQ(points[0].x, x[2]) << "where it is";
  EXPECT_EQ(points[0].on_wall, at_start[2]) << "where it was";
}

}  // namespace
}  // namespace splashdown::apps::probes_test
