// Hulls as the report draws them.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "apps/report/inputs/hull_views.hpp"
#include "box_of_water.hpp"

namespace splashdown::apps::inputs_test {
namespace {

DrawnHull box_hull(double length, double breadth, double height) {
  const auto box = unit_box<3>();
  DrawnHull hull;
  for (Eigen::Index v = 0; v < 8; ++v)
    hull.points.push_back({length * box.vertices(0, v), breadth * box.vertices(1, v), height * box.vertices(2, v)});
  for (Eigen::Index f = 0; f < 12; ++f) hull.cells.push_back({box.facets(0, f), box.facets(1, f), box.facets(2, f)});
  return hull;
}

/// Twice the area inside of the loops of the first path of a picture, and how many corners they have.
struct Loop {
  double area = 0;
  std::size_t corners = 0;
};
Loop outline_of(const std::string& svg) {
  const auto begin = svg.find("<path d=\"") + 9;
  const auto path = svg.substr(begin, svg.find('"', begin) - begin);
  static const std::regex point("([-0-9.]+) ([-0-9.]+)");
  std::vector<std::array<double, 2>> points;
  for (auto it = std::sregex_iterator(path.begin(), path.end(), point); it != std::sregex_iterator(); ++it)
    points.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  Loop loop{0, points.size()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto &a = points[i], &b = points[(i + 1) % points.size()];
    loop.area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  loop.area = std::abs(loop.area);
  return loop;
}

// Edges of the facets that face the viewer, less those that two of them share: of a box its rectangle, at one scale in all views.
TEST(HullViews, of_a_box_are_its_three_rectangles_at_one_scale) {
  const auto views = views_of(box_hull(2, 1, 0.5));
  ASSERT_EQ(views.size(), 3u);
  const double metre = (340 - 32) / 2.0;  // pixels
  const double areas[] = {2 * 0.5, 1 * 0.5, 2 * 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto loop = outline_of(views[k].svg);
    EXPECT_EQ(loop.corners, 4u) << views[k].svg;
    EXPECT_NEAR(loop.area, areas[k] * metre * metre, 0.2 * metre);  // tenths of a pixel along the sides
  }
  EXPECT_NE(views[0].caption.find("length 2.00 m, height 0.500 m"), std::string::npos) << views[0].caption;
  EXPECT_EQ(views[0].svg.find("--c-blue"), std::string::npos) << "no water where none is known";
}

TEST(HullViews, have_the_water_line_where_it_is_seen_from_the_side) {
  auto hull = box_hull(2, 1, 0.5);
  hull.water_normal = {0, 0, 1};
  hull.water_offset = -0.05;
  const auto views = views_of(hull);
  EXPECT_NE(views[0].svg.find("--c-blue"), std::string::npos);
  EXPECT_NE(views[1].svg.find("--c-blue"), std::string::npos);
  EXPECT_EQ(views[2].svg.find("--c-blue"), std::string::npos) << "from above";
}

// Corners that lie at one place are one, so facets that do not share their corners have an outline, too.
TEST(HullViews, of_a_soup_of_facets_are_those_of_the_hull) {
  const auto hull = box_hull(2, 1, 0.5);
  DrawnHull soup;
  for (const auto& cell : hull.cells) {
    soup.cells.push_back({});
    for (const int corner : cell) {
      soup.cells.back().push_back(static_cast<int>(soup.points.size()));
      soup.points.push_back(hull.points[static_cast<std::size_t>(corner)]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(outline_of(views_of(soup)[k].svg).area, outline_of(views_of(hull)[k].svg).area, 1e-9);
}

TEST(HullViews, in_the_plane_are_one_outline) {
  DrawnHull hull;
  hull.plane = true;
  hull.points = {{-0.25, 0.05, 0}, {0, -0.1, 0}, {0.25, 0.05, 0}};
  hull.cells = {{0, 1}, {1, 2}, {2, 0}};
  const auto views = views_of(hull);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(outline_of(views[0].svg).corners, 3u);
  EXPECT_NE(views[0].caption.find("breadth 0.500 m, height 0.150 m"), std::string::npos) << views[0].caption;
  EXPECT_TRUE(views_of({}).empty());
}

}  // namespace
}  // namespace splashdown::apps::inputs_test
