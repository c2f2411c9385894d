#include "fluid/pressure/pressure.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
namespace {

using scenes::eps;

constexpr double density = 1000;

template <int d>
struct Problem {
  static constexpr int m = freedoms<d>;
  scenes::Lattice<d> cube{d == 2 ? 8 : 5};
  std::vector<Vec<d>> centre{Vec<d>::Constant(0.3)};
  PressureEquation<d> equation;
  std::mt19937 random{11};

  bool build(const WallResponse<d>& response = {}) {
    return equation.build(cube.nodes, cube.mesh, density, centre, response);
  }
  std::vector<double> any_phi() {
    std::vector<double> phi(equation.size());
    for (double& p : phi) p = std::uniform_real_distribution<double>(-1, 1)(random);
    return phi;
  }
  std::vector<Vec<d>> any_field() {
    std::vector<Vec<d>> v(cube.nodes.size());
    for (auto& u : v) u = scenes::random_vector<Vec<d>>(random, {});
    return v;
  }
  using Matrix = Eigen::Matrix<double, m, m>;
  Matrix any_inertia() {
    const auto R = scenes::random_vector<Matrix>(random, {});
    return density * (R * R.transpose() + Matrix::Identity());
  }
  /// Of a body that moves freely.
  static WallResponse<d> body(const Matrix& inertia) { return {Matrix::Identity(), inertia, {}}; }
  bool solve(std::vector<double>& r, std::vector<Twist<d>>& s) {
    if (!equation.solve(r)) return false;
    equation.respond(r, s, Eigen::VectorXd::Zero(equation.motions()));
    return true;
  }
  Eigen::MatrixXd dense() const {
    const auto& a = equation.matrix();
    Eigen::MatrixXd A(a.size(), a.size());
    A.setZero();
    for (int j = 0; j < a.size(); ++j)
      for (int k = a.column_start[j]; k < a.column_start[j + 1]; ++k) A(a.row[k], j) = A(j, a.row[k]) = a.value[k];
    return A;
  }
  /// K: the volume that the motion by an impulse takes out, in flux form.
  Eigen::MatrixXd taken_by_impulses() const {
    Eigen::MatrixXd K(equation.size(), equation.size());
    std::vector<double> unit(equation.size(), 0.0), r;
    for (int j = 0; j < equation.size(); ++j) {
      std::vector<Vec<d>> v(cube.nodes.size(), Vec<d>::Zero());
      unit[j] = 1;
      equation.accelerate(unit, v);
      unit[j] = 0;
      equation.flux_residual(cube.nodes.x, v, std::vector<Twist<d>>(1, Twist<d>::Zero()), centre, r);
      K.col(j) = -Eigen::Map<const Eigen::VectorXd>(r.data(), equation.size());
    }
    return K;
  }
  Eigen::MatrixXd B() const {
    Eigen::MatrixXd out(m, equation.size());
    std::vector<double> unit(equation.size(), 0.0);
    for (int j = 0; j < equation.size(); ++j) {
      unit[j] = 1;
      out.col(j) = equation.impulse(0, unit);
      unit[j] = 0;
    }
    return out;
  }
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
double smallest_eigenvalue(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}
Eigen::Map<const Eigen::VectorXd> eigen(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

template <class Dimension>
struct Pressure : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Pressure, Dimensions);

TYPED_TEST(Pressure, hydrostatic_pressure_is_linear_and_stops_the_fall) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const double g = 9.81, kick = 0.01;
  const Vec<d> fall = -g * kick * Vec<d>::Unit(d - 1);
  std::vector<Vec<d>> v(p.cube.nodes.size(), fall);
  std::vector<Twist<d>> s(1, Twist<d>::Zero());
  std::vector<double> phi;
  p.equation.flux_residual(p.cube.nodes.x, v, s, p.centre, phi);
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

TYPED_TEST(Pressure, a_column_lifted_by_its_walls_weighs_more) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const double lift = 3;  // [m/s]: the walls' velocity, the fluid being at rest
  std::vector<Vec<d>> v(p.cube.nodes.size(), Vec<d>::Zero());
  Twist<d> up = Twist<d>::Zero();
  up[d - 1] = lift;
  std::vector<Twist<d>> s{up};
  std::vector<double> phi;
  p.equation.flux_residual(p.cube.nodes.x, v, s, p.centre, phi);
  ASSERT_TRUE(p.solve(phi, s));
  p.equation.accelerate(phi, v);
  for (const auto& u : v) EXPECT_LE((u - up.template head<d>()).norm(), 1e4 * eps * lift);
  // The walls carry the momentum of all the fluid.
  EXPECT_NEAR(p.equation.impulse(0, phi)[d - 1], -density * lift, 1e4 * eps * density * lift);
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
      for (int n : f.nodes) u[n] = rigid_velocity<d>(s, p.cube.nodes.x[n] - p.centre[0]);
  std::vector<double> flux, motion;
  p.equation.flux_residual(p.cube.nodes.x, u, std::vector{s}, p.centre, flux);
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
  for (const auto& x : p.cube.nodes.x) v.push_back(rigid_velocity<d>(s, x - p.centre[0]));
  std::vector<double> r;
  p.equation.flux_residual(p.cube.nodes.x, v, std::vector{s}, p.centre, r);
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
    p.equation.flux_residual(p.cube.nodes.x, still, std::vector{s}, p.centre, flux);
    const double work = s.dot(p.equation.impulse(0, phi));
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
  Vec<d> momentum = p.equation.impulse(0, phi).template head<d>();
  for (std::size_t i = 0; i < v.size(); ++i) momentum += density * p.equation.lumped_volume()[i] * v[i];
  EXPECT_LE(momentum.norm(), 1e3 * eps);
}

TYPED_TEST(Pressure, rigid_response_is_the_dense_solve_with_the_body_added) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const auto M = p.any_inertia();
  const typename Problem<d>::Matrix C = M.inverse();
  ASSERT_TRUE(p.build(p.body(M)));
  const Eigen::MatrixXd A = p.dense(), B = p.B();
  const auto r = p.any_phi();
  const Eigen::VectorXd exact = (A + B.transpose() * C * B).ldlt().solve(eigen(r));
  auto phi = r;
  const auto s0 = scenes::random_vector<Twist<d>>(p.random, {});
  std::vector<Twist<d>> s{s0};
  ASSERT_TRUE(p.solve(phi, s));
  const double condition = A.norm() * A.inverse().norm();
  EXPECT_LE((eigen(phi) - exact).norm(), 100 * eps * condition * exact.norm());
  EXPECT_LE((s[0] - s0 - C * B * exact).norm(), 100 * eps * condition * (C * B * exact).norm());
}

TYPED_TEST(Pressure, a_body_of_any_lightness_gets_a_velocity_that_leaves_no_flux) {
  // M -> 0: the body follows the fluid. Its velocity differs from that without mass by M / (M + G).
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const auto M = p.any_inertia();
  const auto with = [&](double share) {
    EXPECT_TRUE(p.build(p.body(share * M)));
    auto r = std::vector<double>(p.equation.size(), 1e-3);
    std::vector<Twist<d>> s(1, Twist<d>::Zero());
    EXPECT_TRUE(p.solve(r, s));
    return s[0];
  };
  const Twist<d> none = with(0);
  EXPECT_TRUE(none.allFinite());
  const double heaviest = M.norm() * p.equation.added_mass().inverse().norm();
  for (double share : {1e-3, 1e-6, 1e-9})
    EXPECT_LE((with(share) - none).norm(), (share * heaviest + 1e4 * eps) * none.norm()) << share;
}

TYPED_TEST(Pressure, motions_that_are_not_allowed_do_not_happen) {
  // A body that may only move along w: the dense solve with that motion alone.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const auto M = p.any_inertia();
  ASSERT_TRUE(p.build(p.body(M)));
  const Eigen::MatrixXd w = scenes::random_vector<Twist<d>>(p.random, {});
  p.equation.allow(w);
  const auto r = p.any_phi();
  const Eigen::MatrixXd A = p.dense(), B = w.transpose() * p.B();
  const double mass = (w.transpose() * M * w)(0, 0);
  const Eigen::VectorXd exact = (A + B.transpose() * B / mass).ldlt().solve(eigen(r));
  auto phi = r;
  std::vector<Twist<d>> s(1, Twist<d>::Zero());
  ASSERT_TRUE(p.solve(phi, s));
  const double condition = A.norm() * A.inverse().norm();
  EXPECT_LE((eigen(phi) - exact).norm(), 100 * eps * condition * exact.norm());
  EXPECT_LE((s[0] - w * (B * exact)(0) / mass).norm(), 100 * eps * condition * s[0].norm());
}

TYPED_TEST(Pressure, a_motion_without_inertia_in_body_and_water_stays_as_it_is) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  WallResponse<d> response{Eigen::MatrixXd::Zero(2 * p.m, 1), Eigen::MatrixXd::Zero(1, 1), {}};
  response.modes(p.m, 0) = 1;  // of a second wall, which no water touches
  p.centre.push_back(p.centre[0]);
  ASSERT_TRUE(p.build(response));
  auto r = p.any_phi();
  std::vector<Twist<d>> s(2, Twist<d>::Zero());
  ASSERT_TRUE(p.equation.solve(r));
  p.equation.respond(r, s, Eigen::VectorXd::Constant(1, 7.0));
  EXPECT_EQ(s[1], Twist<d>(Twist<d>::Zero()));
}

TYPED_TEST(Pressure, added_mass_is_symmetric_and_positive) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build(p.body(p.any_inertia())));
  const Eigen::MatrixXd G = p.equation.added_mass();
  EXPECT_LE((G - G.transpose()).norm(), 1e3 * eps * G.norm());
  EXPECT_LE((G - p.B() * p.dense().ldlt().solve(p.B().transpose())).norm(), 1e4 * eps * G.norm());
  // The tank's own modes: pushing it moves all its water with it.
  EXPECT_NEAR(G(d - 1, d - 1), density, 1e4 * eps * density);
}

TYPED_TEST(Pressure, added_mass_of_a_wall_is_one_matrix_whatever_the_wall_answers) {
  // G = B X, X of A X = B^T and the corrections of a step, A without the answers of bodies: held, free with its exact
  // answer, or with a Laplacian.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const std::array<std::size_t, 1> wall{0};
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd A = p.dense(), flux = p.B().transpose(), K = p.taken_by_impulses();
  Eigen::MatrixXd X = A.ldlt().solve(flux);
  for (int k = 0; k < corrections<d>; ++k) X += A.ldlt().solve(flux - K * X);
  const Eigen::MatrixXd exact = p.B() * X;
  const double condition = A.norm() * A.inverse().norm();
  for (const WallResponse<d>& answer :
       {WallResponse<d>{}, p.body(p.any_inertia()), WallResponse<d>{{}, {}, {{.laplacian = 0.7}}},
        WallResponse<d>{{}, {}, {{.laplacian = 1e3}}}}) {
    ASSERT_TRUE(p.build(answer));
    const Eigen::MatrixXd G = p.equation.added_mass_of(wall);
    // A Laplacian of this size makes A + K stiffer by K / A ~ 1e3 times its size, which is lost when taken out again.
    const double laplacian = answer.interface_operators.empty() ? 0.0 : answer.interface_operators[0].laplacian,
                 stiffer = 1 + laplacian * density;
    EXPECT_LE((G - exact).norm(), 10 * eps * condition * stiffer * exact.norm()) << laplacian;
    EXPECT_LE((G - G.transpose()).norm(), 10 * eps * condition * stiffer * exact.norm()) << laplacian;
    EXPECT_GE(smallest_eigenvalue(G), -10 * eps * condition * stiffer * exact.norm()) << laplacian;
  }
}

TYPED_TEST(Pressure, interface_laplacian_is_the_difference_it_makes_in_the_matrix) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd without = p.dense();
  ASSERT_TRUE(p.build({{}, {}, {{.laplacian = 0.7}}}));
  const Eigen::MatrixXd K = p.dense() - without;
  const auto phi = p.any_phi();
  std::vector<double> r(p.equation.size(), 0.0);
  p.equation.laplacian().add(p.equation.laplacian().means(phi), r);
  EXPECT_LE((eigen(r) - K * eigen(phi)).norm(), 1e3 * eps * K.norm());
  EXPECT_GE(smallest_eigenvalue(K), -1e3 * eps * K.norm());
  EXPECT_GT(K.norm(), 0);
}

TYPED_TEST(Pressure, interface_laplacian_has_two_pieces_a_freedom) {
  // Its rank bounds the passes of the coupling: short waves along the wall are left alone.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd without = p.dense();
  ASSERT_TRUE(p.build({{}, {}, {{.laplacian = 0.7}}}));
  const auto pieces = p.equation.laplacian().pieces();
  EXPECT_EQ(pieces.size(), static_cast<std::size_t>(2 * freedoms<d>));
  Eigen::FullPivLU<Eigen::MatrixXd> K(p.dense() - without);
  K.setThreshold(1e-9);
  EXPECT_LE(K.rank(), 2 * freedoms<d>);
  EXPECT_GE(K.rank(), freedoms<d>);
  double hull = 0, wetted = 0;
  for (const auto& piece : pieces) hull += piece.measure;
  for (const auto& f : p.cube.mesh.boundary)
    if (f.wall == 0) wetted += area_vector_of<d>(f, p.cube.nodes.x).norm();
  EXPECT_NEAR(hull, wetted, 1e3 * eps * wetted) << "the pieces are the hull";
}

TYPED_TEST(Pressure, a_passed_interface_laplacian_changes_nothing) {
  // At the fixed point the previous pass is this one: the term cancels.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const auto r = p.any_phi();
  auto phi = r;
  std::vector<Twist<d>> s(1, Twist<d>::Zero());
  ASSERT_TRUE(p.solve(phi, s));
  ASSERT_TRUE(p.build({{}, {}, {{.laplacian = 0.7}}}));
  auto again = r;
  p.equation.laplacian().add(p.equation.laplacian().means(phi), again);
  ASSERT_TRUE(p.solve(again, s));
  EXPECT_LE((eigen(again) - eigen(phi)).norm(), 1e5 * eps * eigen(phi).norm());
}

TYPED_TEST(Pressure, without_unknowns_there_is_nothing_to_solve) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  for (auto& s : p.cube.nodes.spray) s = 1;
  ASSERT_TRUE(p.build(p.body(p.any_inertia())));
  EXPECT_EQ(p.equation.size(), 0);
  std::vector<double> r;
  std::vector<Twist<d>> s(1, Twist<d>::Zero());
  EXPECT_TRUE(p.solve(r, s));
  EXPECT_EQ(s[0], Twist<d>(Twist<d>::Zero()));
}

}  // namespace
}  // namespace splashdown::fluid
