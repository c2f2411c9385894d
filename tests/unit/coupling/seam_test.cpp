// Schemes, accelerators and interface terms with a fluid and a structure of a hundred lines, against closed formulas: nothing
// behind the seam is known to them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"
#include "tests/unit/coupling/toys.hpp"

namespace splashdown::coupling::seam_test {
namespace {

using toys::Matrix;
using toys::Modal;
using toys::Vector;
using toys::Water;

constexpr double eps = std::numeric_limits<double>::epsilon();

Matrix one(double value) { return Matrix::Constant(1, 1, value); }

/// A mass on a spring that carries water of mu times its mass, which has a spring and a damper of its own.
struct Oscillator {
  double mass = 2, mu = 3, water_spring = 5, spring = 7, damping = 0, force = 0;

  std::unique_ptr<Water> water() const {
    return std::make_unique<Water>(one(mu * mass), one(damping), one(water_spring), std::vector<std::size_t>{0});
  }
  std::unique_ptr<Modal> body() const {
    return std::make_unique<Modal>(
        Modal::Made{one(1), one(mass), one(spring), Vector::Constant(1, force), toys::one_wall(1, mass)});
  }
};

/// A stepper together with what is in it.
struct Pair {
  std::unique_ptr<Stepper> stepper;
  Water* water;
  Modal* body;
};

Pair simultaneous(const Oscillator& made) {
  auto water = made.water();
  auto body = made.body();
  Pair pair{nullptr, water.get(), body.get()};
  pair.stepper = std::make_unique<Simultaneous>(std::move(water), std::move(body));
  return pair;
}

Pair partitioned(const Oscillator& made, std::unique_ptr<InterfaceTerm> term, std::unique_ptr<Accelerator> accelerator,
                 CouplingLimits limits = {}) {
  auto water = made.water();
  auto body = made.body();
  Pair pair{nullptr, water.get(), body.get()};
  pair.stepper =
      std::make_unique<Partitioned>(std::move(water), std::move(body), std::move(term), std::move(accelerator), limits);
  return pair;
}

const double ratios[] = {0.5, 3.0, 20.0, 1000.0};

TEST(Simultaneous, solves_any_fluid_in_one_pass) {
  for (double mu : ratios) {
    const Oscillator made{.mu = mu, .damping = 11, .force = 13};
    const auto pair = simultaneous(made);
    pair.water->state().place[0] = pair.body->amplitude()[0] = 0.1;
    const double dt = 0.01;
    double place = 0.1, rate = 0;
    for (int k = 0; k < 5; ++k) {
      const auto report = pair.stepper->attempt(dt);
      ASSERT_TRUE(report.ok()) << report.cause;
      EXPECT_EQ(report.passes, 1);
      EXPECT_LE(report.residual, 100 * eps * (1 + mu));
      pair.stepper->commit();
      const double kick = k == 0 ? dt / 2 : dt;  // leapfrog: a policy of the scheme
      rate += kick * (13 - (5 + 7) * place - 11 * rate) / (made.mass * (1 + mu));
      place += dt * rate;
      EXPECT_NEAR(pair.body->rate()[0], rate, 100 * eps * (1 + mu) * std::abs(rate));
      EXPECT_NEAR(pair.body->amplitude()[0], place, 100 * eps * (1 + mu) * std::abs(place));
      EXPECT_EQ(pair.water->state().place, pair.body->amplitude()) << "both sides agree on where walls are";
    }
  }
}

// x -> -mu x + (1 + mu) x*: with a factor w each pass leaves 1 - w (1 + mu) of the residual.
TEST(Report, has_the_residual_of_each_pass_and_they_shrink_as_theory_says) {
  for (const double w : {1.0, 0.5}) {
    const auto pair =
        partitioned({.mu = 0.5, .force = 13}, std::make_unique<NoTerm>(), std::make_unique<ConstantRelaxation>(w));
    const auto report = pair.stepper->attempt(0.01);
    ASSERT_TRUE(report.ok()) << report.cause;
    const auto& residuals = report.pass_residuals;
    ASSERT_EQ(residuals.size(), static_cast<std::size_t>(report.passes));
    EXPECT_EQ(residuals.back(), report.residual);
    for (std::size_t k = 1; k < residuals.size() && residuals[k] > 1e-6; ++k)
      EXPECT_NEAR(residuals[k] / residuals[k - 1], std::abs(1 - w * 1.5), 1e-6);
  }
  const auto one_pass = simultaneous({.mu = 3, .force = 13});
  const auto report = one_pass.stepper->attempt(0.01);
  EXPECT_EQ(report.pass_residuals, std::vector<double>{report.residual});
  const auto refused = partitioned({.mu = 3, .force = 13}, std::make_unique<NoTerm>(),
                                   std::make_unique<ConstantRelaxation>(0.1), {.max_passes = 4});
  EXPECT_EQ(refused.stepper->attempt(0.01).pass_residuals.size(), 4u);
}

// What may be cured by letting a fragment of the fluid go: nothing that the sides do not agree on.
TEST(Report, says_whether_it_is_the_fluid_that_may_not_go_on) {
  for (const char* cause : {"", "an element turns over"}) {
    const bool unfit = *cause != 0;
    std::vector<Pair> agreeing, others;
    agreeing.push_back(simultaneous({.mu = 3, .force = 13}));
    agreeing.push_back(
        partitioned({.mu = 0.5, .force = 13}, std::make_unique<NoTerm>(), std::make_unique<Aitken>(0.5)));
    others.push_back(partitioned({.mu = 3, .force = 13}, std::make_unique<NoTerm>(),
                                 std::make_unique<ConstantRelaxation>(0.1), {.max_passes = 1}));
    for (auto& pair : agreeing) {
      pair.water->unfit = cause;
      const auto report = pair.stepper->attempt(0.01);
      EXPECT_EQ(report.cause, cause);
      EXPECT_EQ(report.of_fluid, unfit);
    }
    for (auto& pair : others) {
      pair.water->unfit = cause;
      const auto report = pair.stepper->attempt(0.01);
      EXPECT_NE(report.cause, cause);
      EXPECT_FALSE(report.of_fluid) << report.cause;
    }
  }
}

TEST(Simultaneous, swings_with_the_frequency_of_leapfrog) {
  // q_n = q_0 cos(n theta), 1 - cos(theta) = (k dt^2 / 2) / (m + m_a): exact, no energy is gained or lost.
  const Oscillator made{.mu = 9};
  const auto pair = simultaneous(made);
  pair.water->state().place[0] = pair.body->amplitude()[0] = 0.1;
  const double dt = 0.05, theta = std::acos(1 - 0.5 * (5 + 7) * dt * dt / (2 * 10));
  for (int n = 1; n <= 2000; ++n) {
    ASSERT_TRUE(pair.stepper->attempt(dt).ok());
    pair.stepper->commit();
    ASSERT_NEAR(pair.body->amplitude()[0], 0.1 * std::cos(n * theta), 10 * n * eps) << n;
  }
}

struct Scheme {
  const char* name;
  std::function<std::unique_ptr<Accelerator>(double mu)> make;
  int passes;  // of a scalar affine map, by theory
};

// One slope: two residuals know it, the third pass is exact; a factor or a slope that is known makes the second one exact.
const Scheme schemes[] = {{"constant", [](double mu) { return std::make_unique<ConstantRelaxation>(1 / (1 + mu)); }, 2},
                          {"aitken", [](double) { return std::make_unique<Aitken>(0.5); }, 3},
                          {"anderson", [](double) { return std::make_unique<Anderson>(0.5); }, 3},
                          {"broyden", [](double) { return std::make_unique<Broyden>(0.5); }, 3},
                          {"iqn_ils", [](double) { return std::make_unique<IqnIls>(0.5); }, 3},
                          {"probe", [](double) { return std::make_unique<Probe>(1); }, 2}};

TEST(Partitioned, takes_the_passes_of_theory_with_any_fluid) {
  for (double mu : ratios)
    for (const auto& scheme : schemes) {
      const Oscillator made{.mu = mu, .force = 13};
      const auto pair = partitioned(made, std::make_unique<NoTerm>(), scheme.make(mu));
      const auto report = pair.stepper->attempt(0.01);
      ASSERT_TRUE(report.ok()) << scheme.name << ' ' << mu << ": " << report.cause;
      EXPECT_EQ(report.passes, scheme.passes) << scheme.name << ' ' << mu;
      // The residual is (1 + mu) times the error, relative.
      EXPECT_NEAR(pair.body->trial_rate()[0] / (0.005 * 13 / (2 * (1 + mu))), 1, 1e-8 * (1 + mu)) << scheme.name;
    }
}

TEST(Partitioned, without_a_term_diverges_if_the_added_mass_exceeds_the_mass) {
  for (double mu : {0.1, 0.5, 0.9, 1.1, 3.0}) {
    const auto pair = partitioned({.mu = mu, .force = 13}, std::make_unique<NoTerm>(),
                                  std::make_unique<ConstantRelaxation>(1.0), {.max_passes = 1000});
    const auto report = pair.stepper->attempt(0.01);
    EXPECT_EQ(report.ok(), mu < 1) << mu;
    // The error of the first guess, at rest, is that of free flight over 1 + mu; it shrinks by mu a pass.
    if (mu < 1) {
      EXPECT_NEAR(report.passes, 1 + std::log(1e-8) / std::log(mu), 1.5) << mu;
    } else {
      EXPECT_NE(report.cause.find("diverged"), std::string::npos) << report.cause;
    }
  }
}

TEST(Partitioned, with_the_answer_of_the_body_itself_as_its_stand_in_takes_three_passes) {
  // On a wall of one coordinate 1/m is B C B^T: the first pass begins with velocities and impulses of different steps, the
  // second is exact, the third finds that it is. Whatever the mass.
  for (double mu : ratios)
    for (const bool robin : {false, true}) {
      std::unique_ptr<InterfaceTerm> term;
      if (robin)
        term = std::make_unique<RobinTerm>();
      else
        term = std::make_unique<LaplacianTerm>();
      const auto pair =
          partitioned({.mu = mu, .force = 13}, std::move(term), std::make_unique<ConstantRelaxation>(1.0));
      const auto report = pair.stepper->attempt(0.01);
      ASSERT_TRUE(report.ok()) << report.cause;
      EXPECT_EQ(report.passes, 3) << mu;
      EXPECT_NEAR(pair.body->trial_rate()[0] / (0.005 * 13 / (2 * (1 + mu))), 1, 100 * eps * (1 + mu));
    }
}

TEST(Partitioned, with_half_the_answer_converges_whatever_the_mass) {
  // phi_{k+1} = const - r phi_k,   r = (1/m - 1/2m) / (1/m_a + 1/2m) = (mu / 2) / (1 + mu / 2) < 1
  for (double mu : ratios) {
    const double r = 0.5 * mu / (1 + 0.5 * mu);
    const auto pair = partitioned({.mu = mu, .force = 13}, std::make_unique<LaplacianTerm>(0.5),
                                  std::make_unique<ConstantRelaxation>(1.0), {.tolerance = 1e-6, .max_passes = 100000});
    const auto report = pair.stepper->attempt(0.01);
    ASSERT_TRUE(report.ok()) << report.cause;
    // Residuals |G(x) - x| are 1 + r times the error; relative to free flight or the motion, whichever is faster.
    EXPECT_LE(report.passes, 3 + std::log(1e-6 / (2 * (1 + mu))) / std::log(r)) << mu;
    EXPECT_NEAR(pair.body->trial_rate()[0] / (0.005 * 13 / (2 * (1 + mu))), 1, 1e-6 * (1 + mu)) << mu;
  }
}

TEST(Partitioned, with_a_stand_in_ends_with_every_accelerator) {
  // Two entries, velocity and impulse: n + 2 passes of least squares, 2 n + 1 of Broyden's method.
  for (double mu : ratios)
    for (const auto& scheme : schemes) {
      const std::string name = scheme.name;
      if (name == "constant" || name == "aitken") continue;  // one factor for two entries: no bound
      const auto pair = partitioned({.mu = mu, .force = 13}, std::make_unique<LaplacianTerm>(0.5), scheme.make(mu));
      const auto report = pair.stepper->attempt(0.01);
      ASSERT_TRUE(report.ok()) << name << ' ' << mu << ": " << report.cause;
      EXPECT_LE(report.passes, name == "broyden" ? 5 : name == "probe" ? 2 : 4) << name << ' ' << mu;
    }
}

TEST(Partitioned, staggered_with_a_slope_is_exact_for_a_fluid_that_is_linear) {
  const auto pair = partitioned({.mu = 20, .force = 13}, std::make_unique<NoTerm>(), std::make_unique<Probe>(1),
                                {.tolerance = 0, .fixed_passes = 2});
  ASSERT_EQ(pair.stepper->attempt(0.01).passes, 2);
  EXPECT_NEAR(pair.body->trial_rate()[0], 0.005 * 13 / (2 * 21), 1e3 * eps);
}

TEST(Coupled, books_the_structure_under_its_name_and_restores_both_sides) {
  const Oscillator made{.force = 13};
  const auto whole = simultaneous(made), resumed = simultaneous(made);
  ASSERT_EQ(whole.stepper->phase_seconds().front().first, "modal");
  ASSERT_TRUE(whole.stepper->attempt(0.01).ok());
  whole.stepper->commit();
  std::stringstream file;
  whole.stepper->save(file);
  resumed.stepper->load(file);
  for (const auto* pair : {&whole, &resumed}) {
    ASSERT_TRUE(pair->stepper->attempt(0.02).ok());
    pair->stepper->commit();
  }
  EXPECT_EQ(whole.body->amplitude(), resumed.body->amplitude());
  EXPECT_EQ(whole.water->state().rate, resumed.water->state().rate);
}

}  // namespace
}  // namespace splashdown::coupling::seam_test
