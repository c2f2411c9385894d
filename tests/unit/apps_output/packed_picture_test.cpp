// Triangles and frames as bytes: what comes back, how exactly, and of how many bytes.
#include "apps/report/replay/packed_picture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "apps/record/frames/vtu_blocks.hpp"
#include "apps/report/replay/mesh_code.hpp"

namespace splashdown::apps::packed_picture_test {
namespace {

std::size_t at(int number) { return static_cast<std::size_t>(number); }

/// As mesh_code.hpp says, and unpack.js does: corners in new numbers.
std::vector<int> corners_of(const MeshCode& code, std::size_t triangles) {
  std::vector<int> corners, after(code.order.size(), -1), before(code.order.size(), -1);
  std::vector<std::array<int, 3>> open;
  std::size_t step = 0, reference = 0, first = 0;
  int points = 0;
  const auto named = [&] { return points - 1 - static_cast<int>(code.references.at(reference++)); };
  const auto add_edge = [&](int p, int q, int o) {
    if (after[at(q)] == p) {
      after[at(q)] = -1;
      if (before[at(p)] == q) before[at(p)] = -1;
    } else {
      after[at(p)] = q;
      before[at(q)] = p;
      open.push_back({p, q, o});
    }
  };
  const auto add = [&](int a, int b, int c) {
    corners.insert(corners.end(), {a, b, c});
    add_edge(a, b, c), add_edge(b, c, a), add_edge(c, a, b);
  };
  while (corners.size() < 3 * triangles) {
    if (first == open.size()) {
      std::array<int, 3> patch;
      for (int& point : patch)
        point = code.steps.at(step++) == static_cast<std::uint8_t>(MeshStep::fresh) ? points++ : named();
      add(patch[0], patch[1], patch[2]);
      continue;
    }
    const auto [u, w, o] = open[first++];
    if (after[at(u)] != w) continue;
    switch (static_cast<MeshStep>(code.steps.at(step++))) {
      case MeshStep::none:
        break;
      case MeshStep::fresh:
        add(w, u, points++);
        break;
      case MeshStep::next:
        add(w, u, after[at(w)]);
        break;
      case MeshStep::last:
        add(w, u, before[at(u)]);
        break;
      case MeshStep::named:
        add(w, u, named());
    }
  }
  EXPECT_EQ(step, code.steps.size());
  EXPECT_EQ(reference, code.references.size());
  EXPECT_EQ(at(points), code.order.size());
  return corners;
}

/// Triangles without the order that they stand in, and without the corner that they begin at.
std::vector<std::array<int, 3>> set_of(const std::vector<int>& corners) {
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    const int i = corners[c], j = corners[c + 1], k = corners[c + 2];
    triangles.push_back(std::min({std::array{i, j, k}, std::array{j, k, i}, std::array{k, i, j}}));
  }
  std::ranges::sort(triangles);
  return triangles;
}

std::vector<int> grid_of_triangles(int columns, int rows) {
  std::vector<int> corners;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      corners.insert(corners.end(), {a, b, d, a, d, c});
    }
  return corners;
}

TEST(MeshCode, gives_any_soup_of_triangles_back) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    // From sheets that are torn and turned over in parts to triangles between points at random, which share edges by threes.
    const int columns = 2 + round % 9;
    auto corners = grid_of_triangles(columns, 2 + round % 7);
    const int points = columns * (2 + round % 7);
    std::uniform_int_distribution<int> any(0, points - 1), one_in_ten(0, 9);
    for (std::size_t c = 0; c < corners.size(); c += 3) {
      if (round % 3 == 1 && one_in_ten(random) == 0) std::swap(corners[c], corners[c + 1]);
      if (round % 3 == 2)
        for (std::size_t k = 0; k < 3; ++k) corners[c + k] = any(random);
    }
    const auto code = mesh_code(corners, at(points));
    auto back = corners_of(code, corners.size() / 3);
    for (int& corner : back) corner = code.order[at(corner)];
    EXPECT_EQ(set_of(back), set_of(corners)) << "round " << round;
  }
}

TEST(MeshCode, leaves_out_points_of_no_triangle) {
  EXPECT_EQ(mesh_code({5, 2, 7}, 9).order, (std::vector<int>{5, 2, 7}));
  EXPECT_TRUE(mesh_code({}, 4).order.empty());
}

/// Arrays of a packed picture by name, as numbers.
std::map<std::string, std::vector<std::uint32_t>> arrays_of(const PackedPicture& packed) {
  std::map<std::string, std::vector<std::uint32_t>> arrays;
  std::size_t byte = 0;
  const auto json = nlohmann::json::parse(packed.json);
  for (const auto& array : json["arrays"]) {
    std::vector<std::uint32_t> numbers(array["count"].get<std::size_t>(), 0);
    for (std::size_t k = 0; k < array["size"].get<std::size_t>(); ++k)
      for (auto& number : numbers)
        number |= static_cast<std::uint32_t>(static_cast<unsigned char>(packed.bytes.at(byte++))) << (8 * k);
    arrays[array["name"]] = std::move(numbers);
  }
  EXPECT_EQ(byte, packed.bytes.size());
  return arrays;
}

std::int32_t unfolded(std::uint32_t v) { return static_cast<std::int32_t>(v >> 1) ^ -static_cast<std::int32_t>(v & 1); }

/// Places of the next part, from the arrays; `from`: where it begins.
std::vector<std::array<double, 3>> places_of(const MeshCode& code, const PackedPicture& packed, std::size_t from) {
  const auto json = nlohmann::json::parse(packed.json);
  const auto arrays = arrays_of(packed);
  std::vector<std::array<std::int32_t, 3>> steps;
  std::vector<std::array<double, 3>> places;
  for (std::size_t i = 0; i < code.order.size(); ++i) {
    const auto [u, w, o] = code.expected[i];
    std::array<std::int32_t, 3> now;
    std::array<double, 3> place;
    for (std::size_t k = 0; k < 3; ++k) {
      now[k] = unfolded(arrays.at(std::array{"x", "y", "z"}[k]).at(from + i)) +
               (u < 0 ? 0 : steps[at(u)][k] + steps[at(w)][k] - steps[at(o)][k]);
      place[k] = json["low"][k].get<double>() + packed.step * now[k];
    }
    steps.push_back(now);
    places.push_back(place);
  }
  return places;
}

/// A sheet of water with waves, nodes shaken by a third of their distance, and a hull, a box that turns.
MovingPicture waves(int side, int frames, std::mt19937& random) {
  MovingPicture picture;
  picture.dimension = 3;
  picture.names = {"box"};
  std::uniform_real_distribution<double> shake(-0.33, 0.33);
  MovingPart box;
  for (int k = 0; k < 8; ++k) box.points.push_back({k & 1 ? 2. : 0., k & 2 ? 1. : 0., k & 4 ? 0.5 : 0.});
  box.cells = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
               2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  for (int f = 0; f < frames; ++f) {
    MovingFrame frame;
    frame.time = 0.1 * f;
    frame.water.cells = grid_of_triangles(side, side);
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double x = i + shake(random), y = j + shake(random);
        frame.water.points.push_back({x, y, std::sin(0.3 * x + f) * std::exp(-0.05 * y)});
      }
    frame.water.pressure.assign(frame.water.points.size(), 0);
    auto body = box;
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(f, 0.5 * f, 0) * Eigen::AngleAxisd(0.4 * f, Eigen::Vector3d(1, 2, 3).normalized());
    for (auto& x : body.points) Eigen::Map<Eigen::Vector3d>(x.data()) = pose * Eigen::Map<Eigen::Vector3d>(x.data());
    for (std::size_t i = 0; i < 8; ++i) body.pressure.push_back(100. * static_cast<double>(i) * f);
    frame.bodies = {body};
    picture.frames.push_back(std::move(frame));
  }
  return picture;
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Half a step on each axis; a hull's turns keep lengths.
TEST(PackedPicture, keeps_places_within_half_a_step_on_each_axis) {
  std::mt19937 random(3);
  const auto picture = waves(12, 4, random);
  const auto result = packed(picture);
  const double tolerance = std::sqrt(3.) / 2 * result.step * (1 + 1e-9) + 1e-12;
  const auto& box = picture.frames[0].bodies[0];
  const auto hull = mesh_code(box.cells, box.points.size());
  const auto at_first = places_of(hull, result, 0);
  std::size_t from = hull.order.size();
  const auto json = nlohmann::json::parse(result.json);
  for (std::size_t f = 0; f < picture.frames.size(); ++f) {
    const auto& water = picture.frames[f].water;
    const auto code = mesh_code(water.cells, water.points.size());
    const auto places = places_of(code, result, from);
    from += code.order.size();
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_LE(distance(places[i], water.points[at(code.order[i])]), tolerance);
    const auto pose = json["frames"][f]["poses"][0].get<std::array<double, 7>>();
    const Eigen::Quaterniond turn(pose[6], pose[3], pose[4], pose[5]);
    for (std::size_t i = 0; i < at_first.size(); ++i) {
      const Eigen::Vector3d x = turn * Eigen::Vector3d(at_first[i][0], at_first[i][1], at_first[i][2]) +
                                Eigen::Vector3d(pose[0], pose[1], pose[2]);
      EXPECT_LE(distance({x[0], x[1], x[2]}, picture.frames[f].bodies[0].points[at(hull.order[i])]), tolerance);
    }
  }
}

TEST(PackedPicture, moves_short_edges_by_a_small_part_of_their_length) {
  std::mt19937 random(4);
  const auto picture = waves(20, 2, random);
  std::vector<double> edges;
  for (const auto& frame : picture.frames)
    for (std::size_t c = 0; c < frame.water.cells.size(); ++c) {
      const auto& cells = frame.water.cells;
      edges.push_back(
          distance(frame.water.points[at(cells[c])], frame.water.points[at(cells[c % 3 == 2 ? c - 2 : c + 1])]));
    }
  const double step = packed(picture).step;
  const auto shorter = std::ranges::count_if(edges, [&](double length) { return length < 32 * step; });
  EXPECT_LE(static_cast<double>(shorter), 0.011 * static_cast<double>(edges.size()));
}

// Levels of 255 up to the limit.
TEST(PackedPicture, keeps_pressures_within_half_a_level) {
  std::mt19937 random(5);
  const auto picture = waves(4, 5, random);
  const auto result = packed(picture);
  const auto hulls = arrays_of(result).at("hulls");
  const auto& box = picture.frames[0].bodies[0];
  const auto order = mesh_code(box.cells, box.points.size()).order;
  std::vector<std::uint8_t> level(order.size(), 0);
  std::size_t next = 0;
  for (const auto& frame : picture.frames)
    for (std::size_t i = 0; i < order.size(); ++i) {
      level[i] = static_cast<std::uint8_t>(level[i] + hulls.at(next++));
      const double pressure = std::min(frame.bodies[0].pressure[at(order[i])], result.limit);
      EXPECT_NEAR(level[i] * result.limit / 255, pressure, 0.5001 * result.limit / 255);
    }
  EXPECT_EQ(next, hulls.size());
}

// 4 MB for 50 frames of 60 000 nodes, in base64, and three.js a twelfth of it. Such a mesh has some 4400 nodes on its surface (an aircraft
// landing, 0.15 m); here 10 000.
TEST(PackedPicture, fits_fifty_frames_of_a_large_surface_into_four_megabytes) {
  std::mt19937 random(6);
  constexpr int frames = 2;
  const auto result = packed(waves(100, frames, random));
  EXPECT_LE(50. / frames * static_cast<double>(stream_of(result.bytes).size()), 11. / 12 * 4e6);
}

// So that no gap opens between the water and its mirror image.
TEST(PackedPicture, keeps_what_lies_on_the_mirror_plane_on_it) {
  std::mt19937 random(9);
  auto picture = waves(6, 2, random);
  picture.mirror = MirrorPlane{1, 0.123};
  for (auto& frame : picture.frames)
    for (auto& x : frame.water.points) x[1] = 0.123;
  const auto result = packed(picture);
  const auto& water = picture.frames[0].water;
  const auto hull = mesh_code(picture.frames[0].bodies[0].cells, 8);
  for (const auto& x : places_of(mesh_code(water.cells, water.points.size()), result, hull.order.size()))
    EXPECT_NEAR(x[1], 0.123, 1e-9);
}

TEST(PackedPicture, refuses_a_hull_of_other_points) {
  std::mt19937 random(8);
  auto picture = waves(4, 3, random);
  picture.frames[2].bodies[0].points.pop_back();
  EXPECT_THROW(packed(picture), std::runtime_error);
}

// The box is bent more and more while it turns: half a step of the first frame's places and half a step of its bends.
TEST(PackedPicture, bends_bodies_before_it_moves_them) {
  std::mt19937 random(8);
  auto picture = waves(6, 4, random);
  for (std::size_t f = 0; f < picture.frames.size(); ++f)
    picture.frames[f].bodies[0].points[3][2] += 0.2 * static_cast<double>(f);
  const auto result = packed(picture);
  const auto json = nlohmann::json::parse(result.json);
  EXPECT_TRUE(json["bodies"][0]["bends"].get<bool>());
  const auto arrays = arrays_of(result);
  const auto& box = picture.frames[0].bodies[0];
  const auto hull = mesh_code(box.cells, box.points.size());
  auto places = places_of(hull, result, 0);
  std::size_t bend = 0;
  for (std::size_t f = 0; f < picture.frames.size(); ++f) {
    const auto pose = json["frames"][f]["poses"][0].get<std::array<double, 7>>();
    const Eigen::Quaterniond turn(pose[6], pose[3], pose[4], pose[5]);
    for (std::size_t i = 0; i < places.size(); ++i, ++bend) {
      for (std::size_t k = 0; k < 3; ++k)
        places[i][k] += result.step * unfolded(arrays.at(std::array{"bends_x", "bends_y", "bends_z"}[k]).at(bend));
      const Eigen::Vector3d x =
          turn * Eigen::Map<const Eigen::Vector3d>(places[i].data()) + Eigen::Vector3d(pose[0], pose[1], pose[2]);
      EXPECT_LE(distance({x[0], x[1], x[2]}, picture.frames[f].bodies[0].points[at(hull.order[i])]),
                std::sqrt(3.) * result.step * (1 + 1e-9) + 1e-12);
    }
  }
  EXPECT_EQ(bend, arrays.at("bends_z").size());
}

TEST(PackedPicture, of_the_plane_tells_outlines_by_their_segments) {
  MovingPicture picture;
  picture.names = {"wedge"};
  MovingFrame frame;
  frame.water = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}, {10, 20, 30}};
  frame.bodies = {{{{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 1, 1, 2, 2, 0}, {5, 0, 0}}};
  picture.frames = {frame, frame};
  const auto result = packed(picture);
  int last = 0;
  std::vector<int> cells;
  const auto arrays = arrays_of(result);
  for (const auto difference : arrays.at("segments")) cells.push_back(last += unfolded(difference));
  EXPECT_EQ(cells, frame.bodies[0].cells);
  EXPECT_EQ(arrays.at("water").size(), 6U);
}

TEST(PackedPicture, of_nothing_is_nothing) { EXPECT_NO_THROW(packed(MovingPicture{})); }

}  // namespace
}  // namespace splashdown::apps::packed_picture_test
