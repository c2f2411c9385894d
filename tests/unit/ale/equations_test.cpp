// The equations by themselves: what they preserve, that slopes are slopes.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

#include "core/mixing.hpp"
#include "flows.hpp"
#include "fluid/ale/equations/free_system.hpp"

namespace splashdown::ale::equations_test {
namespace {

FlowMesh some_mesh() {
  return flow_mesh({.min = {-1, -1}, .max = {1, 1}, .far = 0.4, .hulls = {{scenes::circle(0.3), 0.15}}});
}

Nodes shaken(const Nodes& x, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(-by, by);
  return x + Nodes::NullaryExpr(2, x.cols(), [&](Eigen::Index, Eigen::Index) { return way(random); });
}

StepFields some_fields(const FlowMesh& mesh) {
  StepFields fields;
  fields.x = shaken(mesh.nodes, 0.005, 1);
  fields.x_after = shaken(mesh.nodes, 0.005, 2);
  fields.before = Nodes::Random(2, mesh.size());
  fields.mesh_velocity = Nodes::Random(2, mesh.size());
  fields.rate = 7;
  fields.theta = 0.6;
  return fields;
}

// The geometric conservation law: nodes may go where they like.
TEST(FlowEquations, preserve_a_uniform_flow_on_a_mesh_that_moves_arbitrarily) {
  const auto mesh = some_mesh();
  const FlowEquations equations(mesh, 3, 0.2, {false, true, false, false});
  auto fields = some_fields(mesh);
  fields.before = Nodes::Zero(2, mesh.size()).colwise() + Vec<2>(2, -1);
  Unknowns at = Unknowns::Zero(equations.size());
  at.head(2 * mesh.size()) = fields.before.reshaped();
  Eigen::VectorXd residual;
  equations.residual(fields, at, residual);
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-13);
}

TEST(FlowEquations, have_the_slope_that_they_say) {
  const auto mesh = some_mesh();
  const FlowEquations equations(mesh, 3, 0.2, {false, true, false, false});
  const auto fields = some_fields(mesh);
  const Unknowns at = Unknowns::Random(equations.size()), change = Unknowns::Random(equations.size());
  Eigen::SparseMatrix<double> slope;
  equations.linearise(fields, at, slope);
  Eigen::VectorXd above, below;
  const double step = 1e-3;  // residuals are quadratic: central differences are exact
  equations.residual(fields, at + step * change, above);
  equations.residual(fields, at - step * change, below);
  const Eigen::VectorXd difference = (above - below) / (2 * step);
  EXPECT_LT((slope * change - difference).norm(), 1e-10 * difference.norm());
}

// What acts on all nodes together is the change of momentum: nothing is lost between cells.
TEST(FlowEquations, sum_to_momentum) {
  const auto mesh = some_mesh();
  const double rho = 3;
  const FlowEquations equations(mesh, rho, 0.2, {});
  auto fields = some_fields(mesh);
  fields.mesh_velocity = fields.theta * Nodes::Random(2, mesh.size());
  const Vec<2> to(2, 1), from(0.5, 0);
  fields.before = Nodes::Zero(2, mesh.size()).colwise() + from;
  Unknowns at = Unknowns::Random(equations.size());
  at.head(2 * mesh.size()) = (Nodes::Zero(2, mesh.size()).colwise() + to).reshaped();
  Eigen::VectorXd residual;
  equations.residual(fields, at, residual);
  const Vec<2> sum = residual.head(2 * mesh.size()).reshaped(2, mesh.size()).rowwise().sum();
  const double area =
      2 * equations.kinetic_energy(fields.x, Nodes::Zero(2, mesh.size()).colwise() + Vec<2>(1, 0)) / rho;
  EXPECT_LT((sum - rho * area * fields.rate * (to - from)).norm(), 1e-12 * sum.norm());
}

TEST(DirectSolver, solves_what_it_has_factored_and_refuses_what_is_singular) {
  Eigen::SparseMatrix<double> matrix(3, 3);
  matrix.insert(0, 1) = 2;
  matrix.insert(1, 0) = 3;
  matrix.insert(2, 2) = -1;
  matrix.makeCompressed();
  DirectSolver solver;
  ASSERT_TRUE(solver.factor(matrix));
  const Eigen::Vector3d right(2, 6, 5);
  EXPECT_LT((matrix * solver.solve(right) - right).norm(), 1e-14);
  matrix.coeffRef(2, 2) = 0;
  EXPECT_FALSE(solver.factor(matrix));
  EXPECT_FALSE(solver.is_ready());
}

// A linear map with three eigenvalues: four changes span what is left (Walker & Ni 2011, theorem 2.2), where the sequence by itself
// diverges.
TEST(Mixing, ends_when_it_has_seen_as_many_changes_as_there_are_eigenvalues) {
  constexpr Eigen::Index n = 40;
  Eigen::VectorXd eigenvalues(n);
  for (Eigen::Index k = 0; k < n; ++k) eigenvalues[k] = 0.2 + 1.2 * static_cast<double>(k % 3);
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Random(n, n).householderQr().householderQ();
  const Eigen::MatrixXd A = Q * eigenvalues.asDiagonal() * Q.transpose();
  const Eigen::VectorXd right = Eigen::VectorXd::Random(n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  Mixing mixing(n);
  for (int k = 0; k < 4; ++k) x += mixing.way(right - A * x);
  EXPECT_LT((right - A * x).norm(), 1e-10 * right.norm());
}

}  // namespace
}  // namespace splashdown::ale::equations_test
