#include "apps/record/frames/vtu_grid.hpp"

#include <algorithm>

#include "apps/record/frames/vtu.hpp"

namespace splashdown::apps {

namespace {

/// Of the array of this name; empty without it.
std::vector<double> numbers(const std::vector<VtuArray>& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays, name, &VtuArray::name);
  if (found == arrays.end()) return {};
  return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                    found->values);
}

}  // namespace

Grid grid_of(const VtuGrid& data, const std::string& scalar) {
  Grid grid;
  if (const auto time = numbers(data.field_data, "TimeValue"); !time.empty()) grid.time = time.front();
  if (const auto forward = numbers(data.field_data, "forward"); forward.size() == 3)
    std::ranges::copy(forward, grid.forward.begin());
  for (std::size_t i = 0; i < data.points.size(); i += 3)
    grid.points.push_back({data.points[i], data.points[i + 1], data.points[i + 2]});
  grid.values = numbers(data.point_data, scalar);
  grid.values.resize(grid.points.size());
  int begin = 0;
  for (const int end : data.offsets) {
    grid.cells.emplace_back(data.connectivity.begin() + begin, data.connectivity.begin() + end);
    begin = end;
  }
  return grid;
}

Grid read_grid(const std::filesystem::path& path, const std::string& scalar) { return grid_of(read_vtu(path), scalar); }

}  // namespace splashdown::apps
