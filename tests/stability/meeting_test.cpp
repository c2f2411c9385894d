// Drops and jets that meet in free flight, a few members of a class of random ones: nothing but themselves acts on
// them.
#include <gtest/gtest.h>

#include "tests/stability/ensemble/random.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

using Vec = Eigen::Vector2d;
using coupling::scenes::water;

template <int d>
struct Books {
  Eigen::Matrix<double, d, 1> momentum = Eigen::Matrix<double, d, 1>::Zero();
  double amount = 0, energy = 0, volume = 0;
};

// Of all nodes, drops included, at the half step that the velocities belong to.
template <int d>
Books<d> books_of(const fluid::Fluid<d>& f) {
  Books<d> b;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const double mass = water * f.nodes().volume[i];
    const auto& v = f.nodes().v[i];
    b.momentum += mass * v;
    b.amount += mass * v.norm();
    b.energy += 0.5 * mass * v.squaredNorm();
    b.volume += f.nodes().volume[i];
  }
  return b;
}

// Runs until `end`. Of the momentum its first `kept` components are nobody's but the water's.
template <int d>
void keeps_its_books(fluid::FluidSpec<d> spec, double dt, double end, int kept) {
  coupling::scenes::Watched<d> stepper(
      std::make_unique<fluid::Fluid<d>>(std::move(spec), std::vector<std::unique_ptr<fluid::Effect<d>>>{}));
  std::optional<Books<d>> first;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const Books<d> now = books_of<d>(stepper.fluid());
    if (!first) first = now;
    // Roundoff of a sum over a thousand steps of a thousand nodes is 1e-13 of the amounts.
    ASSERT_LE((now.momentum - first->momentum).head(kept).norm(), 1e-10 * first->amount)
        << "at " << stepper.time() / end;
    const auto& ledger = stepper.fluid().ledger();
    ASSERT_LE(ledger.kinetic_energy, first->energy * (1 + 1e-3)) << "at " << stepper.time() / end;
    // Lumped masses make a front on a wall more than it is; in free water they may not.
    if (kept == d) {
      ASSERT_LE(now.energy, first->energy * (1 + 1e-3)) << "at " << stepper.time() / end;
      ASSERT_LE(std::abs(now.volume - first->volume), 5e-3 * first->volume) << "at " << stepper.time() / end;
    }
    ASSERT_LE(std::abs(ledger.volume + ledger.spray - first->volume), 5e-3 * first->volume)
        << "at " << stepper.time() / end;
  }
}

template <int d>
fluid::FluidSpec<d> water_of_size(double h, double V) {
  fluid::FluidSpec<d> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  return spec;
}

// Width and length of a jet of so many elements, six times as long as it is wide, but no thinner than an element.
Vec jet_of(double elements, double h) {
  const double area = elements * 0.433 * h * h, width = std::max(1.02 * h, std::sqrt(area / 6));
  return {width, area / width};
}

class Meeting : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Meeting, of_two_drops_keeps_momentum_and_makes_no_energy) {
  ensemble::Random random("meeting", GetParam());
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const double elements = random.log_uniform(3, 500), radius = std::sqrt(elements * 0.433 * h * h / std::numbers::pi);
  const double offset = random.uniform(0, 1.5) * radius;
  auto spec = water_of_size<2>(h, V);
  for (const double side : {-1.0, 1.0}) {
    const Vec centre(0.5 * side * offset, side * (radius + 0.25 * h));
    spec.liquids.push_back(
        {fluid::scenes::ellipse(radius, radius, 64, centre), [=](const Vec&) { return Vec(0, -side * V); }});
  }
  keeps_its_books<2>(std::move(spec), 0.01 * h / V, 4 * radius / V, 2);
}

TEST_P(Meeting, of_two_jets_keeps_momentum_and_makes_no_energy) {
  ensemble::Random random("meeting jets", GetParam());
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const Vec size = jet_of(random.log_uniform(3, 500), h);
  const double width = size.x(), length = size.y();
  const double offset = random.uniform(0, 0.75) * width;
  auto spec = water_of_size<2>(h, V);
  for (const double side : {-1.0, 1.0}) {
    const Vec low(0.5 * (side * offset - width), side > 0 ? 0.25 * h : -0.25 * h - length);
    spec.liquids.push_back(
        {fluid::scenes::rectangle(low, low + size), [=](const Vec&) { return Vec(0.3 * V, -side * V); }});
  }
  keeps_its_books<2>(std::move(spec), 0.01 * h / V, 2 * length / V, 2);
}

// The plate pushes upwards alone.
TEST_P(Meeting, of_a_slanting_jet_and_a_plate_keeps_the_momentum_along_it) {
  ensemble::Random random("slanting", GetParam());
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const Vec size = jet_of(random.log_uniform(3, 500), h);
  const double width = size.x(), length = size.y(), end = 2 * length / V;
  auto spec = water_of_size<2>(h, V);
  const double W = 6 * V * end;
  spec.walls.push_back(fluid::scenes::wall("plate", fluid::scenes::rectangle({-W, -2 * h}, {W, 0}), 2 * h));
  const double lean = random.uniform(0, 1) * V;
  spec.liquids.push_back(
      {fluid::scenes::rectangle({0, 0.5 * h}, {width, 0.5 * h + length}), [=](const Vec&) { return Vec(lean, -V); }});
  keeps_its_books<2>(std::move(spec), 0.01 * h / V, end, 1);
}

TEST_P(Meeting, of_two_bodies_of_water_in_space_keeps_momentum_and_makes_no_energy) {
  ensemble::Random random("meeting in space", GetParam());
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const double side = random.uniform(1.5, 5) * h, offset = random.uniform(0, 0.75) * side;
  using Vec3 = Eigen::Vector3d;
  auto spec = water_of_size<3>(h, V);
  const Vec3 low(offset, 0.3 * offset, 0.25 * h), half = Vec3::Constant(0.5 * side);
  spec.liquids.push_back(
      {fluid::scenes::block(low - Vec3(half.x(), half.y(), 0), low + Vec3(half.x(), half.y(), 1.5 * side)),
       [=](const Vec3&) { return Vec3(0, 0, -V); }});
  spec.liquids.push_back(
      {fluid::scenes::block(Vec3(-half.x(), -half.y(), -0.25 * h - side), Vec3(half.x(), half.y(), -0.25 * h)),
       [=](const Vec3&) { return Vec3(0.2 * V, 0, V); }});
  keeps_its_books<3>(std::move(spec), 0.01 * h / V, 3 * side / V, 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Meeting, testing::Range<std::uint64_t>(1, 9));

// A drop on a plate turns into sheets that are thinned to nothing: what they lose of their volume comes back, and their
// fronts, which carry no pressure, bring no energy.
TEST(Drop, that_meets_a_plate_keeps_its_volume_and_makes_no_energy) {
  const double radius = 0.1, h = radius / 6, V = 20;
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  const auto tank = fluid::scenes::rectangle({-8 * radius, 0}, {8 * radius, 8 * radius});
  spec.walls.push_back(fluid::scenes::wall("tank", fluid::scenes::turned_inside_out(tank), 2 * h));
  spec.liquids.push_back(
      {fluid::scenes::ellipse(radius, radius, 64, Vec(0, radius + 0.5 * h)), [=](const Vec&) { return Vec(0, -V); }});
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  double dt = 0.01 * h / V;
  const double initial = stepper.fluid().ledger().volume, energy = 0.5 * water * initial * V * V;
  const double end = 4 * radius / V;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const auto& ledger = stepper.fluid().ledger();
    // Bounds as those of the meeting drops.
    ASSERT_LE(ledger.kinetic_energy, energy * (1 + 1e-3)) << "at " << stepper.time() / end;
    ASSERT_LE(std::abs(ledger.volume + ledger.spray - initial), 5e-3 * initial) << "at " << stepper.time() / end;
  }
  EXPECT_GT(std::abs(stepper.fluid().ledger().returned), 5e-3 * initial) << "nothing was lost: this tests nothing";
}

// Half a dozen elements at many times the speed of the water they fall into: what joins them becomes theirs with its own
// velocity, not with the drop's.
TEST(Drop, that_falls_into_a_pool_lends_it_no_energy) {
  const double radius = 0.02, h = 0.02, V = 20;
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  const auto tank = fluid::scenes::rectangle({-0.3, -0.2}, {0.3, 0.4});
  spec.walls.push_back(fluid::scenes::wall("tank", fluid::scenes::turned_inside_out(tank), 2 * h));
  spec.liquids.push_back({fluid::scenes::rectangle({-0.3, -0.2}, {0.3, 0}), {}});
  spec.liquids.push_back({fluid::scenes::ellipse(radius, radius, 32, Vec(0, radius + 0.5 * h)),
                          [=](const Vec&) { return Vec(0.5 * V, -V); }});
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  double dt = 0.01 * h / V;
  std::optional<double> energy;
  const double end = 8 * radius / V;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const double now = stepper.fluid().ledger().kinetic_energy;
    if (!energy) energy = now;
    ASSERT_LE(now, *energy * (1 + 1e-3)) << "at " << stepper.time() / end;
  }
  EXPECT_LT(stepper.fluid().ledger().kinetic_energy, 0.9 * *energy) << "it did not get there";
}

}  // namespace
}  // namespace splashdown
