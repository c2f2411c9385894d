#include "fluid/pfem/contact/attachment.hpp"

#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::attachment_test {
namespace {

using scenes::eps;
using scenes::point;

template <class Dimension>
struct Attachment : testing::Test {};
TYPED_TEST_SUITE(Attachment, scenes::Dimensions);

// Nodes on their own above the top, x_d = 1, of a unit box whose reference point is elsewhere and which moves in every way.
template <int d>
struct Arrival : scenes::Walls<d> {
  Arrival() {
    const auto at = scenes::elsewhere<d>();
    this->add_wall(scenes::box<d>(-at.translation(), Vec<d>::Ones() - at.translation()), at);
    std::mt19937 random(3);
    this->velocity[0] = scenes::random_vector<Twist<d>>(random, {});
  }
  // At this height above the top, with this velocity upwards beside the wall's own there.
  int add_node(double height, double rising) {
    const Vec<d> x = point<d>(0.4, 1 + height);
    const Vec<d> own = velocity_at<d>(this->pose[0], this->velocity[0], x);
    return nodes.add(x, own + rising * Vec<d>::Unit(d - 1), 0, {}, true);
  }
  void attach(double h = size, double dt = 0) {
    nodes.h.assign(nodes.size(), h);
    attach_nodes<d>(nodes, mesh, this->at(), this->velocity, dt);
  }
  static constexpr double size = 0.1;
  Nodes<d> nodes;
  Mesh<d> mesh;
};

TYPED_TEST(Attachment, a_node_that_has_crossed_the_wall_is_tied_where_it_is_nearest) {
  constexpr int d = TypeParam::value;
  Arrival<d> arrival;
  const int crossed = arrival.add_node(-0.02, -0.1), above = arrival.add_node(0.02, -0.1);
  arrival.attach();
  EXPECT_EQ(arrival.nodes.tie[crossed].wall, 0);
  EXPECT_FALSE(arrival.nodes.tie[crossed].sharp());
  EXPECT_TRUE(arrival.walls[0].has(arrival.nodes.tie[crossed]));
  EXPECT_LE((arrival.nodes.x[crossed] - point<d>(0.4, 1)).norm(), 10 * eps);
  EXPECT_EQ(arrival.nodes.tie[above].wall, -1);
  EXPECT_EQ(arrival.nodes.x[above], (point<d>(0.4, 1 + 0.02)));
}

TYPED_TEST(Attachment, one_that_rises_from_the_moving_wall_is_left_alone) {
  constexpr int d = TypeParam::value;
  Arrival<d> arrival;
  // Velocities of the wall there are of the order of one: its own translation and its turn about the reference point.
  const int rises = arrival.add_node(-0.02, 1e-3), sinks = arrival.add_node(-0.02, -1e-3);
  arrival.attach();
  EXPECT_EQ(arrival.nodes.tie[rises].wall, -1);
  EXPECT_EQ(arrival.nodes.tie[sinks].wall, 0);
}

TYPED_TEST(Attachment, drops_alone_are_found_deeper_than_an_element) {
  constexpr int d = TypeParam::value;
  Arrival<d> arrival;
  const double deep = -2 * Arrival<d>::size;
  const int liquid = arrival.add_node(deep, -1), drop = arrival.add_node(deep, -1);
  arrival.nodes.spray[drop] = 1;
  arrival.attach();
  EXPECT_EQ(arrival.nodes.tie[liquid].wall, -1);
  EXPECT_EQ(arrival.nodes.tie[drop].wall, 0);
  EXPECT_LE((arrival.nodes.x[drop] - point<d>(0.4, 1)).norm(), 10 * eps);
}

// The box is no thicker than an element, and a step carried nodes past its middle, where its bottom is nearer and moves away.
TYPED_TEST(Attachment, what_has_crossed_most_of_a_thin_wall_is_tied_to_the_side_that_it_came_from) {
  constexpr int d = TypeParam::value;
  constexpr double depth = 0.7;
  for (const double before :
       {0.05, 0.0, -0.04}) {  // above the top a step ago: roundoff and turns may put it a little under
    Arrival<d> arrival;
    const int liquid = arrival.add_node(-depth, -1), drop = arrival.add_node(-depth, -1);
    arrival.nodes.spray[drop] = 1;
    arrival.attach(1, depth + before);
    for (const int n : {liquid, drop}) {
      EXPECT_EQ(arrival.nodes.tie[n].wall, 0) << before;
      EXPECT_LE((arrival.nodes.x[n] - point<d>(0.4, 1)).norm(), 1e-5) << before;
    }
  }
  // It has been in there for longer: nobody knows.
  Arrival<d> arrival;
  const int inside = arrival.add_node(-depth, -1);
  arrival.attach(1, 0.3);
  EXPECT_EQ(arrival.nodes.tie[inside].wall, -1);
}

// Water that leaves the lower corner of a body on all sides: none of its nodes arrives there.
template <int d>
void sink(Nodes<d>& nodes) {
  for (auto& v : nodes.v) v = -Vec<d>::Ones();
}

// A box whose lowest corner is the only one near the water, this far under its surface at x_d = 1.
template <int d>
struct Dip : scenes::Tank<d> {
  explicit Dip(double depth, double across, bool has_node = false)
      : scenes::Tank<d>(4), corner(point<d>(across, 1 - depth)) {
    this->add_wall(scenes::box<d>(corner, corner + Vec<d>::Constant(3)));
    if (has_node) this->nodes.add(corner, Vec<d>::Zero(), 0, {1, -1, vertex()}, false, size);
    this->nodes.h.assign(this->nodes.size(), size);
    sink(this->nodes);
    nodes_before = this->nodes.size();
    facets_before = this->mesh.boundary.size();
    volume_before = enclosed_volume(this->mesh.boundary, this->nodes.x);
    attach_nodes<d>(this->nodes, this->mesh, this->at(), this->velocity, 0);
    for (std::size_t i = 0; i < this->nodes.size(); ++i)
      if (this->nodes.tie[i].wall == 1) found.push_back(static_cast<int>(i));
  }
  int vertex() const {
    int v = 0;
    while (this->walls[1].vertex(this->pose[1], v) != corner) ++v;
    return v;
  }
  static constexpr double size = 0.25;
  Vec<d> corner;
  std::vector<int> found;
  std::size_t nodes_before, facets_before;
  double volume_before;
};

TYPED_TEST(Attachment, a_corner_in_the_water_gets_a_node) {
  constexpr int d = TypeParam::value;
  // The node of the lattice that is nearest is two fifths of an element away.
  const Dip<d> dip(0.03, 0.4);
  ASSERT_EQ(dip.found.size(), 1u);
  const int n = dip.found[0];
  EXPECT_EQ(dip.nodes.x[n], dip.corner);
  EXPECT_GE(dip.nodes.tie[n].vertex, 0);
  EXPECT_EQ(dip.walls[1].vertex(dip.pose[1], dip.nodes.tie[n].vertex), dip.corner);
  EXPECT_TRUE(dip.nodes.surface[n]);
  EXPECT_EQ(dip.nodes.size(), dip.nodes_before + 1);
  EXPECT_EQ(dip.nodes.h.back(), dip.size);
  EXPECT_EQ(dip.mesh.boundary.size(), dip.facets_before + d - 1);
  EXPECT_TRUE(scenes::is_closed(dip.mesh.boundary));
  // One facet of the surface, half a square of the lattice in space, becomes a dent of this depth.
  const double facet = d == 2 ? 0.25 : 0.5 * 0.25 * 0.25;
  EXPECT_NEAR(enclosed_volume(dip.mesh.boundary, dip.nodes.x), dip.volume_before - facet * 0.03 / d, 100 * eps);
}

TYPED_TEST(Attachment, a_node_near_the_corner_moves_onto_it) {
  constexpr int d = TypeParam::value;
  const Dip<d> dip(0.03, 0.48);
  ASSERT_EQ(dip.found.size(), 1u);
  EXPECT_EQ(dip.nodes.x[dip.found[0]], dip.corner);
  EXPECT_GE(dip.nodes.tie[dip.found[0]].vertex, 0);
  EXPECT_EQ(dip.nodes.size(), dip.nodes_before);
  EXPECT_EQ(dip.mesh.boundary.size(), dip.facets_before);
}

// A triangulation may join the water on both sides of a tip, so that no facet is left at its node.
TEST(AttachmentInSpace, the_node_of_a_corner_that_was_left_within_the_water_is_on_its_boundary_again) {
  constexpr int d = 3;
  for (const double across : {0.4, 0.48}) {
    const Dip<d> dip(0.03, across, true);
    ASSERT_EQ(dip.found.size(), 1u);
    const int n = dip.found[0];
    EXPECT_EQ(dip.nodes.x[n], dip.corner);
    EXPECT_EQ(dip.nodes.tie[n].vertex, dip.vertex());
    EXPECT_EQ(dip.nodes.size(), dip.nodes_before);
    EXPECT_EQ(dip.mesh.boundary.size(), dip.facets_before + d - 1);
    EXPECT_TRUE(scenes::is_closed(dip.mesh.boundary));
    EXPECT_TRUE(std::ranges::any_of(dip.mesh.boundary,
                                    [&](const auto& f) { return std::ranges::find(f.nodes, n) != f.nodes.end(); }));
  }
}

TYPED_TEST(Attachment, a_corner_above_the_water_gets_none) {
  constexpr int d = TypeParam::value;
  EXPECT_TRUE(Dip<d>(-0.01, 0.4).found.empty());
  EXPECT_TRUE(Dip<d>(-0.01, 0.48).found.empty());
}

TYPED_TEST(Attachment, many_corners_are_found_like_few) {
  constexpr int d = TypeParam::value;
  // More corners than are looked at one by one: nine bodies far away beside the one that dips in.
  Dip<d> few(0.03, 0.4);
  scenes::Tank<d> many(4);
  many.add_wall(scenes::box<d>(few.corner, few.corner + Vec<d>::Constant(3)));
  for (int k = 0; k < 9; ++k) many.add_wall(scenes::box<d>(point<d>(20 + k, 20), point<d>(20.5 + k, 20.5)));
  many.nodes.h.assign(many.nodes.size(), few.size);
  sink(many.nodes);
  attach_nodes<d>(many.nodes, many.mesh, many.at(), many.velocity, 0);
  EXPECT_EQ(many.nodes.x, few.nodes.x);
  EXPECT_EQ(many.nodes.tie, few.nodes.tie);
}

// A cell that lies on two sides of the edge x = 1, z = 0 of a block, its nodes there at this distance from the edge.
struct OverTheEdge : scenes::Walls<3> {
  explicit OverTheEdge(double on_top) {
    add_wall(scenes::block({-1, -1, -1}, {1, 1, 0}));
    const double beside = 0.05;
    for (const Vec<3>& x : {Vec<3>(1 - on_top, 0, 0), Vec<3>(1, 0, -beside)})
      nodes.add(x, {x.x(), 0, x.z()}, 100 * x.x(), scenes::tie_at<3>(walls[0], pose[0], x, 0), true);
    nodes.add({1.1, 0.1, 0.1}, Vec<3>::Zero(), 0, {}, true);
    nodes.add({1.1, -0.1, 0.1}, Vec<3>::Zero(), 0, {}, true);
    scenes::add_cell<3>(nodes, {0, 1, 2, 3}, mesh);
    nodes.h.assign(4, size);
    attach_nodes<3>(nodes, mesh, at(), velocity, 0);
  }
  static constexpr double size = 0.1;
  Nodes<3> nodes;
  Mesh<3> mesh;
};

TEST(AttachmentInSpace, a_crease_that_an_edge_of_the_boundary_crosses_gets_a_node) {
  const OverTheEdge over(0.05);
  ASSERT_EQ(over.nodes.size(), 5u);
  const WallTie& tie = over.nodes.tie[4];
  EXPECT_TRUE(tie.wall == 0 && tie.crease >= 0 && tie.vertex < 0);
  EXPECT_LE((over.nodes.x[4] - Vec<3>(1, 0, 0)).norm(), 10 * eps);
  // As far from either side: the mean of both.
  EXPECT_LE((over.nodes.v[4] - 0.5 * (over.nodes.v[0] + over.nodes.v[1])).norm(), 10 * eps);
  EXPECT_NEAR(over.nodes.p[4], 0.5 * (over.nodes.p[0] + over.nodes.p[1]), 1000 * eps);
  EXPECT_NEAR(over.nodes.h[4], over.size, 10 * eps);
  EXPECT_EQ(over.mesh.boundary.size(), 6u);
  EXPECT_TRUE(scenes::is_closed(over.mesh.boundary));
}

TEST(AttachmentInSpace, a_node_near_the_crease_moves_onto_it) {
  const OverTheEdge over(0.01);
  ASSERT_EQ(over.nodes.size(), 4u);
  EXPECT_GE(over.nodes.tie[0].crease, 0);
  EXPECT_LE((over.nodes.x[0] - Vec<3>(1, 0, 0)).norm(), 10 * eps);
  EXPECT_EQ(over.mesh.boundary.size(), 4u);
}

}  // namespace
}  // namespace splashdown::fluid::attachment_test
