#include <gtest/gtest.h>

#include "apps/record/probes.hpp"
#include "box_of_water.hpp"
#include "stand_ins.hpp"

namespace splashdown::apps::patch_test {
namespace {

template <int d>
Isometry<d> somewhere() {
  Isometry<d> pose = Isometry<d>::Identity();
  pose.translation()(d - 1) = -3;
  pose.translation()(0) = 0.3;
  if constexpr (d == 2)
    pose.rotate(0.4);
  else
    pose.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  return pose;
}

template <int d>
double mean(const BoxOfWater<d>& box, const Isometry<d>& pose, const PatchRegion<d>& region) {
  return patch_force<d>(box.wall(pose), box.p, region) / patch_area<d>(region, box.hull);
}

// Linear pressure on flat facets that are cut exactly: the mean is the pressure at the centroid of the patch, to rounding
// of a few hundred sums.
template <int d>
void hydrostatic_patch_has_rho_g_z() {
  const auto pose = somewhere<d>();
  const auto box = box_of_water<d>(pose);
  Vec<d> low = Vec<d>::Constant(-0.21), high = Vec<d>::Constant(0.33);
  low(0) = 0.4, high(0) = 0.7;  // a part of the face x = 1/2
  Vec<d> centroid = 0.5 * (low + high);
  centroid(0) = 0.5;
  const auto region = box_region<d>(low, high);
  EXPECT_NEAR(patch_area<d>(region, box.hull), std::pow(0.54, d - 1), 1e-14);
  EXPECT_NEAR(mean<d>(box, pose, region), hydrostatic<d>(pose * centroid), 1e-12 * 3 * weight);

  Vec<d> centre = Vec<d>::Constant(0.11);
  centre(d - 1) = -0.5;
  const auto disc = disc_region<d>(centre, 0.2, -Vec<d>::Unit(d - 1));
  EXPECT_NEAR(patch_area<d>(disc, box.hull), d == 2 ? 0.4 : std::numbers::pi * 0.04, 1e-14);
  EXPECT_NEAR(mean<d>(box, pose, disc), hydrostatic<d>(pose * centre), 1e-12 * 3 * weight);
}

TEST(Patch, of_a_box_under_water_has_rho_g_z) {
  hydrostatic_patch_has_rho_g_z<2>();
  hydrostatic_patch_has_rho_g_z<3>();
}

// All around: the force of the pressure's sum, whatever the cuts.
TEST(Patch, around_the_whole_box_has_the_mean_pressure_of_its_centre) {
  const auto pose = somewhere<3>();
  const auto box = box_of_water<3>(pose);
  const auto all = box_region<3>(Vec<3>::Constant(-1), Vec<3>::Constant(1));
  EXPECT_NEAR(patch_area<3>(all, box.hull), 6, 1e-13);
  EXPECT_NEAR(mean<3>(box, pose, all), 3 * weight, 1e-12 * 3 * weight);
}

TEST(Patch, its_dry_part_counts_with_zero) {
  const std::vector<Vec<2>> x{{0, 0}, {1, 0}};
  const std::vector<double> p{10, 10};
  const std::vector<Facet<2>> boundary{{{1, 0}, 0}, {{0, 1}, -1}};
  Surface<2> hull;  // runs on, dry, to x = 3
  hull.vertices.resize(2, 2);
  hull.vertices << 0, 3, 0, 0;
  hull.facets.resize(2, 1);
  hull.facets << 0, 1;
  const auto region = box_region<2>({0.5, -1}, {1.5, 1});
  EXPECT_NEAR(patch_force<2>({x, boundary, 0}, p, region) / patch_area<2>(region, hull), 5, 1e-14);
}

// A plate thinner than the patch's radius: the other side is no part of it.
TEST(Patch, on_a_thin_plate_takes_one_side) {
  Surface<2> plate = unit_box<2>();
  plate.vertices.row(1) *= 0.01;
  const auto below = disc_region<2>({0, -0.005}, 0.1, {0, -1});
  EXPECT_NEAR(patch_area<2>(below, plate), 0.2, 1e-15);
}

TEST(Patch, that_misses_the_hull_has_no_area) {
  EXPECT_EQ((patch_area<3>(box_region<3>({2, 2, 2}, {3, 3, 3}), unit_box<3>())), 0);
  EXPECT_EQ((patch_area<3>(box_region<3>({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), unit_box<3>())), 0);
}

// A wall that is stretched and turned: what water touches goes back to where it was, in the same share of its facet.
TEST(Patch, of_a_wall_that_deforms_is_what_it_was_at_rest) {
  const auto square = unit_box<2>();
  DrawnFluid<2> fluid;
  fluid.made = {{.name = "square", .surface = square, .deforms = true}};
  fluid.poses = {Isometry<2>::Identity()};
  const Eigen::Rotation2Dd turn(0.7);
  const auto moved = [&](const Vec<2>& X) -> Vec<2> { return turn * Vec<2>(3 * X.x(), 0.5 * X.y()) + Vec<2>(5, -2); };
  std::vector<Vec<2>> rest;
  for (Eigen::Index f = 0; f < square.facets.cols(); ++f)
    for (const double share : {0.2, 0.9}) {
      rest.emplace_back((1 - share) * square.vertices.col(square.facets(0, f)) +
                        share * square.vertices.col(square.facets(1, f)));
      fluid.x.push_back(moved(rest.back()));
    }
  for (int f = 0; f < 4; ++f) fluid.facets.push_back({{2 * f + 1, 2 * f}, 0});
  const Vec<2> far(9, 9);
  fluid.x.push_back(far);
  EXPECT_TRUE(points_at_rest<2>(fluid, 0).empty()) << "it is rigid";
  fluid.bent = {square.vertices};
  for (Eigen::Index v = 0; v < square.vertices.cols(); ++v) fluid.bent[0].col(v) = moved(square.vertices.col(v));
  const auto found = points_at_rest<2>(fluid, 0);
  ASSERT_EQ(found.size(), fluid.x.size());
  for (std::size_t k = 0; k < rest.size(); ++k) EXPECT_LT((found[k] - rest[k]).norm(), 1e-13) << k;
  EXPECT_EQ(found.back(), far) << "on no wall";
}

}  // namespace
}  // namespace splashdown::apps::patch_test
