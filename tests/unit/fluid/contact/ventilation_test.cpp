#include "fluid/pfem/contact/ventilation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fluid/pfem/contact/attachment.hpp"
#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::ventilation_test {
namespace {

constexpr int columns = 20;
constexpr double density = 1000, gravity = 9.81, size = 0.02, speed = 3;
constexpr double dynamic = 0.5 * density * speed * speed;

// A film on top of a wall, its nodes in columns: the lowest of each on the wall, air above and at both ends.
struct Film {
  Film(int layers, const Surface<2>& hull, bool round)
      : rows(layers + 1), walls{Wall<2>(scenes::wall("hull", hull, size))} {
    for (int j = 0; j <= columns; ++j)
      for (int k = 0; k < rows; ++k) {
        const double along = (j - 0.5 * columns) * size, up = k * size;
        const Vec<2> normal = round ? Vec<2>(std::sin(along), std::cos(along)) : Vec<2>(0, 1);
        const Vec<2> tangent(normal.y(), -normal.x());
        Vec<2> foot = round ? normal : Vec<2>(along, 0);
        WallTie tie;
        if (k == 0) {
          const auto near = walls[0].nearest(pose[0], foot, 1);
          foot = near.point;
          tie = {0, near.patch, -1};
        }
        nodes.add(foot + up * normal, speed * tangent, 0, tie, k == rows - 1 || j == 0 || j == columns);
      }
    auto cell = [&](int a, int b, int c) {
      std::array<int, 3> nodes_of{a, b, c};
      if (volume<2>(corners(nodes.x, nodes_of)) < 0) std::swap(nodes_of[1], nodes_of[2]);
      mesh.cells.push_back(nodes_of);
    };
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k + 1 < rows; ++k) {
        // Diagonals lean towards the middle, so that the nodes next to either end see as much of the film.
        const int across = j < columns / 2 ? at(j, k) : at(j + 1, k);
        const int opposite = j < columns / 2 ? at(j + 1, k + 1) : at(j, k + 1);
        cell(across, opposite, j < columns / 2 ? at(j + 1, k) : at(j, k));
        cell(across, opposite, j < columns / 2 ? at(j, k + 1) : at(j + 1, k + 1));
      }
    auto facet = [&](int a, int b, int wall) { mesh.boundary.push_back({{a, b}, wall}); };
    for (int j = 0; j < columns; ++j) facet(at(j, 0), at(j + 1, 0), 0), facet(at(j + 1, rows - 1), at(j, rows - 1), -1);
    for (int k = 0; k + 1 < rows; ++k) facet(at(columns, k), at(columns, k + 1), -1), facet(at(0, k + 1), at(0, k), -1);
  }
  int at(int column, int row) const { return column * rows + row; }
  // Pressures of the wetted nodes but the two of the contact line, in dynamic pressures.
  void press(double p) { press_some(1, columns - 1, p); }
  void press_some(int first, int last, double p) {
    for (int j = first; j <= last; ++j) nodes.wall_pressure[at(j, 0)] = p * dynamic;
  }
  void ventilate() {
    nodes.h.assign(nodes.size(), size);
    fluid::ventilate<2>(nodes, mesh, {walls, pose}, still, density, gravity);
  }
  bool left(int column) const { return nodes.tie[at(column, 0)].wall < 0; }
  int left_in_all() const {
    int count = 0;
    for (int j = 0; j <= columns; ++j) count += left(j);
    return count;
  }

  int rows;
  std::vector<WallPlace<2>> pose{Isometry<2>::Identity()};
  std::vector<WallVelocity<2>> still{Twist<2>::Zero()};
  std::vector<Wall<2>> walls;
  Nodes<2> nodes;
  Mesh<2> mesh;
};

Film on_a_round_hull(int layers) { return {layers, scenes::ellipse(1, 1, 256), true}; }
Film on_a_flat_one(int layers) { return {layers, scenes::rectangle({-1, -1}, {1, 0}), false}; }

constexpr int thin = 1, resolved = 4;
// Of a concentric film, p = -rho v^2 delta / R, over the dynamic pressure: weak, and of either thickness here.
constexpr double film_suction = -2 * size;

TEST(Ventilation, a_thin_film_under_suction_leaves_a_round_hull_from_its_contact_lines) {
  Film film = on_a_round_hull(thin);
  film.press(film_suction);
  film.ventilate();
  EXPECT_TRUE(film.left(1) && film.left(columns - 1));
  EXPECT_EQ(film.left_in_all(), 2);
}

TEST(Ventilation, a_node_of_either_sign_among_its_like_does_not_hold_the_film) {
  Film film = on_a_round_hull(thin);
  film.press(film_suction);
  film.press_some(1, 1, -0.25 * film_suction);
  film.ventilate();
  EXPECT_TRUE(film.left(1));
}

TEST(Ventilation, a_thin_film_under_pressure_stays) {
  Film film = on_a_round_hull(thin);
  film.press(-film_suction);
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 0);
}

TEST(Ventilation, a_resolved_film_stays_under_weak_suction) {
  Film film = on_a_round_hull(resolved);
  film.press(film_suction);
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 0);
}

TEST(Ventilation, air_gets_to_strong_suction_along_the_hull) {
  Film film = on_a_round_hull(resolved);
  film.press(film_suction);
  film.press_some(8, 10, -0.2);
  film.ventilate();
  EXPECT_TRUE(film.left(1) && film.left(columns - 1));
  EXPECT_EQ(film.left_in_all(), 2);
}

TEST(Ventilation, pressure_in_between_keeps_air_off) {
  Film film = on_a_round_hull(resolved);
  film.press(film_suction);
  film.press_some(8, 12, -0.2);
  film.press_some(4, 6, 0.2);
  film.press_some(14, 16, 0.2);
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 0);
}

TEST(Ventilation, water_that_hardly_moves_stays) {
  Film film = on_a_round_hull(thin);
  const double slow = 0.9 * std::sqrt(2 * gravity * size);
  for (auto& v : film.nodes.v) v *= slow / speed;
  film.press(0.05 * film_suction);  // below a tenth of the dynamic pressure of this speed, too
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 0);
}

TEST(Ventilation, flat_walls_let_go_under_strong_suction_alone) {
  Film film = on_a_flat_one(thin);
  film.press(film_suction);
  film.press_some(8, 10, -0.2);
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 0);
  film.press(-0.2);
  film.ventilate();
  EXPECT_EQ(film.left_in_all(), 2);
}

TEST(Ventilation, what_has_left_is_not_on_the_wall) {
  for (Film film : {on_a_round_hull(thin), on_a_flat_one(thin)}) {
    film.press(-0.2);
    film.ventilate();
    ASSERT_TRUE(film.left(1));
    EXPECT_GT(film.walls[0].nearest(film.pose[0], film.nodes.x[film.at(1, 0)], 1).distance, 0);
    attach_nodes<2>(film.nodes, film.mesh, {film.walls, film.pose}, film.still, 0);
    EXPECT_TRUE(film.left(1));
  }
}

template <class Dimension>
struct VentilationOfFlatWalls : testing::Test {};
TYPED_TEST_SUITE(VentilationOfFlatWalls, scenes::Dimensions);

// Nodes of a tank's walls that air gets to: the row below the contact line. Water passes them at `speed`, with suction of this
// many dynamic pressures; the tank itself is much faster and turns.
template <int d>
void expect_first_row(double suction, bool leaves) {
  constexpr int across = 4;
  scenes::Tank<d> tank(across);
  tank.velocity[0].rigid.setConstant(10);
  for (std::size_t i = 0; i < tank.nodes.size(); ++i) {
    tank.nodes.v[i] = velocity_at<d>(tank.pose[0], tank.velocity[0], tank.nodes.x[i]) + speed * Vec<d>::Unit(0);
    tank.nodes.wall_pressure[i] = tank.nodes.surface[i] ? 0 : -suction * dynamic;
  }
  const auto before = tank.nodes;
  tank.nodes.h.assign(tank.nodes.size(), size);
  ventilate<d>(tank.nodes, tank.mesh, tank.at(), tank.velocity, density, gravity);
  for (std::size_t i = 0; i < tank.nodes.size(); ++i) {
    if (before.tie[i].wall < 0) continue;
    const bool left = tank.nodes.tie[i].wall < 0, first_row = before.x[i][d - 1] == 1 - 1.0 / across;
    EXPECT_EQ(left, leaves && first_row) << before.x[i].transpose();
    const double off = tank.walls[0].nearest(tank.pose[0], tank.nodes.x[i], 1).distance;
    EXPECT_EQ(off > 1e-3 * 1e-6 * size, left) << "what has left is off the wall";
  }
}

TYPED_TEST(VentilationOfFlatWalls, air_gets_to_one_row_of_nodes_a_step_under_strong_suction_alone) {
  expect_first_row<TypeParam::value>(0.2, true);
  expect_first_row<TypeParam::value>(0.05, false);
}

// Water that passes a node of a plate, and a node that has left it.
template <int d>
struct Passing : scenes::Walls<d> {
  Passing() {
    this->add_wall(scenes::box<d>(Vec<d>::Constant(-1), top(0)));
    this->velocity[0].rigid[0] = 5;
    tied = add(Vec<d>::Zero(), scenes::tie_at<d>(this->walls[0], this->pose[0], Vec<d>::Zero(), 0));
    left = add(top(0.1), {});
    nodes.wall_pressure[left] = dynamic;
  }
  static Vec<d> top(double height) {
    Vec<d> x = Vec<d>::Constant(1);
    x[d - 1] = height;
    return x;
  }
  int add(const Vec<d>& x, WallTie tie) { return nodes.add(x, (5 + speed) * Vec<d>::Unit(0), 0, tie, false, size); }
  double after(double kick, double pressure, double repair = 0) {
    std::vector<int> unknown(nodes.size());
    std::iota(unknown.begin(), unknown.end(), 0);
    nodes.p.assign(nodes.size(), pressure);
    average_wall_pressure<d>(nodes, mesh, this->at(), this->velocity, unknown,
                             std::vector<double>(nodes.size(), kick * repair), kick);
    return nodes.wall_pressure[tied];
  }
  Nodes<d> nodes;
  Mesh<d> mesh;
  int tied, left;
};

// q' = (p - q) |v - w| / h: implicit Euler's error is the first term that it leaves out, half the step over h/|v - w|, e^-1 times.
TEST(WallPressure, in_space_takes_the_time_in_which_water_passes_an_element_whatever_the_step) {
  const double passes = size / speed;
  for (const int steps : {20, 200}) {
    Passing<3> water;
    for (int i = 0; i < steps; ++i) water.after(passes / steps, dynamic);
    EXPECT_NEAR(water.nodes.wall_pressure[water.tied] / dynamic, 1 - std::exp(-1), 0.5 * std::exp(-1) / steps);
    EXPECT_EQ(water.nodes.wall_pressure[water.left], 0);
  }
}

TEST(WallPressure, what_a_repair_brings_and_the_pressure_takes_back_is_no_suction) {
  Passing<3> water;
  EXPECT_NEAR(water.after(1e-3, -dynamic, dynamic), 0, scenes::eps * dynamic);
  EXPECT_GT(water.after(1e-3, -dynamic, 2 * dynamic), 0);
}

TEST(WallPressure, of_a_gap_and_in_the_plane_is_that_of_the_step) {
  Passing<3> water;
  water.add_wall(scenes::block({-1, -1, 0.1}, {1, 1, 1}));
  const int other = water.add({0, 0, 0.1}, scenes::tie_at<3>(water.walls[1], water.pose[1], {0, 0, 0.1}, 1));
  water.mesh.cells.push_back({water.tied, water.left, other, water.left});
  EXPECT_EQ(water.after(1e-3, -dynamic, 2 * dynamic), -dynamic);
  EXPECT_EQ(Passing<2>().after(1e-3, -dynamic, 2 * dynamic), -dynamic);
}

TEST(WallPressure, long_steps_remember_nothing) {
  Passing<3> water;
  water.after(1e-3, dynamic);
  EXPECT_NEAR(water.after(1e6 * size / speed, -dynamic), -dynamic, 3e-6 * dynamic);
}

// A triangle at the contact line of a cone and one behind it, whose far corner has this suction, in dynamic pressures.
bool leaves_a_cone(double suction_behind) {
  scenes::Walls<3> cone;
  cone.add_wall(scenes::cone(1, 1, 24));
  Nodes<3> nodes;
  auto add = [&](double angle, double radius, double p, bool surface) {
    const auto near =
        cone.walls[0].nearest(cone.pose[0], {radius * std::cos(angle), radius * std::sin(angle), radius}, 1);
    const int n = nodes.add(near.point, speed * Vec<3>(std::cos(angle), std::sin(angle), 1).normalized(), 0,
                            {0, near.patch, -1}, surface, size);
    nodes.wall_pressure[n] = p * dynamic;
  };
  add(0.3, 0.60, 0, true);
  add(0.2, 0.55, -0.02, false);
  add(0.4, 0.55, -0.02, false);
  add(0.3, 0.50, -suction_behind, false);
  Mesh<3> mesh;
  mesh.boundary = {{{0, 1, 2}, 0}, {{1, 3, 2}, 0}};
  ventilate<3>(nodes, mesh, cone.at(), cone.velocity, density, gravity);
  EXPECT_EQ(nodes.tie[1].wall, nodes.tie[2].wall);
  EXPECT_EQ(nodes.tie[3].wall, 0) << "not beside the contact line";
  return nodes.tie[1].wall < 0;
}

TEST(VentilationInSpace, air_gets_to_strong_suction_along_a_curved_hull) {
  EXPECT_TRUE(leaves_a_cone(0.5));
  EXPECT_FALSE(leaves_a_cone(0.1));
}

}  // namespace
}  // namespace splashdown::fluid::ventilation_test
