#include "fluid/pfem/pressure/mass_sweep.hpp"

#include <gtest/gtest.h>

#include <random>

#include "fluid/pfem/parallel.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::mass_sweep_test {
namespace {

// Cells between nodes whose numbers are near, of random masses; enough of them for several pieces of the parallel loops.
template <int d>
struct Masses {
  static constexpr int nodes = 3000, cells = 12000, reach = 40;
  std::vector<std::array<int, d + 1>> cell;
  std::vector<double> mass, lumped = std::vector<double>(nodes, 0.0);
  std::vector<Vec<d>> u;

  Masses() {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> first(0, nodes - reach), next(0, reach - 1);
    std::uniform_real_distribution<double> weight(0.1, 1);
    for (int c = 0; c < cells; ++c) {
      std::array<int, d + 1> corners;
      const int base = c < nodes ? std::min(c, nodes - reach) : first(random);
      for (int k = 0; k <= d; ++k) {
        do corners[k] = k == 0 && c < nodes ? c : base + next(random);
        while (std::find(corners.begin(), corners.begin() + k, corners[k]) != corners.begin() + k);
      }
      cell.push_back(corners);
      mass.push_back(weight(random));
      for (int n : corners) lumped[n] += mass.back() / (d + 1);
    }
    for (int i = 0; i < nodes; ++i) u.push_back(scenes::random_vector<Vec<d>>(random, {}));
  }

  std::vector<Vec<d>> swept(const std::vector<Vec<d>>& of) const {
    NodeCells<d> around;
    around.build(cell, nodes);
    std::vector<double> share, per_mass, keeps(nodes, 1 - 1.0 / (d + 2));
    for (double m : mass) share.push_back(m / (d + 2));
    for (double m : lumped) per_mass.push_back(1 / ((d + 1) * m));
    MassSweep<d> sweep;
    sweep.build(cell, around, share, per_mass, keeps);
    std::vector<Vec<d>> out;
    sweep(of, out);
    return out;
  }
};

template <class Dimension>
struct MassSweeps : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MassSweeps, Dimensions);

TYPED_TEST(MassSweeps, take_the_consistent_mass_over_the_lumped_one_from_what_they_sweep) {
  constexpr int d = TypeParam::value;
  const Masses<d> water;
  std::vector<Vec<d>> expected = water.u;
  for (std::size_t c = 0; c < water.cell.size(); ++c)
    for (int i : water.cell[c])
      for (int j : water.cell[c])
        expected[i] -= (i == j ? 2 : 1) * water.mass[c] / ((d + 1) * (d + 2) * water.lumped[i]) * water.u[j];
  const auto found = water.swept(water.u);
  // A node has some 16 cells, hardly ever more than 40, of d + 1 terms each; sizes of a row's terms sum up to that of u.
  constexpr double roundoff = 4 * Masses<d>::reach * scenes::eps;
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LE((found[i] - expected[i]).norm(), roundoff) << i;
}

TYPED_TEST(MassSweeps, take_constants_to_nothing_and_leave_no_momentum) {
  constexpr int d = TypeParam::value;
  const Masses<d> water;
  constexpr double roundoff = 4 * Masses<d>::reach * scenes::eps;
  for (const auto& v : water.swept(std::vector<Vec<d>>(water.u.size(), Vec<d>::Ones()))) EXPECT_LE(v.norm(), roundoff);
  Vec<d> momentum = Vec<d>::Zero();
  double scale = 0;
  const auto found = water.swept(water.u);
  for (std::size_t i = 0; i < found.size(); ++i) momentum += water.lumped[i] * found[i], scale += water.lumped[i];
  EXPECT_LE(momentum.norm(), roundoff * scale);
}

TYPED_TEST(MassSweeps, have_the_same_bits_on_any_number_of_threads) {
  const Masses<TypeParam::value> water;
  use_threads(1);
  const auto one = water.swept(water.u);
  use_threads(3);
  const auto three = water.swept(water.u);
  use_threads(0);
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace splashdown::fluid::mass_sweep_test
