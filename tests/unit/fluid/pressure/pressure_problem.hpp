// The pressure equation of a cube of water, for its tests.
#pragma once

#include <gtest/gtest.h>

#include "fluid/pfem/pressure/pressure.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::pressure_tests {

using scenes::eps;

inline constexpr double density = 1000;

template <int d>
struct Problem {
  static constexpr int m = freedoms<d>;
  scenes::Lattice<d> cube{d == 2 ? 8 : 5};
  const Vec<d> centre = Vec<d>::Constant(0.3);
  std::vector<WallPlace<d>> places{Isometry<d>(Eigen::Translation<double, d>(centre))};
  PressureEquation<d> equation;
  std::mt19937 random{11};

  bool build(const InterfaceModel& response = {}) {
    return equation.build(cube.nodes, cube.mesh, density, places, WallLayout<d>::rigid(places.size()), response);
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
  static InterfaceModel body(const Matrix& inertia) { return {.modal = {Matrix::Identity(), inertia}}; }
  bool solve(std::vector<double>& r, std::vector<WallVelocity<d>>& s) {
    if (!equation.solve(r)) return false;
    equation.respond(r, s, Eigen::VectorXd::Zero(equation.mode_count()));
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
      equation.flux_residual(cube.nodes.x, v, std::vector<WallVelocity<d>>(1, Twist<d>::Zero()), places, r);
      K.col(j) = -Eigen::Map<const Eigen::VectorXd>(r.data(), equation.size());
    }
    return K;
  }
  Eigen::MatrixXd B() const {
    Eigen::MatrixXd out(m, equation.size());
    std::vector<double> unit(equation.size(), 0.0);
    for (int j = 0; j < equation.size(); ++j) {
      unit[j] = 1;
      out.col(j) = equation.impulse(0, unit).rigid;
      unit[j] = 0;
    }
    return out;
  }
};

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
inline double smallest_eigenvalue(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}
inline Eigen::Map<const Eigen::VectorXd> eigen(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace splashdown::fluid::pressure_tests
