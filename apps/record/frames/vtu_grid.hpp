// An unstructured grid from a .vtu file as plain values.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

using Point3 = std::array<double, 3>;

struct Grid {
  double time = 0;
  std::vector<Point3> points;
  std::vector<double> values;  ///< the scalar asked for, at the points; zero without it
  std::vector<std::vector<int>> cells;
  Point3 forward{1, 0, 0};  ///< of a body: where its x axis points
};

struct VtuGrid;
/// Of what a file holds.
Grid grid_of(const VtuGrid& data, const std::string& scalar = "p");
/// Throws std::runtime_error if the file cannot be read.
Grid read_grid(const std::filesystem::path& path, const std::string& scalar = "p");

}  // namespace splashdown::apps
