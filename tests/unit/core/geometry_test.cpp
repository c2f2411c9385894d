#include "fluid/pfem/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/node_cells.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::geometry_test {
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

// Sums over the cells around nodes are the same whether cells give or nodes take, bit for bit, and miss nothing.
TYPED_TEST(Geometry, nodal_volumes_are_the_cells_shared_equally_whoever_sums_them) {
  constexpr int d = TypeParam::value;
  scenes::Lattice<d> cube(4);
  std::mt19937 random(3);
  for (auto& x : cube.nodes.x) x += 0.02 * scenes::random_vector<Vec<d>>(random, {});
  const auto volumes = nodal_volumes(cube.mesh, cube.nodes.x);
  NodeCells<d> around;
  around.build(cube.mesh.cells, cube.nodes.size());
  std::vector<double> taken;
  around.sum(volume_shares(cube.mesh, cube.nodes.x), taken);
  EXPECT_EQ(volumes, taken);
  const double all = enclosed_volume(cube.mesh.boundary, cube.nodes.x);
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), all,
              10 * eps * static_cast<double>(cube.mesh.cells.size()) * all);
}

// A point that circles at constant rate is pulled to the axis by w^2 r; one that spins up is pushed along by alpha r.
TEST(PointAcceleration, of_a_turning_body_is_towards_its_axis) {
  const double w = 3, alpha = 5;
  Twist<3> velocity = Twist<3>::Zero(), acceleration = Twist<3>::Zero();
  velocity(5) = w;
  acceleration(5) = alpha;
  acceleration(2) = -9.81;
  const Vec<3> a = splashdown::rigid_acceleration<3>({2, 0, 0.7}, velocity, acceleration);
  EXPECT_NEAR((a - Vec<3>(-w * w * 2, alpha * 2, -9.81)).norm(), 0, 1e-14);
  const Vec<2> plane = splashdown::rigid_acceleration<2>({2, 0}, {0, 0, w}, {0, -9.81, alpha});
  EXPECT_NEAR((plane - Vec<2>(-w * w * 2, alpha * 2 - 9.81)).norm(), 0, 1e-14);
}

// The same as the second difference of the point's path: error dt^2 / 12 times its fourth derivative, w^4 r, and
// rounding 4 eps |x| / dt^2.
TEST(PointAcceleration, is_the_second_derivative_of_the_points_path) {
  const Vec<3> axis = Vec<3>(1, 2, -2) / 3, r(0.4, -0.3, 0.9);
  const double w = 4, alpha = 1.5, dt = 1e-4;
  const auto at = [&](double t) -> Vec<3> { return Eigen::AngleAxisd(w * t + 0.5 * alpha * t * t, axis) * r; };
  Twist<3> velocity = Twist<3>::Zero(), acceleration = Twist<3>::Zero();
  velocity.tail<3>() = w * axis;
  acceleration.tail<3>() = alpha * axis;
  const Vec<3> differences = (at(dt) - 2 * at(0) + at(-dt)) / (dt * dt);
  EXPECT_NEAR((splashdown::rigid_acceleration<3>(r, velocity, acceleration) - differences).norm(), 0,
              dt * dt / 12 * 2 * std::pow(w, 4) + 4 * 2.2e-16 / (dt * dt));
}

}  // namespace
}  // namespace splashdown::fluid::geometry_test
