#include "tests/unit/fluid/pressure/pressure_problem.hpp"

namespace splashdown::fluid::pressure_test {
namespace {

using namespace pressure_tests;

template <class Dimension>
struct Pressure : testing::Test {};
TYPED_TEST_SUITE(Pressure, Dimensions);

TYPED_TEST(Pressure, hydrostatic_pressure_is_linear_and_stops_the_fall) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const double g = 9.81, kick = 0.01;
  const Vec<d> fall = -g * kick * Vec<d>::Unit(d - 1);
  std::vector<Vec<d>> v(p.cube.nodes.size(), fall);
  std::vector<WallVelocity<d>> s(1, Twist<d>::Zero());
  std::vector<double> phi;
  p.equation.flux_residual(p.cube.nodes.x, v, s, p.places, phi);
  ASSERT_TRUE(p.solve(phi, s));
  // Condition of the Laplacian ~ n^2 ~ 1e2, hence 1e3 eps.
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (p.equation.unknown()[i] < 0) continue;
    const double depth = 1 - p.cube.nodes.x[i][d - 1];
    EXPECT_NEAR(phi[p.equation.unknown()[i]], density * g * kick * depth, 1e3 * eps * density * g * kick);
  }
  p.equation.accelerate(phi, v);
  for (const auto& u : v) EXPECT_LE(u.norm(), 1e4 * eps * g * kick);
}

// PSPG compares the gradient of a pressure in the elements with what it does at the nodes: for a linear one they are the same.
// What it does to others moves volume from node to node: no sum of it where all nodes of the surface have an unknown.
TYPED_TEST(Pressure, stabilisation_leaves_a_linear_pressure_alone_and_makes_no_volume) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  p.equation = PressureEquation<d>(SurfaceUnknowns::all);
  ASSERT_TRUE(p.build());
  ASSERT_EQ(p.equation.size(), static_cast<int>(p.cube.nodes.size()));
  const std::vector<double> theta(p.cube.mesh.cells.size(), 0.5);
  const auto left = [&](const std::vector<double>& phi) {
    std::vector<Vec<d>> change(p.cube.nodes.size(), Vec<d>::Zero());
    p.equation.accelerate(phi, change);
    std::vector<double> r(phi.size(), 0.0);
    p.equation.stabilise(phi, change, theta, r);
    return r;
  };
  std::vector<double> linear(p.cube.nodes.size());
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[p.equation.unknown()[i]] = density * (1 - p.cube.nodes.x[i][d - 1]);
  for (const double r : left(linear)) EXPECT_NEAR(r, 0, 1e3 * eps);
  const auto any = left(p.any_phi());
  const double scale = eigen(any).template lpNorm<1>();
  EXPECT_NEAR(scenes::sum(any), 0, 1e3 * eps * scale);
  EXPECT_GT(scale, 0);
}

TYPED_TEST(Pressure, a_column_lifted_by_its_walls_weighs_more) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const double lift = 3;  // [m/s]: the walls' velocity, the fluid being at rest
  std::vector<Vec<d>> v(p.cube.nodes.size(), Vec<d>::Zero());
  Twist<d> up = Twist<d>::Zero();
  up[d - 1] = lift;
  std::vector<WallVelocity<d>> s{up};
  std::vector<double> phi;
  p.equation.flux_residual(p.cube.nodes.x, v, s, p.places, phi);
  ASSERT_TRUE(p.solve(phi, s));
  p.equation.accelerate(phi, v);
  for (const auto& u : v) EXPECT_LE((u - up.template head<d>()).norm(), 1e4 * eps * lift);
  // The walls carry the momentum of all the fluid.
  EXPECT_NEAR(p.equation.impulse(0, phi).rigid[d - 1], -density * lift, 1e4 * eps * density * lift);
}

TYPED_TEST(Pressure, matrix_is_the_discrete_energy_where_the_surface_is_held_and_positive_definite) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  auto phi = p.any_phi();
  for (std::size_t i = 0; i < p.cube.nodes.size(); ++i)
    if (p.cube.nodes.surface[i] && p.equation.unknown()[i] >= 0) phi[p.equation.unknown()[i]] = 0;
  double energy = 0;  // int |grad phi|^2 / rho
  for (const auto& cell : p.cube.mesh.cells) {
    const auto at = corners(p.cube.nodes.x, cell);
    const auto g = volume_gradients<d>(at);
    Vec<d> gradient = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k)
      if (p.equation.unknown()[cell[k]] >= 0) gradient += g.col(k) * phi[p.equation.unknown()[cell[k]]];
    energy += gradient.squaredNorm() / (density * volume<d>(at));
  }
  const auto A = p.dense();
  EXPECT_NEAR(eigen(phi).dot(A * eigen(phi)), energy, 1e3 * eps * energy);
  EXPECT_GT(smallest_eigenvalue(A), 0);
  // Rows ascend below a leading diagonal, as the solver asks.
  const auto& a = p.equation.matrix();
  for (int j = 0; j < a.size(); ++j) {
    EXPECT_EQ(a.row[a.column_start[j]], j);
    EXPECT_TRUE(std::is_sorted(a.row.begin() + a.column_start[j], a.row.begin() + a.column_start[j + 1]));
  }
}

// The corrections solve D M^-1 D^T phi = r with the matrix A as a preconditioner: phi += A^-1 (r - D M^-1 D^T phi).
TYPED_TEST(Pressure, corrections_shrink_every_error) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const int n = p.equation.size();
  const std::size_t count = p.cube.nodes.size();
  Eigen::MatrixXd S(n, n);
  for (int j = 0; j < n; ++j) {
    std::vector<double> unit(n, 0.0), r;
    unit[j] = 1;
    std::vector<Vec<d>> v(count, Vec<d>::Zero());
    p.equation.accelerate(unit, v);
    for (std::size_t i = 0; i < count; ++i)  // slip walls on all sides but the top
      for (int k = 0; k < d; ++k)
        if (p.cube.nodes.x[i][k] == 0 || (k + 1 < d && p.cube.nodes.x[i][k] == 1)) v[i][k] = 0;
    p.equation.motion_residual(p.cube.nodes.x, v, r);
    S.col(j) = -eigen(r);
  }
  const Eigen::VectorXcd eigenvalues = p.dense().ldlt().solve(S).eigenvalues();
  for (int j = 0; j < n; ++j) EXPECT_LE(std::abs(1.0 - eigenvalues[j]), 1 + 1e3 * eps) << eigenvalues[j];
}

TYPED_TEST(Pressure, flux_form_is_motion_form_for_motions_that_follow_the_walls) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  auto u = p.any_field();
  const auto s = scenes::random_vector<Twist<d>>(p.random, {});
  for (const auto& f : p.cube.mesh.boundary)
    if (f.wall == 0)
      for (int n : f.nodes) u[n] = rigid_velocity<d>(s, p.cube.nodes.x[n] - p.centre);
  std::vector<double> flux, motion;
  p.equation.flux_residual(p.cube.nodes.x, u, std::vector<WallVelocity<d>>{s}, p.places, flux);
  p.equation.motion_residual(p.cube.nodes.x, u, motion);
  EXPECT_LE((eigen(flux) - eigen(motion)).norm(), 100 * eps * eigen(flux).norm() + 1e-13);
  EXPECT_GT(eigen(flux).norm(), 0);
}

TYPED_TEST(Pressure, a_rigid_motion_of_everything_creates_no_volume) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const auto s = scenes::random_vector<Twist<d>>(p.random, {});
  std::vector<Vec<d>> v;
  for (const auto& x : p.cube.nodes.x) v.push_back(rigid_velocity<d>(s, x - p.centre));
  std::vector<double> r;
  p.equation.flux_residual(p.cube.nodes.x, v, std::vector<WallVelocity<d>>{s}, p.places, r);
  EXPECT_LE(eigen(r).norm(), 1e3 * eps);
  p.equation.motion_residual(p.cube.nodes.x, v, r);
  EXPECT_LE(eigen(r).norm(), 1e3 * eps);
}

TYPED_TEST(Pressure, motion_form_is_the_change_of_volume) {
  // Sum over all test functions: the residual of q = 1 is -dV/dt; at the middle it is exact in 2D and has
  // the error (dt^2 / 4) det(grad u) dt ... in 3D, hence the small motion there.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  for (auto& s : p.cube.nodes.surface) s = 0;
  ASSERT_TRUE(p.build() || d > 0);  // p is fixed nowhere: the factor may fail, the residual may not
  auto u = p.any_field();
  const double dt = d == 2 ? 0.01 : 1e-5;
  auto middle = p.cube.nodes.x, after = middle;
  for (std::size_t i = 0; i < u.size(); ++i) middle[i] += 0.5 * dt * u[i], after[i] += dt * u[i];
  std::vector<double> r;
  p.equation.motion_residual(middle, u, r);
  const double change =
      enclosed_volume(p.cube.mesh.boundary, after) - enclosed_volume(p.cube.mesh.boundary, p.cube.nodes.x);
  EXPECT_NEAR(-dt * eigen(r).sum(), change, d == 2 ? 1e3 * eps : 1e-12);
}

TYPED_TEST(Pressure, load_and_flux_are_transposes) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const std::vector<Vec<d>> still(p.cube.nodes.size(), Vec<d>::Zero());
  for (int sample = 0; sample < 10; ++sample) {
    const auto phi = p.any_phi();
    const auto s = scenes::random_vector<Twist<d>>(p.random, {});
    std::vector<double> flux;
    p.equation.flux_residual(p.cube.nodes.x, still, std::vector<WallVelocity<d>>{s}, p.places, flux);
    const double work = s.dot(p.equation.impulse(0, phi).rigid);
    EXPECT_NEAR(-dot(flux, phi), work, 1e3 * eps) << "virtual work is lost between fluid and body";
  }
}

TYPED_TEST(Pressure, fluid_and_walls_exchange_momentum_exactly) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const auto phi = p.any_phi();
  std::vector<Vec<d>> v(p.cube.nodes.size(), Vec<d>::Zero());
  p.equation.accelerate(phi, v);
  Vec<d> momentum = p.equation.impulse(0, phi).rigid.template head<d>();
  for (std::size_t i = 0; i < v.size(); ++i) momentum += density * p.equation.lumped_volume()[i] * v[i];
  EXPECT_LE(momentum.norm(), 1e3 * eps);
}

}  // namespace
}  // namespace splashdown::fluid::pressure_test
