#include "fluid/pfem/contact/wall_motion.hpp"

#include <set>

#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::wall_motion_test {
namespace {

using scenes::eps;

template <class Dimension>
struct WallMotions : testing::Test {};
TYPED_TEST_SUITE(WallMotions, scenes::Dimensions);

constexpr int across = 4;  // elements across the tank of these tests

template <int d>
typename WallMotion<d>::Moved moved_by(const WallMotion<d>& motion, const scenes::Walls<d>& walls,
                                       const std::vector<Vec<d>>& v, double dt) {
  std::vector<WallPlace<d>> there;
  for (std::size_t w = 0; w < walls.walls.size(); ++w)
    there.push_back(walls.walls[w].moved(walls.pose[w], walls.velocity[w], dt));
  typename WallMotion<d>::Moved out;
  motion.move(v, there, dt, out);
  return out;
}

TYPED_TEST(WallMotions, free_nodes_go_straight_and_tied_ones_stay_on_their_wall) {
  constexpr int d = TypeParam::value;
  scenes::Tank<d> tank(across);
  std::mt19937 random(11);
  tank.velocity[0] = scenes::random_vector<Twist<d>>(random, {});
  std::vector<Vec<d>> v;
  for (std::size_t i = 0; i < tank.nodes.size(); ++i) v.push_back(scenes::random_vector<Vec<d>>(random, {}));
  const double dt = 0.05;
  const auto out = moved_by<d>({tank.nodes, tank.mesh, tank.at(), std::vector<char>{0}}, tank, v, dt);
  const auto pose = tank.walls[0].moved(tank.pose[0], tank.velocity[0], dt);
  for (std::size_t i = 0; i < v.size(); ++i) {
    EXPECT_EQ(out.tie[i].wall, tank.nodes.tie[i].wall);
    if (tank.nodes.tie[i].wall < 0) {
      EXPECT_EQ(out.x[i], Vec<d>(tank.nodes.x[i] + dt * v[i]));
      EXPECT_EQ(out.u[i], v[i]);
    } else {
      EXPECT_NEAR(tank.walls[0].nearest(pose, out.x[i], 9).distance, 0, 20 * eps);
      EXPECT_LE((out.u[i] - (out.x[i] - tank.nodes.x[i]) / dt).norm(), 1000 * eps) << "none slips yet";
    }
  }
}

TYPED_TEST(WallMotions, water_that_moves_with_its_tank_stays_where_it_is_in_it) {
  constexpr int d = TypeParam::value;
  scenes::Tank<d> tank(across);
  tank.velocity[0].rigid.template head<d>().setLinSpaced(-0.3, 0.8);
  const Vec<d> w = tank.velocity[0].rigid.template head<d>();
  const double dt = 0.1;
  WallMotion<d> motion(tank.nodes, tank.mesh, tank.at(), std::vector<char>{0});
  motion.meet_pressure(std::vector<int>(tank.nodes.size(), 0), tank.nodes.volume);
  const auto out = moved_by<d>(motion, tank, std::vector<Vec<d>>(tank.nodes.size(), w), dt);
  for (std::size_t i = 0; i < tank.nodes.size(); ++i) {
    EXPECT_LE((out.x[i] - tank.nodes.x[i] - dt * w).norm(), 20 * eps);
    EXPECT_LE((out.u[i] - w).norm(), 1000 * eps);
    EXPECT_EQ(out.tie[i], tank.nodes.tie[i]);
  }
}

TYPED_TEST(WallMotions, nodes_with_a_pressure_keep_the_waters_velocity_and_their_place_on_the_wall) {
  constexpr int d = TypeParam::value;
  scenes::Tank<d> tank(across);
  std::mt19937 random(12);
  std::vector<Vec<d>> v;
  for (std::size_t i = 0; i < tank.nodes.size(); ++i) v.push_back(scenes::random_vector<Vec<d>>(random, {}));
  WallMotion<d> motion(tank.nodes, tank.mesh, tank.at(), std::vector<char>{0});
  std::vector<int> unknown(tank.nodes.size());
  for (std::size_t i = 0; i < unknown.size(); ++i) unknown[i] = tank.nodes.surface[i] ? -1 : static_cast<int>(i);
  motion.meet_pressure(unknown, tank.nodes.volume);
  const double dt = 0.02;
  const auto out = moved_by<d>(motion, tank, v, dt);
  int slipping = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const WallTie& tie = tank.nodes.tie[i];
    if (tie.wall < 0) continue;
    EXPECT_NEAR(tank.walls[0].nearest(tank.pose[0], out.x[i], 9).distance, 0, 20 * eps);
    const bool slips = !tie.sharp() && !tank.nodes.surface[i];
    slipping += slips;
    EXPECT_LE((out.u[i] - (slips ? v[i] : Vec<d>((out.x[i] - tank.nodes.x[i]) / dt))).norm(), 1000 * eps);
  }
  EXPECT_GT(slipping, 0);
  // The flux counts at every facet that has such a node: at all but those of hollow edges and contact lines alone.
  std::size_t expected = 0;
  for (const auto& f : tank.mesh.boundary)
    expected += f.wall >= 0 && std::any_of(f.nodes.begin(), f.nodes.end(),
                                           [&](int n) { return !tank.nodes.tie[n].sharp() && !tank.nodes.surface[n]; });
  EXPECT_EQ(out.slides.size(), expected);
}

TYPED_TEST(WallMotions, hollow_edges_hold_their_nodes_but_along_themselves) {
  constexpr int d = TypeParam::value;
  const scenes::Tank<d> tank(across);
  const WallMotion<d> motion(tank.nodes, tank.mesh, tank.at(), std::vector<char>{1});
  // Two corners in the plane; four in space, with the edges of the bottom between them and four upright ones.
  const std::size_t held = d == 2 ? 2 : 4 + 4 * (across - 1) + 4 * across;
  ASSERT_EQ(motion.held().size(), held);
  for (const auto& h : motion.held()) {
    const WallTie& tie = tank.nodes.tie[h.node];
    EXPECT_TRUE(tie.sharp());
    EXPECT_EQ(h.wall, 0);
    EXPECT_LE((h.arm - (tank.nodes.x[h.node] - tank.pose[0].translation())).norm(), eps);
    EXPECT_LE((h.directions * h.directions - h.directions).norm(), 10 * eps) << "a projector";
    EXPECT_NEAR(h.directions.trace(), tie.vertex >= 0 ? d : d - 1, 10 * eps);
    if (tie.crease < 0) continue;
    const auto along = tank.walls[0].crease_direction(tank.pose[0], tank.nodes.x[h.node], tie.crease);
    EXPECT_LE((h.directions * along).norm(), 10 * eps);
  }
}

// The lower edge of a block, at the origin, with water below it and, if `behind`, beside it: nodes this far from the edge.
template <int d>
struct ConvexEdge : scenes::Walls<d> {
  explicit ConvexEdge(bool behind, double apart = 0.1) {
    Vec<d> min = Vec<d>::Constant(-1), max = Vec<d>::Ones();
    max[0] = min[d - 1] = 0;
    this->add_wall(scenes::box<d>(min, max));
    Vec<d> at = Vec<d>::Zero();
    at[0] = -apart;
    below = add(at, false);
    at[0] = 0;
    edge.push_back(add(at, !behind));
    if constexpr (d == 3) edge.push_back(add({0, 0.1, 0}, !behind));
    at[d - 1] = apart;
    if (behind) beside = add(at, false);
    facet(below);
    if (behind) facet(beside);
  }
  int add(const Vec<d>& x, bool surface) {
    return nodes.add(x, Vec<d>::Zero(), 0, scenes::tie_at<d>(this->walls[0], this->pose[0], x, 0), surface);
  }
  void facet(int n) {
    Facet<d> f;
    f.nodes[0] = n;
    for (std::size_t k = 0; k < edge.size(); ++k) f.nodes[k + 1] = edge[k];
    f.wall = 0;
    mesh.boundary.push_back(f);
  }
  WallMotion<d> motion(char answers = 0) const { return {nodes, mesh, this->at(), std::vector<char>{answers}}; }
  int below, beside = -1;
  std::vector<int> edge;
  Nodes<d> nodes;
  Mesh<d> mesh;
};

TYPED_TEST(WallMotions, what_passes_an_edge_with_air_behind_flies_off_straight) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(false);
  std::vector<Vec<d>> v(edge.nodes.size(), Vec<d>::Zero());
  v[edge.below][0] = 1;
  v[edge.below][d - 1] = 0.5;  // into the block
  const double dt = 0.2;
  const auto out = moved_by<d>(edge.motion(), edge, v, dt);
  EXPECT_EQ(out.tie[edge.below].wall, -1);
  EXPECT_LE((out.x[edge.below] - 0.1 * Vec<d>::Unit(0)).norm(), 10 * eps) << "guided along the bottom";
  EXPECT_LE((out.u[edge.below] - Vec<d>::Unit(0)).norm(), 100 * eps);
}

TYPED_TEST(WallMotions, what_leaves_an_edge_and_what_comes_to_it_become_one) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(false);
  auto& volume = edge.nodes.volume;
  std::vector<int> unknown(edge.nodes.size(), -1);
  for (int n : edge.edge) edge.nodes.separates[n] = 1, volume[n] = 1;
  volume[edge.below] = d - 1, unknown[edge.below] = 0;
  auto motion = edge.motion();
  motion.meet_pressure(unknown, volume);
  std::vector<Vec<d>> v(edge.nodes.size(), Vec<d>::Zero());
  v[edge.below][0] = 3;
  const auto out = moved_by<d>(motion, edge, v, 0.01);
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_LE((out.u[i] - 1.5 * Vec<d>::Unit(0)).norm(), 100 * eps);
  for (int n : edge.edge) EXPECT_LE((out.x[n] - edge.nodes.x[n]).norm(), 10 * eps) << "the node stays";
}

TYPED_TEST(WallMotions, what_passes_an_edge_that_is_wet_behind_turns_the_corner) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(true);
  std::vector<Vec<d>> v(edge.nodes.size(), Vec<d>::Zero());
  v[edge.below][0] = 1;
  v[edge.below][d - 1] = 0.5;
  const auto out = moved_by<d>(edge.motion(), edge, v, 0.2);
  EXPECT_EQ(out.tie[edge.below].wall, 0);
  EXPECT_EQ(out.tie[edge.below].patch, edge.nodes.tie[edge.beside].patch);
  EXPECT_LE((out.x[edge.below] - 0.1 * Vec<d>::Unit(d - 1)).norm(), 10 * eps);
}

TYPED_TEST(WallMotions, nodes_at_edges_stay_there) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(true);
  edge.velocity[0].rigid.template head<d>().setLinSpaced(0.2, 0.7);
  const std::vector<Vec<d>> v(edge.nodes.size(), Vec<d>::Constant(0.3));
  const double dt = 0.1;
  const auto out = moved_by<d>(edge.motion(), edge, v, dt);
  for (int n : edge.edge) {
    Vec<d> from = dt * edge.velocity[0].rigid.template head<d>();
    from -= out.x[n] - edge.nodes.x[n];
    if (d == 3) from[1] = 0;  // along the crease they slide
    EXPECT_LE(from.norm(), 10 * eps);
    EXPECT_EQ(out.tie[n], edge.nodes.tie[n]);
    EXPECT_EQ(out.u[n], v[n]) << "the water flows around it";
  }
  EXPECT_TRUE(edge.motion(1).held().empty());
}

TYPED_TEST(WallMotions, the_first_edge_of_a_dry_body_shares_its_momentum_if_it_answers) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(false);
  edge.mesh.boundary[0].wall = -1;  // its nodes have come, no facet is wet
  EXPECT_TRUE(edge.motion(0).held().empty());
  const auto held = edge.motion(1).held();
  ASSERT_EQ(held.size(), edge.edge.size());
  for (const auto& h : held) EXPECT_NEAR(h.directions.trace(), 2, 10 * eps) << "all of them, but along a crease";
}

TYPED_TEST(WallMotions, water_past_an_edge_has_the_velocity_of_where_it_comes_from) {
  constexpr int d = TypeParam::value;
  const ConvexEdge<d> edge(true);
  auto motion = edge.motion();
  motion.meet_pressure(std::vector<int>(edge.nodes.size(), 0), edge.nodes.volume);
  std::vector<Vec<d>> uniform(edge.nodes.size(), Vec<d>::Unit(0));
  const double dt = 0.02;
  auto u = uniform;
  motion.convect(edge.nodes.x, dt, u);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_LE((u[i] - uniform[i]).norm(), 10 * eps);
  // Upstream is below the block, 0.1 away: a fifth of that passes in the step. Nothing comes from beside it.
  u[edge.below] = 3 * Vec<d>::Unit(0);
  u[edge.beside] = 100 * Vec<d>::Unit(d - 1);
  const Vec<d> before = u[edge.edge[0]];
  motion.convect(edge.nodes.x, dt, u);
  EXPECT_LE((u[edge.edge[0]] - (before + 0.2 * (u[edge.below] - before))).norm(), 10 * eps);
  // All of it, and no more, in a long one.
  motion.convect(edge.nodes.x, 50 * dt, u);
  EXPECT_LE((u[edge.edge[0]] - u[edge.below]).norm(), 10 * eps);
}

TYPED_TEST(WallMotions, a_drop_on_a_wall_gives_up_what_carries_it_in) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(false);
  for (const double inwards : {0.5, -0.5}) {
    Nodes<d>& nodes = edge.nodes;
    nodes.spray[edge.below] = 1;
    std::vector<Vec<d>> v(nodes.size(), Vec<d>::Zero());
    v[edge.below][0] = -1;
    v[edge.below][d - 1] = inwards;
    const auto out = moved_by<d>(edge.motion(), edge, v, 0.1);
    Vec<d> x = -0.2 * Vec<d>::Unit(0), u = -Vec<d>::Unit(0);
    if (inwards < 0) x[d - 1] = 0.1 * inwards, u[d - 1] = inwards;
    EXPECT_LE((out.x[edge.below] - x).norm(), 10 * eps);
    EXPECT_LE((out.u[edge.below] - u).norm(), 100 * eps);
    EXPECT_EQ(out.tie[edge.below].wall, inwards > 0 ? 0 : -1);
  }
}

TYPED_TEST(WallMotions, a_drop_that_goes_past_the_middle_of_a_thin_wall_comes_back_on_its_own_side) {
  constexpr int d = TypeParam::value;
  scenes::Walls<d> plate;
  plate.add_wall(scenes::box<d>(scenes::point<d>(-1, -0.1), scenes::point<d>(1, 0)));
  Nodes<d> nodes;
  const auto top = plate.walls[0].nearest(plate.pose[0], Vec<d>::Zero(), 1);
  nodes.add(Vec<d>::Zero(), Vec<d>::Zero(), 0, {0, top.patch, -1}, false, 0.1);
  nodes.spray[0] = 1;
  const Mesh<d> no_water;
  const auto out =
      moved_by<d>({nodes, no_water, plate.at(), std::vector<char>{0}}, plate, {scenes::point<d>(1, -0.8)}, 0.1);
  EXPECT_LE((out.x[0] - scenes::point<d>(0.1, 0)).norm(), 10 * eps);
  EXPECT_LE((out.u[0] - scenes::point<d>(1, 0)).norm(), 100 * eps);
  EXPECT_EQ(out.tie[0], nodes.tie[0]);
}

TYPED_TEST(WallMotions, a_drop_rests_in_a_corner_however_it_falls_into_it) {
  constexpr int d = TypeParam::value;
  for (const auto& v : {Vec<d>(-3 * Vec<d>::Unit(d - 1)), Vec<d>(-Vec<d>::Ones())}) {
    scenes::Tank<d> tank(across);
    tank.mesh = {};
    const int drop = tank.nodes.add(Vec<d>::Zero(), Vec<d>::Zero(), 0, {0, 0, -1}, false, 0.1);
    tank.nodes.spray[drop] = 1;
    std::vector<Vec<d>> all(tank.nodes.size(), Vec<d>::Zero());
    all[drop] = v;
    const auto out = moved_by<d>({tank.nodes, tank.mesh, tank.at(), std::vector<char>{0}}, tank, all, 0.1);
    EXPECT_LE(out.x[drop].norm(), 20 * eps);
    EXPECT_LE(out.u[drop].norm(), 1000 * eps);
  }
}

TYPED_TEST(WallMotions, a_dry_node_leaves_a_wall_that_goes_away) {
  constexpr int d = TypeParam::value;
  ConvexEdge<d> edge(false);
  edge.mesh.boundary.clear();
  std::vector<Vec<d>> v(edge.nodes.size(), Vec<d>::Zero());
  v[edge.below][d - 1] = -0.5;
  const auto out = moved_by<d>(edge.motion(), edge, v, 0.1);
  EXPECT_EQ(out.tie[edge.below].wall, -1);
  EXPECT_EQ(out.x[edge.below], Vec<d>(edge.nodes.x[edge.below] + 0.1 * v[edge.below]));
}

// A facet whose nodes lie on the side of a cone or of a regular polygon: a chord of it.
template <int d>
struct Chord : scenes::Walls<d> {
  Chord() {
    constexpr int segments = 24;
    if constexpr (d == 2) {
      this->add_wall(scenes::ellipse(1, 1, segments));
      nodes_at(0.02, 1), nodes_at(0.31, 1);
    } else {
      this->add_wall(scenes::cone(1, 1, segments));
      nodes_at(0.02, 0.5), nodes_at(0.31, 0.5), nodes_at(0.1, 0.7);
    }
    Facet<d> f;
    for (int k = 0; k < d; ++k) f.nodes[k] = k;
    f.wall = 0;
    mesh.boundary.push_back(f);
  }
  void nodes_at(double angle, double radius) {
    Vec<d> x;
    x.setConstant(radius);  // the cone's height is its radius
    x[0] = radius * std::cos(angle), x[1] = radius * std::sin(angle);
    const auto near = this->walls[0].nearest(this->pose[0], x, 1);
    nodes.add(near.point, Vec<d>::Zero(), 0, {0, near.patch, -1}, true);
  }
  Nodes<d> nodes;
  Mesh<d> mesh;
};

TYPED_TEST(WallMotions, the_flux_counts_at_chords_of_curved_walls) {
  constexpr int d = TypeParam::value;
  Chord<d> chord;
  std::vector<Vec<d>> v(chord.nodes.size(), Vec<d>::Zero());
  auto slides = [&] {
    WallMotion<d> motion(chord.nodes, chord.mesh, chord.at(), std::vector<char>{0});
    motion.meet_pressure(std::vector<int>(chord.nodes.size(), -1), chord.nodes.volume);
    return moved_by<d>(motion, chord, v, 0.01).slides;
  };
  EXPECT_EQ(slides(), std::vector<int>{0});
  chord.nodes.separates[0] = 1;
  EXPECT_TRUE(slides().empty()) << "what leaves the wall has its own motion";
}

TYPED_TEST(WallMotions, the_flux_of_flat_walls_is_that_of_their_nodes) {
  constexpr int d = TypeParam::value;
  const scenes::Tank<d> tank(across);
  WallMotion<d> motion(tank.nodes, tank.mesh, tank.at(), std::vector<char>{0});
  motion.meet_pressure(std::vector<int>(tank.nodes.size(), -1), tank.nodes.volume);
  const std::vector<Vec<d>> v(tank.nodes.size(), Vec<d>::Zero());
  const auto out = moved_by<d>(motion, tank, v, 0.01);
  for (int f : out.slides) {
    // Edges where two faces of the tank meet lie between two patches.
    std::set<int> patches;
    for (int n : tank.mesh.boundary[f].nodes)
      if (!tank.nodes.tie[n].sharp()) patches.insert(tank.nodes.tie[n].patch);
    EXPECT_GT(patches.size(), 1u);
  }
}

}  // namespace
}  // namespace splashdown::fluid::wall_motion_test
