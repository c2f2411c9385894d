#include "elastic/modes/modes.hpp"

#include <gtest/gtest.h>

#include "solids.hpp"

namespace splashdown::elastic::modes_test {
namespace {

TEST(Modes, a_cantilever_vibrates_as_a_beam_does) {
  // Euler-Bernoulli in plane strain: w = k^2 sqrt(E' I/(rho A L^4)), cos k cosh k = -1. Shear and rotary inertia take off
  // (k h/L)^2 (1 + E'/(5/6 G))/24 (Timoshenko): 0.03 % and 0.2 % at L/h = 50.
  const double L = 50, rho = 2, E = soft.young_modulus / (1 - soft.poisson_ratio * soft.poisson_ratio);
  Solid<2> solid(box_mesh<2>({L, 1}, {50, 1}), st_venant_kirchhoff<2>(soft), rho);
  solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
  const auto modes = lowest_modes(solid, 4, Field::Zero(solid.size()));
  ASSERT_TRUE(modes.status.ok()) << modes.status.cause;
  int k = 0;
  for (const double root : {1.875104, 4.694091}) {
    const double beam = root * root * std::sqrt(E / 12 / (rho * std::pow(L, 4)));
    EXPECT_NEAR(modes.angular_frequencies[k++] / beam, 1, 0.003);
  }
  const Eigen::MatrixXd products = modes.shapes.transpose() * (solid.mass() * modes.shapes);
  EXPECT_LT((products - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-7);
}

TEST(Modes, a_bar_in_space_bends_both_ways_and_rings_along_itself) {
  const double L = 8, rho = 1, Y = 1;
  Solid<3> solid(box_mesh<3>({L, 0.4, 0.4}, {16, 1, 1}), small_strain<3>({Y, 0}), rho);
  solid.clamp([](const Vec<3>& X) { return X.x() < 1e-9; });
  const auto modes = lowest_modes(solid, 10, Field::Zero(solid.size()));
  ASSERT_TRUE(modes.status.ok()) << modes.status.cause;
  const auto& w = modes.angular_frequencies;
  // The cut into tetrahedra is no mirror image of itself across the diagonal; the beam of L/h = 20: shear takes 0.3 % off.
  const double beam = 1.875104 * 1.875104 * std::sqrt(Y * 0.16 / 12 / (rho * std::pow(L, 4)));
  EXPECT_NEAR(w[0] / beam, 1, 0.01);
  EXPECT_NEAR(w[1] / beam, 1, 0.01);
  // Without contraction along itself as a rod: exact but for the mesh.
  const double rod = std::numbers::pi / 2 * std::sqrt(Y / rho) / L;
  EXPECT_LT((w.array() / rod - 1).abs().minCoeff(), 1e-4);
}

TEST(Modes, free_bodies_have_as_many_of_frequency_zero_as_they_have_freedoms) {
  const Solid<2> plane(box_mesh<2>({3, 1}, {6, 2}), st_venant_kirchhoff<2>(soft), 1);
  const Solid<3> space(box_mesh<3>({3, 1, 1}, {4, 2, 2}), neo_hookean<3>(soft), 1);
  const auto of_plane = lowest_modes(plane, 4, Field::Zero(plane.size())).angular_frequencies;
  const auto of_space = lowest_modes(space, 7, Field::Zero(space.size())).angular_frequencies;
  // Roundoff of K is 1e-16 of its largest eigenvalue, that of w the root of it.
  EXPECT_LT(of_plane.head<3>().maxCoeff(), 1e-5 * of_plane[3]);
  EXPECT_LT(of_space.head<6>().maxCoeff(), 1e-5 * of_space[6]);
}

TEST(Modes, a_mass_at_the_tip_slows_a_cantilever_down) {
  // Rayleigh's quotient with the static deflection: w^2 = 3 E' I/(L^3 (m + 33/140 rho A L)), 0.01 % high for m = rho A L.
  const double L = 50, E = soft.young_modulus / (1 - soft.poisson_ratio * soft.poisson_ratio), m = L;
  Solid<2> solid(box_mesh<2>({L, 1}, {50, 2}), small_strain<2>(soft), 1);
  solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
  solid.add_point_mass(*locate<2>(solid.mesh(), {L, 0.5}, 1e-9), m);
  const double beam = std::sqrt(3 * E / 12 / (std::pow(L, 3) * (m + 33. / 140 * L)));
  EXPECT_NEAR(lowest_modes(solid, 1, Field::Zero(solid.size())).angular_frequencies[0] / beam, 1, 0.002);
}

TEST(Modes, more_than_the_mesh_has_are_refused) {
  const Solid<2> solid(box_mesh<2>({1, 1}, {1, 1}), small_strain<2>(soft), 1);
  EXPECT_NO_THROW(lowest_modes(solid, 17, Field::Zero(18)));
  EXPECT_THROW(lowest_modes(solid, 18, Field::Zero(18)), std::invalid_argument);
  EXPECT_THROW(lowest_modes(solid, 0, Field::Zero(18)), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::elastic::modes_test
