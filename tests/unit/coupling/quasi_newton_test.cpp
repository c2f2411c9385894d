// What accelerators learn from passes and keep across steps. Laws that all obey: accelerator_test.cpp.
#include "coupling/accelerators/quasi_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupling/maps.hpp"

namespace splashdown::coupling::quasi_newton_test {
namespace {

using namespace maps;

TEST(IqnIls, that_reuses_steps_knows_the_slope_from_the_last_one) {
  for (const auto& map : maps::all()) {
    if (!map.affine()) continue;
    IqnIls forgetful(0.5), learned(0.5, 2);
    for (auto* scheme : {&forgetful, &learned}) passes(*scheme, map), scheme->commit_step();
    // The newest column of two passes and the old ones span the space: at most one column is new.
    EXPECT_LE(passes(learned, map, nullptr, 0.3), 4) << map.name;
    EXPECT_GE(passes(forgetful, map, nullptr, 0.3), std::min(map.size() + 2, 5)) << map.name;
    learned.forget();
    EXPECT_EQ(passes(learned, map, nullptr, 0.3), passes(forgetful, map, nullptr, 0.3)) << map.name;
  }
}

TEST(Secants, drop_columns_that_newer_ones_contain) {
  Secants secants;
  EXPECT_FALSE(secants.add({.residual = Vector::Zero(3), .image = Vector::Ones(3)})) << "no change";
  EXPECT_FALSE(secants.add({.residual = Vector::Constant(3, nan), .image = Vector::Ones(3)}));
  EXPECT_FALSE(secants.explain(Vector::Ones(3)).has_value());
  const Vector e0 = Vector::Unit(3, 0), e1 = Vector::Unit(3, 1);
  EXPECT_TRUE(secants.add({.residual = e1, .image = e1}));
  EXPECT_TRUE(secants.add({.residual = e0, .image = 2 * e0}));
  EXPECT_TRUE(secants.add({.residual = e0 + 1e-12 * e1, .image = 7 * e0}));
  const auto explained = secants.explain(Eigen::Vector3d(1, 2, 3));
  ASSERT_TRUE(explained.has_value());
  EXPECT_EQ(secants.size(), 2u) << "the older copy of e0 is gone";
  EXPECT_LE((explained->residual - Eigen::Vector3d(1, 2, 0)).norm(), 1e-11);
  EXPECT_LE((explained->image - Eigen::Vector3d(7, 2, 0)).norm(), 1e-10) << "the newest slope holds";
}

}  // namespace
}  // namespace splashdown::coupling::quasi_newton_test
