// Chords of curved walls: what stands on them is water, what cuts a hull is in the solid.
#include "fluid/pfem/mesh/recognition/at_walls.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "fluid/pfem/initial/parts.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::at_walls_test {
namespace {

/// A cell of nodes on one wall and a last one off it, of a mesh that had no boundary there before.
template <int d>
struct Fresh {
  explicit Fresh(const Surface<d>& surface) : walls{Wall<d>(scenes::wall<d>("hull", surface, 0.1))} {}

  bool is_in_solid(const std::array<Vec<d>, d + 1>& corner) const {
    Nodes<d> nodes;
    std::array<int, d + 1> cell;
    Vec<d> centroid = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) {
      const auto& x = corner[static_cast<std::size_t>(k)];
      const WallTie tie = k < d ? tie_at<d>(x, at()) : WallTie{};
      EXPECT_EQ(tie.wall, k < d ? 0 : -1);
      cell[static_cast<std::size_t>(k)] = nodes.add(x, Vec<d>::Zero(), 0, tie, false, 0.1);
      centroid += x / (d + 1);
    }
    return in_solid<d>(cell, centroid, 0.1, nodes, {}, at());
  }
  WallsAt<d> at() const { return {walls, poses}; }

  std::vector<Wall<d>> walls;
  std::vector<WallPlace<d>> poses{Isometry<d>::Identity()};
};

// Beside the tip of a cone chords lie as deep in it as it is thick there. New ones come with every flip: without water on them the tip
// stood at a hole in which p = 0.
TEST(AtWalls, water_stands_on_new_chords_beside_a_tip) {
  for (const double height : {0.3, 0.7, 1.5, 3.0})
    for (const double apart : {20.0, 60.0, 100.0, 130.0}) {
      const Fresh<3> cone(scenes::cone(1, height, 96));
      const double half = apart / 2 * std::numbers::pi / 180, r = 0.1 / std::hypot(1, height);
      const Vec<3> tip = Vec<3>::Zero();
      // On the flat facets in the place of the side, which is nearest to what is a little outside.
      const auto on_side = [&](double angle) {
        return cone.walls[0].nearest(cone.poses[0], {r * std::cos(angle), r * std::sin(angle), height * r}, 1).point;
      };
      const Vec<3> a = on_side(half), b = on_side(-half);
      const Vec<3> out = r * Vec<3>(1, 0, height) + 0.02 * Vec<3>(height, 0, -1).normalized();
      EXPECT_FALSE(cone.is_in_solid({tip, a, b, out})) << height << " " << apart;
    }
}

TEST(AtWalls, what_joins_both_sides_of_a_thin_hull_is_in_it) {
  const Fresh<3> plate(scenes::block({-1, -1, 0}, {1, 1, 0.02}));
  EXPECT_TRUE(plate.is_in_solid({Vec<3>(0, 0, 0.02), {0.1, 0, 0.02}, {0.05, 0.1, 0}, {0.05, 0.03, 0.03}}));
  const Fresh<2> strip(scenes::ellipse(1, 0.05, 400));
  const auto on_hull = [&](double x, double y) { return strip.walls[0].nearest(strip.poses[0], {x, y}, 1).point; };
  EXPECT_TRUE(strip.is_in_solid({on_hull(0, 0.05), on_hull(0.1, -0.05), Vec<2>(0.05, 0.06)}));
}

}  // namespace
}  // namespace splashdown::fluid::at_walls_test
