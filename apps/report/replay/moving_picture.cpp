#include "apps/report/replay/moving_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/record/frames/frames.hpp"
#include "apps/record/frames/vtu.hpp"
#include "apps/record/frames/vtu_grid.hpp"

namespace splashdown::apps {
namespace {

/// Cells of so many corners, one after the other.
std::vector<int> cells_with(const Grid& grid, std::size_t corners) {
  std::vector<int> cells;
  for (const auto& cell : grid.cells)
    if (cell.size() == corners) cells.insert(cells.end(), cell.begin(), cell.end());
  return cells;
}

/// Faces of tetrahedra that belong to one alone and have a node of the free surface, the others on it too: the surface of the water.
std::vector<int> water_surface_of(const std::vector<int>& tetrahedra, const std::vector<double>& kinds) {
  const auto is = [&](int node, NodeKind what) {
    return kinds[static_cast<std::size_t>(node)] == static_cast<double>(what);
  };
  const auto is_free = [&](int node) { return is(node, NodeKind::free_surface); };
  std::map<std::array<int, 3>, std::array<int, 3>> once;  // sorted -> as it stands
  constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (std::size_t c = 0; c < tetrahedra.size(); c += 4)
    for (const auto& face : faces) {
      std::array<int, 3> nodes;
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = tetrahedra[c + static_cast<std::size_t>(face[k])];
      if (!std::ranges::any_of(nodes, is_free)) continue;
      if (!std::ranges::all_of(nodes, [&](int n) { return is_free(n) || is(n, NodeKind::contact); })) continue;
      auto sorted = nodes;
      std::ranges::sort(sorted);
      if (const auto [known, fresh] = once.emplace(sorted, nodes); !fresh) once.erase(known);
    }
  std::vector<int> triangles;
  for (const auto& [sorted, nodes] : once) triangles.insert(triangles.end(), nodes.begin(), nodes.end());
  return triangles;
}

/// Without points that no cell names.
void compact_part(MovingPart& part) {
  std::vector<int> number(part.points.size(), -1);
  MovingPart kept;
  for (int& node : part.cells) {
    int& at = number[static_cast<std::size_t>(node)];
    if (at < 0) {
      at = static_cast<int>(kept.points.size());
      kept.points.push_back(part.points[static_cast<std::size_t>(node)]);
      kept.pressure.push_back(part.pressure[static_cast<std::size_t>(node)]);
    }
    node = at;
  }
  kept.cells = std::move(part.cells);
  part = std::move(kept);
}

/// The value that a share of these pressures, those above zero, is below [Pa]; 0: there are none.
double quantile(std::vector<double> pressures, double share) {
  std::erase_if(pressures, [](double p) { return !(p > 0); });
  if (pressures.empty()) return 0;
  const auto nth = pressures.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(pressures.size() - 1));
  std::ranges::nth_element(pressures, nth);
  return *nth;
}

/// Where the colours end: few points at hulls are above it, and not most of the water.
double colour_limit(const MovingPicture& picture) {
  constexpr double of_hulls = 0.995, of_water = 0.9;
  std::vector<double> at_hulls, in_water;
  for (const auto& frame : picture.frames) {
    in_water.insert(in_water.end(), frame.water.pressure.begin(), frame.water.pressure.end());
    for (const auto& body : frame.bodies) at_hulls.insert(at_hulls.end(), body.pressure.begin(), body.pressure.end());
  }
  const double hulls = quantile(std::move(at_hulls), of_hulls);
  return picture.dimension == 3 && hulls > 0 ? hulls : std::max(hulls, quantile(std::move(in_water), of_water));
}

/// Differences from number to number, all first bytes, then all second ones and so on: neighbours differ little, and zlib finds that.
template <class Number>
void append_differences(std::string& bytes, const std::vector<Number>& numbers) {
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    Number before = 0;
    for (const Number number : numbers) {
      bytes.push_back(static_cast<char>((static_cast<Number>(number - before) >> (8 * byte)) & 0xff));
      before = number;
    }
  }
}

class Packer {
 public:
  Packer(std::array<double, 3> low, std::array<double, 3> high, double limit) : low_(low), limit_(limit) {
    for (std::size_t k = 0; k < 3; ++k)
      step_[k] = std::max(high[k] - low[k], 1e-300) / std::numeric_limits<std::uint16_t>::max();
  }
  nlohmann::json add(const MovingPart& part, bool with_cells) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<std::uint16_t> places;
      for (const auto& x : part.points)
        places.push_back(static_cast<std::uint16_t>(std::lround((x[k] - low_[k]) / step_[k])));
      append_differences(bytes, places);
    }
    std::vector<std::uint8_t> pressures(part.points.size(), 0);
    for (std::size_t i = 0; i < part.pressure.size() && limit_ > 0; ++i)
      pressures[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(part.pressure[i] / limit_, 0., 1.)));
    append_differences(bytes, pressures);
    if (with_cells) append_differences(bytes, std::vector<std::uint32_t>(part.cells.begin(), part.cells.end()));
    return {{"points", part.points.size()}, {"cells", with_cells ? part.cells.size() : 0}};
  }
  std::string bytes;

 private:
  std::array<double, 3> low_, step_;
  double limit_;
};

}  // namespace

MovingPicture moving_picture(const std::filesystem::path& run, std::size_t most_frames) {
  MovingPicture picture;
  const auto listed = listed_frames(run);
  const std::size_t count = std::min(most_frames, listed.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& from = listed[count > 1 ? i * (listed.size() - 1) / (count - 1) : 0];
    MovingFrame frame{.time = from.time, .water = {}, .bodies = {}};
    for (const auto& [part, file] : from.pieces) {
      if (part == "tank") continue;
      const auto data = read_vtu(run / file);
      auto grid = grid_of(data);
      const auto tetrahedra = cells_with(grid, 4);
      MovingPart moving{std::move(grid.points), cells_with(grid, 3), std::move(grid.values)};
      if (part == "fluid") {
        if (!tetrahedra.empty()) {
          picture.dimension = 3;
          moving.cells = water_surface_of(tetrahedra, grid_of(data, "kind").values);
        }
        compact_part(moving);
        frame.water = std::move(moving);
      } else {
        if (moving.cells.empty()) moving.cells = cells_with(grid, 2);
        if (i == 0) picture.names.push_back(part);
        frame.bodies.push_back(std::move(moving));
      }
    }
    frame.bodies.resize(picture.names.size());
    picture.frames.push_back(std::move(frame));
  }
  return picture;
}

PackedPicture packed(const MovingPicture& picture) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{far, far, far}, high{-far, -far, -far};
  const auto look = [&](const MovingPart& part) {
    for (const auto& x : part.points)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  };
  for (const auto& frame : picture.frames) {
    look(frame.water);
    for (const auto& body : frame.bodies) look(body);
  }
  const double limit = colour_limit(picture);
  nlohmann::json json{
      {"dimension", picture.dimension}, {"names", picture.names}, {"low", low}, {"high", high}, {"pressure", limit}};
  Packer packer(low, high, limit);
  for (const auto& frame : picture.frames) {
    auto& entry = json["frames"].emplace_back(nlohmann::json{{"time", frame.time}});
    entry["water"] = packer.add(frame.water, true);
    entry["bodies"] = nlohmann::json::array();
    for (const auto& body : frame.bodies)
      entry["bodies"].push_back(packer.add(body, &frame == &picture.frames.front()));
  }
  return {json.dump(), std::move(packer.bytes), limit};
}

}  // namespace splashdown::apps
