// Velocity lines: exact for linear fields, nothing outside the fluid, the mirror image behind a plane of symmetry.
#include "apps/record/sections/velocity_lines.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "stand_ins.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::velocity_lines_test {
namespace {

/// A block from 0 to 1 along each axis as the simplices that share its diagonal, one for each order of the axes.
template <int d>
DrawnFluid<d> block(const Eigen::Matrix<double, d, d>& gradient, const Vec<d>& offset) {
  DrawnFluid<d> fluid;
  for (int corner = 0; corner < 1 << d; ++corner) {
    Vec<d> x;
    for (int k = 0; k < d; ++k) x(k) = corner >> k & 1;
    fluid.x.push_back(x);
    fluid.v.push_back(gradient * x + offset);
  }
  std::array<int, d> order;
  for (int k = 0; k < d; ++k) order[static_cast<std::size_t>(k)] = k;
  do {
    std::array<int, d + 1> cell{};
    for (std::size_t k = 0; k < d; ++k) cell[k + 1] = cell[k] + (1 << order[k]);
    fluid.simplices.push_back(cell);
  } while (std::ranges::next_permutation(order).found);
  return fluid;
}

template <int d>
void linear_fields_are_exact() {
  const Eigen::Matrix<double, d, d> gradient = Eigen::Matrix<double, d, d>::Random();
  const Vec<d> offset = Vec<d>::Random();
  const auto fluid = block<d>(gradient, offset);
  std::vector<Vec<d>> points;
  for (int k = 0; k < 50; ++k) points.emplace_back(0.5 * (Vec<d>::Random() + Vec<d>::Ones()));
  points.emplace_back(Vec<d>::Zero());
  points.emplace_back(Vec<d>::Constant(1.1));
  const auto found = velocities_at<d>(fluid, points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    ASSERT_TRUE(found[i]) << points[i].transpose();
    EXPECT_LT((*found[i] - gradient * points[i] - offset).norm(), 1e-12);
  }
  EXPECT_FALSE(found.back());
}

TEST(VelocityLines, are_exact_for_linear_fields) {
  linear_fields_are_exact<2>();
  linear_fields_are_exact<3>();
}

TEST(VelocityLines, tell_the_mirror_image_and_leave_out_what_is_dry) {
  const ScratchFolder folder;
  const auto fluid = block<2>(Eigen::Matrix2d::Identity(), Vec<2>(0, 0));  // v = x
  VelocityLineRecord<2> line{.name = "wake", .points = {}, .every = {}, .times = {}, .mirror = Mirror{}};
  line.mirror->axis = 0;
  line.mirror->at = 0;
  for (const double x : {-0.5, 0.25, 1.5}) line.points.emplace_back(x, 0.5);
  {
    CsvFile file(folder.path() / "velocity_lines.csv", velocity_lines_header);
    file.create();
    write_rows<2>(file, 2, line, fluid);
    file.write();
  }
  EXPECT_EQ(
      folder.text("velocity_lines.csv"),
      fmt::format("{}\n2,wake,0,-0.5,0.5,0,-0.5,0.5,0\n2,wake,0.75,0.25,0.5,0,0.25,0.5,0\n", velocity_lines_header));
}

}  // namespace
}  // namespace splashdown::apps::velocity_lines_test
