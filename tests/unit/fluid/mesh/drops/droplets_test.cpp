#include "fluid/pfem/mesh/drops/droplets.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::droplets_test {
namespace {

template <class D>
class Droplets : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Droplets, Dimensions);

template <int d>
struct Carried {
  double volume = 0, energy = 0;
  Vec<d> momentum = Vec<d>::Zero(), moment = Vec<d>::Zero();
};

template <int d>
Carried<d> carried(const Nodes<d>& nodes, const std::vector<char>& left) {
  Carried<d> sum;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!left[i]) continue;
    sum.volume += nodes.volume[i];
    sum.momentum += nodes.volume[i] * nodes.v[i];
    sum.moment += nodes.volume[i] * nodes.x[i];
    sum.energy += 0.5 * nodes.volume[i] * nodes.v[i].squaredNorm();
  }
  return sum;
}

template <int d>
int add_drop(Nodes<d>& nodes, const Vec<d>& x, const Vec<d>& v, double volume, double size = 1) {
  const int n = nodes.add(x, v, 0, {}, false, size);
  nodes.spray[n] = 1;
  nodes.volume[n] = volume;
  return n;
}

template <int d>
Nodes<d> cloud(double spacing, int count) {
  std::mt19937 random(5);
  Nodes<d> nodes;
  for (int k = 0; k < count; ++k)
    add_drop<d>(nodes, spacing * scenes::random_vector<Vec<d>>(random, {}), scenes::random_vector<Vec<d>>(random, {}),
                std::uniform_real_distribution<double>(1e-6, 1e-5)(random));
  return nodes;
}

TYPED_TEST(Droplets, that_join_keep_volume_momentum_and_centre_and_lose_energy) {
  constexpr int d = TypeParam::value;
  auto nodes = cloud<d>(0.02, 200);
  const std::vector<char> all(nodes.size(), 1);
  const auto before = carried<d>(nodes, all);
  const auto left = join_drops<d>(nodes);
  const auto after = carried<d>(nodes, left);
  EXPECT_LT(std::accumulate(left.begin(), left.end(), 0), 200);
  EXPECT_NEAR(after.volume, before.volume, 200 * scenes::eps * before.volume);
  EXPECT_LE((after.momentum - before.momentum).norm(), 200 * scenes::eps * before.volume * std::sqrt(d));
  EXPECT_LE((after.moment - before.moment).norm(), 200 * scenes::eps * before.volume);
  EXPECT_LE(after.energy, before.energy);
}

TYPED_TEST(Droplets, join_where_they_touch_by_their_own_size) {
  constexpr int d = TypeParam::value;
  const double V = 1e-7, s = drop_size<d>(V);
  for (double gap : {0.9, 1.1}) {
    Nodes<d> nodes;
    add_drop<d>(nodes, Vec<d>::Zero(), Vec<d>::Zero(), V);
    add_drop<d>(nodes, gap * s * Vec<d>::Unit(0), Vec<d>::Zero(), V);
    const auto left = join_drops<d>(nodes);
    EXPECT_EQ(left[0] + left[1], gap < 1 ? 1 : 2) << "however coarse the mesh is that they fly over";
  }
}

TYPED_TEST(Droplets, grow_no_larger_than_the_elements_there) {
  constexpr int d = TypeParam::value;
  Nodes<d> nodes;
  for (int k = 0; k < 2; ++k) add_drop<d>(nodes, Vec<d>::Zero(), Vec<d>::Zero(), 1e-6, drop_size<d>(1.9e-6));
  const auto left = join_drops<d>(nodes);
  EXPECT_EQ(left[0] + left[1], 2);
}

TYPED_TEST(Droplets, that_land_raise_the_surface_by_their_volume_and_bring_their_momentum) {
  constexpr int d = TypeParam::value;
  scenes::Lattice<d> pool(4);
  auto& nodes = pool.nodes;
  nodes.volume = nodal_volumes(pool.mesh, nodes.x);
  for (auto& f : pool.mesh.boundary) f.wall = -1;
  for (auto& tie : nodes.tie) tie = {};
  const double V = 1e-5;
  // Well inside: the surface gives way to it all the same.
  const int drop = add_drop<d>(nodes, Vec<d>::Constant(0.4), Vec<d>::Constant(-3), V);
  const int far = add_drop<d>(nodes, Vec<d>::Constant(2), Vec<d>::Constant(-3), V);
  nodes.h.assign(nodes.size(), 0.25);
  std::vector<char> left(nodes.size(), 1);
  const double enclosed = enclosed_volume(pool.mesh.boundary, nodes.x);
  const auto before = carried<d>(nodes, left);
  absorb_drops<d>(nodes, pool.mesh.boundary, {}, left);
  EXPECT_FALSE(left[drop]);
  EXPECT_TRUE(left[far]);
  const auto after = carried<d>(nodes, left);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e3 * scenes::eps * before.momentum.norm());
  EXPECT_LE(after.energy, before.energy);
  // The shift is V / (d area); what it does at second order is its share of the facets' length.
  EXPECT_NEAR(enclosed_volume(pool.mesh.boundary, nodes.x) - enclosed, V, 1e-2 * V);
}

// Such a drop lies on the facets of the liquid there, neither inside nor outside of them.
TYPED_TEST(Droplets, that_slide_along_a_wall_land_in_the_water_that_wets_it) {
  constexpr int d = TypeParam::value;
  scenes::Tank<d> tank(4);
  auto& nodes = tank.nodes;
  nodes.volume = nodal_volumes(tank.mesh, nodes.x);
  const auto count = nodes.size();
  const auto on_wall = [&](double up) {
    return add_drop<d>(nodes, scenes::point<d>(0.5, up) - 0.5 * Vec<d>::Unit(0), -Vec<d>::Unit(d - 1), 1e-6);
  };
  const int below = on_wall(0.4), above = on_wall(1.4);
  nodes.h.assign(nodes.size(), 0.25);
  std::vector<char> left(nodes.size(), 1);
  const auto before = carried<d>(nodes, left);
  absorb_drops<d>(nodes, tank.mesh.boundary, tank.at(), left);
  EXPECT_FALSE(left[below]);
  EXPECT_TRUE(left[above]);
  const auto after = carried<d>(nodes, left);
  EXPECT_NEAR(after.volume, before.volume, static_cast<double>(count) * scenes::eps);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e3 * scenes::eps * before.momentum.norm());
}

TYPED_TEST(Droplets, that_land_at_a_contact_line_leave_its_nodes_on_the_wall) {
  constexpr int d = TypeParam::value;
  scenes::Tank<d> tank(4);
  auto& nodes = tank.nodes;
  nodes.volume = nodal_volumes(tank.mesh, nodes.x);
  nodes.h.assign(nodes.size(), 0.25);
  Vec<d> place = scenes::point<d>(0.4, 1);
  place[0] = 0.1;
  const int drop = add_drop<d>(nodes, place, -Vec<d>::Unit(d - 1), 1e-4);
  std::vector<char> left(nodes.size(), 1);
  const auto before = nodes.x;
  absorb_drops<d>(nodes, tank.mesh.boundary, tank.at(), left);
  EXPECT_FALSE(left[drop]);
  EXPECT_NE(nodes.x, before);  // others give way
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.tie[i].wall >= 0) {
      EXPECT_EQ(nodes.x[i], before[i]);
    }
  }
}

// Both sides of a sheet without thickness: the nodes of its facets have no area that could give way.
TYPED_TEST(Droplets, without_volume_leave_a_surface_without_area_where_it_is) {
  constexpr int d = TypeParam::value;
  Nodes<d> nodes;
  Facet<d> front;
  front.wall = -1;
  for (int k = 0; k < d; ++k) front.nodes[k] = nodes.add(Vec<d>::Unit(k), Vec<d>::Zero(), 0, {}, true, 1);
  Facet<d> back = front;
  std::swap(back.nodes[0], back.nodes[1]);
  add_drop<d>(nodes, Vec<d>::Constant(1.0 / d), Vec<d>::Ones(), 0);
  std::vector<char> left(nodes.size(), 1);
  absorb_drops<d>(nodes, {front, back}, {}, left);
  for (int k = 0; k < d; ++k) EXPECT_EQ(nodes.x[k], Vec<d>(Vec<d>::Unit(k)));
}

}  // namespace
}  // namespace splashdown::fluid::droplets_test
