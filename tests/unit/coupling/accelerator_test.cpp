#include "coupling/accelerator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace splashdown::coupling {
namespace {

using Vector = Eigen::VectorXd;

// x = A x + b has the solution 1 if b = (1 - A) 1.
struct Map {
  Eigen::MatrixXd A;
  Vector operator()(const Vector& x) const {
    return A * x + (Vector::Ones(A.rows()) - A * Vector::Ones(A.rows()));
  }
};

Map scalar(double a) { return {Eigen::MatrixXd::Constant(1, 1, a)}; }
Map diagonal(std::initializer_list<double> a) {
  Vector values(static_cast<Eigen::Index>(a.size()));
  std::copy(a.begin(), a.end(), values.begin());
  return {values.asDiagonal().toDenseMatrix()};
}

// Passes until |G(x) - x| < 1e-10; 1000: never.
int passes(Accelerator& scheme, const Map& map) {
  scheme.begin_step();
  Vector x = Vector::Zero(map.A.rows());
  for (int k = 1; k < 1000; ++k) {
    const Vector image = map(x);
    if (!image.allFinite()) return 1000;
    if ((image - x).norm() < 1e-10) return k;
    x = scheme.next(x, image);
  }
  return 1000;
}

TEST(ConstantRelaxation, reduces_the_error_of_a_linear_map_by_its_factor) {
  for (double w : {0.1, 0.5, 1.0})
    for (double a : {-3.0, -0.5, 0.5}) {
      ConstantRelaxation scheme(w);
      const Vector x = Vector::Constant(1, 0.2);
      const double error = scheme.next(x, scalar(a)(x))[0] - 1;
      EXPECT_NEAR(error, (1 - w * (1 - a)) * (0.2 - 1), 1e-15);
    }
}

TEST(ConstantRelaxation, needs_the_passes_that_its_factor_predicts) {
  for (double a : {-0.9, -0.5, 0.5, 0.9}) {
    ConstantRelaxation scheme(1);
    const int predicted =
        static_cast<int>(std::ceil(std::log(1e-10 / std::abs(1 - a)) / std::log(std::abs(a)))) + 1;
    EXPECT_NEAR(passes(scheme, scalar(a)), predicted, 1);
  }
}

TEST(ConstantRelaxation, diverges_where_added_mass_exceeds_mass) {
  // a = -M_a / m; relaxed it converges if w < 2 / (1 + M_a / m).
  ConstantRelaxation plain(1), relaxed(0.4), too_bold(0.6);
  EXPECT_EQ(passes(plain, scalar(-3)), 1000);
  EXPECT_LT(passes(relaxed, scalar(-3)), 60);
  EXPECT_EQ(passes(too_bold, scalar(-3)), 1000);
}

TEST(Aitken, solves_a_scalar_linear_map_in_three_passes) {
  // Two residuals determine the line; the third pass finds its zero.
  for (double a : {-100.0, -3.0, -0.5, 0.5, 0.99, 3.0})
    for (double w : {0.1, 0.5, 1.0}) {
      Aitken scheme(w);
      const int count = passes(scheme, scalar(a));
      EXPECT_LE(count, 3) << a << ' ' << w;
      EXPECT_GE(count, std::abs(1 - w * (1 - a)) < 1e-12 ? 2 : 3) << a << ' ' << w;
    }
}

TEST(Aitken, beats_the_constant_factor_it_starts_from) {
  for (const Map& map : {diagonal({0.9, 0.8}), diagonal({-3, -2.5, -2}), diagonal({-3, 0.5})}) {
    Aitken dynamic(0.3);
    ConstantRelaxation constant(0.3);
    EXPECT_LT(passes(dynamic, map), std::min(passes(constant, map), 60));
  }
}

TEST(Aitken, begins_each_step_anew) {
  Aitken scheme(0.5);
  const int first = passes(scheme, diagonal({-3, -2}));
  EXPECT_EQ(passes(scheme, diagonal({-3, -2})), first);
  scheme.begin_step();
  EXPECT_EQ(scheme.next(Vector::Zero(1), Vector::Ones(1))[0], 0.5);
}

TEST(Aitken, equal_residuals_keep_the_factor) {
  Aitken scheme(0.5);
  scheme.begin_step();
  Vector x = Vector::Zero(1);
  for (int k = 0; k < 3; ++k) x = scheme.next(x, x + Vector::Ones(1));
  EXPECT_EQ(x[0], 1.5);
}

TEST(Accelerators, leave_a_solution_alone) {
  Aitken dynamic(0.5);
  ConstantRelaxation constant(0.5);
  dynamic.begin_step();
  for (Accelerator* scheme : {static_cast<Accelerator*>(&dynamic), static_cast<Accelerator*>(&constant)})
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(scheme->next(Vector::Ones(2), Vector::Ones(2)), Vector(Vector::Ones(2)));
}

}  // namespace
}  // namespace splashdown::coupling
