// Maps with known fixed points, on which the tests of accelerators count passes.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "coupling/accelerators/accelerator.hpp"

namespace splashdown::coupling::maps {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

inline constexpr int never = 1000;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One pass of Dirichlet-Neumann: slopes -mu_1 ... -mu_n, added mass over mass, around the solution (1, ..., 1).
struct Map {
  std::string name;
  Vector mu;  // ascending
  std::function<Vector(const Vector&)> image;
  Matrix slope;          // at the solution
  double condition = 1;  // of the basis of its modes
  double bend = 0;       // most that its slope changes on the way from 0 to the solution
  int size() const { return static_cast<int>(mu.size()); }
  bool affine() const { return bend == 0; }
  bool symmetric() const { return condition == 1; }
};

inline Map affine(const std::string& name, const Vector& mu, const Matrix& basis = {}) {
  const Matrix modes = basis.size() ? basis : Matrix(Matrix::Identity(mu.size(), mu.size()));
  const Matrix A = -modes * mu.asDiagonal() * modes.inverse();
  const Vector b = Vector::Ones(A.rows()) - A * Vector::Ones(A.rows());
  const bool orthogonal = (modes.transpose() * modes).isIdentity(1e-12);
  return {name,
          mu,
          [A, b](const Vector& x) -> Vector { return A * x + b; },
          A,
          orthogonal ? 1.0 : modes.norm() * modes.inverse().norm(),
          0.0};
}

inline Map scalar(double mu) { return affine("scalar " + std::to_string(mu), Vector::Constant(1, mu)); }

/// Random modes, at right angles or not.
inline Matrix modes(Eigen::Index n, bool orthogonal) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Matrix R(n, n);
  for (auto& r : R.reshaped()) r = normal(random);
  const Matrix Q = R.householderQr().householderQ();
  return orthogonal ? Q : Matrix(Q + 0.3 * R / std::sqrt(static_cast<double>(n)));
}

/// The table that every accelerator meets.
inline std::vector<Map> all() {
  std::vector<Map> out;
  for (double mu : {0.5, 3.0, 20.0, 1000.0}) out.push_back(scalar(mu));
  const Vector three = Eigen::Vector3d(0.5, 3, 20), twenty = Vector::LinSpaced(20, 0.5, 20);
  out.push_back(affine("three", three, modes(3, true)));
  out.push_back(affine("three_nonsymmetric", three, modes(3, false)));
  out.push_back(affine("twenty", twenty, modes(20, true)));
  out.push_back(affine("twenty_nonsymmetric", twenty, modes(20, false)));
  Map bent = affine("mildly_nonlinear", three, modes(3, true));
  bent.image = [linear = bent.image](const Vector& x) -> Vector {
    return (linear(x).array() + 0.01 * (x.array() - 1).square()).matrix();
  };
  bent.bend = 0.02 * std::sqrt(3.0);
  out.push_back(bent);
  return out;
}

/// Passes until |G(x) - x| < 1e-9 of its first value: roundoff is 1e-16 times the largest slope, 1000, squared.
inline int passes(Accelerator& scheme, const Map& map, Vector* solution = nullptr, double shift = 0) {
  scheme.begin_step();
  if (scheme.needs_slope()) scheme.set_slope(map.slope);
  Vector x = Vector::Zero(map.size());
  double first = 0;
  for (int k = 1; k < never; ++k) {
    const Vector image = map.image(x).array() + shift;
    if (k == 1) first = (image - x).norm();
    if (!image.allFinite() || image.norm() > 1e100) return never;
    if ((image - x).norm() <= 1e-9 * first) {
      if (solution) *solution = x;
      return k;
    }
    x = scheme.next(x, image);
  }
  return never;
}

}  // namespace splashdown::coupling::maps
