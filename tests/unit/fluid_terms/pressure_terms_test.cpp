// What effects may do beside momentum: terms of the pressure equation, and work that is booked.
#include <gtest/gtest.h>

#include <numeric>

#include "basin.hpp"

namespace splashdown::fluid::pressure_terms_test {
namespace {

using testing::Basin;

constexpr double density = 1000, g = 9.81;

/// Fills the terms of a step.
class Terms final : public Effect<2> {
 public:
  using Fill = std::function<void(const StepView<2>&, PressureTerms&)>;
  explicit Terms(Fill fill) : fill_(std::move(fill)) {}
  std::string name() const override { return "terms"; }
  Status predict(const StepView<2>&, const Carried<2>&, const Predicted<2>&) override { return {}; }
  void pressure(const StepView<2>& step, PressureTerms& terms) override {
    fill_(step, terms);
    last = terms;
  }

  PressureTerms last;

 private:
  Fill fill_;
};

auto surface_pressure(std::function<double(const Vec<2>&)> p) {
  return std::make_unique<Terms>([p](const StepView<2>& step, PressureTerms& terms) {
    for (const auto& x : step.nodes.x) terms.surface_pressure.push_back(p(x));
  });
}

double fastest_until(coupling::scenes::Watched<2>& stepper, double end) {
  double fastest = 0;
  EXPECT_TRUE(testing::run(stepper, end,
                           [&](const auto& fluid, double) { fastest = std::max(fastest, testing::max_speed(fluid)); }));
  return fastest;
}

// It is one more constant of the pressure: water does not feel it, walls do.
TEST(SurfacePressure, that_is_uniform_moves_nothing_and_loads_walls) {
  constexpr double p0 = 5000;
  auto stepper =
      testing::water(Basin{.size = 0.1}, testing::gravity(), surface_pressure([](const auto&) { return p0; }));
  EXPECT_LT(fastest_until(stepper, 0.2), 1e-10);  // roundoff of p0 / rho over some tens of solves
  ASSERT_TRUE(stepper.attempt(1e-3).ok());
  for (std::size_t i = 0; i < stepper.fluid().nodes().size(); ++i)
    EXPECT_NEAR(stepper.fluid().pressure()[i], p0 - density * g * stepper.fluid().nodes().x[i].y(), 1e-6 * p0);
  const auto load = stepper.fluid().result().loads[0].total();
  EXPECT_NEAR(load[1], -(density * g * 0.5 + p0), 1e-6 * p0);
  EXPECT_NEAR(load[0], 0, 1e-6 * p0);
}

// p = -rho g eta carries a surface that is eta high: linear theory, so that what moves is of second order in eta.
TEST(SurfacePressure, holds_up_a_wave) {
  const Basin basin{.size = 0.05, .amplitude = 0.01};
  const auto carried = [](const Vec<2>& x) { return -density * g * 0.01 * std::cos(2 * std::numbers::pi * x.x()); };
  auto held = testing::water(basin, testing::gravity(), surface_pressure(carried));
  auto free = testing::water(basin, testing::gravity());
  EXPECT_LT(fastest_until(held, 0.3), 0.1 * fastest_until(free, 0.3));
}

// dV/dt = -sum C_i phi_i: what the diagonal says an impulse takes away is what the water loses.
TEST(Diagonal, takes_the_volume_that_it_says) {
  const double kick = 5e-4;  // of the first step: half of dt
  auto terms = std::make_unique<Terms>([](const StepView<2>& step, PressureTerms& out) {
    for (const double v : step.lumped_volume) out.diagonal.push_back(v * 1e-7);
  });
  const auto* seen = terms.get();
  auto stepper = testing::water(Basin{.size = 0.1}, testing::gravity(), std::move(terms));
  const double before = stepper.fluid().ledger().volume, dt = 1e-3;
  ASSERT_TRUE(stepper.attempt(dt).ok());
  double taken = 0;
  for (std::size_t i = 0; i < seen->last.diagonal.size(); ++i)
    taken += seen->last.diagonal[i] * kick * stepper.fluid().pressure()[i];
  stepper.commit();
  ASSERT_GT(taken, 0);
  EXPECT_NEAR((before - stepper.fluid().ledger().volume) / dt, taken,
              0.02 * taken);  // smoothed pressures, not impulses
}

TEST(Source, makes_the_volume_that_it_says) {
  const double rate = 1e-3;  // [m^2/s] in all
  auto stepper = testing::water(Basin{.size = 0.1}, testing::gravity(),
                                std::make_unique<Terms>([&](const StepView<2>& step, PressureTerms& out) {
                                  out.source.assign(step.nodes.size(), 0.0);
                                  double sum = 0;
                                  for (std::size_t i = 0; i < out.source.size(); ++i)
                                    if (step.nodes.x[i].y() < -0.2) sum += out.source[i] = step.lumped_volume[i];
                                  for (double& q : out.source) q *= rate / sum;
                                }));
  const double before = stepper.fluid().ledger().volume;
  ASSERT_TRUE(testing::run(stepper, 0.1, [](const auto&, double) {}));
  const auto& ledger = stepper.fluid().ledger();
  EXPECT_NEAR(ledger.volume_of_effects, 0.1 * rate, 1e-12);
  EXPECT_NEAR(ledger.volume - before, 0.1 * rate, 1e-9 * before);
}

/// Shakes the basin's water with its first mode.
class Shaker final : public Effect<2> {
 public:
  std::string name() const override { return "shaker"; }
  bool books_work() const override { return true; }
  Status predict(const StepView<2>& step, const Carried<2>&, const Predicted<2>& predicted) override {
    const double k = std::numbers::pi, omega = std::sqrt(g * k * std::tanh(k * 0.5));
    for (std::size_t i = 0; i < predicted.v.size(); ++i) {
      const Vec<2>& x = step.nodes.x[i];
      const Vec<2> mode(-std::sin(k * x.x()) * std::cosh(k * (x.y() + 0.5)),
                        std::cos(k * x.x()) * std::sinh(k * (x.y() + 0.5)));
      predicted.v[i] += step.kick * 0.2 * std::cos(omega * step.t) * mode;
    }
    return {};
  }
};

// K + P grow by what the effect brings; the scheme's own error is that of standing waves at this mesh, 1 % of the energy a
// period (docs/validation.md), over a period and a half.
TEST(Work, of_an_effect_that_books_it_closes_the_balance_of_energy) {
  auto stepper = testing::water(Basin{.size = 0.04}, testing::gravity(), std::make_unique<Shaker>());
  double first = 0, last = 0, booked = 0;
  bool begun = false;
  ASSERT_TRUE(testing::run(stepper, 1.8, [&](const auto& fluid, double) {
    const auto& ledger = fluid.ledger();
    last = ledger.kinetic_energy + ledger.potential_energy;
    booked = ledger.work_of_effects;
    if (!begun) first = last, begun = true;
  }));
  ASSERT_GT(booked, 1);  // [J/m]
  EXPECT_NEAR(last - first, booked, 0.02 * booked);
  const auto names = stepper.fluid().diagnostics();
  EXPECT_EQ(names.back().first, "work_of_effects");
  EXPECT_EQ(names[names.size() - 2].first, "shaker_work_rate");
}

TEST(Gravity, alone_is_taken_for_gravity) {
  const Gravity<2> gravity({1, -g});
  EXPECT_EQ(gravity.uniform_acceleration(), Vec<2>(1, -g));
  EXPECT_TRUE(Shaker().uniform_acceleration().isZero(0));
}

}  // namespace
}  // namespace splashdown::fluid::pressure_terms_test
