// Every accelerator on the same table of maps with known fixed points, with bounds that theory gives.
#include "coupling/quasi_newton.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <sstream>

namespace splashdown::coupling {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int never = 1000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Map {
  std::string name;
  int size;
  std::function<Vector(const Vector&)> image;
  bool affine = true;
};

/// x = A x + b with the solution (1, ..., 1).
Map affine(const std::string& name, const Matrix& A) {
  const Vector b = Vector::Ones(A.rows()) - A * Vector::Ones(A.rows());
  return {name, static_cast<int>(A.rows()), [A, b](const Vector& x) -> Vector { return A * x + b; }};
}

/// Eigenvalues -mu_1 ... -mu_n in a random basis, orthogonal or not: a Dirichlet-Neumann pass.
Matrix exchange(const Vector& mu, bool symmetric) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto n = mu.size();
  Matrix R(n, n);
  for (auto& r : R.reshaped()) r = normal(random);
  const Matrix Q = R.householderQr().householderQ();
  if (symmetric) return -Q * mu.asDiagonal() * Q.transpose();
  const Matrix V = Q + 0.3 * R / std::sqrt(static_cast<double>(n));
  return -V * mu.asDiagonal() * V.inverse();
}

std::vector<Map> maps() {
  std::vector<Map> out;
  for (double mu : {0.5, 3.0, 20.0, 1000.0})
    out.push_back(affine("scalar " + std::to_string(mu), Matrix::Constant(1, 1, -mu)));
  out.push_back(affine("three", exchange(Eigen::Vector3d(0.5, 3, 20), true)));
  out.push_back(affine("three_nonsymmetric", exchange(Eigen::Vector3d(0.5, 3, 20), false)));
  out.push_back(affine("twenty", exchange(Vector::LinSpaced(20, 0.5, 20), true)));
  out.push_back(affine("twenty_nonsymmetric", exchange(Vector::LinSpaced(20, 0.5, 20), false)));
  // Second derivatives of a hundredth: the slope changes by that much over the way to the solution (1, 1, 1).
  const Map linear = affine("", exchange(Eigen::Vector3d(0.5, 3, 20), true));
  out.push_back({"mildly_nonlinear", 3,
                 [linear](const Vector& x) -> Vector {
                   return (linear.image(x).array() + 0.01 * (x.array() - 1).square()).matrix();
                 },
                 false});
  return out;
}

/// Passes until |G(x) - x| < 1e-9 of its first value: roundoff is 1e-16 times the largest slope, 1000, squared.
int passes(Accelerator& scheme, const Map& map, Vector* solution = nullptr, double shift = 0) {
  scheme.begin_step();
  Vector x = Vector::Zero(map.size);
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

struct Scheme {
  const char* name;
  std::function<std::unique_ptr<Accelerator>()> make;
};
void PrintTo(const Scheme& scheme, std::ostream* out) { *out << scheme.name; }

class Accelerators : public testing::TestWithParam<Scheme> {};

const Scheme all[] = {{"constant", [] { return std::make_unique<ConstantRelaxation>(0.5); }},
                      {"aitken", [] { return std::make_unique<Aitken>(0.5); }},
                      {"anderson", [] { return std::make_unique<Anderson>(0.5); }},
                      {"broyden", [] { return std::make_unique<Broyden>(0.5); }},
                      {"iqn_ils", [] { return std::make_unique<IqnIls>(0.5); }},
                      {"iqn_ils", [] { return std::make_unique<IqnIls>(0.5, 3); }}};

INSTANTIATE_TEST_SUITE_P(All, Accelerators, testing::ValuesIn(all));

TEST_P(Accelerators, have_the_name_a_scene_gives_them) { EXPECT_EQ(GetParam().make()->name(), GetParam().name); }

TEST_P(Accelerators, give_the_same_bits_twice) {
  for (const auto& map : maps()) {
    Vector once, twice;
    const auto a = GetParam().make(), b = GetParam().make();
    EXPECT_EQ(passes(*a, map, &once), passes(*b, map, &twice)) << map.name;
    EXPECT_EQ(once, twice) << map.name;
  }
}

TEST_P(Accelerators, an_attempt_that_is_not_committed_leaves_no_trace) {
  // Neither its stale residuals, nor values that are not finite.
  const auto map = maps()[4];
  const auto fresh = GetParam().make(), used = GetParam().make();
  passes(*used, map);
  used->begin_step();
  used->next(Vector::Zero(3), Vector::Constant(3, nan));
  used->next(Vector::Zero(3), Vector::Ones(3));
  Vector a, b;
  EXPECT_EQ(passes(*used, map, &a), passes(*fresh, map, &b));
  EXPECT_EQ(a, b);
}

TEST_P(Accelerators, leave_a_solution_alone_from_the_first_step_on) {
  const auto scheme = GetParam().make();
  for (int step = 0; step < 2; ++step) {
    scheme->begin_step();
    for (int k = 0; k < 3; ++k) EXPECT_EQ(scheme->next(Vector::Ones(2), Vector::Ones(2)), Vector(Vector::Ones(2)));
    scheme->commit_step();
  }
}

TEST_P(Accelerators, equal_residuals_and_equal_iterates_fall_back_on_relaxation) {
  const auto scheme = GetParam().make();
  scheme->begin_step();
  Vector x = Vector::Zero(2);
  for (int k = 0; k < 4; ++k) x = scheme->next(x, x + Vector::Ones(2));
  EXPECT_EQ(x, Vector(Vector::Constant(2, 4 * 0.5))) << "no slope to learn: four steps of the factor";
  scheme->begin_step();
  for (int k = 0; k < 4; ++k) x = scheme->next(Vector::Zero(2), Vector::Ones(2));
  EXPECT_EQ(x, Vector(Vector::Constant(2, 0.5)));
}

TEST_P(Accelerators, recover_from_a_pass_that_was_not_finite) {
  const auto scheme = GetParam().make();
  scheme->begin_step();
  scheme->next(Vector::Zero(2), Vector::Constant(2, nan));
  EXPECT_TRUE(scheme->next(Vector::Zero(2), Vector::Ones(2)).allFinite());
  EXPECT_TRUE(scheme->next(Vector::Constant(2, 0.5), Vector::Constant(2, 0.7)).allFinite());
}

TEST_P(Accelerators, checkpoints_continue_bit_for_bit) {
  const auto map = maps()[5];
  const auto straight = GetParam().make(), resumed = GetParam().make();
  passes(*straight, map);
  straight->commit_step();
  std::stringstream file;
  straight->save(file);
  resumed->load(file);
  Vector a, b;
  EXPECT_EQ(passes(*straight, map, &a, 0.3), passes(*resumed, map, &b, 0.3));
  EXPECT_EQ(a, b);
}

class LeastSquares : public testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(All, LeastSquares, testing::Values(all[2], all[4], all[5]));

TEST_P(LeastSquares, an_affine_map_of_n_dimensions_takes_n_and_two_passes) {
  // One pass to begin, n differences to know the slope, one to confirm. Fewer than n differences do not span the
  // error: all eigenvalues differ, none is small.
  for (const auto& map : maps()) {
    if (!map.affine) continue;
    const int count = passes(*GetParam().make(), map);
    EXPECT_LE(count, map.size + 2) << map.name;
    if (map.size <= 3) {
      EXPECT_GE(count, map.size + 2) << map.name;
    }
  }
}

TEST_P(LeastSquares, a_mildly_nonlinear_map_takes_a_few_more) {
  // Superlinear: each further pass gains about the two digits by which the slope is wrong; 9 digits.
  const auto map = maps().back();
  const int count = passes(*GetParam().make(), map);
  EXPECT_LE(count, map.size + 2 + 5);
  EXPECT_GT(count, map.size + 2);
}

TEST(Broyden, ends_on_an_affine_map_within_twice_its_dimensions) {
  // Gay 1979: 2 n steps, and a pass to confirm; the first pass has no step behind it.
  for (const auto& map : maps()) {
    if (!map.affine) continue;
    Broyden scheme(1);
    const int count = passes(scheme, map);
    EXPECT_LE(count, 2 * map.size + 1) << map.name;
    EXPECT_GE(count, 3) << map.name;
  }
}

TEST(Broyden, follows_a_mild_nonlinearity) {
  Broyden scheme(0.5);
  EXPECT_LE(passes(scheme, maps().back()), 2 * 3 + 1 + 5);
}

TEST(Aitken, solves_a_scalar_map_of_any_slope_in_three_passes) {
  for (const auto& map : maps())
    if (map.size == 1) {
      Aitken scheme(0.5);
      EXPECT_EQ(passes(scheme, map), 3) << map.name;
    }
}

TEST(ConstantRelaxation, with_the_factor_of_theory_solves_a_scalar_map_at_once) {
  for (double mu : {0.5, 3.0, 20.0, 1000.0}) {
    ConstantRelaxation scheme(1 / (1 + mu));
    EXPECT_EQ(passes(scheme, affine("", Matrix::Constant(1, 1, -mu))), 2) << mu;
    ConstantRelaxation bold(2.1 / (1 + mu));
    EXPECT_EQ(passes(bold, affine("", Matrix::Constant(1, 1, -mu))), never) << mu;
  }
}

TEST(IqnIls, that_reuses_steps_knows_the_slope_from_the_last_one) {
  for (const auto& map : maps()) {
    if (!map.affine) continue;
    IqnIls forgetful(0.5), learned(0.5, 2);
    for (auto* scheme : {&forgetful, &learned}) passes(*scheme, map), scheme->commit_step();
    // The newest column of two passes and the old ones span the space: at most one column is new.
    EXPECT_LE(passes(learned, map, nullptr, 0.3), 4) << map.name;
    EXPECT_GE(passes(forgetful, map, nullptr, 0.3), std::min(map.size + 2, 5)) << map.name;
    learned.forget();
    EXPECT_EQ(passes(learned, map, nullptr, 0.3), passes(forgetful, map, nullptr, 0.3)) << map.name;
  }
}

TEST(Secants, drop_columns_that_newer_ones_contain) {
  Secants secants;
  EXPECT_FALSE(secants.add({.residual = Vector::Zero(3), .image = Vector::Ones(3)})) << "no change";
  EXPECT_FALSE(secants.add({.residual = Vector::Constant(3, nan), .image = Vector::Ones(3)}));
  EXPECT_FALSE(secants.explain(Vector::Ones(3)).has_value());
  const Vector e0 = Vector::Unit(3, 0), e1 = Vector::Unit(3, 1);
  EXPECT_TRUE(secants.add({.residual = e1, .image = e1}));
  EXPECT_TRUE(secants.add({.residual = e0, .image = 2 * e0}));
  EXPECT_TRUE(secants.add({.residual = e0 + 1e-12 * e1, .image = 7 * e0}));
  const auto explained = secants.explain(Eigen::Vector3d(1, 2, 3));
  ASSERT_TRUE(explained.has_value());
  EXPECT_EQ(secants.size(), 2u) << "the older copy of e0 is gone";
  EXPECT_LE((explained->residual - Eigen::Vector3d(1, 2, 0)).norm(), 1e-11);
  EXPECT_LE((explained->image - Eigen::Vector3d(7, 2, 0)).norm(), 1e-10) << "the newest slope holds";
}

}  // namespace
}  // namespace splashdown::coupling
