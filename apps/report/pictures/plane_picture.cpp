#include "apps/report/pictures/plane_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "apps/record/frames/vtu_grid.hpp"

namespace splashdown::apps {

namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

PlanePoint flat(const Point3& x) { return {x[0], x[1]}; }

/// Edges of the triangles, and those that belong to one triangle only.
void collect_edges(PlanePicture& picture) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * picture.triangles.size());
  for (const auto& t : picture.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(int{t[k]}, int{t[(k + 1) % 3]}));
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    const Segment segment{picture.points[index(edges[i].first)], picture.points[index(edges[i].second)]};
    picture.edges.push_back(segment);
    if (j - i == 1) picture.surface.push_back(segment);
    i = j;
  }
}

void take_plane_mesh(const Grid& grid, PlanePicture& picture) {
  for (const auto& x : grid.points) picture.points.push_back(flat(x));
  picture.pressure = grid.values;
  for (const auto& cell : grid.cells) {
    if (cell.size() == 3) picture.triangles.push_back({cell[0], cell[1], cell[2]});
    if (cell.size() == 1) picture.drops.push_back(picture.points[index(cell[0])]);
  }
  collect_edges(picture);
}

/// Where the edge between two points meets y = level, as a fraction of it.
double fraction(double a, double b, double level) { return (level - a) / (b - a); }

/// Cuts cells by a plane; cells that share an edge share its point.
class Cutter {
 public:
  Cutter(const Grid& grid, double level, PlanePicture& picture) : grid_(grid), level_(level), picture_(picture) {}

  void cut(const std::vector<int>& cell) {
    // Corner points of the cut, ordered so that neighbours share a node on one side: a triangle or a quad.
    std::vector<int> below, above, corners;
    for (const int node : cell) (y(node) < level_ ? below : above).push_back(node);
    if (below.empty() || above.empty()) return;
    for (std::size_t i = 0; i < below.size(); ++i)
      for (std::size_t j = 0; j < above.size(); ++j)
        corners.push_back(point_between(below[i], above[i % 2 == 0 ? j : above.size() - 1 - j]));
    for (std::size_t k = 0; k < corners.size(); ++k)
      ++edges_[std::minmax(int{corners[k]}, int{corners[(k + 1) % corners.size()]})];
    for (std::size_t k = 2; k < corners.size(); ++k)
      picture_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
  /// The edges of all cuts; those of one cell only are the outline of the water.
  void finish() {
    for (const auto& [edge, cells] : edges_) {
      const Segment segment{picture_.points[index(edge.first)], picture_.points[index(edge.second)]};
      picture_.edges.push_back(segment);
      if (cells == 1) picture_.surface.push_back(segment);
    }
  }

 private:
  double y(int node) const { return grid_.points[index(node)][1]; }
  int point_between(int a, int b) {
    const auto [place, is_new] = points_.try_emplace({a, b}, static_cast<int>(picture_.points.size()));
    if (!is_new) return place->second;
    const double f = fraction(y(a), y(b), level_);
    const auto &from = grid_.points[index(a)], &to = grid_.points[index(b)];
    picture_.points.push_back({from[0] + f * (to[0] - from[0]), from[2] + f * (to[2] - from[2])});
    picture_.pressure.push_back(grid_.values[index(a)] + f * (grid_.values[index(b)] - grid_.values[index(a)]));
    return place->second;
  }

  const Grid& grid_;
  double level_;
  PlanePicture& picture_;
  std::map<std::pair<int, int>, int> points_, edges_;
};

double signed_volume(const Grid& grid) {
  double volume = 0;
  for (const auto& cell : grid.cells) {
    const auto& a = grid.points[index(cell[0])];
    const auto& b = grid.points[index(cell[1])];
    if (cell.size() == 2) volume += a[0] * b[1] - a[1] * b[0];
    if (cell.size() != 3) continue;
    const auto& c = grid.points[index(cell[2])];
    volume +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return volume;
}

/// An edge of a surface that the plane cuts, and where; each is shared by two facets.
struct Crossing {
  std::pair<int, int> edge;
  PlanePoint at;
};

/// Where a plane cuts a triangle's sides; none, or two.
std::vector<Crossing> crossings(const Grid& grid, const std::vector<int>& cell, double level) {
  std::vector<Crossing> found;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const std::pair<int, int> edge = std::minmax(int{cell[k]}, int{cell[(k + 1) % cell.size()]});
    const auto &a = grid.points[index(edge.first)], &b = grid.points[index(edge.second)];
    if ((a[1] < level) == (b[1] < level)) continue;
    const double f = fraction(a[1], b[1], level);
    found.push_back({edge, {a[0] + f * (b[0] - a[0]), a[2] + f * (b[2] - a[2])}});
  }
  return found;
}

/// The cut through a closed surface, one outline a loop, each segment beginning where the one before ended.
void add_cut_outlines(const Grid& grid, double level, std::vector<PlaneOutline>& outlines) {
  std::vector<std::vector<Crossing>> cuts;
  std::map<std::pair<int, int>, std::vector<std::size_t>> cuts_at;
  for (const auto& cell : grid.cells) {
    if (cell.size() != 3) continue;
    auto ends = crossings(grid, cell, level);
    if (ends.size() != 2) continue;
    for (const auto& end : ends) cuts_at[end.edge].push_back(cuts.size());
    cuts.push_back(std::move(ends));
  }
  const bool encloses_solid = signed_volume(grid) > 0;
  std::vector<char> used(cuts.size(), 0);
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (used[first]) continue;
    PlaneOutline outline;
    outline.encloses_solid = encloses_solid;
    Crossing from = cuts[first][0];
    for (std::size_t at = first; !used[at];) {
      used[at] = 1;
      const Crossing to = cuts[at][0].edge == from.edge ? cuts[at][1] : cuts[at][0];
      outline.segments.push_back({from.at, to.at});
      for (const std::size_t next : cuts_at[to.edge])
        if (!used[next]) at = next;
      from = to;
    }
    outlines.push_back(std::move(outline));
  }
}

void add_outlines(const Grid& grid, double level, std::vector<PlaneOutline>& outlines) {
  if (!grid.cells.empty() && grid.cells.front().size() == 3) return add_cut_outlines(grid, level, outlines);
  PlaneOutline outline;
  outline.encloses_solid = signed_volume(grid) > 0;
  for (const auto& cell : grid.cells)
    if (cell.size() == 2)
      outline.segments.push_back({flat(grid.points[index(cell[0])]), flat(grid.points[index(cell[1])])});
  outlines.push_back(std::move(outline));
}

const Grid* first_solid(const std::vector<Grid>& walls) {
  const auto solid = std::ranges::find_if(walls, [](const Grid& wall) { return signed_volume(wall) > 0; });
  return solid == walls.end() ? nullptr : &*solid;
}

/// Turns everything about the vertical until the first body's heading lies in the x axis, to whichever side is nearer.
void turn_to_heading(Grid& fluid, std::vector<Grid>& walls) {
  const Grid* solid = first_solid(walls);
  if (!solid) return;
  const double length = std::hypot(solid->forward[0], solid->forward[1]);
  if (length < 0.1) return;  // it stands on its nose: any plane is as good
  const double sign = solid->forward[0] < 0 ? -1 : 1;
  const double cosine = sign * solid->forward[0] / length, sine = sign * solid->forward[1] / length;
  if (sine == 0) return;
  const auto turn = [&](Grid& grid) {
    for (auto& x : grid.points) x = {cosine * x[0] + sine * x[1], cosine * x[1] - sine * x[0], x[2]};
  };
  turn(fluid);
  for (auto& wall : walls) turn(wall);
}

/// Lowest and highest y.
std::array<double, 2> span_across(const std::vector<Point3>& points) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& x : points) low = std::min(low, x[1]), high = std::max(high, x[1]);
  return {low, high};
}

/// The plane through the middle of the first body, or of the water. Where that is a side of the water, as in half of a scene, it goes
/// through the cells beside it.
double cut_level(const Grid& fluid, const std::vector<Grid>& walls) {
  const Grid* solid = first_solid(walls);
  const auto [low, high] = span_across(solid ? solid->points : fluid.points);
  const double middle = 0.5 * (low + high), little = 1e-3 * (high - low);
  const auto [side, other] = span_across(fluid.points);
  if (std::abs(middle - side) < little) return side + little;
  if (std::abs(middle - other) < little) return other - little;
  return middle;
}

bool is_spatial(const Grid& fluid, const std::vector<Grid>& walls) {
  for (const auto& cell : fluid.cells)
    if (cell.size() > 1) return cell.size() == 4;
  return !walls.empty() && !walls.front().cells.empty() && walls.front().cells.front().size() == 3;
}

}  // namespace

PlanePicture read_picture(const std::filesystem::path& folder, const std::string& stem) {
  Grid fluid;
  if (std::filesystem::exists(folder / (stem + ".vtu"))) fluid = read_grid(folder / (stem + ".vtu"));
  std::vector<std::filesystem::path> pieces;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".vtu" && entry.path().filename().string().starts_with(stem + "_"))
      pieces.push_back(entry.path());
  std::ranges::sort(pieces);
  std::vector<Grid> walls;
  for (const auto& piece : pieces) walls.push_back(read_grid(piece));

  PlanePicture picture;
  picture.time = fluid.points.empty() && !walls.empty() ? walls.front().time : fluid.time;
  picture.nodes = fluid.points.size();
  for (const auto& cell : fluid.cells) picture.cells += cell.size() > 1 ? 1 : 0;
  const bool spatial = is_spatial(fluid, walls);
  if (spatial) turn_to_heading(fluid, walls);
  const double level = cut_level(fluid, walls);
  if (spatial) {
    Cutter cutter(fluid, level, picture);
    for (const auto& cell : fluid.cells)
      if (cell.size() == 4) cutter.cut(cell);
    cutter.finish();
  } else {
    take_plane_mesh(fluid, picture);
  }
  for (const auto& wall : walls) add_outlines(wall, level, picture.outlines);
  return picture;
}

Raster rasterise(const PlanePicture& picture, PlanePoint low, PlanePoint high, int width, int height) {
  Raster raster{width, height, low, high,
                std::vector<float>(index(width) * index(height), std::numeric_limits<float>::quiet_NaN())};
  const double dx = (high[0] - low[0]) / width, dy = (high[1] - low[1]) / height;
  for (const auto& t : picture.triangles) {
    const auto &a = picture.points[index(t[0])], &b = picture.points[index(t[1])], &c = picture.points[index(t[2])];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (!(std::abs(area) > 0)) continue;
    const auto column = [&](double x) { return (x - low[0]) / dx - 0.5; };
    const auto row = [&](double y) { return (y - low[1]) / dy - 0.5; };
    // Clamped before the conversion: corners far outside the view do not fit into an int.
    const auto clamped = [](double v, int limit) { return static_cast<int>(std::clamp(v, -1.0, limit + 0.0)); };
    const int x0 = std::max(0, clamped(std::ceil(column(std::min({a[0], b[0], c[0]}))), width));
    const int x1 = std::min(width - 1, clamped(std::floor(column(std::max({a[0], b[0], c[0]}))), width));
    const int y0 = std::max(0, clamped(std::ceil(row(std::min({a[1], b[1], c[1]}))), height));
    const int y1 = std::min(height - 1, clamped(std::floor(row(std::max({a[1], b[1], c[1]}))), height));
    const double p = picture.pressure[index(t[0])];
    const double pb = picture.pressure[index(t[1])] - p, pc = picture.pressure[index(t[2])] - p;
    const double across_b = dx * (c[1] - a[1]) / area, across_c = -dx * (b[1] - a[1]) / area;
    const double left = low[0] + (x0 + 0.5) * dx - a[0];
    for (int j = y0; j <= y1; ++j) {
      const double y = low[1] + (j + 0.5) * dy - a[1];
      const double wb0 = (left * (c[1] - a[1]) - (c[0] - a[0]) * y) / area;
      const double wc0 = ((b[0] - a[0]) * y - left * (b[1] - a[1])) / area;
      float* const row_values = &raster.values[index(j) * index(width)];
      for (int i = x0; i <= x1; ++i) {
        const double wb = wb0 + (i - x0) * across_b, wc = wc0 + (i - x0) * across_c;
        if (wb < -1e-9 || wc < -1e-9 || wb + wc > 1 + 1e-9) continue;
        row_values[i] = static_cast<float>(p + wb * pb + wc * pc);
      }
    }
  }
  return raster;
}

}  // namespace splashdown::apps
