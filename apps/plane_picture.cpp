#include "apps/plane_picture.hpp"

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace splashdown::apps {

namespace {

using Point3 = std::array<double, 3>;

struct Grid {
  double time = 0;
  std::vector<Point3> points;
  std::vector<double> pressure;
  std::vector<std::vector<int>> cells;
};

Grid read_grid(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(path.c_str()))
    throw std::runtime_error(path.string() + ": is not a readable .vtu file");
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* data = reader->GetOutput();
  Grid grid;
  if (auto* time = data->GetFieldData()->GetArray("TimeValue")) grid.time = time->GetTuple1(0);
  auto* pressure = data->GetPointData()->GetArray("p");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Point3 x;
    data->GetPoint(i, x.data());
    grid.points.push_back(x);
    grid.pressure.push_back(pressure ? pressure->GetTuple1(i) : 0);
  }
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data->GetCellPoints(c, count, ids);
    grid.cells.emplace_back(ids, ids + count);
  }
  return grid;
}

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
  picture.pressure = grid.pressure;
  for (const auto& cell : grid.cells) {
    if (cell.size() == 3) picture.triangles.push_back({cell[0], cell[1], cell[2]});
    if (cell.size() == 1) picture.drops.push_back(picture.points[index(cell[0])]);
  }
  collect_edges(picture);
}

/// Where the edge between two points meets y = level, as a fraction of it.
double fraction(double a, double b, double level) { return (level - a) / (b - a); }

void cut_cell(const Grid& grid, const std::vector<int>& cell, double level, PlanePicture& picture) {
  const auto y = [&](int node) { return grid.points[index(node)][1]; };
  // Corner points of the cut, ordered so that neighbours share a node on one side: a triangle or a quad.
  std::vector<int> below, above;
  for (const int node : cell) (y(node) < level ? below : above).push_back(node);
  if (below.empty() || above.empty()) return;
  std::vector<std::pair<int, int>> crossed;
  for (std::size_t i = 0; i < below.size(); ++i)
    for (std::size_t j = 0; j < above.size(); ++j)
      crossed.emplace_back(below[i], above[i % 2 == 0 ? j : above.size() - 1 - j]);
  const int first = static_cast<int>(picture.points.size());
  for (const auto& [a, b] : crossed) {
    const double f = fraction(y(a), y(b), level);
    const auto &from = grid.points[index(a)], &to = grid.points[index(b)];
    picture.points.push_back({from[0] + f * (to[0] - from[0]), from[2] + f * (to[2] - from[2])});
    picture.pressure.push_back(grid.pressure[index(a)] +
                               f * (grid.pressure[index(b)] - grid.pressure[index(a)]));
  }
  const int count = static_cast<int>(crossed.size());
  for (int k = 0; k < count; ++k)
    picture.edges.push_back(
        {picture.points[index(first + k)], picture.points[index(first + (k + 1) % count)]});
  for (int k = 2; k < count; ++k) picture.triangles.push_back({first, first + k - 1, first + k});
}

double signed_volume(const Grid& grid) {
  double volume = 0;
  for (const auto& cell : grid.cells) {
    const auto& a = grid.points[index(cell[0])];
    const auto& b = grid.points[index(cell[1])];
    if (cell.size() == 2) volume += a[0] * b[1] - a[1] * b[0];
    if (cell.size() != 3) continue;
    const auto& c = grid.points[index(cell[2])];
    volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
              a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return volume;
}

PlaneOutline outline_of(const Grid& grid, double level) {
  PlaneOutline outline;
  outline.encloses_solid = signed_volume(grid) > 0;
  for (const auto& cell : grid.cells) {
    if (cell.size() == 2) {
      outline.segments.push_back({flat(grid.points[index(cell[0])]), flat(grid.points[index(cell[1])])});
      continue;
    }
    std::vector<PlanePoint> ends;
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const auto &a = grid.points[index(cell[k])], &b = grid.points[index(cell[(k + 1) % cell.size()])];
      if ((a[1] < level) == (b[1] < level)) continue;
      const double f = fraction(a[1], b[1], level);
      ends.push_back({a[0] + f * (b[0] - a[0]), a[2] + f * (b[2] - a[2])});
    }
    if (ends.size() == 2) outline.segments.push_back({ends[0], ends[1]});
  }
  return outline;
}

/// The plane through the middle of the first body, or of the water.
double cut_level(const Grid& fluid, const std::vector<Grid>& walls) {
  const auto solid = std::ranges::find_if(walls, [](const Grid& wall) { return signed_volume(wall) > 0; });
  const auto& points = solid != walls.end() ? solid->points : fluid.points;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& x : points) low = std::min(low, x[1]), high = std::max(high, x[1]);
  return 0.5 * (low + high);
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
  const double level = cut_level(fluid, walls);
  if (is_spatial(fluid, walls)) {
    for (const auto& cell : fluid.cells)
      if (cell.size() == 4) cut_cell(fluid, cell, level, picture);
  } else {
    take_plane_mesh(fluid, picture);
  }
  for (const auto& wall : walls) picture.outlines.push_back(outline_of(wall, level));
  return picture;
}

Raster rasterise(const PlanePicture& picture, PlanePoint low, PlanePoint high, int width, int height) {
  Raster raster{width, height, low, high,
                std::vector<float>(index(width) * index(height), std::numeric_limits<float>::quiet_NaN())};
  const double dx = (high[0] - low[0]) / width, dy = (high[1] - low[1]) / height;
  for (const auto& t : picture.triangles) {
    const auto &a = picture.points[index(t[0])], &b = picture.points[index(t[1])],
               &c = picture.points[index(t[2])];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (!(std::abs(area) > 0)) continue;
    const auto column = [&](double x) { return (x - low[0]) / dx - 0.5; };
    const auto row = [&](double y) { return (y - low[1]) / dy - 0.5; };
    // Clamped before the conversion: corners far outside the view do not fit into an int.
    const auto clamped = [](double v, int limit) {
      return static_cast<int>(std::clamp(v, -1.0, limit + 0.0));
    };
    const int x0 = std::max(0, clamped(std::ceil(column(std::min({a[0], b[0], c[0]}))), width));
    const int x1 = std::min(width - 1, clamped(std::floor(column(std::max({a[0], b[0], c[0]}))), width));
    const int y0 = std::max(0, clamped(std::ceil(row(std::min({a[1], b[1], c[1]}))), height));
    const int y1 = std::min(height - 1, clamped(std::floor(row(std::max({a[1], b[1], c[1]}))), height));
    for (int j = y0; j <= y1; ++j) {
      const double y = low[1] + (j + 0.5) * dy;
      for (int i = x0; i <= x1; ++i) {
        const double x = low[0] + (i + 0.5) * dx;
        const double wb = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
        const double wc = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        if (wb < -1e-9 || wc < -1e-9 || wb + wc > 1 + 1e-9) continue;
        raster.values[index(j) * index(width) + index(i)] =
            static_cast<float>((1 - wb - wc) * picture.pressure[index(t[0])] +
                               wb * picture.pressure[index(t[1])] + wc * picture.pressure[index(t[2])]);
      }
    }
  }
  return raster;
}

}  // namespace splashdown::apps
