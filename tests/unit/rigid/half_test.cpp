// Law of halves: under half of each force half of a body moves as the whole one does.
#include "rigid/forces/half.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "rigid/lines/line.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::half_test {
namespace {

/// F = -c |V| V at the centre of mass.
class Drag final : public Force<3> {
 public:
  explicit Drag(double c) : c_(c) {}
  std::string name() const override { return "drag"; }
  void add(const BodiesAt<3>& at, std::span<Wrench<3>> wrenches) const override {
    for (std::size_t b = 0; b < wrenches.size(); ++b) {
      const auto velocity = at.states[b].velocity.head<3>();
      wrenches[b].head<3>() -= c_ * velocity.norm() * velocity;
    }
  }
  bool is_of_velocity() const override { return true; }

 private:
  double c_;
};

/// Lines in the plane y = 0 and in pairs beside it, a parachute, drag; drawn again alike for the same seed.
std::vector<std::unique_ptr<Force<3>>> forces_of(std::mt19937& random) {
  const auto any = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  std::vector<std::unique_ptr<Force<3>>> forces = pull<3>({0, 0, -9.81});
  forces.push_back(std::make_unique<Drag>(any(0, 2)));
  LineSpec<3> line{.name = "side", .length = any(1, 3), .spring = {std::pow(10, any(1, 6)), any(0, 10)}};
  for (const double side : {-1.0, 1.0}) {
    line.from = {0, {0.2, 0.4 * side, 0.1}};
    line.to = {std::nullopt, {any(1, 1.001), 2 * side, 2}};
    line.to.point.x() = 1;
    forces.push_back(std::make_unique<Line<3>>(line));
  }
  LineSpec<3> riser{.name = "riser",
                    .from = {0, {0, 0, 0.3}},
                    .to = {std::nullopt, {0, 0, 2}},
                    .length = 1.6,
                    .spring = {std::pow(10, any(2, 5)), 0}};
  riser.canopy = Canopy<3>{.mass = any(0.1, 2), .drag_area = any(1, 5), .gravity = {0, 0, -9.81}};
  riser.release.load = 1e3;
  forces.push_back(std::make_unique<Line<3>>(riser));
  return forces;
}

Bodies<3> drawn(unsigned seed, bool half) {
  std::mt19937 random(seed);
  BodySpec<3> body = lump<3>(3, {0, 0, 1});
  body.velocity << 2, 0, -1, 0, 0.7, 0;
  body.free = {true, false, true, false, true, false};  // what a plane of symmetry leaves
  auto forces = forces_of(random);
  if (half) {
    body.mass *= 0.5, body.inertia *= 0.5;
    for (auto& force : forces) force = std::make_unique<HalfForce<3>>(std::move(force));
  }
  return Bodies<3>({body}, std::move(forces));
}

void steps(Bodies<3>& bodies, int from, int to) {
  const double dt = 2e-3;
  for (int i = from; i < to; ++i) {
    bodies.begin(i == 0 ? dt / 2 : dt, dt);
    bodies.solve({Wrench<3>::Zero()});
    bodies.commit();
  }
}

// Roundoff grows with stiff lines: 1e-16 of it by the square root of 1e6 a step.
TEST(HalfForce, moves_half_of_a_body_as_the_whole_moves) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto whole = drawn(seed, false), half = drawn(seed, true);
    for (int i = 0; i < 500; i += 50) {
      steps(whole, i, i + 50);
      steps(half, i, i + 50);
      const auto a = whole.state(0), b = half.state(0);
      EXPECT_LT((a.pose.matrix() - b.pose.matrix()).norm(), 1e-8) << seed << ", step " << i;
      EXPECT_LT((a.velocity - b.velocity).norm(), 1e-6) << seed << ", step " << i;
      const auto told = whole.diagnostics(), told_of_half = half.diagnostics();
      ASSERT_EQ(told.size(), told_of_half.size());
      for (std::size_t k = 0; k < told.size(); ++k) {
        EXPECT_EQ(told[k].first, told_of_half[k].first);
        EXPECT_NEAR(told[k].second, told_of_half[k].second, 1e-6 * (1 + std::abs(told[k].second))) << told[k].first;
      }
    }
  }
}

TEST(HalfForce, goes_on_from_what_was_saved) {
  auto half = drawn(3, true), again = drawn(3, true);
  steps(half, 0, 100);
  std::stringstream saved;
  half.save(saved);
  steps(half, 100, 200);
  again.load(saved);
  steps(again, 100, 200);
  EXPECT_EQ(half.state(0).pose.matrix(), again.state(0).pose.matrix());
}

}  // namespace
}  // namespace splashdown::rigid::half_test
