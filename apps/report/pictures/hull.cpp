#include "apps/report/pictures/hull.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/record/frames/frames.hpp"
#include "apps/record/frames/vtu_grid.hpp"
#include "apps/report/pictures/picture.hpp"
#include "apps/report/pictures/vectors.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {

namespace {

/// (name, file) of each map.
std::vector<std::pair<std::string, std::filesystem::path>> hull_files(const std::filesystem::path& run) {
  std::vector<std::pair<std::string, std::filesystem::path>> files;
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    const auto name = entry.path().stem().string();
    if (entry.path().extension() == ".vtu" && name.starts_with("hull_"))
      files.emplace_back(name.substr(5), entry.path());
  }
  std::ranges::sort(files);
  return files;
}

bool is_surface(const Grid& hull) { return !hull.cells.empty() && hull.cells.front().size() == 3; }

/// Directions of a picture in the frame of the hull's shape; right x up points at the viewer.
struct View {
  const char* title;
  const char* name;
  Point3 right, up;
};
constexpr View views[] = {{"from below", "below", {1, 0, 0}, {0, -1, 0}},
                          {"from the starboard side", "side", {1, 0, 0}, {0, 0, 1}},
                          {"from ahead", "ahead", {0, 1, 0}, {0, 0, 1}}};

std::map<std::pair<int, int>, int> facet_edges(const Grid& hull) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& cell : hull.cells)
    for (std::size_t k = 0; cell.size() == 3 && k < 3; ++k) ++edges[std::minmax(int{cell[k]}, int{cell[(k + 1) % 3]})];
  return edges;
}

/// Where a half of a hull was cut, along a horizontal axis: all its free edges lie there; nothing: it is whole.
std::optional<std::pair<std::size_t, double>> cut_of(const Grid& hull) {
  std::vector<Point3> rim;
  for (const auto& [edge, count] : facet_edges(hull))
    if (count == 1) rim.push_back(hull.points[static_cast<std::size_t>(edge.first)]);
  if (rim.empty()) return {};
  const auto size = [&](std::size_t axis) {
    const auto [low, high] = std::ranges::minmax(hull.points, {}, [=](const Point3& x) { return x[axis]; });
    return high[axis] - low[axis];
  };
  for (const std::size_t axis : {1, 0})
    if (std::ranges::all_of(rim, [&](const Point3& x) { return std::abs(x[axis] - rim[0][axis]) < 1e-6 * size(axis); }))
      return std::pair(axis, rim[0][axis]);
  return {};
}

/// A half with its mirror image, whose pressures are the same.
Grid whole_of(Grid hull) {
  const auto cut = cut_of(hull);
  if (!cut) return hull;
  const auto [axis, at] = *cut;
  const std::size_t points = hull.points.size(), cells = hull.cells.size();
  for (std::size_t i = 0; i < points; ++i) {
    auto image = hull.points[i];
    image[axis] = 2 * at - image[axis];
    hull.points.push_back(image);
    hull.values.push_back(hull.values[i]);
  }
  for (std::size_t c = 0; c < cells; ++c) {
    auto image = hull.cells[c];
    for (auto& point : image) point += static_cast<int>(points);
    std::swap(image[1], image[2]);
    hull.cells.push_back(image);
  }
  return hull;
}

/// What the viewer sees: facets that face him, the nearest drawn last, and their silhouette.
PlanePicture seen(const Grid& hull, const View& view) {
  PlanePicture picture;
  picture.time = hull.time;
  picture.pressure = hull.values;
  for (const auto& x : hull.points) picture.points.push_back({dot(x, view.right), dot(x, view.up)});
  const Point3 towards = cross(view.right, view.up);
  std::vector<std::pair<double, std::array<int, 3>>> facets;
  std::map<std::pair<int, int>, int> edges;
  for (const auto& cell : hull.cells) {
    if (cell.size() != 3) continue;
    const auto corner = [&](std::size_t k) { return hull.points[static_cast<std::size_t>(cell[k])]; };
    if (!(dot(cross(minus(corner(1), corner(0)), minus(corner(2), corner(0))), towards) > 0)) continue;
    const double nearness = dot(corner(0), towards) + dot(corner(1), towards) + dot(corner(2), towards);
    facets.push_back({nearness, {cell[0], cell[1], cell[2]}});
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(int{cell[k]}, int{cell[(k + 1) % 3]})];
  }
  std::ranges::stable_sort(facets, {}, [](const auto& facet) { return facet.first; });
  for (const auto& [nearness, facet] : facets) picture.triangles.push_back(facet);
  for (const auto& [edge, count] : edges)
    if (count == 1)
      picture.surface.push_back({picture.points[static_cast<std::size_t>(edge.first)],
                                 picture.points[static_cast<std::size_t>(edge.second)]});
  return picture;
}

Box room_around(const PlanePicture& picture) {
  Box box;
  for (const auto& x : picture.points) box.add(x);
  const double margin = 0.06 * std::max(box.width(), box.height());
  for (std::size_t k = 0; k < 2; ++k) box.low[k] -= margin, box.high[k] += margin;
  // Between 0.3 and 0.85 as high as wide, growing the short side to both ends.
  if (const double lack = 0.3 * box.width() - box.height(); lack > 0)
    box.low[1] -= 0.5 * lack, box.high[1] += 0.5 * lack;
  if (const double lack = box.height() / 0.85 - box.width(); lack > 0)
    box.low[0] -= 0.5 * lack, box.high[0] += 0.5 * lack;
  return box;
}

}  // namespace

FigureGroup hull_curves(const std::filesystem::path& run) {
  FigureGroup group{"Highest pressure on the hulls", {}};
  for (const auto& [name, file] : hull_files(run)) {
    Grid hull;
    try {
      hull = read_grid(file, "p_max");
    } catch (const std::exception&) {  // prepare_hull_figures tells of it
      continue;
    }
    if (is_surface(hull) || hull.points.empty()) continue;
    const auto distance = read_grid(file, "s").values;
    std::vector<std::size_t> order(distance.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return distance[i]; });
    const Unit unit = si_unit(*std::ranges::max_element(hull.values), "Pa");
    Curve curve{"", {}, {}, "#0f2f4f", 1.6};
    for (const std::size_t i : order) {
      curve.x.push_back(distance[i]);
      curve.y.push_back(hull.values[i] * unit.scale);
    }
    Figure figure;
    figure.name = "hull_" + file_name_of(name);
    figure.x_label = "s / m";
    figure.y_label = "highest pressure / " + unit.unit;
    figure.curves = {std::move(curve)};
    figure.caption =
        fmt::format("The highest pressure of the run on <b>{}</b> over the distance along its outline from the keel.",
                    html_escaped(name));
    group.figures.push_back(std::move(figure));
  }
  return group;
}

FieldFigures prepare_hull_figures(const std::filesystem::path& run) {
  FieldFigures result;
  for (const auto& [name, file] : hull_files(run)) {
    try {
      Grid hull = read_grid(file, "p_max");
      if (!is_surface(hull)) continue;
      hull = whole_of(std::move(hull));
      for (const auto& view : views) {
        const PlanePicture picture = seen(hull, view);
        if (picture.triangles.empty()) continue;
        auto figure = figure_of("hull_" + file_name_of(name) + "_" + view.name, picture, room_around(picture),
                                {.label = "highest pressure"});
        figure.title = name + " " + view.title;
        figure.caption += (figure.caption.empty() ? "of all instants until t = " : ", of all instants until t = ") +
                          seconds_text(hull.time) + ".";
        result.figures.push_back(std::move(figure));
      }
    } catch (const std::exception& error) {
      result.warnings.push_back(error.what());
    }
  }
  return result;
}

}  // namespace splashdown::apps
