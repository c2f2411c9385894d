// Sound in a liquid, with both formulations.
#include "fluid/effects/compressibility/compressibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "basin.hpp"

namespace splashdown::fluid::compressibility_test {
namespace {

constexpr double pi = std::numbers::pi, density = 1000, sound = 100;

struct Way {
  const char* name;
  Formulation<2> (*make)();
};
Formulation<2> fractional_way() { return fractional<2>(); }
Formulation<2> monolithic_way() { return monolithic<2>(); }

/// Water in a tube along x that starts at x = 0; the tube is longer than the water, or as long.
coupling::scenes::Watched<2> tube(const Way& way, double length, double closed_at, double size,
                                  std::function<Vec<2>(const Vec<2>&)> velocity,
                                  const CompressibilitySpec& liquid = {.bulk_modulus = density * sound * sound}) {
  const double width = 2 * size;
  FluidSpec<2> spec;
  spec.density = density;
  spec.size = {.surface = size, .far = size};
  spec.step.dt_max = 1;
  spec.walls.push_back(
      {.name = "tube", .surface = testing::Basin::box({0, 0}, {closed_at, width}, true), .size = size});
  spec.liquids.push_back({testing::Basin::box({0, 0}, {length, width}, false), std::move(velocity)});
  std::vector<std::unique_ptr<Effect<2>>> effects;
  effects.push_back(std::make_unique<Compressibility<2>>(liquid));
  return coupling::scenes::Watched<2>(std::make_unique<Fluid<2>>(std::move(spec), std::move(effects), way.make()));
}

class Compressible : public ::testing::TestWithParam<Way> {};

// u = U sin(n pi x / L) between closed ends swings with n c / 2 L; the trapezoidal rule is slow by (omega dt)^2 / 12, 0.2 % at 40
// steps a period, elements by as much. What swings keeps its energy.
TEST_P(Compressible, the_first_modes_of_a_closed_tube_are_those_of_sound) {
  const double length = 1, speed = 1e-4;
  for (const int n : {1, 2, 3}) {
    const double period = 2 * length / (n * sound), dt = period / 40;
    auto stepper = tube(GetParam(), length, length, length / 60,
                        [&](const Vec<2>& x) { return Vec<2>(speed * std::sin(n * pi * x.x() / length), 0); });
    std::vector<double> crossings, energies;
    double before = 0, time_before = 0;
    while (stepper.time() < 2.2 * period) {
      ASSERT_TRUE(stepper.attempt(dt).ok());
      const auto& fluid = stepper.fluid();
      double mode = 0;
      for (std::size_t i = 0; i < fluid.nodes().size(); ++i)
        mode += fluid.pressure()[i] * std::cos(n * pi * fluid.nodes().x[i].x() / length);
      if (before * mode < 0)
        crossings.push_back(time_before + (stepper.time() - time_before) * before / (before - mode));
      before = mode, time_before = stepper.time();
      energies.push_back(fluid.ledger().kinetic_energy + fluid.ledger().potential_energy);
      stepper.commit();
    }
    ASSERT_GE(crossings.size(), 4u);
    const double found = 2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
    EXPECT_NEAR(found / period, 1, 0.01);
    EXPECT_NEAR(energies.back() / energies[2], 1, 0.003);  // damping of waves of 40 elements: third order
  }
}

// A column of length L that is stopped at once: rho c U from t = 0 to 2 L / c, when it goes back as it came.
TEST_P(Compressible, a_column_hammers_with_rho_c_u_until_the_echo_returns) {
  const double length = 1, speed = 0.1;
  auto stepper = tube(GetParam(), length, 2 * length, length / 40, [&](const auto&) { return Vec<2>(-speed, 0); });
  const double echo = 2 * length / sound, dt = echo / 200;
  double impulse = 0, until = 0, plateau = 0, over = 0;
  while (stepper.time() < 0.95 * echo) {
    ASSERT_TRUE(stepper.attempt(dt).ok());
    const auto load = stepper.fluid().result().loads[0].total();
    const double kick = stepper.time() > 0 ? dt : 0.5 * dt;
    impulse -= load[0] * kick, until += kick;
    if (stepper.time() > 0.1 * echo && stepper.time() < 0.9 * echo) plateau -= load[0] * kick, over += kick;
    stepper.commit();
  }
  const double width = 2 * length / 40, exact = density * sound * speed * width;
  EXPECT_NEAR(plateau / over / exact, 1, 0.01);
  EXPECT_NEAR(impulse / (exact * until), 1, 0.01);
}

/// P of P (1 - rho_0 / rho(P)) = rho_0 u^2: balance of mass and momentum across a shock that stops u.
double shock_pressure(const CompressibilitySpec& liquid, double u) {
  double low = 0, high = 1e10;
  for (int k = 0; k < 200; ++k) {
    const double p = 0.5 * (low + high);
    (p * (1 - 1 / liquid_state(liquid, p).density) < density * u * u ? low : high) = p;
  }
  return low;
}

// A column of any liquid with gas that meets a wall, as fast as birds. The mean behind the front counts: it is five elements thick.
TEST_P(Compressible, liquid_with_gas_hits_a_wall_with_the_pressure_of_its_jump_conditions) {
  std::mt19937 random(7);
  for (int member = 0; member < 6; ++member) {
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const CompressibilitySpec liquid{
        .bulk_modulus = between(1e9, 4e9), .bulk_modulus_slope = between(0, 8), .gas_content = between(0.05, 0.2)};
    const double u = between(80, 230), size = 1.0 / 60, width = 2 * size, p = shock_pressure(liquid, u);
    const auto behind = liquid_state(liquid, p);
    const double front = u * behind.density / (behind.density - 1),
                 dt = 0.3 * size * std::sqrt(density * behind.density * behind.compliance), end = 0.8 / front;
    auto stepper = tube(
        GetParam(), 1, 2, size, [u](const auto&) { return Vec<2>(-u, 0); }, liquid);
    double sum = 0, over = 0;
    while (stepper.time() < end) {
      ASSERT_TRUE(stepper.attempt(dt).ok()) << "member " << member;
      if (stepper.time() > 0.3 * end) sum -= stepper.fluid().result().loads[0].total()[0], ++over;
      stepper.commit();
    }
    EXPECT_NEAR(sum / over / (p * width), 1, 0.03)
        << "member " << member << ", u = " << u << ", gas " << liquid.gas_content;
  }
}

// It starts in equilibrium, though no pressure of it is known.
TEST_P(Compressible, water_at_rest_stays_at_rest) {
  std::vector<std::unique_ptr<Effect<2>>> effects;
  effects.push_back(testing::gravity());
  effects.push_back(std::make_unique<Compressibility<2>>(CompressibilitySpec{.bulk_modulus = density * sound * sound}));
  coupling::scenes::Watched<2> stepper(
      std::make_unique<Fluid<2>>(testing::Basin{.size = 0.1}.spec(), std::move(effects), GetParam().make()));
  double fastest = 0;
  ASSERT_TRUE(testing::run(stepper, 0.1,
                           [&](const auto& fluid, double) { fastest = std::max(fastest, testing::max_speed(fluid)); }));
  EXPECT_LT(fastest, 1e-6);  // the first pressure has a millionth of the compression in it
}

INSTANTIATE_TEST_SUITE_P(Both, Compressible,
                         ::testing::Values(Way{"fractional", fractional_way}, Way{"monolithic", monolithic_way}),
                         [](const auto& info) { return info.param.name; });

// Wood 1930: gas makes a mixture soft, liquid heavy.
TEST(Compliance, of_a_mixture_is_the_mean_of_its_parts_by_volume) {
  const CompressibilitySpec spec{.bulk_modulus = 2.2e9, .gas_content = 0.1};
  EXPECT_DOUBLE_EQ(liquid_state(spec, 0).compliance, 0.9 / 2.2e9 + 0.1 / (1.4 * 101325));
  // Gas that is pressed to nothing leaves the liquid.
  EXPECT_NEAR(liquid_state(spec, 1e9).compliance * 2.2e9, 1, 0.02);
}

// d ln(density)/dp is the compliance and dE = p dV the energy, of liquids of any stiffness with and without gas.
TEST(LiquidState, derivatives_of_its_law_are_its_compliance_and_its_energy) {
  for (const double slope : {0.0, 1.0, 7.0})
    for (const double gas : {0.0, 0.1, 0.5})
      for (const double p : {-2e4, 1e3, 1e6, 9e7}) {
        const CompressibilitySpec spec{.bulk_modulus = 2.2e9, .bulk_modulus_slope = slope, .gas_content = gas};
        const double step = 1e-3 * std::abs(p);
        const auto before = liquid_state(spec, p - step), here = liquid_state(spec, p),
                   after = liquid_state(spec, p + step);
        // Central differences: third derivatives of the gas's law are of the order of 1 / (p_a + p)^3.
        EXPECT_NEAR((std::log(after.density) - std::log(before.density)) / (2 * step) / here.compliance, 1, 1e-4);
        EXPECT_NEAR((after.energy - before.energy) / (p * (1 / before.density - 1 / after.density)), 1, 1e-4);
      }
}

}  // namespace
}  // namespace splashdown::fluid::compressibility_test
