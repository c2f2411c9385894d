#include "fluid/pfem/initial/initial.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>

#include "fluid/pfem/mesh/conservation/displaced_volume.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::initial_test {
namespace {

using scenes::eps;

struct Basin {
  explicit Basin(double h) {
    spec.size = {.surface = h, .far = h};
    spec.liquids.push_back({scenes::block({-1, -1, -1}, {1, 1, 0}), {}});
    spec.walls.push_back(scenes::wall("tank", scenes::turned_inside_out(scenes::block({-1, -1, -1}, {1, 1, 1})), h));
  }
  InitialLiquid<3> fill() const {
    std::vector<Wall<3>> walls;
    std::vector<WallPlace<3>> poses;
    for (const auto& w : spec.walls) walls.emplace_back(w), poses.push_back(w.pose);
    return fluid::fill<3>(spec, {walls, poses});
  }
  FluidSpec<3> spec;
};

double volume_of(const InitialLiquid<3>& liquid) {
  double sum = 0;
  for (const auto& cell : liquid.mesh.cells) sum += volume<3>(corners(liquid.nodes.x, cell));
  return sum;
}

double area_of(const InitialLiquid<3>& liquid, int wall) {
  double sum = 0;
  for (const auto& f : liquid.mesh.boundary)
    if (f.wall == wall) sum += area_vector_of<3>(f, liquid.nodes.x).norm();
  return sum;
}

TEST(InitialLiquidInSpace, a_basin_is_filled_to_its_edges) {
  const auto liquid = Basin(0.3).fill();
  const double roundoff = 1e3 * eps;  // of some hundred facets
  EXPECT_NEAR(volume_of(liquid), 4, 4 * roundoff);
  EXPECT_NEAR(enclosed_volume(liquid.mesh.boundary, liquid.nodes.x), 4, 4 * roundoff);
  EXPECT_NEAR(area_of(liquid, -1), 4, 4 * roundoff);
  EXPECT_NEAR(area_of(liquid, 0), 12, 12 * roundoff);
  for (std::size_t i = 0; i < liquid.nodes.size(); ++i) {
    const Vec<3>& x = liquid.nodes.x[i];
    const int sides = (std::abs(x.x()) == 1) + (std::abs(x.y()) == 1) + (x.z() == -1);
    const WallTie& tie = liquid.nodes.tie[i];
    EXPECT_EQ(tie.wall >= 0, sides > 0);
    EXPECT_EQ(tie.crease >= 0, sides == 2) << x.transpose();
    EXPECT_EQ(tie.vertex >= 0, sides == 3) << x.transpose();
    EXPECT_FALSE(liquid.nodes.spray[i]);
  }
}

TEST(InitialLiquidInSpace, edges_are_as_long_as_the_size_field_says) {
  const auto liquid = Basin(0.2).fill();
  double sum = 0;
  int count = 0;
  for (const auto& cell : liquid.mesh.cells)
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j <= 3; ++j, ++count) sum += (liquid.nodes.x[cell[i]] - liquid.nodes.x[cell[j]]).norm();
  // Regular tetrahedra do not fill space: edges of the best meshes spread by a fifth.
  EXPECT_NEAR(sum / count, 0.2, 0.2 * 0.2);
}

TEST(InitialLiquidInSpace, bodies_are_cut_out) {
  for (double depth : {0.5, 0.1, 0.0}) {  // inside, through the surface, touching it
    Basin basin(0.3);
    const Vec<3> corner(0.4, 0.3, 0.2), centre(0.05, 0, 0.1 - depth);
    auto box = scenes::wall("box", scenes::block(-0.5 * corner, 0.5 * corner), 0.1);
    box.pose.translation() = centre;
    basin.spec.walls.push_back(box);
    const auto liquid = basin.fill();
    const double immersed = std::min(depth, 0.2);
    EXPECT_NEAR(volume_of(liquid), 4 - 0.4 * 0.3 * immersed, 1e-12) << depth;
    const double wet = 0.4 * 0.3 * (depth > 0.2 ? 2 : 1) + 2 * (0.4 + 0.3) * immersed;
    EXPECT_NEAR(area_of(liquid, 1), wet, 1e-12) << depth;
  }
}

/// Octahedron, its facets cut in four, `times`, on a sphere.
// A body that its pose puts on the floor, against a wall or from wall to wall, but for roundoff: the strip between two such faces
// is thinner than any number can say.
TEST(InitialLiquidInSpace, stands_beside_bodies_that_touch_the_tank_but_for_roundoff) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  constexpr int members = 12;
  int filled = 0;
  for (int member = 0; member < members; ++member) {
    Basin basin(0.3);
    Vec<3> side(0.3 + 0.4 * share(random), member % 3 == 2 ? 2 : 0.3 + 0.4 * share(random), 1.1 + 0.3 * share(random));
    auto body = scenes::wall("body", scenes::block(-0.5 * side, 0.5 * side), 0.1);
    const double x = member % 2 == 0 ? -1 + 0.5 * side.x() : 0.2 * (share(random) - 0.5);
    const double y = member % 3 == 0 ? 1 - 0.5 * side.y() : 0;
    body.pose.translation() << x, y, -1 + 0.5 * side.z();
    for (int k = 0; k < 3; ++k)  // an ulp or two to either side
      body.pose.translation()[k] += (share(random) - 0.5) * 4 * scenes::eps;
    basin.spec.walls.push_back(body);
    try {  // where three faces meet in a hollow corner, coarse cells may leave a hole: it is refused
      // A cell may cut across a hollow edge: an eighth of h^3 each, of eight at most.
      EXPECT_NEAR(volume_of(basin.fill()), 4 - side.x() * side.y(), std::pow(body.size, 3))
          << member << ": " << side.transpose();
      ++filled;
    } catch (const GapRefused&) {
    }
  }
  EXPECT_GE(filled, members / 2);
}

Surface<3> ball(double radius, int times) {
  std::vector<Vec<3>> x{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> facets{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < times; ++k) {
    std::map<std::pair<int, int>, int> middles;
    auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(x.size()));
      if (fresh) x.push_back((x[a] + x[b]).normalized());
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : facets) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    facets = finer;
  }
  Surface<3> s{Eigen::Matrix3Xd(3, x.size()), Eigen::Matrix3Xi(3, facets.size())};
  for (std::size_t i = 0; i < x.size(); ++i) s.vertices.col(static_cast<Eigen::Index>(i)) = radius * x[i];
  for (std::size_t f = 0; f < facets.size(); ++f)
    s.facets.col(static_cast<Eigen::Index>(f)) << facets[f][0], facets[f][1], facets[f][2];
  return s;
}

// A hole in the wetted hull would be free surface beside the tank's own, 2 x 2, and p = 0 there.
TEST(InitialLiquidInSpace, smooth_bodies_under_water_are_wetted_all_over) {
  for (const double size : {0.35, 0.2, 0.1})
    for (const double depth : {0.5, 0.6}) {
      Basin basin(0.3);
      auto body = scenes::wall("ball", ball(0.3, 4), size);
      body.pose.translation() << 0.1, -0.2, -depth;
      basin.spec.walls.push_back(body);
      const auto liquid = basin.fill();
      EXPECT_NEAR(area_of(liquid, -1), 4, 1e-12) << size << " " << depth;
      // Between the icosahedron of its seeds and the ball.
      const double hull = 4 * std::numbers::pi * 0.09;
      EXPECT_LT(area_of(liquid, 1), hull);
      EXPECT_GT(area_of(liquid, 1), 0.76 * hull) << size;
    }
}

TEST(InitialLiquidInSpace, turned_boxes_under_water_are_wetted_all_over) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 10; ++k) {
    Basin basin(0.3);
    const Vec<3> side(0.3 + 0.3 * share(random), 0.2 + 0.2 * share(random), 0.1 + 0.2 * share(random));
    auto box =
        scenes::wall("box", scenes::block(-0.5 * side, 0.5 * side), side.minCoeff() / (1.5 + 2.5 * share(random)));
    box.pose.linear() =
        Eigen::Quaterniond(share(random), share(random), share(random), share(random)).normalized().matrix();
    box.pose.translation() << 0.1, -0.1, -0.5;
    basin.spec.walls.push_back(box);
    const auto liquid = basin.fill();
    EXPECT_NEAR(area_of(liquid, -1), 4, 1e-12) << k;
    const double hull = 2 * (side.x() * side.y() + side.y() * side.z() + side.z() * side.x());
    EXPECT_NEAR(area_of(liquid, 1), hull, 1e-9 * hull) << k;
  }
}

// Nodes that keep the triangulation from a hull go while others, on the boundary, have no cell: those stay until there is another
// boundary. (It named nodes that were gone, and what the memory beside them held decided.)
TEST(InitialLiquidInSpace, a_tilted_box_afloat_displaces_what_is_under_water) {
  Basin basin(0.15);
  basin.spec.size.far = 0.2;
  const Vec<3> side(0.304011, 0.239526, 0.149009);
  auto box = scenes::wall("box", scenes::block(-0.5 * side, 0.5 * side), side.z() / 3);
  box.pose.linear() = (Eigen::AngleAxisd(std::numbers::pi / 6, Vec<3>::UnitY()) *
                       Eigen::AngleAxisd(std::numbers::pi / 36, Vec<3>::UnitX()))
                          .matrix();
  basin.spec.walls.push_back(box);
  // Where the water line meets an edge of the box a cell may cut it: an eighth of h^3 each, of eight at most.
  EXPECT_NEAR(volume_of(basin.fill()), 4 - 0.5 * side.prod(), std::pow(box.size, 3));
}

// Water above the flat top that is joined to the slanted side, through the rim, takes a piece of the hull. Rings of edges of
// length h are polygons: of the area pi rho^2 within them h^2 pi / 6 is missing, of the cone (h / r)^2 / 2.
void expect_rims(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < count; ++k) {
    Basin basin(0.3);
    const double radius = 0.3, height = radius * (0.36 + 0.6 * share(random));  // 20 to 44 degrees
    auto cone = scenes::wall("cone", scenes::cone(radius, height, 96), height / (2 + 2 * share(random)));
    cone.pose.linear() =
        Eigen::Quaterniond(share(random), share(random), share(random), share(random)).normalized().matrix();
    cone.pose.translation() = Vec<3>(0.1, -0.1, -0.5) - 0.6 * height * cone.pose.linear().col(2);
    basin.spec.walls.push_back(cone);
    const auto liquid = basin.fill();
    EXPECT_NEAR(area_of(liquid, -1), 4, 1e-12) << k;
    const double whole = std::numbers::pi * radius * radius * height / 3, chord = cone.size / radius;
    EXPECT_LT(1 - displaced_volumes(liquid.mesh, liquid.nodes.x, 2)[1].volume / whole, chord * chord / 2) << k;
  }
}
TEST(InitialLiquidInSpace, cones_under_water_keep_their_rims) { expect_rims(11, 6); }
TEST(InitialLiquidInSpaceNightly, cones_under_water_keep_their_rims) { expect_rims(12, 40); }

/// A basin with a box beside one of its walls.
Basin with_gap(double h, double gap, const Vec<3>& side, double depth) {
  Basin basin(h);
  auto box = scenes::wall("box", scenes::block(-0.5 * side, 0.5 * side), h);
  box.pose.translation() << -1 + gap + 0.5 * side.x(), 0.05, -depth;
  basin.spec.walls.push_back(box);
  return basin;
}

// Between two walls nearer to each other than an element a cell's circumcentre may lie in either.
TEST(InitialLiquidInSpace, gaps_of_four_tenths_of_an_element_and_more_are_filled) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 12; ++k) {
    const double h = 0.15 + 0.1 * share(random), gap = h * std::pow(0.4, share(random));
    const Vec<3> side(0.3 + 0.3 * share(random), 0.3 + 0.3 * share(random), 0.3 + 0.3 * share(random));
    const double depth = share(random) < 0.5 ? 0 : 0.5;
    const double displaced = depth == 0 ? 0.5 : 1;
    const auto liquid = with_gap(h, gap, side, depth).fill();
    EXPECT_NEAR(volume_of(liquid), 4 - displaced * side.prod(), 1e-9) << k << ": gap " << gap / h << " h";
  }
}

// With two elements a side, more or less, smoothing may lead the triangulation over a vertical edge of the box.
TEST(InitialLiquidInSpace, coarse_boxes_afloat_displace_what_is_under_water) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 24; ++k) {
    Basin basin(0.2 + 0.15 * share(random));
    const double h = basin.spec.size.surface, side = h * (1.6 + share(random)),
                 draft = side * (0.5 + 0.4 * share(random));
    auto box = scenes::wall("box", scenes::block(Vec<3>::Constant(-0.5 * side), Vec<3>::Constant(0.5 * side)), h);
    box.pose.translation() << -1 + 0.5 * side + h * (0.5 + 0.5 * share(random)), 0.1 * share(random),
        0.5 * side - draft;
    basin.spec.walls.push_back(box);
    EXPECT_NEAR(volume_of(basin.fill()), 4 - side * side * draft, 1e-9) << k << ": " << side / h << " elements a side";
  }
}

TEST(InitialLiquidInSpace, gaps_that_cannot_be_filled_are_told_with_their_place) {
  for (const double share : {0.04, 0.004}) {
    const auto basin = with_gap(0.2, share * 0.2, {0.4, 0.4, 0.4}, 0.5);
    try {
      basin.fill();
      FAIL() << share;
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with("the gap between ")) << text;
      for (const char* word : {"tank", "box", " at (-0.99", "elements of 0.2 m", "Use smaller ones"})
        EXPECT_NE(text.find(word), std::string::npos) << text;
    }
  }
}

TEST(InitialLiquidInSpace, narrow_gaps_are_found_before_there_is_a_mesh) {
  const double h = 0.2;
  for (const double share : {0.05, 0.2, 0.39, 0.41, 0.8, 2.0})
    for (const double depth : {0.0, 0.5}) {
      const auto basin = with_gap(h, share * h, {0.4, 0.3, 0.5}, depth);
      std::vector<Wall<3>> walls;
      std::vector<WallPlace<3>> poses;
      for (const auto& w : basin.spec.walls) walls.emplace_back(w), poses.push_back(w.pose);
      const auto gap = look_at_start<3>(basin.spec, {walls, poses});
      ASSERT_EQ(gap.has_value(), share < filled_gap) << share;
      if (!gap) continue;
      EXPECT_NEAR(gap->width, share * h, 1e-12);
      EXPECT_NEAR(gap->size, h, 1e-12);
      EXPECT_EQ(gap->first + gap->second, 1u);
    }
}

// Half a heap on a plate, cut by the tank's side: where both walls meet its round surface, chords are off it by h^2 / (8 R). They
// were taken for a hole between the walls.
TEST(InitialLiquidInSpace, round_heaps_stand_where_two_walls_meet) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 12; ++k) {
    const double radius = 0.3, height = 0.3, h = radius / (5 + 4 * share(random));
    Basin basin(h);
    basin.spec.walls[0] = scenes::wall("tank", scenes::turned_inside_out(scenes::block({-1, 0, -1}, {1, 1, 1})), h);
    basin.spec.walls.push_back(scenes::wall("plate", scenes::block({-0.6, 0, -1}, {0.6, 0.6, -0.5}), h));
    auto heap = scenes::cone(radius, height, 128);
    heap.vertices.bottomRows<2>() *= -1;  // half a turn about x: apex up
    heap.vertices.row(2).array() += height - 0.5;
    basin.spec.liquids[0].boundary = heap;
    const double half = std::numbers::pi * radius * radius * height / 6, chord = h / radius;
    EXPECT_NEAR(volume_of(basin.fill()), half, half * chord * chord / 2) << k;
  }
}

TEST(InitialLiquidInSpace, no_liquid_is_told) {
  Basin basin(0.3);
  basin.spec.liquids[0].boundary = scenes::block({3, 3, 3}, {4, 4, 4});
  EXPECT_THROW(basin.fill(), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::fluid::initial_test
