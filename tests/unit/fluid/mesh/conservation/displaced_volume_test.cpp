#include "fluid/pfem/mesh/conservation/displaced_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splashdown::fluid::displaced_volume_test {
namespace {

template <class D>
class DisplacedVolumes : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(DisplacedVolumes, Dimensions);

constexpr double side = 0.5;

/// The simplex from `corner` along the axes as a hull in the midst of water: its facets, of wall 1, look inwards. Wall 0 and
/// other facets are elsewhere.
template <int d>
struct Sunken {
  std::vector<Vec<d>> x;
  Mesh<d> mesh;

  explicit Sunken(const Vec<d>& corner) {
    x.push_back(corner);
    for (int k = 0; k < d; ++k) x.push_back(corner + side * Vec<d>::Unit(k));
    std::array<int, d + 1> cell;
    for (int k = 0; k <= d; ++k) cell[k] = k;
    for (int k = 0; k <= d; ++k) {
      auto nodes = facet_nodes(cell, k);
      std::swap(nodes[0], nodes[1]);
      add(nodes, 1);
    }
    std::array<int, d> beside;
    for (int k = 0; k < d; ++k) beside[k] = static_cast<int>(x.size()), x.push_back(2 * Vec<d>::Unit(k));
    add(beside, 0), add(beside, -1);
  }
  void add(const std::array<int, d>& nodes, int wall) {
    Facet<d> facet;
    facet.nodes = nodes;
    facet.wall = wall;
    mesh.boundary.push_back(facet);
  }
};

TYPED_TEST(DisplacedVolumes, have_the_volume_and_the_centre_of_their_hull) {
  constexpr int d = TypeParam::value;
  for (const double far : {0.0, 1e3}) {
    const Vec<d> corner = Vec<d>::Constant(far);
    const Sunken<d> hull(corner);
    const auto found = displaced_volumes(hull.mesh, hull.x, 2);
    const double volume = std::pow(side, d) / (d == 2 ? 2 : 6);
    const double roundoff = 1e-15 * (side + far);  // of places
    ASSERT_TRUE(found[1].is_closed());
    EXPECT_NEAR(found[1].volume, volume, 10 * d * volume / side * roundoff);
    EXPECT_LT((found[1].centre - corner - Vec<d>::Constant(side / (d + 1))).norm(), 10 * d * roundoff);
    EXPECT_FALSE(found[0].is_closed()) << "another facet is at its nodes";
  }
}

TYPED_TEST(DisplacedVolumes, are_none_where_air_or_another_wall_meets_the_hull) {
  constexpr int d = TypeParam::value;
  for (const int wall : {-1, 0}) {
    Sunken<d> hull(Vec<d>::Zero());
    hull.mesh.boundary[0].wall = wall;
    EXPECT_FALSE(displaced_volumes(hull.mesh, hull.x, 2)[1].is_closed());
  }
  Sunken<d> tank(Vec<d>::Zero());
  for (auto& facet : tank.mesh.boundary) std::swap(facet.nodes[0], facet.nodes[1]);
  EXPECT_FALSE(displaced_volumes(tank.mesh, tank.x, 2)[1].is_closed()) << "water is inside";
}

}  // namespace
}  // namespace splashdown::fluid::displaced_volume_test
