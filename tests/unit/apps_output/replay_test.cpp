// Frames as a moving picture: what is read back of them, and what their bytes hold.
#include "apps/report/replay/replay.hpp"

#include <gtest/gtest.h>

#include "apps/record/frames/frames.hpp"
#include "apps/report/replay/moving_picture.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::replay_test {
namespace {

/// Two triangles of water, a node that no cell names, and a body, a segment long.
Frame<2> plane_frame(double time, double lift) {
  Frame<2> frame;
  frame.time = time;
  frame.x = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 5}};
  frame.v.assign(5, Vec<2>::Zero());
  frame.p = {100, 50, 0, 0, 0};
  frame.drop_diameter.assign(5, 0);
  frame.kind.assign(5, NodeKind::interior);
  frame.wall.assign(5, -1);
  frame.cells = {{0, 1, 2}, {0, 2, 3}};
  Outline<2> body;
  body.name = "fluid_like";  // no body is taken for the water by its name's beginning
  body.surface.vertices.resize(2, 2);
  body.surface.vertices << 0, 1, 2 + lift, 2 + lift;
  body.surface.facets.resize(2, 1);
  body.surface.facets << 0, 1;
  body.p = {10, 20};
  frame.outlines = {body};
  auto tank = body;
  tank.name = "tank";
  frame.outlines.push_back(tank);
  return frame;
}

/// A tetrahedron with a face of the free surface.
Frame<3> spatial_frame(double time) {
  Frame<3> frame;
  frame.time = time;
  frame.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  frame.v.assign(4, Vec<3>::Zero());
  frame.p.assign(4, 0);
  frame.drop_diameter.assign(4, 0);
  frame.kind = {NodeKind::free_surface, NodeKind::free_surface, NodeKind::contact, NodeKind::wall};
  frame.wall.assign(4, -1);
  frame.cells = {{0, 2, 1, 3}};
  return frame;
}

template <int d, class Make>
void write_frames(const std::filesystem::path& folder, int count, const Make& make) {
  FrameSeries series(folder);
  for (int i = 0; i < count; ++i) series.add<d>(make(0.1 * i));
}

TEST(Replay, of_the_plane_has_all_triangles_and_no_tank) {
  ScratchFolder folder;
  write_frames<2>(folder.path(), 3, [](double t) { return plane_frame(t, t); });
  const auto picture = moving_picture(folder.path(), 60);
  EXPECT_EQ(picture.dimension, 2);
  ASSERT_EQ(picture.frames.size(), 3U);
  EXPECT_EQ(picture.names, std::vector<std::string>{"fluid_like"});
  EXPECT_EQ(picture.frames[1].water.points.size(), 4U);  // without the one that no cell names
  EXPECT_EQ(picture.frames[1].water.cells.size(), 6U);
  EXPECT_NEAR(picture.frames[2].bodies[0].points[0][1], 2.2, 1e-12);
}

TEST(Replay, of_space_has_the_free_surface_alone) {
  ScratchFolder folder;
  write_frames<3>(folder.path(), 2, spatial_frame);
  const auto picture = moving_picture(folder.path(), 60);
  EXPECT_EQ(picture.dimension, 3);
  EXPECT_EQ(picture.frames[0].water.cells.size(), 3U);
  EXPECT_EQ(picture.frames[0].water.points.size(), 3U);
}

TEST(Replay, keeps_the_first_and_the_last_of_many_frames) {
  ScratchFolder folder;
  write_frames<2>(folder.path(), 9, [](double t) { return plane_frame(t, t); });
  const auto picture = moving_picture(folder.path(), 4);
  ASSERT_EQ(picture.frames.size(), 4U);
  EXPECT_EQ(picture.frames.front().time, 0);
  EXPECT_NEAR(picture.frames.back().time, 0.8, 1e-12);
}

TEST(Replay, of_a_damaged_frame_says_so_and_of_none_says_nothing) {
  ScratchFolder folder;
  EXPECT_TRUE(replay_of(folder.path()).warnings.empty());
  write_frames<2>(folder.path(), 3, [](double t) { return plane_frame(t, t); });
  folder.write("frames/000001.vtu", "damaged");
  const auto replay = replay_of(folder.path());
  EXPECT_TRUE(replay.html.empty());
  ASSERT_EQ(replay.warnings.size(), 1U);
  EXPECT_NE(replay.warnings[0].find("000001.vtu"), std::string::npos);
}

TEST(Replay, needs_no_network) {
  ScratchFolder folder;
  write_frames<2>(folder.path(), 3, [](double t) { return plane_frame(t, t); });
  const auto html = replay_of(folder.path()).html;
  for (const char* outside : {"src=\"", "@import", "<link"})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

}  // namespace
}  // namespace splashdown::apps::replay_test
