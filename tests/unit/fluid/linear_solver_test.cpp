#include "fluid/pfem/linear/linear_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

#include "fluid/pfem/linear/generalised_conjugate_residual.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid::linear_solver_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

SymmetricMatrix lower(const Eigen::MatrixXd& dense) {
  SymmetricMatrix m;
  m.column_start = {0};
  for (int j = 0; j < dense.cols(); ++j) {
    for (int i = j; i < dense.rows(); ++i)
      if (i == j || dense(i, j) != 0) m.row.push_back(i), m.value.push_back(dense(i, j));
    m.column_start.push_back(static_cast<int>(m.row.size()));
  }
  return m;
}

// Graph Laplacian with random weights plus a little of the identity: positive definite, sparse.
Eigen::MatrixXd laplacian(int n, double shift, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.1, 10);
  std::uniform_int_distribution<int> node(0, n - 1);
  Eigen::MatrixXd A = shift * Eigen::MatrixXd::Identity(n, n);
  for (int e = 0; e < 4 * n; ++e) {
    const int i = node(random), j = node(random);
    if (i == j) continue;
    const double w = weight(random);
    A(i, i) += w, A(j, j) += w, A(i, j) -= w, A(j, i) -= w;
  }
  return A;
}

// -1 to four neighbours on a strip.
SymmetricMatrix band(int n, double diagonal) {
  SymmetricMatrix m;
  m.column_start = {0};
  for (int j = 0; j < n; ++j) {
    m.row.push_back(j), m.value.push_back(diagonal);
    for (int i : {j + 1, j + 70})
      if (i < n) m.row.push_back(i), m.value.push_back(-1);
    m.column_start.push_back(static_cast<int>(m.row.size()));
  }
  return m;
}

TEST(LinearSolver, leaves_a_residual_of_roundoff) {
  for (int n : {1, 2, 50, 400}) {
    const auto A = laplacian(n, 0.01);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, 3);
    Eigen::MatrixXd x = b;
    LinearSolver solver;
    ASSERT_TRUE(solver.factor(lower(A)));
    ASSERT_TRUE(solver.solve({x.data(), static_cast<std::size_t>(x.size())}, 3));
    // Cholesky is backward stable: |Ax - b| <= c n eps |A| |x| (Higham 2002, theorem 10.4).
    EXPECT_LE((A * x - b).norm(), 10 * n * eps * A.norm() * x.norm());
  }
}

TEST(LinearSolver, multigrid_leaves_the_residual_it_was_asked_for) {
  const int n = 400;
  const auto A = laplacian(n, 0.01);
  for (double tolerance : {1e-2, 1e-6, 1e-10}) {
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, 10);  // 6 and 3 together and one alone
    Eigen::MatrixXd x = b;
    LinearSolver solver(0);
    ASSERT_TRUE(solver.factor(lower(A)));
    ASSERT_TRUE(solver.solve({x.data(), static_cast<std::size_t>(x.size())}, 10, tolerance));
    for (int k = 0; k < 10; ++k) EXPECT_LE((A * x.col(k) - b.col(k)).norm(), (tolerance + 1e3 * eps) * b.col(k).norm());
  }
}

TEST(LinearSolver, multigrid_takes_any_guess_and_profits_from_a_good_one) {
  const int n = 400;
  const auto A = laplacian(n, 0.01);
  const Eigen::VectorXd solution = Eigen::VectorXd::Random(n), b = A * solution;
  LinearSolver solver(0);
  ASSERT_TRUE(solver.factor(lower(A)));
  auto solved = [&](const Eigen::VectorXd& rhs, const Eigen::VectorXd& guess, double tolerance) {
    Eigen::VectorXd x = rhs;
    EXPECT_TRUE(solver.solve({x.data(), static_cast<std::size_t>(n)}, 1, tolerance,
                             {guess.data(), static_cast<std::size_t>(guess.size())}));
    return x;
  };
  EXPECT_TRUE(solved(b, solution, 1e-8) == solution) << "nothing is left to be done";
  for (const Eigen::VectorXd& guess :
       {Eigen::VectorXd(0.9 * solution), Eigen::VectorXd(1e9 * Eigen::VectorXd::Random(n))})
    EXPECT_LE((A * solved(b, guess, 1e-8) - b).norm(), 1.01e-8 * b.norm());
  EXPECT_TRUE(solved(Eigen::VectorXd::Zero(n), solution, 1e-8).isZero(0)) << "no right-hand side, no solution";
}

// No row depends on others there, and multigrid finds no coarser level: a factor of thousands of dense rows would take
// minutes.
TEST(LinearSolver, multigrid_is_quick_where_the_diagonal_dominates) {
  const int n = 20000;
  LinearSolver solver(0);
  ASSERT_TRUE(solver.factor(band(n, 400)));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(n);
  ASSERT_TRUE(solver.solve({x.data(), static_cast<std::size_t>(n)}));
  EXPECT_NEAR(x[n / 2], 1.0 / 396, 1e-8) << "rows inside add up to 396";
}

TEST(LinearSolver, multigrid_gives_the_same_bits_on_any_number_of_threads) {
  const int n = 5000;  // several blocks
  const SymmetricMatrix m = band(n, 4.001);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
  Eigen::VectorXd first;
  for (int threads : {1, 2, 8}) {
    use_threads(threads);
    Eigen::VectorXd x = b;
    LinearSolver solver(0);
    ASSERT_TRUE(solver.factor(m));
    ASSERT_TRUE(solver.solve({x.data(), static_cast<std::size_t>(n)}));
    if (threads == 1) first = x;
    EXPECT_TRUE(x == first) << threads;
  }
  use_threads(0);
}

TEST(LinearSolver, multigrid_tells_where_it_fails) {
  const auto A = laplacian(100, 0.01);
  LinearSolver solver(0);
  ASSERT_TRUE(solver.factor(lower(A)));
  Eigen::VectorXd b = Eigen::VectorXd::Random(100);
  b[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.solve({b.data(), 100}));
  Eigen::VectorXd again = Eigen::VectorXd::Random(100);
  EXPECT_TRUE(solver.solve({again.data(), 100})) << "and goes on";
}

TEST(LinearSolver, columns_together_are_columns_alone) {
  const auto A = laplacian(200, 0.01);
  Eigen::MatrixXd together = Eigen::MatrixXd::Random(200, 4), alone = together;
  LinearSolver solver;
  ASSERT_TRUE(solver.factor(lower(A)));
  ASSERT_TRUE(solver.solve({together.data(), 800}, 4));
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(solver.solve({alone.col(k).data(), 200}));
  EXPECT_LE((together - alone).norm(), 1e3 * eps * A.norm() / 0.01 * alone.norm());
}

TEST(LinearSolver, gives_the_same_bits_again) {
  const auto A = laplacian(200, 0.01);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(200);
  LinearSolver one, two;
  Eigen::VectorXd x = b, y = b;
  ASSERT_TRUE(one.factor(lower(A)) && one.solve({x.data(), 200}));
  ASSERT_TRUE(two.factor(lower(laplacian(300, 1, 2))) && two.factor(lower(A)) && two.solve({y.data(), 200}));
  EXPECT_EQ(x, y) << "what was factored before leaves no trace";
}

TEST(LinearSolver, says_so_if_the_matrix_is_not_positive_definite) {
  LinearSolver solver;
  EXPECT_FALSE(solver.factor(lower(-laplacian(50, 1))));
  auto indefinite = laplacian(50, 1);
  indefinite(25, 25) = -1;
  EXPECT_FALSE(solver.factor(lower(indefinite)));
  EXPECT_FALSE(solver.factor(lower(Eigen::MatrixXd::Zero(10, 10))));
}

TEST(LinearSolver, a_matrix_that_is_not_finite_does_not_pass_unnoticed) {
  auto A = laplacian(50, 1);
  A(25, 25) = std::numeric_limits<double>::quiet_NaN();
  LinearSolver solver;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(50);
  EXPECT_TRUE(!solver.factor(lower(A)) || !solver.solve({x.data(), 50}) || !x.allFinite());
}

TEST(LinearSolver, works_again_after_a_failure) {
  const auto A = laplacian(50, 1);
  LinearSolver solver;
  EXPECT_FALSE(solver.factor(lower(-A)));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(50);
  ASSERT_TRUE(solver.factor(lower(A)) && solver.solve({x.data(), 50}));
  EXPECT_LE((A * x - Eigen::VectorXd::Ones(50)).norm(), 1e3 * eps * A.norm() * x.norm());
}

TEST(LinearSolver, solves_nothing_before_it_has_a_factor) {
  LinearSolver solver;
  std::vector<double> b(3, 1.0);
  EXPECT_FALSE(solver.solve(b));
}

// A residual and what a preconditioner makes of it.
struct Left {
  Eigen::VectorXd residual, step;
  double dot(const Left& other) const { return residual.dot(other.step); }
  void add(double share, const Left& other) { residual += share * other.residual, step += share * other.step; }
};

// In exact arithmetic as many steps as the preconditioned operator has eigenvalues, twenty at most. To 1e-10 in the norm of the
// inverse; the condition of its square root is below 1e2.
TEST(GeneralisedConjugateResidual, solves_what_is_not_symmetric_in_as_many_steps_as_it_has_rows) {
  const int n = 20;
  const Eigen::MatrixXd A = laplacian(n, 1), turn = Eigen::MatrixXd::Random(n, n);
  const Eigen::MatrixXd J = A + 0.5 * (turn - turn.transpose());
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(n);
  const Eigen::LDLT<Eigen::MatrixXd> factor(A);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  const auto left_by = [&](const Eigen::VectorXd& at) -> Left {
    const Eigen::VectorXd r = b - J * at;
    return {r, factor.solve(r)};
  };
  GeneralisedConjugateResidual<Left> iteration(left_by(x));
  const double first = iteration.size(), enough = 1e-20 * first;
  double before = first;
  for (int k = 0; k < n && iteration.size() > enough; ++k) {
    iteration.step(left_by(x + iteration.left().step));
    x += iteration.last().step;
    EXPECT_LE(iteration.size(), (1 + 1e-9) * before);
    before = iteration.size();
  }
  EXPECT_LE(iteration.size(), enough);
  EXPECT_LE((b - J * x).norm(), 1e-8 * b.norm());
}

}  // namespace
}  // namespace splashdown::fluid::linear_solver_test
