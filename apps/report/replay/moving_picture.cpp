#include "apps/report/replay/moving_picture.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "apps/record/frames/frames.hpp"
#include "apps/record/frames/vtu.hpp"
#include "core/parallel.hpp"

namespace splashdown::apps {
namespace {

/// Cells of so many corners, one after the other.
std::vector<int> cells_with(const VtuGrid& grid, int corners) {
  std::vector<int> cells;
  int begin = 0;
  for (const int end : grid.offsets) {
    if (end - begin == corners)
      cells.insert(cells.end(), grid.connectivity.begin() + begin, grid.connectivity.begin() + end);
    begin = end;
  }
  return cells;
}

/// The scalar at the points; zero where there is none.
std::vector<double> scalar(const VtuGrid& grid, const std::string& name) {
  std::vector<double> values;
  if (const auto found = std::ranges::find(grid.point_data, name, &VtuArray::name); found != grid.point_data.end())
    std::visit([&](const auto& array) { values.assign(array.begin(), array.end()); }, found->values);
  values.resize(grid.points.size() / 3);
  return values;
}

/// Faces of tetrahedra that belong to one alone and have a node of the free surface, the others on it too: the surface of the
/// water.
std::vector<int> water_surface_of(const std::vector<int>& tetrahedra, const std::vector<double>& kinds) {
  const auto is = [&](int node, NodeKind what) {
    return kinds[static_cast<std::size_t>(node)] == static_cast<double>(what);
  };
  using Face = std::array<int, 3>;
  std::vector<std::pair<Face, Face>> faces;  // sorted, as it stands
  constexpr int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (std::size_t c = 0; c < tetrahedra.size(); c += 4)
    for (const auto& face : corners) {
      Face nodes;
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = tetrahedra[c + static_cast<std::size_t>(face[k])];
      bool on_surface = true, any_free = false;
      for (const int node : nodes) {
        const bool is_free = is(node, NodeKind::free_surface);
        any_free = any_free || is_free;
        on_surface = on_surface && (is_free || is(node, NodeKind::contact));
      }
      if (!on_surface || !any_free) continue;
      Face sorted = nodes;
      std::ranges::sort(sorted);
      faces.emplace_back(sorted, nodes);
    }
  std::ranges::sort(faces);
  std::vector<int> triangles;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].first == faces[i].first) ++end;
    if (end == i + 1) triangles.insert(triangles.end(), faces[i].second.begin(), faces[i].second.end());
    i = end;
  }
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

struct ReadFrame {
  MovingFrame frame;
  std::vector<std::string> names;
  bool in_space = false;
  std::string trouble;
};

MovingPart part_of(const VtuGrid& grid) {
  MovingPart part;
  for (std::size_t i = 0; i < grid.points.size(); i += 3)
    part.points.push_back({grid.points[i], grid.points[i + 1], grid.points[i + 2]});
  part.pressure = scalar(grid, "p");
  part.cells = cells_with(grid, 3);
  return part;
}

ReadFrame read_frame(const std::filesystem::path& run, const ListedFrame& listed) {
  ReadFrame read;
  read.frame.time = listed.time;
  for (const auto& [name, file] : listed.pieces) {
    if (name == "tank") continue;
    const auto grid = read_vtu(run / file);
    auto part = part_of(grid);
    if (name == "fluid") {
      if (const auto tetrahedra = cells_with(grid, 4); !tetrahedra.empty()) {
        read.in_space = true;
        part.cells = water_surface_of(tetrahedra, scalar(grid, "kind"));
      }
      compact_part(part);
      read.frame.water = std::move(part);
    } else {
      if (part.cells.empty()) part.cells = cells_with(grid, 2);
      read.names.push_back(name);
      read.frame.bodies.push_back(std::move(part));
    }
  }
  return read;
}

}  // namespace

MovingPicture moving_picture(const std::filesystem::path& run, std::size_t most_frames) {
  const auto listed = listed_frames(run);
  const std::size_t count = std::min(most_frames, listed.size());
  std::vector<ReadFrame> frames(count);
  in_pieces(count, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) try {
        frames[i] = read_frame(run, listed[count > 1 ? i * (listed.size() - 1) / (count - 1) : 0]);
      } catch (const std::exception& error) {
        frames[i].trouble = error.what();
      }
  });
  MovingPicture picture;
  picture.mirror = mirror_plane(run);
  for (auto& [frame, names, in_space, trouble] : frames) {
    if (!trouble.empty()) throw std::runtime_error(trouble);
    if (in_space) picture.dimension = 3;
    if (picture.frames.empty()) picture.names = std::move(names);
    frame.bodies.resize(picture.names.size());
    picture.frames.push_back(std::move(frame));
  }
  return picture;
}

}  // namespace splashdown::apps
