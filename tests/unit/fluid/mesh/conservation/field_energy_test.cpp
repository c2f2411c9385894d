#include "fluid/pfem/mesh/conservation/field_energy.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::field_energy_test {
namespace {

template <class D>
class FieldEnergy : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FieldEnergy, Dimensions);

/// A box in random motion, one part of water, whose nodes carry what its cells have.
template <int d>
struct Box : scenes::Lattice<d> {
  std::vector<double> volumes;

  Box() : scenes::Lattice<d>(4) {
    std::mt19937 random(5);
    for (auto& v : this->nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
    this->nodes.volume = volumes = nodal_volumes(this->mesh, this->nodes.x);
    this->nodes.field_energy = field_energies(this->mesh, this->nodes);
  }

  /// As if the nodes with x below `to` and above `from` had got a tenth of their water, and this share of their energy, from the new mesh.
  void let_gain(double share, double from, double to) {
    for (std::size_t i = 0; i < volumes.size(); ++i)
      if (this->nodes.x[i].x() >= from && this->nodes.x[i].x() <= to)
        this->nodes.volume[i] *= 0.9, this->nodes.field_energy[i] *= 1 - share;
  }

  Vec<d> momentum() const {
    Vec<d> p = Vec<d>::Zero();
    for (std::size_t i = 0; i < volumes.size(); ++i) p += volumes[i] * this->nodes.v[i];
    return p;
  }
  double energy() const { return scenes::sum(field_energies(this->mesh, this->nodes)); }
  void limit() {
    limit_field_energy<d>(this->nodes, this->mesh, FreeWater<d>(this->mesh, this->nodes, {}), volumes, volumes);
  }
  void expect_left_alone() {
    const auto before = this->nodes.v;
    limit();
    EXPECT_EQ(this->nodes.v, before);
  }
};

TYPED_TEST(FieldEnergy, is_exact_for_linear_fields_on_any_mesh) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(2);
  const Vec<d> a = scenes::random_vector<Vec<d>>(random, {});
  Mat<d> B;
  for (int k = 0; k < d; ++k) B.col(k) = scenes::random_vector<Vec<d>>(random, {});
  // int x dx and int x x^T dx over the unit box
  const Vec<d> first = Vec<d>::Constant(0.5);
  const Mat<d> second = Mat<d>::Constant(0.25) + Mat<d>(Vec<d>::Constant(1.0 / 12).asDiagonal());
  const double exact = 0.5 * a.squaredNorm() + a.dot(B * first) + 0.5 * (B * second * B.transpose()).trace();
  for (const unsigned seed : {1U, 2U}) {
    scenes::Lattice<d> box(4, 0.3, seed);
    for (std::size_t i = 0; i < box.nodes.size(); ++i) box.nodes.v[i] = a + B * box.nodes.x[i];
    EXPECT_NEAR(scenes::sum(field_energies(box.mesh, box.nodes)), exact, 1e3 * scenes::eps * exact);
  }
}

TYPED_TEST(FieldEnergy, of_drops_is_their_own) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  const int drop = box.nodes.add(Vec<d>::Constant(3), Vec<d>::Constant(2), 0, {}, false);
  box.nodes.spray[drop] = 1, box.nodes.volume[drop] = 0.1;
  EXPECT_DOUBLE_EQ(field_energies(box.mesh, box.nodes)[drop], 0.5 * 0.1 * 4 * d);
}

TYPED_TEST(FieldEnergy, that_a_mesh_adds_goes_where_it_came_and_momentum_stays) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  box.let_gain(0.1, 0, 0.6);
  const auto v = box.nodes.v;
  const Vec<d> momentum = box.momentum();
  const double held = scenes::sum(box.nodes.field_energy), excess = box.energy() - held;
  ASSERT_GT(excess, 0);
  box.limit();
  EXPECT_LE(box.energy() - held, 1e-5 * excess);  // exchanges end where 1e-6 is left
  EXPECT_GE(box.energy() - held, -1e4 * scenes::eps * held);
  EXPECT_LT((box.momentum() - momentum).norm(), 1e3 * scenes::eps * std::sqrt(held));
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_TRUE(box.nodes.x[i].x() <= 0.6 || box.nodes.v[i] == v[i]) << i;
}

TYPED_TEST(FieldEnergy, that_one_patch_gains_and_another_has_lost_is_left_alone) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  box.let_gain(0.1, 0, 0.1);
  box.let_gain(-0.2, 0.9, 1);
  ASSERT_LT(box.energy(), scenes::sum(box.nodes.field_energy));
  box.expect_left_alone();
}

TYPED_TEST(FieldEnergy, is_no_matter_where_no_water_changes) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  for (double& energy : box.nodes.field_energy) energy *= 1 - 1e-12;  // roundoff
  box.expect_left_alone();
}

TYPED_TEST(FieldEnergy, of_water_that_no_wall_touches_is_left_to_what_keeps_its_momentum) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  for (auto& tie : box.nodes.tie) tie = {};
  box.let_gain(0.1, 0, 0.6);
  box.expect_left_alone();
}

TYPED_TEST(FieldEnergy, passes_on_with_nodes_that_merge) {
  constexpr int d = TypeParam::value;
  Box<d> box;
  const double all = scenes::sum(box.nodes.field_energy);
  box.nodes.bequeath(0, 1);
  EXPECT_EQ(box.nodes.field_energy[0], 0);
  EXPECT_NEAR(scenes::sum(box.nodes.field_energy), all, 100 * scenes::eps * all);
}

}  // namespace
}  // namespace splashdown::fluid::field_energy_test
