// What an outline covers and encloses.
#include "fluid/vortex/penalised/outline.hpp"

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace splashdown::vortex::outline_test {
namespace {

TEST(Outline, moments_are_those_of_a_box_off_its_origin) {
  auto outline = scenes::box(2, 1);
  outline.vertices.colwise() += Vec<2>(0.5, 0.25);
  const auto m = moments_of(outline);
  EXPECT_NEAR(m.area, 2, 1e-14);
  EXPECT_NEAR((m.centroid - Vec<2>(0.5, 0.25)).norm(), 0, 1e-14);
  EXPECT_NEAR(m.polar, 2 * (4 + 1) / 12. + 2 * Vec<2>(0.5, 0.25).squaredNorm(), 1e-13);
  EXPECT_NEAR(m.length, 6, 1e-14);
  EXPECT_FALSE(m.is_inside_out());
  outline.facets.row(0).swap(outline.facets.row(1));
  EXPECT_TRUE(moments_of(outline).is_inside_out());
}

double covered(double h, double width) {
  const Grid g{.min = {-1, -1}, .h = h, .nx = static_cast<int>(2 / h + 0.5), .ny = static_cast<int>(2 / h + 0.5)};
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translation() = Vec<2>(0.013, -0.021);
  const auto outline = scenes::circle(0.5, 400);
  const auto box = box_around(g, outline, pose, width * h, 3);
  FaceField chi;
  cover(g, box, outline, pose, width * h, false, chi);
  double sum = 0;
  for (const double c : chi.u) sum += c;
  return sum * h * h;
}

// Sharp outlines are counted like lattice points, h^(3/2) or so; smoothed ones are integrated, drawn in by a third.
TEST(Outline, covers_its_area) {
  const double area = moments_of(scenes::circle(0.5, 400)).area;
  EXPECT_NEAR(covered(1. / 64, 0), area, 2 * std::pow(1. / 64, 1.5));
  const double smaller = area * std::pow(1 - 0.5 / 64 / 0.5, 2);
  EXPECT_NEAR(covered(1. / 64, 1.5), smaller, 1e-3 * area);
}

// Boxes are larger than they need to be; that may not push them out of a grid in which the body has its rim.
TEST(Outline, its_box_stays_on_the_grid) {
  const auto outline = scenes::circle(0.5, 60);
  for (const double x : {-0.9, -0.2, 0.3, 0.9}) {
    const Grid g{.min = {-1.6, -1.6}, .h = 0.1, .nx = 32, .ny = 32};
    Isometry<2> pose = Isometry<2>::Identity();
    pose.translation() = Vec<2>(0.8 * x, x);
    const auto box = box_around(g, outline, pose, 0, 3);
    EXPECT_GE(std::min(box.i0, box.j0), -1);
    EXPECT_LE(box.i0 + box.width, g.nx + 2);
    EXPECT_LE(box.j0 + box.height, g.ny + 2);
  }
}

TEST(Outline, a_turned_box_covers_what_lies_inside_of_it) {
  const auto g = scenes::square_grid(64);
  Isometry<2> pose = Isometry<2>::Identity();
  pose.linear() = Eigen::Rotation2Dd(0.4).toRotationMatrix();
  const auto outline = scenes::box(0.8, 0.3);
  const auto box = box_around(g, outline, pose, 0, 2);
  FaceField chi;
  cover(g, box, outline, pose, 0, false, chi);
  for (int j = 0; j + 1 < box.height; ++j)
    for (int i = 0; i < box.width; ++i) {
      const Vec<2> x = pose.inverse() * (g.node(box.i0 + i, box.j0 + j) + Vec<2>(0, 0.5 * g.h));
      const bool inside = std::abs(x.x()) < 0.4 && std::abs(x.y()) < 0.15;
      EXPECT_EQ(chi.u[box.at(i, j)], inside ? 1 : 0);
    }
}

TEST(Outline, inside_out_it_covers_the_rest) {
  const auto g = scenes::square_grid(32);
  const FaceBox all{0, 0, g.nx + 1, g.ny + 1};
  const auto outline = scenes::box(1, 1);
  FaceField inside, outside;
  cover(g, all, outline, Isometry<2>::Identity(), 0, false, inside);
  cover(g, all, outline, Isometry<2>::Identity(), 0, true, outside);
  for (int j = 0; j < g.ny; ++j)
    for (int i = 0; i <= g.nx; ++i) EXPECT_EQ(inside.u[all.at(i, j)] + outside.u[all.at(i, j)], 1);
}

}  // namespace
}  // namespace splashdown::vortex::outline_test
