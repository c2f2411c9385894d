// Writes frames whose numbers follow from indices, for readers that are not ours: expected_frames.py has the same formulas.
//   write_frames DIR
#include <filesystem>
#include <limits>
#include <string>

#include "apps/record/frames/frames.hpp"

namespace splashdown::apps {
namespace {

template <int d>
Vec<d> place(int i) {
  Vec<d> x;
  for (int k = 0; k < d; ++k) x(k) = ((i * (k + 1)) % 1000) / 8.0 - k;
  return x;
}

/// Simplices of nodes that follow each other; the last node is in none, a drop.
template <int d>
Frame<d> frame_of(int nodes, double time) {
  Frame<d> frame;
  frame.time = time;
  for (int i = 0; i < nodes; ++i) {
    frame.x.push_back(place<d>(i));
    frame.v.push_back(-place<d>(i));
    frame.p.push_back(1000.0 * i + 0.125);
    frame.drop_diameter.push_back(i % 3 == 0 ? i / 64.0 : 0.0);
    frame.kind.push_back(i + 1 == nodes ? NodeKind::drop : static_cast<NodeKind>(i % 5));
    frame.wall.push_back(i % 5 - 1);
  }
  for (int i = 0; i + d + 1 < nodes; ++i) {
    frame.cells.emplace_back();
    for (int k = 0; k <= d; ++k) frame.cells.back()[static_cast<std::size_t>(k)] = i + k;
  }
  Outline<d> hull{"a hull & more", {}};
  hull.surface.vertices.resize(d, d + 2);
  hull.surface.facets.resize(d, 2);
  for (int i = 0; i < d + 2; ++i) {
    hull.surface.vertices.col(i) = place<d>(i);
    hull.v.push_back(-place<d>(i));
    hull.p.push_back(i == 0 ? std::numeric_limits<double>::quiet_NaN() : 1000.0 * i + 0.125);
  }
  for (int f = 0; f < 2; ++f)
    for (int k = 0; k < d; ++k) hull.surface.facets(k, f) = f + k;
  hull.forward = Vec<d>::UnitY();
  frame.outlines = {std::move(hull)};
  return frame;
}

template <int d>
void write_all(const std::filesystem::path& directory) {
  // Blocks hold 8192 numbers of double precision: fewer than a block, one block, a block and a number, several.
  for (const int nodes : {1, 7, 8192, 8193, 30000})
    write_pieces(directory / "pieces", std::to_string(d) + "d_" + std::to_string(nodes), frame_of<d>(nodes, 0.25));
  FrameSeries series(directory / (std::to_string(d) + "d"));
  std::filesystem::create_directories(directory / (std::to_string(d) + "d"));
  for (int k = 0; k < 3; ++k) series.add(frame_of<d>(10 + k, 0.25 * k));
}

}  // namespace
}  // namespace splashdown::apps

int main(int, char** arguments) {
  splashdown::apps::write_all<2>(arguments[1]);
  splashdown::apps::write_all<3>(arguments[1]);
}
