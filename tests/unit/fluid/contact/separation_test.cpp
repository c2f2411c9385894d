#include "fluid/pfem/contact/separation.hpp"

#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::separation_test {
namespace {

using scenes::eps;

constexpr double gravity = 9.81, size = 0.1;

// The bottom of a block, or the floor of a `hollow` one, that ends at its edge x = 1, with one node inside it and those of
// the edge, which are on the free surface. `behind`: a node on the side x = 1 is wetted, too.
template <int d>
struct AtTheEdge : scenes::Walls<d> {
  explicit AtTheEdge(double speed, bool behind = false, bool hollow = false) {
    const auto at = scenes::elsewhere<d>();
    Vec<d> min = Vec<d>::Constant(-1), max = Vec<d>::Ones();
    min[d - 1] = 0;
    const auto box = scenes::box<d>(min - at.translation(), max - at.translation());
    this->add_wall(hollow ? scenes::turned_inside_out<d>(box) : box, at);
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
    nodes.h.assign(nodes.size(), size);
    separate<d>(nodes, mesh, this->at(), this->velocity, gravity);
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

TEST(Separation, no_flow_leaves_a_wall_where_it_is_hollow) {
  EXPECT_FALSE(AtTheEdge<2>(10 * slowest, false, true).separates());
  EXPECT_FALSE(AtTheEdge<3>(10 * slowest, false, true).separates());
}

TEST(Separation, of_a_crease_takes_fast_water) {
  EXPECT_TRUE(AtTheEdge<3>(1.01 * slowest).separates());
  EXPECT_FALSE(AtTheEdge<3>(0.99 * slowest).separates());
}

TEST(Separation, speed_is_that_past_the_wall) {
  AtTheEdge<3> along(1.01 * slowest);
  along.velocity[0].rigid.head<3>() = along.nodes.v[along.inside];
  EXPECT_FALSE(along.separates());
  // Turning about its reference point, the wall moves with the water there.
  AtTheEdge<3> turning(0);
  const Vec<3> arm = turning.nodes.x[turning.inside] - turning.pose[0].translation();
  turning.velocity[0].rigid.tail<3>() = Vec<3>(0, 0, 5);
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
    EXPECT_EQ(s.neighbour, edge.inside);
    EXPECT_LE((s.area - area).norm(), eps);
  }
}

// One facet spans the side of a body from edge to edge: each edge has the other one beside it, and they are one pair.
TEST(Upstream, two_edges_that_have_no_other_neighbour_are_one_pair) {
  scenes::Walls<2> walls;
  walls.add_wall(scenes::box<2>({-1, 0}, {1, 1}), Isometry<2>::Identity());
  Nodes<2> nodes;
  Mesh<2> mesh;
  for (double x : {-1., 1.}) {
    nodes.add({x, 0}, Vec<2>::Zero(), 0, scenes::tie_at<2>(walls.walls[0], walls.pose[0], {x, 0}, 0), true);
    nodes.separates.back() = 1;
  }
  mesh.boundary.push_back({{0, 1}, 0});
  const auto pairs = separations<2>(nodes, mesh);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NE(pairs[0].edge, pairs[0].neighbour);
}

// Edge nodes 0, 1, 2 with neighbours among 3 to 6, several of them shared, edge nodes 0 and 1 beside each other, and volumes of
// three decades.
template <int d>
struct Exchange {
  std::mt19937 random{5};
  std::vector<Vec<d>> u;
  std::vector<double> volume;
  std::vector<Separation<d>> met{{0, 3}, {0, 4}, {1, 4}, {1, 0}, {2, 4}, {2, 5}, {2, 6}};

  Exchange() {
    std::uniform_real_distribution<double> decades(-3, 0);
    for (int i = 0; i < 7; ++i) {
      u.push_back(scenes::random_vector<Vec<d>>(random, {}));
      volume.push_back(std::pow(10, decades(random)));
    }
    for (auto& s : met) s.area = scenes::random_vector<Vec<d>>(random, {});
  }
  Vec<d> momentum() const {
    Vec<d> sum = Vec<d>::Zero();
    for (std::size_t i = 0; i < u.size(); ++i) sum += volume[i] * u[i];
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i) sum += volume[i] * u[i].squaredNorm();
    return sum;
  }
};

TYPED_TEST(Upstream, takes_momentum_from_nobody_and_makes_no_energy) {
  constexpr int d = TypeParam::value;
  for (int trial = 0; trial < 20; ++trial) {
    Exchange<d> e;
    e.random.seed(static_cast<unsigned>(trial));
    for (auto& u : e.u) u = scenes::random_vector<Vec<d>>(e.random, {});
    share_momentum<d>(e.volume, e.met);
    const auto momentum = e.momentum();
    const double energy = e.energy();
    mix_with_upstream<d>(e.met, e.u);
    EXPECT_LE((e.momentum() - momentum).norm(), 100 * eps);
    EXPECT_LT(e.energy(), energy);
  }
}

TYPED_TEST(Upstream, and_its_edge_have_one_velocity_but_for_what_crosses_the_surface_in_space) {
  constexpr int d = TypeParam::value;
  Exchange<d> e;
  std::vector<Separation<d>> pair{{0, 3, e.met[0].area}};
  share_momentum<d>(e.volume, pair);
  const auto before = e.u;
  mix_with_upstream<d>(pair, e.u);
  const Vec<d> normal = pair[0].area.normalized(), apart = e.u[3] - e.u[0], was = before[3] - before[0];
  EXPECT_LE((apart - (d == 2 ? 0.0 : normal.dot(was)) * normal).norm(), 100 * eps);
}

TYPED_TEST(Upstream, without_water_is_left_alone) {
  constexpr int d = TypeParam::value;
  Exchange<d> e;
  e.volume.assign(e.volume.size(), 0.0);
  share_momentum<d>(e.volume, e.met);
  const auto before = e.u;
  mix_with_upstream<d>(e.met, e.u);
  EXPECT_EQ(e.u, before);
}

}  // namespace
}  // namespace splashdown::fluid::separation_test
