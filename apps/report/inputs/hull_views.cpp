#include "apps/report/inputs/hull_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "apps/report/pictures/picture.hpp"
#include "apps/report/pictures/vectors.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr double picture_width = 340, rim = 16;  // pixels
constexpr double crease_deg = 30;                // as an edge where flow may separate
constexpr std::size_t most_creases = 4000;       // more are a texture, not a shape

using Edge = std::pair<int, int>;

/// Directions of a picture; right x up points at the viewer.
struct Viewpoint {
  const char* name;
  Point3 right, up;
};
constexpr Viewpoint three_sides[] = {{"From starboard", {1, 0, 0}, {0, 0, 1}},
                                     {"From ahead", {0, 1, 0}, {0, 0, 1}},
                                     {"From above", {1, 0, 0}, {0, 1, 0}}};
constexpr Viewpoint one_side = {"Outline", {1, 0, 0}, {0, 1, 0}};
constexpr const char* names_of_axes[] = {"length", "breadth", "height"};

/// Facets by numbers of places: corners of neighbours that lie at one place count as one.
struct Mesh {
  std::vector<Point3> places;
  std::vector<std::vector<int>> cells;
};

Mesh mesh_of(const DrawnHull& hull) {
  const auto extent = extent_of(hull);
  const double step = 1e-7 * std::max({extent[0], extent[1], extent[2], 1e-300});
  Mesh mesh;
  std::map<std::array<long, 3>, int> numbers;
  std::vector<int> number_of;
  for (const auto& x : hull.points) {
    const std::array key{std::lround(x[0] / step), std::lround(x[1] / step), std::lround(x[2] / step)};
    const auto [place, is_new] = numbers.try_emplace(key, static_cast<int>(mesh.places.size()));
    if (is_new) mesh.places.push_back(x);
    number_of.push_back(place->second);
  }
  for (auto cell : hull.cells) {
    for (int& corner : cell) corner = number_of[static_cast<std::size_t>(corner)];
    mesh.cells.push_back(std::move(cell));
  }
  return mesh;
}

Point3 normal_of(const Mesh& mesh, const std::vector<int>& cell) {
  const auto corner = [&](std::size_t k) { return mesh.places[static_cast<std::size_t>(cell[k])]; };
  return cross(minus(corner(1), corner(0)), minus(corner(2), corner(0)));
}

/// Edges of the facets that face the viewer which no other such facet shares; in the plane all segments.
std::set<Edge> silhouette(const Mesh& mesh, const Point3& towards) {
  std::set<Edge> edges;
  for (const auto& cell : mesh.cells) {
    if (cell.size() == 2) {
      edges.insert({cell[0], cell[1]});
    } else if (cell.size() == 3 && dot(normal_of(mesh, cell), towards) > 0) {
      for (std::size_t k = 0; k < 3; ++k)
        if (const Edge edge{cell[k], cell[(k + 1) % 3]}; edges.erase({edge.second, edge.first}) == 0)
          edges.insert(edge);
    }
  }
  return edges;
}

/// Edges on facets that the viewer sees where the hull bends sharply.
std::vector<Edge> creases(const Mesh& mesh, const Point3& towards) {
  std::map<Edge, Point3> first;  // normal of the facet on one side
  std::vector<Edge> sharp;
  const double bend = std::cos(crease_deg * std::numbers::pi / 180);
  for (const auto& cell : mesh.cells) {
    if (cell.size() != 3) continue;
    const auto normal = normal_of(mesh, cell);
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge = std::minmax(int{cell[k]}, int{cell[(k + 1) % 3]});
      const auto [other, is_first] = first.try_emplace(edge, normal);
      if (is_first) continue;
      const double lengths = std::sqrt(dot(normal, normal) * dot(other->second, other->second));
      const bool seen = dot(normal, towards) > 0 || dot(other->second, towards) > 0;
      if (seen && dot(normal, other->second) < bend * lengths) sharp.push_back(edge);
    }
  }
  return sharp.size() > most_creases ? std::vector<Edge>{} : sharp;
}

/// From metres to pixels.
struct Paper {
  const Viewpoint& view;
  Box box;
  double scale = 1;

  double x(const Point3& at) const { return rim + (dot(at, view.right) - box.low[0]) * scale; }
  double y(const Point3& at) const { return rim + (box.high[1] - dot(at, view.up)) * scale; }
  double width() const { return 2 * rim + box.width() * scale; }
  double height() const { return 2 * rim + box.height() * scale; }
};

/// Closed loops of edges, one after the other.
std::string loops_of(std::set<Edge> edges, const Mesh& mesh, const Paper& paper) {
  std::string path;
  while (!edges.empty()) {
    auto edge = *edges.begin();
    std::string last;
    for (const char* letter = "M";; letter = "L") {
      const auto& at = mesh.places[static_cast<std::size_t>(edge.first)];
      const auto point = fmt::format("{:.1f} {:.1f}", paper.x(at), paper.y(at));
      if (point != last) path += letter + point;
      last = point;
      edges.erase(edge);
      const auto next = edges.lower_bound({edge.second, INT_MIN});
      if (next == edges.end() || next->first != edge.second) break;
      edge = *next;
    }
    path += 'Z';
  }
  return path;
}

std::string lines_of(const std::vector<Edge>& edges, const Mesh& mesh, const Paper& paper) {
  std::string path;
  for (const auto& [a, b] : edges) {
    const auto &from = mesh.places[static_cast<std::size_t>(a)], &to = mesh.places[static_cast<std::size_t>(b)];
    path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", paper.x(from), paper.y(from), paper.x(to), paper.y(to));
  }
  return path;
}

/// Where the water at rest meets the plane of the picture through the middle of the hull.
std::string water_line(const DrawnHull& hull, const Paper& paper, const Point3& middle) {
  const double along = dot(hull.water_normal, paper.view.right), up = dot(hull.water_normal, paper.view.up);
  if (std::abs(up) < 0.2) return {};  // seen from above, or upright: no line across
  const auto towards = cross(paper.view.right, paper.view.up);
  const double offset = hull.water_offset - dot(hull.water_normal, towards) * dot(middle, towards);
  const auto at = [&](double x) {
    const double y = (offset - along * x) / up;
    return fmt::format("{:.1f} {:.1f}", rim + (x - paper.box.low[0]) * paper.scale,
                       rim + (paper.box.high[1] - y) * paper.scale);
  };
  const double room = rim / paper.scale;
  return fmt::format("<path d=\"M{}L{}\" stroke=\"var(--c-blue)\" stroke-width=\"1.6\"/>", at(paper.box.low[0] - room),
                     at(paper.box.high[0] + room));
}

HullView drawn(const DrawnHull& hull, const Mesh& mesh, const Paper& paper, const Point3& extent) {
  const auto towards = cross(paper.view.right, paper.view.up);
  Point3 middle{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::ranges::minmax(mesh.places, {}, [&](const Point3& x) { return x[k]; });
    middle[k] = 0.5 * (low[k] + high[k]);
  }
  const Point3 origin{0, 0, 0};
  HullView view;
  view.svg = fmt::format(
      "<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\" style=\"width:{:.0f}px\" fill=\"none\">"
      "<path d=\"{}\" fill=\"var(--c-theory)\" stroke=\"var(--c-ink)\" stroke-width=\"1.4\" stroke-linejoin=\"round\"/>"
      "<path d=\"{}\" stroke=\"var(--c-axis)\" stroke-width=\".7\"/>{}"
      "<path d=\"M{:.1f} {:.1f}h12m-6 -6v12\" stroke=\"var(--c-red)\" stroke-width=\"1.4\"/></svg>",
      paper.width(), paper.height(), paper.view.name, paper.width(), loops_of(silhouette(mesh, towards), mesh, paper),
      lines_of(creases(mesh, towards), mesh, paper), water_line(hull, paper, middle), paper.x(origin) - 6,
      paper.y(origin));
  std::string sizes;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(towards[k]) < 0.5) {
      const char* name = hull.plane && k == 1 ? "height" : hull.plane ? "breadth" : names_of_axes[k];
      sizes += fmt::format("{}{} {}", sizes.empty() ? "" : ", ", name, digits_with_unit(extent[k], "m", 3));
    }
  view.caption = fmt::format("<b>{}</b>: {}", paper.view.name, sizes);
  return view;
}

}  // namespace

Point3 extent_of(const DrawnHull& hull) {
  Point3 extent{0, 0, 0};
  if (hull.points.empty()) return extent;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::ranges::minmax(hull.points, {}, [&](const Point3& x) { return x[k]; });
    extent[k] = high[k] - low[k];
  }
  return extent;
}

std::vector<HullView> views_of(const DrawnHull& hull) {
  std::vector<HullView> views;
  if (hull.points.empty()) return views;
  const auto mesh = mesh_of(hull);
  const auto extent = extent_of(hull);
  std::vector<Paper> papers;
  double widest = 0, highest = 0;
  const auto add = [&](const Viewpoint& view) {
    Paper paper{view, {}};
    for (const auto& x : mesh.places) paper.box.add({dot(x, view.right), dot(x, view.up)});
    widest = std::max(widest, paper.box.width());
    highest = std::max(highest, paper.box.height());
    papers.push_back(paper);
  };
  if (hull.plane)
    add(one_side);
  else
    for (const auto& view : three_sides) add(view);
  const double room = picture_width - 2 * rim;
  for (auto& paper : papers) {  // one scale for all
    paper.scale = std::min(room / std::max(widest, 1e-300), room / std::max(highest, 1e-300));
    views.push_back(drawn(hull, mesh, paper, extent));
  }
  return views;
}

}  // namespace splashdown::apps
