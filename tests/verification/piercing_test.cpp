// Bodies that pierce a free surface, at rest in liquid that p = 0 bounds: added mass and first accelerations.
//   half circle of radius a in a half disc of radius b:
//     heave  rho pi/2 a^2 (b^2 - a^2) / (b^2 + a^2)
//     sway   rho a^2 8/pi sum over even n of n / (n^2 - 1)^2 (1 - q^n) / (1 + q^n), q = (a/b)^2; without a bound 2/pi rho a^2
//   (odd in y: cos = sum b_n sin(n theta), b_n = 4/pi n / (n^2 - 1); velocity like log r at the contact line);
//   boxes in a rectangle of three times the larger of half breadth and draft to each side and below, p = 0 around: matched
//   eigenfunctions, sin(k_n y) beside and sin((m + 1/2) pi y / H) below the box, 400 of these; to 0.03 %.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"
#include "tests/verification/order.hpp"

namespace splashdown::piercing_test {
namespace {

namespace scenes = coupling::scenes;
using scenes::water;
using std::numbers::pi;

constexpr double a = 0.5, b = 1.5;

double exact_heave() { return water * pi / 2 * a * a * (b * b - a * a) / (b * b + a * a); }

double exact_sway() {
  double sum = 0;
  for (int n = 2; n < 10000; n += 2) {  // what is left out is 1 / (2 n^2) = 5e-9
    const double q = std::pow(a / b, 2 * n), n_squared = static_cast<double>(n) * n;
    sum += n / ((n_squared - 1) * (n_squared - 1)) * (1 - q) / (1 + q);
  }
  return water * a * a * 8 / pi * sum;
}

Eigen::Matrix3d added_mass_of_half_circle(double h) {
  scenes::Scene scene;
  scene.fluid.size = {.surface = h, .far = h};
  std::vector<Eigen::Vector2d> bowl;
  constexpr int segments = 512;
  for (int i = 0; i <= segments; ++i)
    bowl.push_back({-b * std::cos(pi * i / segments), i % segments == 0 ? 0.0 : -b * std::sin(pi * i / segments)});
  scene.fluid.liquids.push_back({fluid::scenes::outline(bowl), {}});
  scene.add_body(rigid::circle(a, 512), 100, {0, 0}, h);
  fluid::Fluid<2> f(scene.fluid, fluid::scenes::no_effects());
  const std::array<std::size_t, 1> circle{0};
  EXPECT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
  return f.added_mass(circle);
}

TEST(Piercing, added_mass_of_a_half_circle_is_of_second_order) {
  const std::array h{a / 6, a / 12, a / 24};
  std::array<double, 3> heave, sway;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const Eigen::Matrix3d G = added_mass_of_half_circle(h[i]);
    heave[i] = G(1, 1) / exact_heave() - 1;
    sway[i] = G(0, 0) / exact_sway() - 1;
  }
  EXPECT_LE(std::abs(heave[1]), 0.01);
  EXPECT_LE(std::abs(sway[1]), 0.01);
  EXPECT_GE(order_of(h, heave), 2 - 0.2) << heave[0] << ' ' << heave[1] << ' ' << heave[2];
  EXPECT_GE(order_of(h, sway), 2 - 0.2) << sway[0] << ' ' << sway[1] << ' ' << sway[2];
}

/// Half submerged, with a draft of 0.4 m; about the centre of its waterline.
struct Box {
  double breadth_over_draft, sway, heave, roll;  // kg/m, kg/m, kg m
};

class PiercingBox : public testing::TestWithParam<Box> {};

TEST_P(PiercingBox, added_mass_is_within_one_percent_at_twelve_elements) {
  const Box& box = GetParam();
  constexpr double draft = 0.4;
  const double half = box.breadth_over_draft * draft / 2, reach = 3 * std::max(half, draft);
  const double h = std::min(half, draft) / 12;
  scenes::Scene scene;
  scene.fluid.size = {.surface = 4 * h, .far = 4 * h, .growth = 0.2};
  scene.fluid.liquids.push_back({fluid::scenes::rectangle({-reach, -reach}, {reach, 0}), {}});
  scene.add_body(rigid::box(2 * half, 2 * draft), 100, {0, 0}, h);
  fluid::Fluid<2> f(scene.fluid, fluid::scenes::no_effects());
  const std::array<std::size_t, 1> walls{0};
  ASSERT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
  const Eigen::Matrix3d G = f.added_mass(walls);
  EXPECT_NEAR(G(0, 0), box.sway, 0.01 * box.sway);
  EXPECT_NEAR(G(1, 1), box.heave, 0.01 * box.heave);
  EXPECT_NEAR(G(2, 2), box.roll, 0.01 * box.roll);
}

INSTANTIATE_TEST_SUITE_P(Breadths, PiercingBox,
                         testing::Values(Box{0.5, 115.68466, 27.64083, 5.96470}, Box{1, 119.39057, 93.34069, 5.87350},
                                         Box{2, 122.03032, 297.22783, 9.27042}, Box{4, 126.51230, 1196.99334, 93.98132},
                                         Box{8, 129.04520, 4583.96643, 1527.06774}));

// A box that has sunk in to its middle and is let go, six elements a half side.
scenes::Scene sinking_box(double pitch) {
  constexpr double half = 0.4, h = half / 6, tank = 4 * half;
  scenes::Scene scene;
  scene.fluid = fluid::scenes::still_water(2 * tank, tank, 4 * h);
  scene.fluid.size = {.surface = 4 * h, .far = 4 * h, .growth = 0.2};
  scene.add_body(rigid::box(2 * half, 2 * half), 1.5 * water * 4 * half * half, {0, 0}, h, pitch);
  return scene;
}

/// Accelerations (heave, pitch) of the first steps; the first kick is half as long.
std::vector<Eigen::Vector2d> accelerations(const scenes::Scene& scene, double dt) {
  const auto stepper = scenes::coupled(scene);
  std::vector<Eigen::Vector2d> found;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(stepper->attempt(dt).ok()) << i;
    stepper->commit();
    const Eigen::Vector3d now = stepper->bodies().state(0).velocity;
    found.push_back((now - before).tail<2>() / (i == 0 ? dt / 2 : dt));
    before = now;
  }
  return found;
}

TEST(Piercing, a_box_let_go_accelerates_alike_in_its_first_steps_however_short) {
  // In 50 steps of 0.1 ms it sinks by 6e-5 m, a thousandth of an element. What drifts with the steps and not with time is
  // what they leave of the volume's balance; sharp corners under water have most of it.
  const auto scene = sinking_box(pi / 9);
  const Eigen::Vector2d reference = accelerations(scene, 1e-6).front();
  for (double dt : {1e-4, 1e-5, 1e-6})
    for (const Eigen::Vector2d& now : accelerations(scene, dt))
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(now[k], reference[k], 0.002 * std::abs(reference[k])) << dt << ' ' << k;
}

}  // namespace
}  // namespace splashdown::piercing_test
