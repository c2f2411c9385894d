#include "fluid/contact/separation.hpp"

#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid {
namespace {

using scenes::eps;

constexpr double gravity = 9.81, size = 0.1;

// The bottom of a block that ends at its edge x = 1, with one node inside it and those of the edge, which are on the free
// surface. `behind`: a node on the side x = 1 is wetted, too.
template <int d>
struct AtTheEdge : scenes::Walls<d> {
  explicit AtTheEdge(double speed, bool behind = false) {
    const auto at = scenes::elsewhere<d>();
    Vec<d> min = Vec<d>::Constant(-1), max = Vec<d>::Ones();
    min[d - 1] = 0;
    this->add_wall(scenes::box<d>(min - at.translation(), max - at.translation()), at);
    auto add = [&](Vec<d> x, bool surface) {
      return nodes.add(x, speed * Vec<d>::Unit(0), 0, scenes::tie_at<d>(this->walls[0], at, x, 0), surface);
    };
    Vec<d> x = Vec<d>::Zero();
    inside = add(x, false);
    x[0] = 1;
    edge.push_back(add(x, true));
    if constexpr (d == 3) edge.push_back(add({1, 0.1, 0}, true));
    facet(inside);
    x[d - 1] = 0.1;
    if (behind) facet(add(x, true));
  }
  void facet(int n) {
    Facet<d> f;
    f.nodes[0] = n;
    for (std::size_t k = 0; k < edge.size(); ++k) f.nodes[k + 1] = edge[k];
    f.wall = 0;
    mesh.boundary.push_back(f);
  }
  bool separates() {
    std::vector<double> h(nodes.size(), size);
    separate<d>(nodes, h, mesh, this->at(), this->velocity, gravity);
    for (int n : edge) EXPECT_EQ(nodes.separates[n], nodes.separates[edge[0]]);
    EXPECT_FALSE(nodes.separates[inside]);
    return nodes.separates[edge[0]] != 0;
  }
  int inside;
  std::vector<int> edge;
  Nodes<d> nodes;
  Mesh<d> mesh;
};

const double slowest = std::sqrt(2 * gravity * size);  // that parts from a crease: |v|^2 / 2 = g h

TEST(Separation, of_a_corner_in_the_plane_is_where_the_surface_meets_it) {
  AtTheEdge<2> dry(0);
  EXPECT_TRUE(dry.separates());
  AtTheEdge<2> wet(0);
  wet.nodes.surface[wet.edge[0]] = 0;
  EXPECT_FALSE(wet.separates());
}

TEST(Separation, of_a_crease_takes_fast_water) {
  EXPECT_TRUE(AtTheEdge<3>(1.01 * slowest).separates());
  EXPECT_FALSE(AtTheEdge<3>(0.99 * slowest).separates());
}

TEST(Separation, speed_is_that_past_the_wall) {
  AtTheEdge<3> along(1.01 * slowest);
  along.velocity[0].head<3>() = along.nodes.v[along.inside];
  EXPECT_FALSE(along.separates());
  // Turning about its reference point, the wall moves with the water there.
  AtTheEdge<3> turning(0);
  const Vec<3> arm = turning.nodes.x[turning.inside] - turning.pose[0].translation();
  turning.velocity[0].tail<3>() = Vec<3>(0, 0, 5);
  turning.nodes.v[turning.inside] = Vec<3>(0, 0, 5).cross(arm);
  ASSERT_GT(turning.nodes.v[turning.inside].norm(), slowest);
  EXPECT_FALSE(turning.separates());
}

TEST(Separation, a_crease_that_is_wet_on_both_sides_keeps_its_water) {
  EXPECT_FALSE(AtTheEdge<3>(10 * slowest, true).separates());
}

TEST(Separation, what_was_found_before_is_forgotten) {
  AtTheEdge<3> edge(0);
  for (int n : edge.edge) edge.nodes.separates[n] = 1;
  EXPECT_FALSE(edge.separates());
}

template <class Dimension>
struct Upstream : testing::Test {};
TYPED_TEST_SUITE(Upstream, scenes::Dimensions);

TYPED_TEST(Upstream, is_what_is_wetted_beside_the_edge) {
  constexpr int d = TypeParam::value;
  AtTheEdge<d> edge(10 * slowest);
  ASSERT_TRUE(edge.separates());
  const auto found = separations<d>(edge.nodes, edge.mesh);
  ASSERT_EQ(found.size(), edge.edge.size());
  Vec<d> area = area_vector_of<d>(edge.mesh.boundary[0], edge.nodes.x);
  for (const auto& s : found) {
    EXPECT_EQ(s.upstream, std::vector<int>{edge.inside});
    EXPECT_LE((s.area - area).norm(), eps);
  }
}

TYPED_TEST(Upstream, gives_its_velocity_but_for_what_crosses_the_surface_in_space) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(5);
  std::vector<Vec<d>> u;
  for (int i = 0; i < 3; ++i) u.push_back(scenes::random_vector<Vec<d>>(random, {}));
  const auto before = u;
  const Separation<d> s{0, {1, 2}, scenes::random_vector<Vec<d>>(random, {})};
  take_from_upstream<d>(std::span(&s, 1), u);
  const Vec<d> mean = 0.5 * (before[1] + before[2]), normal = s.area.normalized();
  const Vec<d> change =
      d == 2 ? Vec<d>(mean - before[0]) : Vec<d>(mean - before[0] - normal * normal.dot(mean - before[0]));
  EXPECT_LE((u[0] - before[0] - change).norm(), 10 * eps);
  EXPECT_EQ(u[1], before[1]);
  EXPECT_EQ(u[2], before[2]);
  if (d == 3) {
    EXPECT_NEAR(u[0].dot(normal), before[0].dot(normal), 10 * eps);
  }
}

}  // namespace
}  // namespace splashdown::fluid
