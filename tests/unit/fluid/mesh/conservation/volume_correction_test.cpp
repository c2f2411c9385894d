#include "fluid/pfem/mesh/conservation/volume_correction.hpp"

#include <gtest/gtest.h>

#include "fluid/pfem/mesh/parts.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::volume_correction_test {
namespace {

template <class D>
class VolumeCorrection : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(VolumeCorrection, Dimensions);

template <int d>
double in_the_books(const Nodes<d>& nodes) {
  return scenes::sum(nodes.volume) + scenes::sum(nodes.owed);
}

template <int d>
double enclosed(const scenes::Lattice<d>& pool) {
  return enclosed_volume(pool.mesh.boundary, pool.nodes.x);
}

template <int d>
double kinetic_energy(const std::vector<double>& volumes, const std::vector<Vec<d>>& v) {
  double twice = 0;
  for (std::size_t i = 0; i < volumes.size(); ++i) twice += volumes[i] * v[i].squaredNorm();
  return twice / 2;
}

template <int d>
double kinetic_energy(const scenes::Lattice<d>& pool) {
  return kinetic_energy<d>(nodal_volumes(pool.mesh, pool.nodes.x), pool.nodes.v);
}

/// A pool of volume 1 that the books know, in motion.
template <int d>
scenes::Lattice<d> pool() {
  scenes::Lattice<d> pool(4);
  pool.nodes.volume = nodal_volumes(pool.mesh, pool.nodes.x);
  for (std::size_t i = 0; i < pool.nodes.size(); ++i) pool.nodes.v[i] = Vec<d>::Constant(std::sin(double(i)));
  return pool;
}

template <int d>
void give_volume_back(scenes::Lattice<d>& pool, const WallsAt<d>& walls = {}) {
  const auto carried = pool.nodes.volume;
  return_volume<d>(pool.nodes, pool.mesh, walls, FreeWater<d>(pool.mesh, pool.nodes, walls),
                   nodal_volumes(pool.mesh, pool.nodes.x), carried);
}

/// Adds water that does not touch it. The first of its nodes.
template <int d>
std::size_t add_water(scenes::Lattice<d>& p, const scenes::Lattice<d>& other) {
  const auto first = static_cast<int>(p.nodes.size());
  for (std::size_t i = 0; i < other.nodes.size(); ++i) {
    const int n = p.nodes.add(other.nodes.x[i] + 3 * Vec<d>::UnitX(), other.nodes.v[i], 0, other.nodes.tie[i],
                              other.nodes.surface[i]);
    p.nodes.volume[n] = other.nodes.volume[i];
  }
  auto shifted = [&](auto simplex) {
    for (int& n : simplex) n += first;
    return simplex;
  };
  for (const auto& cell : other.mesh.cells) p.mesh.cells.push_back(shifted(cell));
  for (const auto& facet : other.mesh.boundary) {
    p.mesh.boundary.push_back(facet);
    p.mesh.boundary.back().nodes = shifted(facet.nodes);
  }
  return p.nodes.size() - other.nodes.size();
}

constexpr double lost = 1e-4;

TYPED_TEST(VolumeCorrection, what_the_mesh_lost_comes_back_wherever_it_was_lost) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  p.nodes.owed.front() = lost;
  const double books = in_the_books(p.nodes);
  give_volume_back(p);
  // Exact but for what the surface's own motion adds, of second order in what the surface moves by over its length.
  EXPECT_NEAR(enclosed(p), 1 + lost, 100 * lost * lost);
  EXPECT_NEAR(in_the_books(p.nodes), books, 10 * scenes::eps);
}

/// First moment of what the mesh encloses.
template <int d>
Vec<d> moment(const scenes::Lattice<d>& p) {
  const auto volumes = nodal_volumes(p.mesh, p.nodes.x);
  Vec<d> sum = Vec<d>::Zero();
  for (std::size_t i = 0; i < volumes.size(); ++i) sum += volumes[i] * p.nodes.x[i];
  return sum;
}

// So gravity does no work on it.
TYPED_TEST(VolumeCorrection, it_comes_back_about_the_place_where_it_was_lost) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  for (auto& tie : p.nodes.tie) tie = {};
  for (auto& surface : p.nodes.surface) surface = 1;
  for (auto& facet : p.mesh.boundary) facet.wall = -1;
  const auto beside_a_corner = [](const Vec<d>& x) { return (x - Vec<d>::Constant(0.3)).cwiseAbs().maxCoeff() < 0.15; };
  const auto place = std::ranges::find_if(p.nodes.x, beside_a_corner);
  ASSERT_NE(place, p.nodes.x.end());
  const Vec<d> lost_at = *place;
  p.nodes.owed[static_cast<std::size_t>(place - p.nodes.x.begin())] = lost;
  const Vec<d> before = moment<d>(p) + lost * lost_at;
  give_volume_back(p);
  EXPECT_NEAR(enclosed(p), 1 + lost, 100 * lost * lost);
  // Equal shares would have it about the middle.
  const Vec<d> middle = Vec<d>::Constant(0.5);
  EXPECT_LT((moment<d>(p) - before).norm(), 0.4 * (middle - lost_at).norm() * lost);
}

TYPED_TEST(VolumeCorrection, what_the_mesh_gained_goes_too) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  p.nodes.owed.back() = -lost;
  give_volume_back(p);
  EXPECT_NEAR(enclosed(p), 1 - lost, 100 * lost * lost);
}

TYPED_TEST(VolumeCorrection, no_kinetic_energy_comes_with_it) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  p.nodes.owed.front() = 100 * lost;
  const double before = kinetic_energy(p);
  give_volume_back(p);
  EXPECT_LE(kinetic_energy(p), before * (1 + 100 * scenes::eps));
}

// A pool on a wall, of which nodes had carried a tenth more than is left around them; `lost` of it comes back.
template <int d>
scenes::Lattice<d> cut_pool() {
  auto p = pool<d>();
  p.nodes.tie.front().wall = 0;
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    p.nodes.owed[i] = (lost - 0.1) * p.nodes.volume[i];
    p.nodes.volume[i] *= 1.1;
  }
  return p;
}

TYPED_TEST(VolumeCorrection, water_that_a_cut_has_made_smaller_and_that_grows_again_goes_on_at_its_speed) {
  constexpr int d = TypeParam::value;
  auto p = cut_pool<d>();
  const double had = kinetic_energy<d>(p.nodes.volume, p.nodes.v);
  const auto v = p.nodes.v;
  give_volume_back(p);
  EXPECT_NEAR(enclosed(p), 1 + lost, 100 * lost * lost);
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_EQ(p.nodes.v[i], v[i]);
  EXPECT_LE(kinetic_energy(p), had);
}

TYPED_TEST(VolumeCorrection, no_more_energy_comes_with_it_than_was_lost) {
  constexpr int d = TypeParam::value;
  auto p = cut_pool<d>();
  // One slow node has lost all that the fast ones are given.
  const auto slow = p.nodes.size() - 1;
  p.nodes.v[slow] *= 0.01;
  const auto around = nodal_volumes(p.mesh, p.nodes.x);
  for (std::size_t i = 0; i < p.nodes.size(); ++i)
    if (i != slow) p.nodes.owed[i] += p.nodes.volume[i] - around[i], p.nodes.volume[i] = around[i];
  const double had = kinetic_energy<d>(p.nodes.volume, p.nodes.v);
  give_volume_back(p);
  EXPECT_GT(enclosed(p), 1 + lost / 2);
  EXPECT_LE(kinetic_energy(p), had * (1 + 100 * scenes::eps));
}

// No volume, no energy to keep: at rest they would stand still in water that passes.
TYPED_TEST(VolumeCorrection, nodes_whose_cells_have_turned_over_go_with_the_water_around_them) {
  constexpr int d = TypeParam::value;
  int gained = 0;
  for (std::size_t node = 0; node < pool<d>().nodes.size(); ++node)
    for (const double deep : {0.3, 0.6, 0.9}) {
      auto p = pool<d>();
      if (!p.nodes.surface[node]) continue;
      p.nodes.x[node][d - 1] -= deep;
      p.nodes.owed[node] = lost;
      const auto v = p.nodes.v;
      const auto before = nodal_volumes(p.mesh, p.nodes.x);
      give_volume_back(p);
      const auto after = nodal_volumes(p.mesh, p.nodes.x);
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (after[i] > 0) continue;
        gained += after[i] > before[i];
        EXPECT_EQ(p.nodes.v[i], v[i]);
      }
    }
  EXPECT_GT(gained, 0);
}

TYPED_TEST(VolumeCorrection, nothing_moves_where_nothing_is_owed) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  const auto x = p.nodes.x;
  const auto v = p.nodes.v;
  give_volume_back(p);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LE((p.nodes.x[i] - x[i]).norm(), 100 * scenes::eps);
    EXPECT_LE((p.nodes.v[i] - v[i]).norm(), 100 * scenes::eps);
  }
}

TYPED_TEST(VolumeCorrection, a_surface_moves_by_half_of_its_reach_at_once_and_the_rest_stays_owed) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  p.nodes.owed.front() = 1;
  give_volume_back(p);
  const double spacing = 0.25;
  EXPECT_LT(enclosed(p), 1 + 6 * 0.5 * spacing);
  EXPECT_GT(enclosed(p), 1);
  EXPECT_NEAR(in_the_books(p.nodes), 2, 10 * scenes::eps);
  const auto volumes = nodal_volumes(p.mesh, p.nodes.x);
  for (const auto& cell : p.mesh.cells) EXPECT_GT(volume<d>(corners(p.nodes.x, cell)), 0);
}

TYPED_TEST(VolumeCorrection, other_water_does_not_pay) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  const std::size_t first = add_water(p, pool<d>());
  p.nodes.owed.front() = lost;
  const auto x = p.nodes.x;
  give_volume_back(p);
  EXPECT_NEAR(enclosed(p), 2 + lost, 100 * lost * lost);
  for (std::size_t i = first; i < x.size(); ++i) EXPECT_LE((p.nodes.x[i] - x[i]).norm(), 100 * scenes::eps);
}

TYPED_TEST(VolumeCorrection, what_water_turned_inside_out_is_owed_goes_to_the_largest_once) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  auto other = pool<d>();
  for (auto& x : other.nodes.x) x = 0.2 * x;
  for (auto& cell : other.mesh.cells) std::swap(cell[0], cell[1]);
  other.nodes.volume.assign(other.nodes.size(), 0.0);
  const std::size_t first = add_water(p, other);
  p.nodes.owed[first] = lost;
  const double books = in_the_books(p.nodes);
  give_volume_back(p);
  EXPECT_NEAR(in_the_books(p.nodes), books, 100 * scenes::eps);
}

TYPED_TEST(VolumeCorrection, too_much_water_of_a_part_is_its_own_to_lose) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  auto other = pool<d>();
  for (auto& x : other.nodes.x) x = 0.5 * x;
  const double small = std::pow(0.5, d);
  other.nodes.volume = nodal_volumes(other.mesh, other.nodes.x);
  const std::size_t first = add_water(p, other);
  const auto x = p.nodes.x;
  for (std::size_t i = first; i < x.size(); ++i) p.nodes.owed[i] = -0.02 * p.nodes.volume[i];
  give_volume_back(p);
  for (std::size_t i = 0; i < first; ++i) EXPECT_LE((p.nodes.x[i] - x[i]).norm(), 100 * scenes::eps);
  EXPECT_NEAR(enclosed(p), 1 + 0.98 * small, 1e-3 * small);  // what is worth another move
}

TYPED_TEST(VolumeCorrection, water_without_a_free_surface_keeps_its_shape) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  for (auto& facet : p.mesh.boundary) facet.wall = 0;
  std::fill(p.nodes.surface.begin(), p.nodes.surface.end(), 0);
  p.nodes.owed.front() = lost;
  const auto x = p.nodes.x;
  give_volume_back(p);
  EXPECT_EQ(p.nodes.x, x);
  EXPECT_NEAR(in_the_books(p.nodes), 1 + lost, 10 * scenes::eps);
}

TYPED_TEST(VolumeCorrection, the_surface_moves_into_no_wall) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  const double gap = 1e-9;  // less than any share moves a node by
  const Vec<d> size = Vec<d>::Constant(2);
  Vec<d> centre = Vec<d>::Constant(0.5);
  centre[d - 1] = 1 + gap + size[d - 1];
  Surface<d> lid;
  if constexpr (d == 2)
    lid = scenes::rectangle(-size, size);
  else
    lid = scenes::block(-size, size);
  const std::vector<Wall<d>> walls{Wall<d>({"lid", lid, Isometry<d>::Identity(), Twist<d>::Zero(), 0.25})};
  std::vector<WallPlace<d>> poses{Isometry<d>::Identity()};
  Isometry<d> pose = Isometry<d>::Identity();
  pose.translation() = centre;
  poses[0] = pose;
  p.nodes.owed.front() = lost;
  const auto x = p.nodes.x;
  give_volume_back(p, {walls, poses});
  EXPECT_EQ(p.nodes.x, x);
  EXPECT_NEAR(in_the_books(p.nodes), 1 + lost, 10 * scenes::eps);
}

TYPED_TEST(VolumeCorrection, what_a_shred_has_no_room_for_goes_to_the_water) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  const auto first = static_cast<int>(p.nodes.size());
  std::array<int, d + 1> cell;
  for (int k = 0; k <= d; ++k) {
    Vec<d> x = Vec<d>::Constant(3);
    if (k > 0) x[k - 1] += 1e-3;
    cell[k] = p.nodes.add(x, Vec<d>::Zero(), 0, WallTie{0}, true);
  }
  p.mesh.cells.push_back(cell);
  p.nodes.owed[first] = lost;
  give_volume_back(p);
  EXPECT_NEAR(enclosed(p), 1 + lost, 100 * lost * lost);
}

TEST(Parts, are_named_by_their_first_node_and_nodes_without_cells_by_themselves) {
  const Mesh<2> mesh{{{1, 2, 3}, {5, 6, 7}, {3, 8, 9}}, {}};
  EXPECT_EQ(parts_of(mesh, 10), (std::vector<int>{0, 1, 1, 1, 4, 5, 5, 5, 1, 1}));
}

}  // namespace
}  // namespace splashdown::fluid::volume_correction_test
