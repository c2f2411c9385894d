#include "apps/record/frames/hull_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "box_of_water.hpp"

namespace splashdown::apps::hull_map_test {
namespace {

template <int d>
double area_of(const Surface<d>& surface) {
  double area = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[static_cast<std::size_t>(k)] = surface.vertices.col(surface.facets(k, f));
    area += area_vector(corner).norm();
  }
  return area;
}

TEST(Refined, a_closed_surface_stays_closed_and_has_no_long_edge) {
  const auto box = unit_box<3>();
  const auto fine = refined<3>(box, 0.11);
  std::map<std::pair<int, int>, int> uses;  // of directed edges
  for (Eigen::Index f = 0; f < fine.facets.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = fine.facets(k, f), b = fine.facets((k + 1) % 3, f);
      ++uses[{a, b}];
      EXPECT_LE((fine.vertices.col(a) - fine.vertices.col(b)).norm(), 0.11);
    }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(uses.contains({edge.second, edge.first}));
  }
  EXPECT_NEAR(area_of<3>(fine), 6, 1e-12);
  EXPECT_NEAR(area_of<2>(refined<2>(unit_box<2>(), 0.03)), 4, 1e-13);
  EXPECT_EQ(refined<2>(unit_box<2>(), 0.03).vertices.cols(), 4 * 64);  // 1/32 is too long
}

// Every point of a box under water has the linear pressure of its place.
template <int d>
void map_of_a_hydrostatic_box() {
  Isometry<d> pose = Isometry<d>::Identity();
  pose.translation()(d - 1) = -3;
  if constexpr (d == 2)
    pose.rotate(0.4);
  else
    pose.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto box = box_of_water<d>(pose);
  HullMap<d> map(box.hull, 0.1);
  map.add(box.wall(pose), box.p, {}, {0.5, 0.4, 0.6});
  for (std::size_t i = 0; i < map.pressure().size(); ++i) {
    const Vec<d> x = map.surface().vertices.col(static_cast<Eigen::Index>(i));
    EXPECT_EQ(map.time()[i], 0.5);
    // Random cuts leave slivers down to a hundredth of a side, through which pressure is found to eps over their height.
    EXPECT_NEAR(map.pressure()[i], hydrostatic<d>(pose * x), 1e-9 * 3 * weight);
  }
}

TEST(HullMap, of_a_box_under_water_is_rho_g_z_everywhere) {
  map_of_a_hydrostatic_box<2>();
  map_of_a_hydrostatic_box<3>();
}

TEST(HullMap, keeps_the_maximum_pressure_and_its_first_time_and_sums_impulses) {
  auto box = box_of_water<3>(Isometry<3>::Identity());
  HullMap<3> map(box.hull, 0.25);
  const std::vector<double> repair(box.p.size(), 2.0);
  double time = 0;
  for (const double pressure : {5., 8., 8., 3.}) {
    std::ranges::fill(box.p, pressure);
    map.add(box.wall(Isometry<3>::Identity()), box.p, repair, {time, time, time + 0.5});
    ++time;
  }
  for (std::size_t i = 0; i < map.pressure().size(); ++i) {
    EXPECT_NEAR(map.pressure()[i], 8, 1e-12);
    EXPECT_LE(map.time()[i], 2);  // barycentric weights add up to one but for rounding
    EXPECT_GE(map.time()[i], 1);
    EXPECT_NEAR(map.impulse()[i], 0.5 * (5 + 8 + 8 + 3 + 4 * 2), 1e-11) << "with what repairs add, once on an edge";
  }
}

TEST(HullMap, what_stays_dry_has_no_time) {
  auto box = box_of_water<3>(Isometry<3>::Identity());
  for (auto& facet : box.boundary) {  // wet at the bottom only
    for (const int node : facet.nodes)
      if (box.x[static_cast<std::size_t>(node)].z() > -0.49) facet.wall = -1;
  }
  HullMap<3> map(box.hull, 0.25);
  map.add(box.wall(Isometry<3>::Identity()), box.p, {}, {1, 1, 2});
  for (std::size_t i = 0; i < map.pressure().size(); ++i) {
    const double z = map.surface().vertices(2, static_cast<Eigen::Index>(i));
    EXPECT_EQ(std::isfinite(map.time()[i]), z < -0.49) << z;
    if (z > -0.49) {
      EXPECT_EQ(map.pressure()[i], 0);
      EXPECT_EQ(map.impulse()[i], 0);
    }
  }
}

// A thin plate, wet below: its upper side is nearer than half an element, and dry.
TEST(HullMap, the_other_side_of_a_thin_plate_is_not_wetted) {
  Surface<2> plate = unit_box<2>();
  plate.vertices.row(1) *= 0.02;
  const std::vector<Vec<2>> x{{-0.5, -0.01}, {0.5, -0.01}};
  const std::vector<double> p{7, 7};
  const std::vector<Facet<2>> boundary{{{1, 0}, 0}};
  HullMap<2> map(plate, 0.1);
  map.add({x, boundary, 0}, p, {}, {0, 0, 1});
  for (std::size_t i = 0; i < map.pressure().size(); ++i) {
    const Vec<2> at = map.surface().vertices.col(static_cast<Eigen::Index>(i));
    if (std::abs(at.x()) < 0.49) {
      EXPECT_EQ(map.pressure()[i] > 0, at.y() < 0) << at.transpose();
    }
  }
}

}  // namespace
}  // namespace splashdown::apps::hull_map_test
