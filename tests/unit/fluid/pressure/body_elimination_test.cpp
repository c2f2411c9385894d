// Bodies and interface operators in the pressure equation.
#include "tests/unit/fluid/pressure/pressure_problem.hpp"

namespace splashdown::fluid::body_elimination_test {
namespace {

using namespace pressure_tests;

template <class Dimension>
struct BodyElimination : testing::Test {};
TYPED_TEST_SUITE(BodyElimination, Dimensions);

TYPED_TEST(BodyElimination, rigid_response_is_the_dense_solve_with_the_body_added) {
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
  std::vector<WallVelocity<d>> s{s0};
  ASSERT_TRUE(p.solve(phi, s));
  const double condition = A.norm() * A.inverse().norm();
  EXPECT_LE((eigen(phi) - exact).norm(), 100 * eps * condition * exact.norm());
  EXPECT_LE((s[0] - s0 - C * B * exact).norm(), 100 * eps * condition * (C * B * exact).norm());
}

TYPED_TEST(BodyElimination, a_body_of_any_lightness_gets_a_velocity_that_leaves_no_flux) {
  // M -> 0: the body follows the fluid. Its velocity differs from that without mass by M / (M + G).
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const auto M = p.any_inertia();
  const auto with = [&](double share) {
    EXPECT_TRUE(p.build(p.body(share * M)));
    auto r = std::vector<double>(p.equation.size(), 1e-3);
    std::vector<WallVelocity<d>> s(1, Twist<d>::Zero());
    EXPECT_TRUE(p.solve(r, s));
    return s[0].rigid;
  };
  const Twist<d> none = with(0);
  EXPECT_TRUE(none.allFinite());
  const double heaviest = M.norm() * p.equation.added_mass().inverse().norm();
  for (double share : {1e-3, 1e-6, 1e-9})
    EXPECT_LE((with(share) - none).norm(), (share * heaviest + 1e4 * eps) * none.norm()) << share;
}

TYPED_TEST(BodyElimination, motions_that_are_not_allowed_do_not_happen) {
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
  std::vector<WallVelocity<d>> s(1, Twist<d>::Zero());
  ASSERT_TRUE(p.solve(phi, s));
  const double condition = A.norm() * A.inverse().norm();
  EXPECT_LE((eigen(phi) - exact).norm(), 100 * eps * condition * exact.norm());
  EXPECT_LE((s[0] - w * (B * exact)(0) / mass).norm(), 100 * eps * condition * s[0].norm());
}

TYPED_TEST(BodyElimination, a_motion_without_inertia_in_body_and_water_stays_as_it_is) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  InterfaceModel response{.modal = {Eigen::MatrixXd::Zero(2 * p.m, 1), Eigen::MatrixXd::Zero(1, 1)}};
  response.modal.modes(p.m, 0) = 1;  // of a second wall, which no water touches
  p.places.push_back(p.places[0]);
  ASSERT_TRUE(p.build(response));
  auto r = p.any_phi();
  std::vector<WallVelocity<d>> s(2, Twist<d>::Zero());
  ASSERT_TRUE(p.equation.solve(r));
  p.equation.respond(r, s, Eigen::VectorXd::Constant(1, 7.0));
  EXPECT_EQ(s[1], Twist<d>(Twist<d>::Zero()));
}

TYPED_TEST(BodyElimination, added_mass_is_symmetric_and_positive) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build(p.body(p.any_inertia())));
  const Eigen::MatrixXd G = p.equation.added_mass();
  EXPECT_LE((G - G.transpose()).norm(), 1e3 * eps * G.norm());
  EXPECT_LE((G - p.B() * p.dense().ldlt().solve(p.B().transpose())).norm(), 1e4 * eps * G.norm());
  // The tank's own modes: pushing it moves all its water with it.
  EXPECT_NEAR(G(d - 1, d - 1), density, 1e4 * eps * density);
}

TYPED_TEST(BodyElimination, added_mass_of_a_wall_is_one_matrix_whatever_the_wall_answers) {
  // G = B X, X of A X = B^T and the corrections of a step, A without the answers of bodies: held, free with its exact
  // answer, or with a Laplacian. Corrections that are conjugate leave less of K X = B^T than plain ones.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  const std::array<std::size_t, 1> wall{0};
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd A = p.dense(), flux = p.B().transpose(), K = p.taken_by_impulses();
  Eigen::MatrixXd X = A.ldlt().solve(flux);
  for (int k = 0; k < corrections<d>; ++k) X += A.ldlt().solve(flux - K * X);
  const Eigen::MatrixXd limit = p.B() * K.completeOrthogonalDecomposition().solve(flux);
  const Eigen::MatrixXd exact = p.equation.added_mass_of(wall);
  EXPECT_LE((exact - limit).norm(), (p.B() * X - limit).norm());
  const double condition = A.norm() * A.inverse().norm();
  for (const InterfaceModel& answer :
       {InterfaceModel{}, p.body(p.any_inertia()), InterfaceModel{.interface_operators = {{.laplacian = 0.7}}},
        InterfaceModel{.interface_operators = {{.laplacian = 1e3}}}}) {
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

TYPED_TEST(BodyElimination, interface_laplacian_is_the_difference_it_makes_in_the_matrix) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd without = p.dense();
  ASSERT_TRUE(p.build({.interface_operators = {{.laplacian = 0.7}}}));
  const Eigen::MatrixXd K = p.dense() - without;
  const auto phi = p.any_phi();
  std::vector<double> r(p.equation.size(), 0.0);
  p.equation.laplacian().add(p.equation.laplacian().means(phi), r);
  EXPECT_LE((eigen(r) - K * eigen(phi)).norm(), 1e3 * eps * K.norm());
  EXPECT_GE(smallest_eigenvalue(K), -1e3 * eps * K.norm());
  EXPECT_GT(K.norm(), 0);
}

TYPED_TEST(BodyElimination, interface_laplacian_has_two_pieces_a_freedom) {
  // Its rank bounds the passes of the coupling: short waves along the wall are left alone.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const Eigen::MatrixXd without = p.dense();
  ASSERT_TRUE(p.build({.interface_operators = {{.laplacian = 0.7}}}));
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

TYPED_TEST(BodyElimination, a_passed_interface_laplacian_changes_nothing) {
  // At the fixed point the previous pass is this one: the term cancels.
  constexpr int d = TypeParam::value;
  Problem<d> p;
  ASSERT_TRUE(p.build());
  const auto r = p.any_phi();
  auto phi = r;
  std::vector<WallVelocity<d>> s(1, Twist<d>::Zero());
  ASSERT_TRUE(p.solve(phi, s));
  ASSERT_TRUE(p.build({.interface_operators = {{.laplacian = 0.7}}}));
  auto again = r;
  p.equation.laplacian().add(p.equation.laplacian().means(phi), again);
  ASSERT_TRUE(p.solve(again, s));
  EXPECT_LE((eigen(again) - eigen(phi)).norm(), 1e5 * eps * eigen(phi).norm());
}

TYPED_TEST(BodyElimination, without_unknowns_there_is_nothing_to_solve) {
  constexpr int d = TypeParam::value;
  Problem<d> p;
  for (auto& s : p.cube.nodes.spray) s = 1;
  ASSERT_TRUE(p.build(p.body(p.any_inertia())));
  EXPECT_EQ(p.equation.size(), 0);
  std::vector<double> r;
  std::vector<WallVelocity<d>> s(1, Twist<d>::Zero());
  EXPECT_TRUE(p.solve(r, s));
  EXPECT_EQ(s[0], Twist<d>(Twist<d>::Zero()));
}

}  // namespace
}  // namespace splashdown::fluid::body_elimination_test
