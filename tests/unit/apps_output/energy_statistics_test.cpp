#include "apps/statistics/energy_statistics.hpp"

#include <gtest/gtest.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "apps/record/tables/energy.hpp"
#include "box_of_water.hpp"
#include "stand_ins.hpp"

namespace splashdown::apps::energy_statistics_test {
namespace {

constexpr double roundoff = 1e-13;  // a few hundred operations on numbers of the sums' size

Ledger ledger_of(double kinetic, double potential, double work) {
  Ledger ledger;
  ledger.volume = ledger.volume_initial = 2;
  ledger.kinetic_energy = kinetic;
  ledger.potential_energy = potential;
  ledger.work_on_walls = work;
  return ledger;
}

LedgerSummary summary_of_energy(const EnergyStatistics& energy) {
  LedgerSummary summary;
  energy.summarise(summary);
  return summary;
}

TEST(EnergyGain, is_the_largest_of_what_the_water_holds_beyond_what_walls_gave) {
  EnergyStatistics energy;
  // Walls give 10 J; of these 6 arrive at first, then 13, then 9.
  for (const auto& [time, kinetic, potential, work] :
       {std::array{0., 1., -50., 0.}, {1., 5., -48., -10.}, {2., 9., -45., -10.}, {3., 7., -47., -10.}})
    energy.add(time, ledger_of(kinetic, potential, work), {});
  EXPECT_NEAR(energy.gain(), -1, roundoff);
  const auto summary = summary_of_energy(energy);
  EXPECT_NEAR(summary.energy_gain_joule, 3, roundoff);
  EXPECT_EQ(summary.energy_gain_time, 2);
  EXPECT_EQ(summary.energy_gain_since, 1);
  EXPECT_EQ(summary.energy_scale, 10);
  EXPECT_NEAR(summary.energy_gain, 0.3, roundoff);
}

TEST(EnergyGain, of_water_that_only_loses_is_zero) {
  EnergyStatistics energy;
  for (int n = 0; n < 50; ++n) energy.add(n, ledger_of(10 * std::exp(-0.1 * n), -50, 0), {});
  EXPECT_EQ(summary_of_energy(energy).energy_gain, 0);
  EXPECT_EQ(summary_of_energy(energy).energy_gain_joule, 0);
}

// Energy that goes from height to motion, as in a breaking dam, is no gain, and the fall is its scale.
TEST(EnergyGain, of_water_that_falls_is_over_what_the_fall_let_go) {
  EnergyStatistics energy;
  for (int n = 0; n <= 100; ++n) {
    const double fallen = 30 * std::sin(std::numbers::pi * n / 100);
    energy.add(n, ledger_of(1.01 * fallen, 50 - fallen, 0), {});
  }
  const auto summary = summary_of_energy(energy);
  EXPECT_NEAR(summary.energy_scale, 30, roundoff);
  EXPECT_NEAR(summary.energy_gain, 0.01, roundoff);
}

TEST(EnergyGain, of_water_at_rest_is_not_roundoff_over_roundoff) {
  EnergyStatistics energy;
  const double depth_energy = 1000 * 9.81 * 0.3 * 0.3;  // 1 m of water 0.3 m deep
  energy.begin({.level_energy = 0, .depth_energy = depth_energy, .hull_volume = 0});
  energy.add(0, ledger_of(0, -441, 0), {});
  energy.add(1, ledger_of(1e-12, -441 + 1e-12, 0), {});
  EXPECT_LT(summary_of_energy(energy).energy_gain, 1e-6);
  // A thousandth of sqrt(g H) everywhere is the scale itself.
  energy.add(2, ledger_of(0.5 * 300 * 1e-6 * 9.81 * 0.3, -441, 0), {});
  EXPECT_NEAR(summary_of_energy(energy).energy_gain, 1, 1e-9);
}

TEST(EnergyGain, without_any_scale_is_infinite_and_without_any_gain_zero) {
  EnergyStatistics energy;
  energy.add(0, ledger_of(0, 0, 0), {});
  EXPECT_EQ(summary_of_energy(energy).energy_gain, 0);
  energy.add(1, ledger_of(1e-9, 0, 0), {});
  EXPECT_TRUE(std::isinf(summary_of_energy(energy).energy_gain));
}

TEST(EnergyGain, that_is_no_number_is_infinite) {
  EnergyStatistics energy;
  energy.add(0, ledger_of(1, 0, 0), {});
  energy.add(1, ledger_of(std::nan(""), 0, 0), {});
  EXPECT_TRUE(std::isinf(summary_of_energy(energy).energy_gain));
}

TEST(EnergyGain, kinetic_energy_below_zero_is_told) {
  EnergyStatistics energy;
  energy.add(0, ledger_of(4, 0, 0), {});
  energy.add(1, ledger_of(-1, 0, 0), {});
  EXPECT_NEAR(summary_of_energy(energy).kinetic_deficit, 0.25, roundoff);
}

TEST(EnergyGain, volume_that_appears_at_the_level_brings_no_energy) {
  EnergyStatistics energy;
  energy.begin({.level_energy = 700, .depth_energy = 1, .hull_volume = 4});
  auto ledger = ledger_of(1, -50, 0);
  energy.add(0, ledger, {});
  ledger.volume += 0.1;
  ledger.spray = 0.02;
  ledger.potential_energy += 700 * 0.12;
  energy.add(1, ledger, {});
  EXPECT_NEAR(energy.gain(), 0, 700 * roundoff);
  LedgerSummary summary;
  summary.volume_initial = 2;
  summary.volume_final = 2.1;
  summary.spray = 0.02;
  energy.summarise(summary);
  ASSERT_TRUE(summary.volume_error_bodies);
  EXPECT_NEAR(*summary.volume_error_bodies, 0.03, roundoff);
  EXPECT_FALSE(summary_of_energy(EnergyStatistics{}).volume_error_bodies) << "no bodies";
}

TEST(EnergyScale, of_a_body_that_falls_in_is_what_it_moves_with_at_first_contact) {
  EnergyStatistics energy;
  for (int n = 0; n < 10; ++n) {
    const bool wet = n >= 5;
    // It is slowed from the step of its first contact on; another body stays dry, and one is driven.
    energy.add(n, ledger_of(0, 0, 0),
               {{true, wet, wet ? 30. : 8. * n, 3}, {true, false, 1000., 0}, {false, true, 1000., 1000}});
  }
  const auto summary = summary_of_energy(energy);
  EXPECT_EQ(summary.energy_scale, 32);
  EXPECT_EQ(summary.energy_scale_from, "kinetic energy of arriving bodies");
}

TEST(EnergyScale, of_a_body_afloat_is_what_it_takes_to_press_it_under) {
  EnergyStatistics energy;
  for (int n = 0; n < 10; ++n) energy.add(n, ledger_of(1e-9 * n, 0, 0), {{true, true, 1e-9, 7. + n}});
  EXPECT_EQ(summary_of_energy(energy).energy_scale, 7) << "as it was found";
  EXPECT_LT(summary_of_energy(energy).energy_gain, 1e-8);
}

// A box that is pressed under from its touch displaces from nothing to V: work rho g V H/2.
TEST(EnergyScale, pressing_under_is_half_of_weight_times_height) {
  StandInDrop drop;
  RecordInput<2> input = drop.at(0.02, 1e-4);
  const auto bodies = body_energies(input);
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_TRUE(bodies[0].free && bodies[0].wet);
  const double area = wedge_half_breadth * wedge_height, v = input.body_velocity_n[0](1);
  EXPECT_NEAR(bodies[0].immersion, 0.5 * 1000 * 9.81 * area * wedge_height, 1e-10);
  EXPECT_NEAR(bodies[0].kinetic, 0.5 * 241 * v * v, 1e-9);
  const auto water = water_at_start(input);
  EXPECT_NEAR(water.hull_volume, area, 1e-15);
  // The level of the tank's water: 2 w d of it in a tank of 2 w whose floor is at -d.
  EXPECT_NEAR(water.level_energy, 0, 1e-10);
}

TEST(EnergyScale, hulls_have_the_volume_they_enclose_wherever_they_are) {
  auto square = unit_box<2>();
  auto cube = unit_box<3>();
  square.vertices.array() += 3;
  cube.vertices.array() -= 5;
  EXPECT_NEAR(hull_volume<2>(square), 1, 1e-13);
  EXPECT_NEAR(hull_volume<3>(cube), 1, 1e-12);
}

TEST(EnergyStatistics, resumed_anywhere_end_as_if_never_stopped) {
  const auto add = [](EnergyStatistics& energy, int from, int to) {
    for (int n = from; n < to; ++n) {
      const bool wet = n > 6;
      energy.add(n, ledger_of(20 + 10 * std::sin(n), -3 * std::cos(n), -n), {{true, wet, 40. - n, 2}});
    }
  };
  EnergyStatistics whole;
  whole.begin({1, 2, 3});
  add(whole, 0, 20);
  for (int stop = 1; stop < 20; ++stop) {
    std::stringstream checkpoint;
    EnergyStatistics before, after;
    before.begin({1, 2, 3});
    add(before, 0, stop);
    {
      cereal::BinaryOutputArchive archive(checkpoint);
      archive(before);
    }
    cereal::BinaryInputArchive archive(checkpoint);
    archive(after);
    EXPECT_EQ(after.gain(), before.gain());
    add(after, stop, 20);
    const auto a = summary_of_energy(after), w = summary_of_energy(whole);
    EXPECT_EQ(a.energy_gain, w.energy_gain) << stop;
    EXPECT_EQ(a.energy_gain_time, w.energy_gain_time);
    EXPECT_EQ(a.energy_gain_since, w.energy_gain_since);
    EXPECT_EQ(a.energy_scale, w.energy_scale);
    EXPECT_EQ(a.volume_error_bodies, w.volume_error_bodies);
  }
}

}  // namespace
}  // namespace splashdown::apps::energy_statistics_test
