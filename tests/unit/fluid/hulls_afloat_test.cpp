// The first mesh holds the stated water, however near the water line comes to a corner of a hull, and the water stays where it is.
#include "tests/unit/fluid/hulls_afloat.hpp"

#include <gtest/gtest.h>

#include <array>

namespace splashdown::fluid::hulls_afloat_test {
namespace {

using scenes::Afloat;

constexpr std::array kinds{Afloat::box_at_small_draft, Afloat::box_of_small_freeboard,
                           Afloat::tilted_box,         Afloat::wedge,
                           Afloat::any_corners,        Afloat::beside_wall};

/// Contact lines and corners at the hull.
std::vector<Vec<2>> contact_lines(const Nodes<2>& nodes) {
  std::vector<Vec<2>> at;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.tie[i].wall == 0 && nodes.surface[i]) at.push_back(nodes.x[i]);
  return at;
}

class HullsAfloat : public testing::TestWithParam<Afloat> {};
INSTANTIATE_TEST_SUITE_P(Kinds, HullsAfloat, testing::ValuesIn(kinds));

TEST_P(HullsAfloat, first_mesh_holds_the_stated_water) {
  for (unsigned seed = 0; seed < 8u; ++seed) {
    const auto hull = scenes::hull_afloat(GetParam(), seed, 0.12, 3);
    const scenes::Placed placed(hull.fluid);
    const auto liquid = fill<2>(hull.fluid, placed.at());
    // Roundoff of the clipping and of the sum over a few hundred facets is far below.
    EXPECT_NEAR(enclosed_volume(liquid.mesh.boundary, liquid.nodes.x), hull.water, 1e-10 * hull.water)
        << "seed " << seed << ", corner at " << hull.near << " elements";
    for (const auto& x : contact_lines(liquid.nodes))
      EXPECT_NEAR(x.y(), 0, 1e-10) << "seed " << seed << ", corner at " << hull.near << " elements, contact at "
                                   << x.x();
  }
}

/// Held fast, so that the hull need not be in equilibrium.
TEST_P(HullsAfloat, still_water_stays_still) {
  constexpr double g = 9.81, seconds = 2;
  for (unsigned seed = 0; seed < 3u; ++seed) {
    const auto hull = scenes::hull_afloat(GetParam(), seed, 0.12, 3);
    Fluid<2> water(hull.fluid, scenes::gravity({0, -g}));
    const std::vector<Twist<2>> still(2, Twist<2>::Zero());
    const std::vector<Isometry<2>> poses(2, Isometry<2>::Identity());
    const auto told = ::testing::Message() << "seed " << seed << ", corner at " << hull.near << " elements";
    double last = 1e-3, fastest = 0;
    while (water.time() < seconds) {
      const double dt = std::min(water.stable_dt(), 1.5 * last);
      ASSERT_TRUE(water.begin(0.5 * (last + dt), dt, {}).ok()) << told;
      ASSERT_TRUE(water.solve(still).status.ok()) << told;
      water.commit(poses);
      last = dt;
      for (const auto& v : water.nodes().v) fastest = std::max(fastest, v.norm());
    }
    EXPECT_LE(fastest, 1e-10 * std::sqrt(g)) << told;
    EXPECT_NEAR(water.ledger().volume, hull.water, 1e-10 * hull.water) << told;
    for (const auto& x : contact_lines(water.nodes())) EXPECT_NEAR(x.y(), 0, 1e-10) << told << ", contact at " << x.x();
  }
}

}  // namespace
}  // namespace splashdown::fluid::hulls_afloat_test
