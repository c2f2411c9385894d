// Constant and dynamic relaxation. Laws that all accelerators obey: accelerator_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/accelerators/accelerator.hpp"
#include "tests/unit/coupling/maps.hpp"

namespace splashdown::coupling::relaxation_test {
namespace {

using namespace maps;

TEST(ConstantRelaxation, reduces_the_error_of_a_linear_map_by_its_factor) {
  for (double w : {0.1, 0.5, 1.0})
    for (double mu : {3.0, 0.5, -0.5}) {
      ConstantRelaxation scheme(w);
      const Vector x = Vector::Constant(1, 0.2);
      const double error = scheme.next(x, scalar(mu).image(x))[0] - 1;
      EXPECT_NEAR(error, (1 - w * (1 + mu)) * (0.2 - 1), 1e-15);
    }
}

TEST(ConstantRelaxation, needs_the_passes_that_its_factor_predicts) {
  for (double mu : {0.9, 0.5, -0.5, -0.9}) {
    ConstantRelaxation scheme(1);
    const int predicted = static_cast<int>(std::ceil(std::log(1e-9) / std::log(std::abs(mu)))) + 1;
    EXPECT_NEAR(passes(scheme, scalar(mu)), predicted, 1);
  }
}

TEST(ConstantRelaxation, converges_if_its_factor_is_below_two_over_one_and_the_mass_ratio) {
  for (double mu : {0.5, 3.0, 20.0, 1000.0}) {
    ConstantRelaxation exact(1 / (1 + mu)), timid(1.9 / (1 + mu)), bold(2.1 / (1 + mu));
    EXPECT_EQ(passes(exact, scalar(mu)), 2) << mu;
    EXPECT_NEAR(passes(timid, scalar(mu)), std::log(1e-9) / std::log(0.9) + 1, 1) << mu;
    EXPECT_EQ(passes(bold, scalar(mu)), never) << mu;
  }
  ConstantRelaxation plain(1);
  EXPECT_EQ(passes(plain, scalar(3)), never) << "added mass exceeds mass";
}

TEST(Aitken, solves_a_scalar_linear_map_in_three_passes) {
  // Two residuals determine the line; the third pass finds its zero.
  for (double mu : {100.0, 3.0, 0.5, -0.5, -0.99, -3.0})
    for (double w : {0.1, 0.5, 1.0}) {
      Aitken scheme(w);
      EXPECT_EQ(passes(scheme, scalar(mu)), std::abs(1 - w * (1 + mu)) < 1e-12 ? 2 : 3) << mu << ' ' << w;
    }
}

TEST(Aitken, begins_each_step_anew_with_its_first_factor) {
  Aitken scheme(0.5);
  passes(scheme, affine("", Eigen::Vector2d(3, 2)));
  scheme.begin_step();
  EXPECT_EQ(scheme.next(Vector::Zero(1), Vector::Ones(1))[0], 0.5);
}

}  // namespace
}  // namespace splashdown::coupling::relaxation_test
