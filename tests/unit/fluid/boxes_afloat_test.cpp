// In space: the first mesh holds the stated water around shallow boxes, whose sides are wet on a strip narrower than an element, and
// the water stays where it is.
#include <gtest/gtest.h>

#include <array>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::boxes_afloat_test {
namespace {

constexpr double half = 1.5, depth = 1.2;  // of the tank, m

struct Afloat {
  FluidSpec<3> fluid;  // the box is its first wall, the tank its last
  double draft, water;
};

/// A box of about 1 m, turned about the vertical; its draft is drawn from 0.12 to 1.5 elements.
Afloat box_afloat(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = between(0.15, 0.25), draft = size * std::exp(between(std::log(0.12), std::log(1.5)));
  const double length = between(0.8, 1.2), width = between(0.6, 1), freeboard = size * between(0.5, 2);
  const double far = 2.5 * size;
  Afloat box{{}, draft, 4 * half * half * depth - length * width * draft};
  box.fluid.size = {.surface = 1.7 * size, .far = far};
  box.fluid.liquids.push_back({scenes::block({-half, -half, -depth}, {half, half, 0}), {}});
  box.fluid.walls.push_back(scenes::wall<3>(
      "box", scenes::block({-length / 2, -width / 2, -draft}, {length / 2, width / 2, freeboard}), size));
  box.fluid.walls[0].pose.rotate(Eigen::AngleAxisd(between(0, 3), Vec<3>::UnitZ()));
  box.fluid.walls.push_back(
      scenes::wall<3>("tank", scenes::turned_inside_out(scenes::block({-half, -half, -depth}, {half, half, 1})), far));
  return box;
}

std::string told(unsigned seed, const Afloat& box) {
  return "seed " + std::to_string(seed) + ", draft of " + std::to_string(box.draft / box.fluid.walls[0].size) +
         " elements";
}

void expect_stated_water(unsigned seed) {
  const Afloat box = box_afloat(seed);
  std::vector<Wall<3>> walls;
  std::vector<WallPlace<3>> poses;
  for (const auto& w : box.fluid.walls) walls.emplace_back(w), poses.push_back(w.pose);
  const auto liquid = fill<3>(box.fluid, {walls, poses});
  // Roundoff of the clipping and of the sum over some thousand facets is far below.
  EXPECT_NEAR(enclosed_volume(liquid.mesh.boundary, liquid.nodes.x), box.water, 1e-10 * box.water) << told(seed, box);
  for (const auto& f : liquid.mesh.boundary) {
    if (f.wall >= 0) continue;
    for (int n : f.nodes) EXPECT_NEAR(liquid.nodes.x[n].z(), 0, 1e-10) << told(seed, box);
  }
}

/// Held fast: the box need not be in equilibrium.
void expect_still_water(unsigned seed) {
  constexpr double g = 9.81, seconds = 0.3;
  const Afloat box = box_afloat(seed);
  std::vector<std::unique_ptr<Effect<3>>> effects;
  effects.push_back(std::make_unique<Gravity<3>>(Vec<3>(0, 0, -g)));
  Fluid<3> water(box.fluid, std::move(effects));
  const std::vector<WallVelocity<3>> still(2, Twist<3>::Zero());
  std::vector<WallPlace<3>> poses;
  for (const auto& w : box.fluid.walls) poses.push_back(w.pose);
  double last = 1e-3, energy = 0;
  while (water.time() < seconds) {
    const double dt = std::min(water.stable_dt(), 1.5 * last);
    ASSERT_TRUE(water.begin(0.5 * (last + dt), dt, {}).ok()) << told(seed, box);
    ASSERT_TRUE(water.solve(still).status.ok()) << told(seed, box);
    water.commit(poses);
    last = dt;
    energy = std::max(energy, water.ledger().kinetic_energy);
  }
  // Single nodes that weigh next to nothing may move, the water may not: as much of it as the box displaces, by a tenth of what a body at rest
  // is allowed, 1e-3 sqrt(g L), L: 1 m.
  const double displaced = box.fluid.density * (4 * half * half * depth - box.water);
  EXPECT_LE(std::sqrt(2 * energy / displaced), 1e-4 * std::sqrt(g)) << told(seed, box);
  EXPECT_NEAR(water.ledger().volume, box.water, 1e-10 * box.water) << told(seed, box);
}

TEST(BoxesAfloat, first_mesh_holds_the_stated_water) {
  for (unsigned seed = 0; seed < 3u; ++seed) expect_stated_water(seed);
}

TEST(BoxesAfloat, still_water_stays_still) { expect_still_water(0); }

TEST(ManyBoxesAfloat, first_mesh_holds_the_stated_water) {
  for (unsigned seed = 3; seed < 103u; ++seed) expect_stated_water(seed);
}

TEST(ManyBoxesAfloat, still_water_stays_still) {
  for (unsigned seed = 1; seed < 21u; ++seed) expect_still_water(seed);
}

}  // namespace
}  // namespace splashdown::fluid::boxes_afloat_test
