#include "fluid/pfem/mesh/delaunay/delaunay.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <set>

#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"
#include "fluid/pfem/parallel.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::delaunay_test {
namespace {

using scenes::eps;

template <int d>
std::vector<Vec<d>> cloud(int count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<Vec<d>> x(count);
  for (auto& p : x) p = scenes::random_vector<Vec<d>>(random, {});
  return x;
}

std::set<std::pair<int, int>> edges_of(const Delaunay<2>& t) {
  std::set<std::pair<int, int>> edges;
  for (const auto& c : t.cells)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(c[k], c[(k + 1) % 3]));
  return edges;
}

template <class Dimension>
struct DelaunayIn : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(DelaunayIn, Dimensions);

TYPED_TEST(DelaunayIn, cells_are_positive_and_neighbours_mutual) {
  constexpr int d = TypeParam::value;
  const auto x = cloud<d>(300);
  const auto t = delaunay<d>(std::span<const Vec<d>>(x), {});
  ASSERT_FALSE(t.cells.empty());
  for (std::size_t c = 0; c < t.cells.size(); ++c) {
    EXPECT_GT(volume<d>(corners(x, t.cells[c])), 0);
    for (int k = 0; k <= d; ++k) {
      const int other = t.neighbours[c][k];
      if (other < 0) continue;
      const auto& back = t.neighbours[other];
      EXPECT_NE(std::find(back.begin(), back.end(), static_cast<int>(c)), back.end());
      // All corners but k are shared.
      for (int j = 0; j <= d; ++j) {
        const auto& n = t.cells[other];
        EXPECT_EQ(std::find(n.begin(), n.end(), t.cells[c][j]) == n.end(), j == k);
      }
    }
  }
}

TYPED_TEST(DelaunayIn, circumspheres_are_empty) {
  constexpr int d = TypeParam::value;
  const auto x = cloud<d>(120, 2);
  const auto t = delaunay<d>(std::span<const Vec<d>>(x), {});
  for (const auto& cell : t.cells) {
    // |x_k - c| equal for all corners: 2 (x_k - x_0) . c = |x_k|^2 - |x_0|^2
    Mat<d> A;
    Vec<d> b;
    for (int k = 0; k < d; ++k) {
      A.row(k) = 2 * (x[cell[k + 1]] - x[cell[0]]).transpose();
      b[k] = x[cell[k + 1]].squaredNorm() - x[cell[0]].squaredNorm();
    }
    const Vec<d> centre = A.fullPivLu().solve(b);
    const double radius = (x[cell[0]] - centre).norm();
    for (const auto& p : x) EXPECT_GE((p - centre).norm(), radius * (1 - 1e-6));
  }
}

TYPED_TEST(DelaunayIn, equal_points_belong_to_no_cell_but_the_first) {
  constexpr int d = TypeParam::value;
  auto x = cloud<d>(40);
  const auto once = delaunay<d>(std::span<const Vec<d>>(x), {});
  const auto all = x;
  x.insert(x.end(), all.begin(), all.end());
  const auto twice = delaunay<d>(std::span<const Vec<d>>(x), {});
  EXPECT_EQ(once.cells.size(), twice.cells.size());
  std::set<int> used;
  for (const auto& c : twice.cells)
    for (int n : c) {
      EXPECT_FALSE(used.contains((n + 40) % 80)) << "both copies are used";
      used.insert(n);
    }
  EXPECT_EQ(used.size(), 40u);
}

TYPED_TEST(DelaunayIn, too_few_or_flat_points_make_no_cells) {
  constexpr int d = TypeParam::value;
  std::vector<Vec<d>> x;
  EXPECT_TRUE(delaunay<d>(std::span<const Vec<d>>(x), {}).cells.empty());
  for (int i = 0; i < 20; ++i) {
    x.push_back(Vec<d>::Unit(0) * i);
    EXPECT_TRUE(delaunay<d>(std::span<const Vec<d>>(x), {}).cells.empty());
  }
}

TYPED_TEST(DelaunayIn, spatial_order_is_a_permutation_of_short_hops) {
  constexpr int d = TypeParam::value;
  const auto x = cloud<d>(4096);
  const auto order = spatial_order<d>(std::span<const Vec<d>>(x));
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), x.size());
  double hops = 0, unsorted = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    hops += (x[order[i]] - x[order[i - 1]]).norm();
    unsorted += (x[i] - x[i - 1]).norm();
  }
  EXPECT_LT(hops, 0.2 * unsorted);
}

// A thin wedge of liquid, its lower side coarse and its upper one fine: the nodes above stand inside the
// circles around the coarse facets.
TEST(Delaunay2, keeps_the_facets_of_a_thin_wedge) {
  std::vector<Vec<2>> x;
  for (int i = 0; i <= 8; ++i) x.push_back({i / 8.0, 0});
  for (int i = 79; i > 0; --i) x.push_back({i / 80.0 + 1e-4, 0.02 * i / 80.0});
  std::vector<Facet<2>> ring;
  const int n = static_cast<int>(x.size());
  for (int i = 0; i < n; ++i) ring.push_back({{i, (i + 1) % n}, -1});
  // Somewhere below, so that the facets are no hull.
  for (int i = 0; i <= 10; ++i) x.push_back({i / 10.0, -1});
  const auto missing = [&](const std::vector<Facet<2>>& kept) {
    const auto edges = edges_of(delaunay<2>(x, kept));
    return std::count_if(ring.begin(), ring.end(),
                         [&](const Facet<2>& f) { return !edges.contains(std::minmax(f.nodes[0], f.nodes[1])); });
  };
  EXPECT_GT(missing({}), 0) << "the wedge is no test";
  EXPECT_EQ(missing(ring), 0);
}

TEST(Delaunay2, keeping_facets_covers_the_same_hull) {
  const auto x = cloud<2>(200, 5);
  std::vector<Facet<2>> far_apart;  // none of them crosses another
  for (int i = 0; i + 1 < 200; i += 40) far_apart.push_back({{i, i}, -1});
  far_apart.push_back({{0, 199}, -1});
  const auto hull = [&](const Delaunay<2>& t) {
    double area = 0;
    for (const auto& c : t.cells) area += volume<2>(corners(x, c));
    return area;
  };
  EXPECT_NEAR(hull(delaunay<2>(x, far_apart)), hull(delaunay<2>(x, {})), 1000 * eps);
  EXPECT_TRUE(edges_of(delaunay<2>(x, far_apart)).contains({0, 199}));
}

TEST(Delaunay2, facets_that_cross_are_left_out) {
  const std::vector<Vec<2>> x{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto t = delaunay<2>(x, {{{0, 2}, -1}, {{1, 3}, -1}});
  EXPECT_EQ(t.cells.size(), 2u);
  EXPECT_TRUE(edges_of(t).contains({0, 2})) << "the first one is kept";
}

// Enough points to be inserted by several threads.
TEST(DelaunayInSpace, is_the_same_on_any_number_of_threads) {
  auto lattice = [] {
    std::vector<Vec<3>> x;
    for (int i = 0; i < 25 * 25 * 25; ++i) x.emplace_back(i % 25, i / 25 % 25, i / 625);
    return x;
  };
  auto doubled = lattice();
  doubled.push_back(doubled[1000]);
  for (const auto& x : {cloud<3>(20000), lattice(), doubled}) {
    use_threads(1);
    const auto one = delaunay<3>(std::span<const Vec<3>>(x), {});
    use_threads(2);
    const auto two = delaunay<3>(std::span<const Vec<3>>(x), {});
    use_threads(0);
    EXPECT_EQ(one.cells, two.cells);
    EXPECT_EQ(one.neighbours, two.neighbours);
  }
}

// ---- nodes that move

template <int d>
struct Moving {
  std::vector<Vec<d>> x;
  std::vector<Facet<d>> facets{};
  std::vector<int> before = std::vector<int>(x.size(), -1);
  MovingDelaunay<d> triangulation{};

  // Has the bits of a triangulation from nothing.
  void expect_followed(const char* what) {
    const auto followed = triangulation.follow(x, before, facets);
    const auto anew = delaunay<d>(std::span<const Vec<d>>(x), facets);
    EXPECT_TRUE(followed.cells == anew.cells) << what;
    EXPECT_TRUE(followed.neighbours == anew.neighbours) << what;
    before.resize(x.size());
    std::iota(before.begin(), before.end(), 0);
  }
  void jiggle(std::mt19937& random, double by) {
    for (auto& p : x) p += by * scenes::random_vector<Vec<d>>(random, {});
  }
  void come_and_go(std::mt19937& random) {
    for (int k = 0; k < 8; ++k) {
      const auto gone = static_cast<std::ptrdiff_t>(random() % x.size());
      x.erase(x.begin() + gone), before.erase(before.begin() + gone);
      const std::size_t at = random() % x.size();
      // In the cloud, beyond its hull, or half way between two of its points.
      const Vec<d> p = k < 4    ? scenes::random_vector<Vec<d>>(random, {})
                       : k == 4 ? Vec<d>(0.99 * Vec<d>::Unit(static_cast<int>(random() % d)))
                                : Vec<d>(0.5 * (x[at] + x[(at + 1) % x.size()]));
      x.insert(x.begin() + static_cast<std::ptrdiff_t>(at), p);
      before.insert(before.begin() + static_cast<std::ptrdiff_t>(at), -1);
    }
  }
};

// A triangulation starts anew where the power of two changes that coordinates stay below.
template <class Points>
Points within(double extent, Points x) {
  for (auto& p : x) p *= extent;
  return x;
}

template <class Dimension>
struct MovingDelaunayIn : testing::Test {};
TYPED_TEST_SUITE(MovingDelaunayIn, Dimensions);

TYPED_TEST(MovingDelaunayIn, follows_points_that_move) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(3);
  for (const double by : {0.0, 1e-9, 1e-5, 3e-4, 1e-3}) {  // a cell: 0.03, in space 0.1
    Moving<d> m{within(0.9, cloud<d>(3000))};
    m.expect_followed("at first");
    for (int step = 0; step < 5; ++step) {
      m.jiggle(random, by);
      m.expect_followed("moved");
    }
    EXPECT_EQ(m.triangulation.followed(), 5) << by;
  }
}

TYPED_TEST(MovingDelaunayIn, starts_anew_where_much_has_changed) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(3);
  Moving<d> m{cloud<d>(1000)};
  m.expect_followed("at first");
  m.jiggle(random, 0.1);
  m.expect_followed("moved far");
  m.x = cloud<d>(500, 9);
  m.before.assign(500, -1);
  m.expect_followed("others");
  m.before.assign(500, 7);
  m.expect_followed("numbers that make no sense");
  m.x.resize(d), m.before.resize(d);
  m.expect_followed("no cells");
  EXPECT_EQ(m.triangulation.followed(), 0);
}

template <int d>
Vec<d> on_lattice(int i) {
  constexpr int side = d == 2 ? 55 : 15;
  Vec<d> p;
  for (int k = 0; k < d; ++k, i /= side) p[k] = i % side / static_cast<double>(side);
  return p;
}

// Walls: the hull is made of planes, and nodes slide on them.
TYPED_TEST(MovingDelaunayIn, follows_points_on_planes_and_lattices) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(4);
  for (const bool lattice : {false, true}) {
    Moving<d> m;
    for (int i = 0; i < 3000; ++i) {
      Vec<d> p = lattice ? on_lattice<d>(i) : scenes::random_vector<Vec<d>>(random, {});
      if (!lattice && i < 1000) p[i % d] = i / d % 2 == 0 ? -1 : 1;
      m.x.push_back(p);
    }
    m.before.assign(m.x.size(), -1);
    m.expect_followed("at first");
    std::vector<Vec<d>> fixed = m.x;
    for (int step = 0; step < 8; ++step) {
      m.jiggle(random, lattice ? 1e-3 : 3e-4);
      for (std::size_t i = 0; i < m.x.size(); ++i)
        for (int k = 0; k < d; ++k)
          if (lattice ? step % 2 == 0 && fixed[i][k] < 0.5 : std::abs(fixed[i][k]) == 1) m.x[i][k] = fixed[i][k];
      m.expect_followed("slid");
    }
    // Of a lattice nothing is left once it moves: its nodes have been in special position.
    if (!lattice) {
      EXPECT_EQ(m.triangulation.followed(), 8);
    }
  }
}

TYPED_TEST(MovingDelaunayIn, follows_points_that_come_and_go) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(5);
  Moving<d> m{within(0.9, cloud<d>(3000))};
  m.expect_followed("at first");
  for (int step = 0; step < 10; ++step) {
    m.jiggle(random, 1e-4);
    m.come_and_go(random);
    if (step == 5) std::swap(m.x[7], m.x[2900]), std::swap(m.before[7], m.before[2900]);  // other numbers
    m.expect_followed("came and went");
  }
  EXPECT_EQ(m.triangulation.followed(), 10);
}

TYPED_TEST(MovingDelaunayIn, knows_points_that_meet) {
  constexpr int d = TypeParam::value;
  Moving<d> m{cloud<d>(500)};
  m.expect_followed("at first");
  m.x[3] = m.x[400];
  m.expect_followed("one upon another");
  m.x[3] = Vec<d>::Zero();
  m.expect_followed("apart again");
  m.x.push_back(m.x[9]), m.before.push_back(-1);
  m.expect_followed("a new one upon another");
}

// A sheet that waves through a plane: beyond it all cells of the hull change.
TYPED_TEST(MovingDelaunayIn, follows_a_surface_that_waves) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(6);
  const auto rest = cloud<d>(2000);
  for (const double height : {1e-6, 1e-3, 0.03}) {
    Moving<d> m{rest};
    for (int step = 0; step < 10; ++step) {
      for (std::size_t i = 0; i < 1000; ++i)
        m.x[i][d - 1] = 1 + height * std::sin(3 * m.x[i].x() + (d == 3 ? 2 * m.x[i][1] : 0.0) + 0.05 * step);
      m.expect_followed("waved");
    }
  }
}

// A thin body in waves: its facets are kept however nodes stand around them.
TEST(MovingDelaunay2, keeps_facets_of_a_moving_plate) {
  std::mt19937 random(8);
  constexpr int along = 40;
  Moving<2> m{within(0.9, cloud<2>(2000))};
  for (int i = 0; i < along; ++i) m.facets.push_back({{i, (i + 1) % along}, -1});
  for (int step = 0; step < 12; ++step) {
    for (int i = 0; i < along; ++i) {
      const double angle = 2 * std::numbers::pi * i / along;
      m.x[i] = {0.5 * std::cos(angle) + 0.002 * step, 1e-3 * std::sin(angle) + 1e-4 * step};
    }
    m.expect_followed("kept");
    const auto edges = edges_of(m.triangulation.follow(m.x, m.before, m.facets));
    for (const auto& f : m.facets) EXPECT_TRUE(edges.contains(std::minmax(f.nodes[0], f.nodes[1])));
    for (std::size_t i = along; i < m.x.size(); ++i) m.x[i] += 1e-3 * scenes::random_vector<Vec<2>>(random, {});
  }
  EXPECT_EQ(m.triangulation.followed(), 23);
}

// Constrained Delaunay (Lee and Lin 1986): beyond an edge that is not kept no node lies in the circle around a cell.
TEST(Delaunay2, cells_beside_kept_facets_are_delaunay_as_far_as_those_allow) {
  const auto x = cloud<2>(400, 11);
  std::vector<Facet<2>> kept;
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i)
    kept.push_back({{static_cast<int>(random() % 400), static_cast<int>(random() % 400)}, -1});
  const auto t = delaunay<2>(std::span<const Vec<2>>(x), kept);
  std::set<std::pair<int, int>> facets;
  for (const auto& f : kept) facets.insert(std::minmax(f.nodes[0], f.nodes[1]));
  double area = 0, plain = 0;
  for (const auto& c : t.cells) area += volume<2>(corners(x, c));
  for (const auto& c : delaunay<2>(std::span<const Vec<2>>(x), {}).cells) plain += volume<2>(corners(x, c));
  EXPECT_NEAR(area, plain, 1000 * eps);
  int found = 0;
  for (std::size_t i = 0; i < t.cells.size(); ++i) {
    const auto& c = t.cells[i];
    EXPECT_GT(volume<2>(corners(x, c)), 0);
    for (int k = 0; k < 3; ++k) {
      const int n = t.neighbours[i][k], a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      if (facets.contains(std::minmax(a, b))) ++found;
      if (n < 0 || facets.contains(std::minmax(a, b))) continue;
      const auto& back = t.neighbours[n];
      const int p = t.cells[n][std::find(back.begin(), back.end(), static_cast<int>(i)) - back.begin()];
      Eigen::Matrix3d in_circle;
      for (int j = 0; j < 3; ++j) {
        const Vec<2> r = x[c[j]] - x[p];
        in_circle.row(j) << r.x(), r.y(), r.squaredNorm();
      }
      EXPECT_LE(in_circle.determinant(), eps);
    }
  }
  EXPECT_GT(found, 20) << "sides of facets: most cross an earlier one, ten at least do not";
}

}  // namespace
}  // namespace splashdown::fluid::delaunay_test
