// What bodies enclose, and whether two of them share space.
#include "apps/scene/solid.hpp"

#include <gtest/gtest.h>

#include "apps/scene/scene.hpp"

namespace splashdown::apps::solid_test {
namespace {

const BoxShape brick{.size = {0.4, 0.2, 0.1}};

TEST(PlaneSolids, touching_is_not_overlapping) {
  Body a, b;
  const auto share_space = [](const Body& p, const Body& q) {
    return overlap(Solid<2>(outline<2>(p)), Solid<2>(outline<2>(q)));
  };
  a.shape = b.shape = RectangleShape{.width = 1, .height = 1};
  b.position = {1, 0, 0};
  EXPECT_FALSE(share_space(a, b));
  b.position = {0.999, 0, 0};
  EXPECT_TRUE(share_space(a, b));
  b.position = a.position;
  EXPECT_TRUE(share_space(a, b));
  b.shape = CircleShape{.radius = 0.1};  // one within the other
  EXPECT_TRUE(share_space(a, b));
  EXPECT_TRUE(share_space(b, a));
}

TEST(SpatialSolids, touching_is_not_overlapping) {
  Body a, b;
  a.shape = b.shape = brick;
  const auto share_space = [&] { return overlap(Solid<3>(outline<3>(a)), Solid<3>(outline<3>(b))); };
  EXPECT_TRUE(share_space()) << "the same place";
  b.position = {0.4, 0, 0};
  EXPECT_FALSE(share_space()) << "face to face";
  b.shape = BoxShape{.size = {0.4, 0.1, 0.5}};
  EXPECT_FALSE(share_space()) << "a taller one at the face";
  b.position = {0.399, 0, 0};
  EXPECT_TRUE(share_space());
  b.shape = BoxShape{.size = {0.05, 0.05, 3}};
  b.position = {0, 0, 0.3};
  EXPECT_TRUE(share_space()) << "pierced through the diagonals of its faces";
  b.shape = SphereShape{.radius = 0.04};
  b.position.setZero();
  EXPECT_TRUE(share_space()) << "one within the other";
}

TEST(SpatialSolids, a_point_is_contained_as_deep_as_the_nearest_facet_is_far) {
  Body box;
  box.shape = brick;
  const Solid<3> solid(outline<3>(box));
  const Point centre(0, 0, 0), towards_a_face = Point(0.17, 0, 0.01);
  for (const Point& x : {centre, towards_a_face}) {
    const double depth = -solid.signed_distance(x);
    ASSERT_GT(depth, 0);
    EXPECT_TRUE(solid.contains(x, (1 - 1e-9) * depth));
    EXPECT_FALSE(solid.contains(x, (1 + 1e-9) * depth));
  }
  EXPECT_FALSE(solid.contains({0.21, 0, 0}, 1e-3)) << "outside";
}

TEST(SpatialSolids, fine_hulls_that_nearly_coincide_share_space_by_what_is_more_than_roundoff) {
  Body a, b;
  const auto revolved = [](double radius) { return RevolvedShape{.profile = {{0, 0}, {radius, 0.001}, {0.04, 0.75}}}; };
  a.shape = revolved(0.053);
  b.shape = revolved(0.053 + 1e-6);
  const auto share_space = [&] { return overlap(Solid<3>(outline<3>(a)), Solid<3>(outline<3>(b))); };
  EXPECT_TRUE(share_space()) << "one in the other";
  b.position.z() -= outline<3>(a).vertices.row(2).maxCoeff() - outline<3>(b).vertices.row(2).minCoeff();
  EXPECT_FALSE(share_space()) << "one upon the other";
}

}  // namespace
}  // namespace splashdown::apps::solid_test
