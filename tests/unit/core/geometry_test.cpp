#include "fluid/geometry.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
namespace {

using scenes::eps;

template <class Dimension>
struct Geometry : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Geometry, Dimensions);

template <int d>
std::array<Vec<d>, d + 1> simplex(std::mt19937& random) {
  std::array<Vec<d>, d + 1> x;
  for (auto& c : x) c = scenes::random_vector<Vec<d>>(random, {});
  return x;
}

TYPED_TEST(Geometry, volume_gradients_are_finite_differences) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(1);
  for (int sample = 0; sample < 50; ++sample) {
    auto x = simplex<d>(random);
    auto at = [&](int k) { return x[k]; };
    const auto g = volume_gradients<d>(at);
    for (int j = 0; j <= d; ++j)
      for (int k = 0; k < d; ++k) {
        // The volume is affine in each coordinate of one corner: any step is exact.
        const double x0 = x[j][k];
        x[j][k] = x0 + 1;
        const double above = volume<d>(at);
        x[j][k] = x0 - 1;
        const double below = volume<d>(at);
        x[j][k] = x0;
        EXPECT_NEAR(g(k, j), 0.5 * (above - below), 50 * eps);
      }
  }
}

TYPED_TEST(Geometry, shape_functions_sum_to_one_and_reproduce_positions) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(2);
  const auto x = simplex<d>(random);
  auto at = [&](int k) { return x[k]; };
  const auto g = volume_gradients<d>(at);
  EXPECT_LE(g.rowwise().sum().norm(), 10 * eps);
  Mat<d> identity = Mat<d>::Zero();  // sum x_j (grad N_j)^T
  for (int j = 0; j <= d; ++j) identity += x[j] * g.col(j).transpose();
  EXPECT_LE((identity - volume<d>(at) * Mat<d>::Identity()).norm(), 50 * eps);
}

TYPED_TEST(Geometry, a_flat_cell_has_finite_gradients) {
  constexpr int d = TypeParam::value;
  std::array<Vec<d>, d + 1> x;
  for (int k = 0; k <= d; ++k) x[k] = Vec<d>::Constant(k);
  EXPECT_TRUE(volume_gradients<d>([&](int k) { return x[k]; }).allFinite());
}

TYPED_TEST(Geometry, a_force_does_the_work_of_its_wrench) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(3);
  for (int sample = 0; sample < 20; ++sample) {
    const auto s = scenes::random_vector<Twist<d>>(random, {});
    const auto r = scenes::random_vector<Vec<d>>(random, {}), f = scenes::random_vector<Vec<d>>(random, {});
    EXPECT_NEAR(f.dot(rigid_velocity<d>(s, r)), s.dot(wrench_of<d>(r, f)), 20 * eps);
  }
}

TYPED_TEST(Geometry, rotation_is_the_exponential) {
  constexpr int d = TypeParam::value;
  using Rotation = Eigen::Matrix<double, rotations<d>, 1>;
  std::mt19937 random(4);
  const auto w = scenes::random_vector<Rotation>(random, {});
  const auto R = rotation(w);
  EXPECT_LE((R * R.transpose() - Mat<d>::Identity()).norm(), 20 * eps);
  EXPECT_NEAR(R.determinant(), 1, 20 * eps);
  EXPECT_LE((rotation(Rotation(0.3 * w)) * rotation(Rotation(0.7 * w)) - R).norm(), 20 * eps);
  EXPECT_EQ(rotation(Rotation(Rotation::Zero())), Mat<d>(Mat<d>::Identity()));
  // exp(hw) r = r + h w x r + rest, |rest| <= (h |w|)^2 |r| / 2.
  const auto r = scenes::random_vector<Vec<d>>(random, {});
  const double h = 1e-4;
  EXPECT_LE((rotation(Rotation(h * w)) * r - r - h * cross(w, r)).norm(),
            0.5 * std::pow(h * w.norm(), 2) * r.norm() + 10 * eps);
}

TYPED_TEST(Geometry, moving_back_returns_to_the_pose) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(5);
  const auto s = scenes::random_vector<Twist<d>>(random, {});
  Isometry<d> pose = moved<d>(Isometry<d>::Identity(), scenes::random_vector<Twist<d>>(random, {}), 1.0);
  const Isometry<d> back = moved<d>(moved<d>(pose, s, 0.7), s, -0.7);
  EXPECT_LE((back.matrix() - pose.matrix()).norm(), 20 * eps);
}

TYPED_TEST(Geometry, a_closed_boundary_has_no_net_area_and_encloses_the_cells) {
  constexpr int d = TypeParam::value;
  const scenes::Lattice<d> cube(4);
  Vec<d> area = Vec<d>::Zero();
  for (const auto& f : cube.mesh.boundary) area += area_vector_of<d>(f, cube.nodes.x);
  double cells = 0;
  for (const auto& c : cube.mesh.cells) cells += volume<d>(corners(cube.nodes.x, c));
  const double roundoff = 10 * eps * static_cast<double>(cube.mesh.cells.size());
  EXPECT_LE(area.norm(), roundoff);
  EXPECT_NEAR(enclosed_volume(cube.mesh.boundary, cube.nodes.x), cells, roundoff);
  EXPECT_NEAR(cells, 1, roundoff);
}

}  // namespace
}  // namespace splashdown::fluid
