#include "fluid/vortex/poisson/lattice_green.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace splashdown::vortex {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int near = 40;  // the series is good to 40^-6 beyond

struct Rule {
  std::vector<double> points, weights;  // on [0, pi]
};

/// Gauss-Legendre by the eigenvalues of Jacobi's matrix (Golub & Welsch 1969). The integrand turns at most near/2
/// times.
Rule gauss() {
  constexpr int n = 96;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n), side(n - 1);
  for (int k = 1; k < n; ++k) side[k - 1] = k / std::sqrt(4. * k * k - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, side);
  Rule rule;
  for (int k = 0; k < n; ++k) {
    const double first = solver.eigenvectors()(0, k);
    rule.points.push_back(0.5 * pi * (1 + solver.eigenvalues()[k]));
    rule.weights.push_back(pi * first * first);
  }
  return rule;
}

double by_integral(int m, int n) {
  static const Rule rule = gauss();
  double sum = 0;
  for (std::size_t k = 0; k < rule.points.size(); ++k) {
    const double b = rule.points[k], c = 2 - std::cos(b), s = std::acosh(c);
    sum += rule.weights[k] * (1 - std::exp(-m * s) * std::cos(n * b)) / std::sqrt(c * c - 1);
  }
  return -sum / (2 * pi);
}

double by_series(double m, double n) {
  const double a = m * m, b = n * n, r2 = a + b;
  const double fourth = a * a - 6 * a * b + b * b;
  const double eighth =
      43 * a * a * a * a - 772 * a * a * a * b + 1570 * a * a * b * b - 772 * a * b * b * b + 43 * b * b * b * b;
  return -(0.5 * std::log(r2) + lattice_offset) / (2 * pi) + fourth / (24 * pi * std::pow(r2, 3)) +
         eighth / (480 * pi * std::pow(r2, 6));
}

}  // namespace

double lattice_green(int m, int n) {
  m = std::abs(m);
  n = std::abs(n);
  if (m < n) std::swap(m, n);
  return m <= near ? by_integral(m, n) : by_series(m, n);
}

}  // namespace splashdown::vortex
