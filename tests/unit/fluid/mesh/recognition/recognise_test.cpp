#include "fluid/pfem/mesh/recognition/recognise.hpp"

#include <gtest/gtest.h>

#include <set>

#include "fluid/pfem/initial/parts.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::recognise_test {
namespace {

using scenes::eps;

struct Liquid {
  Nodes<2> nodes;
  std::vector<Facet<2>> boundary;
  double h = 0.1;

  int add(const Vec<2>& x) { return nodes.add(x, Vec<2>::Zero(), 0, {}, false); }
  void add_ring(const std::vector<Vec<2>>& points) {
    const int first = static_cast<int>(nodes.size()), n = static_cast<int>(points.size());
    for (int i = 0; i < n; ++i) {
      add(points[i]);
      boundary.push_back({{first + i, first + (i + 1) % n}, -1});
    }
  }
  Mesh<2> recognised() {
    nodes.h.assign(nodes.size(), h);
    return recognise<2>(nodes, boundary, WallsAt<2>{});
  }
};

// Corners of a rectangle's outline, n per unit length, counter-clockwise.
std::vector<Vec<2>> ring(double x0, double y0, double x1, double y1, int n) {
  std::vector<Vec<2>> p;
  const int across = static_cast<int>(std::lround((x1 - x0) * n)), up = static_cast<int>(std::lround((y1 - y0) * n));
  for (int i = 0; i < across; ++i) p.push_back({x0 + (x1 - x0) * i / across, y0});
  for (int i = 0; i < up; ++i) p.push_back({x1, y0 + (y1 - y0) * i / up});
  for (int i = 0; i < across; ++i) p.push_back({x1 - (x1 - x0) * i / across, y1});
  for (int i = 0; i < up; ++i) p.push_back({x0, y1 - (y1 - y0) * i / up});
  return p;
}

double area(const Mesh<2>& mesh, const Nodes<2>& nodes) {
  double sum = 0;
  for (const auto& c : mesh.cells) sum += volume<2>(corners(nodes.x, c));
  return sum;
}

std::set<std::pair<int, int>> facets(const std::vector<Facet<2>>& boundary) {
  std::set<std::pair<int, int>> out;
  for (const auto& f : boundary) out.insert({f.nodes[0], f.nodes[1]});
  return out;
}

// A square of cocircular lattice nodes: each four of them have two Delaunay triangulations.
Liquid lattice_square() {
  Liquid l;
  l.add_ring(ring(0, 0, 1, 1, 10));
  for (int i = 1; i < 10; ++i)
    for (int j = 1; j < 10; ++j) l.add({i / 10.0, j / 10.0});
  return l;
}

TEST(Recognise, a_cocircular_lattice_keeps_its_boundary_and_volume) {
  Liquid l = lattice_square();
  const auto mesh = l.recognised();
  EXPECT_EQ(facets(mesh.boundary), facets(l.boundary));
  EXPECT_EQ(mesh.cells.size(), 200u);
  EXPECT_NEAR(area(mesh, l.nodes), 1, 200 * eps);
  EXPECT_NEAR(enclosed_volume(mesh.boundary, l.nodes.x), 1, 200 * eps);
  for (std::size_t i = 0; i < l.nodes.size(); ++i) EXPECT_EQ(l.nodes.spray[i], 0);
}

TEST(Recognise, a_hole_is_not_bridged) {
  // A cavity much narrower than an element is long: any single circumradius threshold would fill it.
  Liquid l;
  l.add_ring(ring(0, 0, 1, 1, 10));
  auto slit = ring(0.3, 0.47, 0.7, 0.53, 10);
  slit.erase(std::unique(slit.begin(), slit.end()), slit.end());
  std::reverse(slit.begin(), slit.end());
  l.add_ring(slit);
  for (int i = 1; i < 10; ++i)
    for (int j = 1; j < 10; ++j)
      if (i < 2 || i > 8 || j < 4 || j > 6) l.add({i / 10.0, j / 10.0});
  const auto mesh = l.recognised();
  EXPECT_EQ(facets(mesh.boundary), facets(l.boundary));
  EXPECT_NEAR(area(mesh, l.nodes), 1 - 0.4 * 0.06, 300 * eps);
}

TEST(Recognise, fluid_under_the_peak_is_not_dropped) {
  // Fine and coarse nodes side by side: cells have circumradii of many h of the fine side.
  Liquid l;
  l.add_ring(ring(0, 0, 1, 1, 20));
  l.h = 0.03;  // the size field asks for more than the mesh has: 0.8 h < R < 8 h
  for (int i = 1; i < 4; ++i)
    for (int j = 1; j < 4; ++j) l.add({i / 4.0, j / 4.0});
  const auto mesh = l.recognised();
  EXPECT_EQ(facets(mesh.boundary), facets(l.boundary));
  EXPECT_NEAR(area(mesh, l.nodes), 1, 300 * eps);
}

TEST(Recognise, duplicate_nodes_fly_and_take_no_volume) {
  Liquid l = lattice_square();
  const std::size_t count = l.nodes.size();
  for (int n : {45, 60, 77, 100, 120}) l.add(l.nodes.x[n]);
  const auto mesh = l.recognised();
  EXPECT_NEAR(area(mesh, l.nodes), 1, 200 * eps);
  int spray = 0;
  for (char s : l.nodes.spray) spray += s;
  EXPECT_EQ(spray, 5);
  EXPECT_EQ(l.nodes.size(), count + 5);
}

TEST(Recognise, a_droplet_of_one_element_is_fluid_with_a_free_surface) {
  Liquid l;
  l.add_ring({{0, 0}, {0.1, 0}, {0.05, 0.08}});
  const auto mesh = l.recognised();
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(facets(mesh.boundary), facets(l.boundary));
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(l.nodes.surface[n], 1);
    EXPECT_EQ(l.nodes.spray[n], 0);
  }
}

TEST(Recognise, nodes_that_span_no_volume_are_spray) {
  for (int count : {0, 1, 2, 5}) {
    Liquid l;
    for (int i = 0; i < count; ++i) l.add({0.01 * i, 0.01 * i});
    const auto mesh = l.recognised();
    EXPECT_TRUE(mesh.cells.empty());
    EXPECT_TRUE(mesh.boundary.empty());
    for (char s : l.nodes.spray) EXPECT_EQ(s, 1);
  }
}

TEST(Recognise, drops_that_overlap_join) {
  Liquid l;
  l.add_ring(ring(0, 0, 0.5, 0.5, 20));
  auto second = ring(0, 0, 0.5, 0.5, 20);
  for (auto& p : second) p += Vec<2>(0.487, 0.013);
  l.add_ring(second);
  l.h = 0.05;
  const auto mesh = l.recognised();
  // Their union, but for cells across the ends of the overlap: two of at most R = 0.3 h, pi R^2 each.
  EXPECT_NEAR(area(mesh, l.nodes), 0.5 - 0.013 * (0.5 - 0.013), 2 * std::numbers::pi * std::pow(0.3 * 0.05, 2));
  EXPECT_TRUE(scenes::closed(mesh.boundary, l.nodes.size()));
}

TEST(Recognise, drops_a_spacing_apart_stay_apart) {
  Liquid l;
  l.add_ring(ring(0, 0, 0.5, 0.5, 10));
  auto second = ring(0, 0, 0.5, 0.5, 10);
  for (auto& p : second) p += Vec<2>(0.6, 0);
  l.add_ring(second);
  const auto mesh = l.recognised();
  EXPECT_NEAR(area(mesh, l.nodes), 0.5, 200 * eps);
  EXPECT_EQ(facets(mesh.boundary), facets(l.boundary));
}

TEST(Recognise, facets_are_wetted_where_both_ends_lie_on_the_wall_and_the_wall_between) {
  auto spec = scenes::still_water(1, 0.5, 0.1);
  const scenes::Placed placed(spec);
  auto liquid = fill<2>(spec, placed.at());
  const auto mesh = recognise<2>(liquid.nodes, liquid.mesh.boundary, placed.at());
  double wetted = 0, free = 0;
  for (const auto& f : mesh.boundary) (f.wall == 0 ? wetted : free) += area_vector_of<2>(f, liquid.nodes.x).norm();
  EXPECT_NEAR(wetted, 2, 100 * eps);
  EXPECT_NEAR(free, 1, 100 * eps);
  EXPECT_NEAR(enclosed_volume(mesh.boundary, liquid.nodes.x), 0.5, 100 * eps);
}

// Chords of a circle that are as long as its radius lie 0.13 of their length inside: deeper than a facet may stand off.
TEST(Recognise, a_hull_that_the_mesh_hardly_resolves_is_wet_all_around) {
  for (double size : {0.5, 1.0, 1.4}) {  // over the radius
    auto spec = scenes::still_water(1, 0.5, 0.1);
    spec.size.curvature = std::numeric_limits<double>::infinity();
    const double radius = 0.05;
    const auto circle = scenes::ellipse(radius, radius, 64, {0, -0.25});
    spec.walls.insert(spec.walls.begin(), scenes::wall("hull", circle, size * radius));
    const scenes::Placed placed(spec);
    auto liquid = fill<2>(spec, placed.at());
    for (const auto& f : liquid.mesh.boundary) {
      if (f.wall >= 0) continue;
      for (int n : f.nodes) EXPECT_NEAR(liquid.nodes.x[n].y(), 0, 100 * eps) << size;
    }
  }
}

// Nodes that smoothing pushes into a hull are neither water nor spray; here there was one.
TEST(Recognise, the_first_mesh_has_no_lost_nodes) {
  auto spec = scenes::still_water(8, 6, 0.3);
  spec.size = {.surface = 0.1, .far = 0.3};
  auto hull = scenes::wall("hull", scenes::ellipse(0.25, 0.05, 256), 0.0025);
  hull.pose.translate(Vec<2>(0.25 * std::cos(std::numbers::pi / 6), -2.875));
  hull.pose.rotate(std::numbers::pi / 6);
  spec.walls.insert(spec.walls.begin(), hull);
  const scenes::Placed placed(spec);
  const auto liquid = fill<2>(spec, placed.at());
  for (std::size_t i = 0; i < liquid.nodes.size(); ++i)
    EXPECT_EQ(liquid.nodes.spray[i], 0) << liquid.nodes.x[i].transpose();
}

/// Free surface of the water that lies below `depth` [m].
double surface_below(double depth, const Mesh<2>& mesh, const Nodes<2>& nodes) {
  double length = 0;
  for (const auto& f : mesh.boundary)
    if (f.wall < 0 && nodes.x[f.nodes[0]].y() < -depth && nodes.x[f.nodes[1]].y() < -depth)
      length += area_vector_of<2>(f, nodes.x).norm();
  return length;
}

// The facet from before the corner to behind it cuts it off: it lies in the solid, where no air is.
TEST(Recognise, a_node_that_has_just_passed_a_corner_opens_no_cavity) {
  for (const double passed : {1e-4, 1e-3, 5e-3, 2e-2}) {
    auto spec = scenes::still_water(1, 0.6, 0.06);
    spec.walls.insert(spec.walls.begin(), scenes::wall("box", scenes::rectangle({-0.1, -0.4}, {0.1, -0.2}), 0.06));
    const scenes::Placed placed(spec);
    auto liquid = fill<2>(spec, placed.at());
    auto& nodes = liquid.nodes;
    // The node nearest to the corner (0.1, -0.2) on the top goes around it, down the side.
    int goes = -1;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes.tie[i].wall == 0 && !nodes.tie[i].sharp() && std::abs(nodes.x[i].y() + 0.2) < eps &&
          (goes < 0 || nodes.x[i].x() > nodes.x[goes].x()))
        goes = static_cast<int>(i);
    ASSERT_GE(goes, 0);
    nodes.x[goes] = {0.1, -0.2 - passed};
    nodes.tie[goes].patch = placed.at().walls[0].nearest(placed.at().poses[0], {0.1, -0.3}, 1).patch;
    const auto mesh = recognise<2>(nodes, liquid.mesh.boundary, placed.at());
    EXPECT_EQ(surface_below(0.01, mesh, nodes), 0) << passed;
  }
}

// A corner of one box a hair above the side of another: what is left of the water between them is no air.
TEST(Recognise, a_gap_that_closes_under_water_opens_no_cavity) {
  for (const double gap : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    auto spec = scenes::still_water(1, 0.8, 0.06);
    spec.walls.insert(spec.walls.begin(), scenes::wall("lower", scenes::rectangle({-0.15, -0.6}, {0.1, -0.4}), 0.06));
    Surface<2> rhomb;
    rhomb.vertices.resize(2, 4);
    rhomb.vertices << 0, 0.12, 0, -0.12, -0.12, 0, 0.12, 0;
    rhomb.facets.resize(2, 4);
    rhomb.facets << 0, 1, 2, 3, 1, 2, 3, 0;
    auto upper = scenes::wall("upper", rhomb, 0.06);
    upper.pose.translate(Vec<2>(0, -0.4 + 0.12 + 0.05));
    spec.walls.insert(spec.walls.begin() + 1, upper);
    scenes::Placed placed(spec);
    auto liquid = fill<2>(spec, placed.at());
    const double down = 0.05 - gap;
    Isometry<2> lower = placed.poses[1].pose();
    lower.translation().y() -= down;
    placed.poses[1] = lower;
    for (std::size_t i = 0; i < liquid.nodes.size(); ++i)
      if (liquid.nodes.tie[i].wall == 1) liquid.nodes.x[i].y() -= down;
    const auto mesh = recognise<2>(liquid.nodes, liquid.mesh.boundary, placed.at());
    EXPECT_EQ(surface_below(0.02, mesh, liquid.nodes), 0) << gap;
  }
}

// Four nodes down a slit between two hulls, two of them opposite each other. Where it is as wide as a facet may stand off, all facets would be walls'.
TEST(Recognise, a_film_that_walls_close_in_is_no_water) {
  for (const double width : {1e-6, 1e-5, 3e-5, 1e-3, 1e-2}) {
    auto spec = scenes::still_water(1, 0.8, 0.06);
    const double side = width / 2;
    spec.walls.insert(spec.walls.begin(), scenes::wall("left", scenes::rectangle({-0.4, -0.6}, {-side, -0.1}), 0.06));
    spec.walls.insert(spec.walls.begin() + 1,
                      scenes::wall("right", scenes::rectangle({side, -0.6}, {0.4, -0.1}), 0.06));
    const scenes::Placed placed(spec);
    Liquid film;
    film.h = 0.06;
    film.add_ring({{-side, -0.2}, {-side, -0.25}, {side, -0.3}, {side, -0.2504}});
    for (std::size_t i = 0; i < 4; ++i) {
      const int wall = film.nodes.x[i].x() < 0 ? 0 : 1;
      film.nodes.tie[i].wall = wall;
      film.nodes.tie[i].patch = placed.at().walls[wall].nearest(placed.at().poses[wall], film.nodes.x[i], 1).patch;
    }
    film.nodes.h.assign(4, film.h);
    const auto mesh = recognise<2>(film.nodes, film.boundary, placed.at());
    const bool open =
        std::any_of(mesh.boundary.begin(), mesh.boundary.end(), [](const Facet<2>& f) { return f.wall < 0; });
    EXPECT_EQ(open, !mesh.cells.empty()) << width << ": what is water has a way out";
    EXPECT_NEAR(area(mesh, film.nodes), width < 1e-4 ? 0 : 0.0498 * width, 100 * eps) << width;
    for (char flies : film.nodes.spray) EXPECT_EQ(flies != 0, width < 1e-4) << width;
  }
}

// A chord across a notch of a hull passes for a facet on it where the notch is shallow. Nothing but the hull bounds what is behind.
TEST(Recognise, water_that_a_hull_alone_closes_in_is_none) {
  const double length = 0.1;
  for (const double depth : {0.02, 0.05, 0.08, 0.2, 0.5}) {
    auto spec = scenes::still_water(1, 0.8, 0.06);
    spec.walls.insert(spec.walls.begin(), scenes::wall("notched",
                                                       scenes::outline({{-0.4, -0.6},
                                                                        {0.4, -0.6},
                                                                        {0.4, -0.2},
                                                                        {length / 2, -0.2},
                                                                        {0, -0.2 - depth * length},
                                                                        {-length / 2, -0.2},
                                                                        {-0.4, -0.2}}),
                                                       0.06));
    const scenes::Placed placed(spec);
    Liquid notch;
    notch.h = 0.06;
    notch.add_ring({{-length / 2, -0.2}, {0, -0.2 - depth * length}, {length / 2, -0.2}});
    for (std::size_t i = 0; i < 3; ++i) notch.nodes.tie[i] = tie_at<2>(notch.nodes.x[i], placed.at());
    notch.nodes.h.assign(3, notch.h);
    const auto mesh = recognise<2>(notch.nodes, notch.boundary, placed.at());
    const bool open =
        std::any_of(mesh.boundary.begin(), mesh.boundary.end(), [](const Facet<2>& f) { return f.wall < 0; });
    EXPECT_EQ(open, !mesh.cells.empty()) << depth << ": what is water has a way out";
    EXPECT_EQ(mesh.cells.empty(), depth < 0.1) << depth;
    for (char flies : notch.nodes.spray) EXPECT_EQ(flies != 0, depth < 0.1) << depth;
  }
}

TEST(Recognise3, a_cocircular_lattice_keeps_its_volume) {
  scenes::Lattice<3> cube(5, 0.0);
  for (auto& t : cube.nodes.tie) t = {};
  cube.nodes.h.assign(cube.nodes.size(), 0.2);
  const auto mesh = recognise<3>(cube.nodes, cube.mesh.boundary, WallsAt<3>{});
  double sum = 0;
  for (const auto& c : mesh.cells) sum += volume<3>(corners(cube.nodes.x, c));
  EXPECT_NEAR(sum, 1, 1e-3) << "slivers aside";
  EXPECT_NEAR(enclosed_volume(mesh.boundary, cube.nodes.x), sum, 1e4 * eps);
}

// Eight nodes of a lattice's cube have a circumsphere in common: all but without shake, flat cells lie between them.
TEST(Recognise3, flat_cells_with_water_around_them_are_no_gap) {
  for (const double shake : {0.0, 1e-12, 1e-9, 1e-6}) {
    scenes::Lattice<3> cube(5, shake);
    for (auto& t : cube.nodes.tie) t = {};
    cube.nodes.h.assign(cube.nodes.size(), 0.2);
    const auto mesh = recognise<3>(cube.nodes, cube.mesh.boundary, WallsAt<3>{});
    auto is_outside = [&](int n) {
      return (cube.nodes.x[n].array() == 0).any() || (cube.nodes.x[n].array() == 1).any();
    };
    for (const auto& f : mesh.boundary)
      for (int n : f.nodes) EXPECT_TRUE(is_outside(n)) << cube.nodes.x[n].transpose() << " shake " << shake;
  }
}

// A flat cell across a crease of a tank is water: without it there is a hole with p = 0 at the bottom. One between a
// hull and its chords is a film.
TEST(Recognise3, flat_cells_on_a_wall_are_films_if_all_of_their_facets_lie_on_it) {
  const std::vector<Wall<3>> tank{
      Wall<3>(scenes::wall("tank", scenes::turned_inside_out(scenes::block({-1, -1, -1}, {1, 1, 1})), 0.5))};
  const std::vector<WallPlace<3>> poses{Isometry<3>::Identity()};
  auto cells = [&](const std::array<Vec<3>, 4>& corner) {
    Nodes<3> nodes;
    for (const auto& x : corner)
      nodes.add(x, Vec<3>::Zero(), 0, WallTie{0, tank[0].nearest(poses[0], x, 0.5).patch}, false, 0.5);
    const std::vector<Facet<3>> outside{{{1, 2, 3}, -1}, {{0, 3, 2}, -1}, {{0, 1, 3}, -1}, {{0, 2, 1}, -1}};
    EXPECT_GT(enclosed_volume(outside, nodes.x), 0);
    return recognise<3>(nodes, outside, {tank, poses}).cells.size();
  };
  EXPECT_EQ(cells({Vec<3>(0, -1, -1), {0.03, -1, -1}, {0, -0.6, -1}, {0, -1, -0.6}}), 1u);
  const double sag = 0.01;
  EXPECT_EQ(cells({Vec<3>(0, 0, -1), {0, 0.4, sag - 1}, {0.4, 0, sag - 1}, {0.4, 0.4, -1}}), 0u);
  // Along a crease, all of it nearer to the wall than a tenth of its length.
  EXPECT_EQ(cells({Vec<3>(-0.3, -1, -0.94), {0.3, -1, -0.98}, {-0.3, -0.98, -1}, {0.3, -0.94, -1}}), 1u);
}

}  // namespace
}  // namespace splashdown::fluid::recognise_test
