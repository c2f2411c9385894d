#include "apps/record/frames/frames.hpp"

#include <gtest/gtest.h>

#include "apps/record/frames/base64.hpp"
#include "apps/record/frames/vtu.hpp"
#include "apps/report/pictures/plane_picture.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::frames_test {
namespace {

/// A unit square of two triangles, a drop, and a body beside it.
Frame<2> square() {
  Frame<2> frame;
  frame.time = 0.125;
  frame.x = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {3, 3}};
  frame.v = {{0, 1}, {0, 1}, {0, 1}, {0, 1}, {5, 5}};
  frame.p = {4, 3, 2, 1, 0};
  frame.kind = {NodeKind::wall_vertex, NodeKind::wall, NodeKind::free_surface, NodeKind::free_surface, NodeKind::drop};
  frame.wall = {0, 0, -1, -1, -1};
  frame.cells = {{0, 1, 2}, {0, 2, 3}};
  Outline<2> body{"hull", {}};
  body.surface.vertices.resize(2, 3);
  body.surface.vertices << 2, 3, 2, 0, 0, 1;
  body.surface.facets.resize(2, 3);
  body.surface.facets << 0, 1, 2, 1, 2, 0;
  frame.outlines = {body};
  return frame;
}

TEST(Vtu, what_is_written_can_be_read_back) {
  ScratchFolder folder;
  const auto pieces = write_pieces(folder.path(), "state", square());
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0], (std::pair<std::string, std::string>("fluid", "state.vtu")));
  EXPECT_EQ(pieces[1], (std::pair<std::string, std::string>("hull", "state_hull.vtu")));
  const PlanePicture picture = read_picture(folder.path(), "state");
  EXPECT_EQ(picture.time, 0.125);
  EXPECT_EQ(picture.nodes, 5u);
  EXPECT_EQ(picture.cells, 2u);
  EXPECT_EQ(picture.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(picture.points[2], (PlanePoint{1, 1}));
  EXPECT_EQ(picture.pressure, square().p);
  EXPECT_EQ(picture.drops, (std::vector<PlanePoint>{{3, 3}}));
  EXPECT_EQ(picture.surface.size(), 4u);
  EXPECT_EQ(picture.edges.size(), 5u);
  ASSERT_EQ(picture.outlines.size(), 1u);
  EXPECT_TRUE(picture.outlines[0].encloses_solid);
  EXPECT_EQ(picture.outlines[0].segments.size(), 3u);
}

TEST(Base64, has_the_examples_of_rfc_4648) {
  const std::pair<const char*, const char*> examples[] = {{"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
                                                          {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}};
  for (const auto& [bytes, text] : examples) {
    std::string encoded;
    append_base64(encoded, bytes);
    EXPECT_EQ(encoded, text);
    EXPECT_EQ(from_base64(text), bytes);
  }
  for (const char* wrong : {"Zg", "Zg=", "Z===", "Zm9v\n===", "Zm*v"})
    EXPECT_THROW(from_base64(wrong), std::runtime_error);
}

/// What reading a file with this text says; empty if it can be read.
std::string refusal(const ScratchFolder& folder, const std::string& text) {
  folder.write("grid.vtu", text);
  try {
    read_vtu(folder.path() / "grid.vtu");
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string with(std::string text, const std::string& old_part, const std::string& new_part) {
  return text.replace(text.find(old_part), old_part.size(), new_part);
}

TEST(Vtu, what_is_cut_short_or_changed_is_refused_with_what_is_wrong) {
  ScratchFolder folder;
  write_pieces(folder.path(), "state", square());
  const std::string whole = folder.text("state.vtu");
  EXPECT_EQ(refusal(folder, whole), "");
  for (std::size_t length = 0; length + 2 < whole.size(); length += 7)  // behind the last bracket nothing is missed
    EXPECT_NE(refusal(folder, whole.substr(0, length)).find("grid.vtu: is not a readable .vtu file: "),
              std::string::npos)
        << length;
  for (const auto& [old_part, new_part, said] : std::initializer_list<std::array<const char*, 3>>{
           {"vtkZLib", "vtkLZ4", "compressor is \"vtkLZ4DataCompressor\", not \"vtkZLibDataCompressor\""},
           {"LittleEndian", "BigEndian", "byte_order is"},
           {"NumberOfPoints=\"5\"", "NumberOfPoints=\"6\"", "has not three coordinates a point"},
           {"Name=\"types\"", "Name=\"kinds\"", "an array is not of type UInt8"},
           {"<Piece", "<AppendedData encoding=\"raw\">", "as earlier versions wrote them"}})
    EXPECT_NE(refusal(folder, with(whole, old_part, new_part)).find(said), std::string::npos) << new_part;
}

TEST(Vtu, a_tank_is_told_from_a_body_by_its_sense) {
  ScratchFolder folder;
  Frame<2> frame = square();
  frame.outlines[0].surface.facets << 1, 2, 0, 0, 1, 2;
  write_pieces(folder.path(), "state", frame);
  EXPECT_FALSE(read_picture(folder.path(), "state").outlines[0].encloses_solid);
}

TEST(Frames, the_index_lists_every_piece_with_its_time) {
  ScratchFolder folder;
  FrameSeries series(folder.path());
  Frame<2> frame = square();
  series.add(frame);
  frame.time = 0.25;
  series.add(frame);
  const std::string index = folder.text("frames.pvd");
  for (const char* entry : {"timestep=\"0.125\" group=\"\" part=\"0\" name=\"fluid\" file=\"frames/000000.vtu\"",
                            "timestep=\"0.125\" group=\"\" part=\"1\" name=\"hull\" file=\"frames/000000_hull.vtu\"",
                            "timestep=\"0.25\" group=\"\" part=\"0\" name=\"fluid\" file=\"frames/000001.vtu\""})
    EXPECT_NE(index.find(entry), std::string::npos) << entry << " in\n" << index;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames/000001_hull.vtu"));
}

TEST(Frames, an_index_that_grew_is_the_one_that_is_written_at_once) {
  ScratchFolder folder;
  FrameSeries series(folder.path());
  Frame<2> frame = square();
  for (int k = 0; k < 5; ++k) frame.time = 0.125 * k, series.add(frame);
  const std::string grown = folder.text("frames.pvd");
  series.write_index();
  EXPECT_EQ(grown, folder.text("frames.pvd"));
  // Whoever put another file there does not get it broken further.
  folder.write("frames.pvd", "something else");
  series.add(frame);
  const std::string again = folder.text("frames.pvd");
  series.write_index();
  EXPECT_EQ(again, folder.text("frames.pvd"));
}

TEST(Raster, interpolates_linearly_and_knows_what_is_outside) {
  PlanePicture picture;
  picture.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& x : picture.points) picture.pressure.push_back(2 * x[0] + 3 * x[1]);
  picture.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Raster raster = rasterise(picture, {-1, -1}, {2, 2}, 30, 30);
  for (int j = 0; j < 30; ++j)
    for (int i = 0; i < 30; ++i) {
      const double x = -1 + (i + 0.5) * 0.1, y = -1 + (j + 0.5) * 0.1;
      const float value = raster.values[static_cast<std::size_t>(30 * j + i)];
      if (x > 0 && x < 1 && y > 0 && y < 1)
        EXPECT_NEAR(value, 2 * x + 3 * y, 1e-6);  // single precision
      else
        EXPECT_TRUE(std::isnan(value));
    }
}

// A cut through tetrahedra of a linear field shows that field.
TEST(Vtu, a_spatial_mesh_is_cut_in_the_middle_of_its_body) {
  ScratchFolder folder;
  Frame<3> frame;
  // A cube as six tetrahedra around its diagonal.
  for (int k = 0; k < 8; ++k) frame.x.emplace_back(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  for (const auto& x : frame.x) {
    frame.v.emplace_back(0, 0, 0);
    frame.p.push_back(2 * x.x() + 3 * x.y() + 5 * x.z());
    frame.kind.push_back(NodeKind::interior);
    frame.wall.push_back(-1);
  }
  frame.cells = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  write_pieces(folder.path(), "state", frame);
  const PlanePicture picture = read_picture(folder.path(), "state");
  ASSERT_FALSE(picture.triangles.empty());
  double area = 0;
  for (const auto& t : picture.triangles) {
    const auto &a = picture.points[static_cast<std::size_t>(t[0])], &b = picture.points[static_cast<std::size_t>(t[1])],
               &c = picture.points[static_cast<std::size_t>(t[2])];
    area += 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
  }
  EXPECT_NEAR(area, 1, 1e-14);
  for (std::size_t i = 0; i < picture.points.size(); ++i)
    EXPECT_NEAR(picture.pressure[i], 2 * picture.points[i][0] + 3 * 0.5 + 5 * picture.points[i][1], 1e-14);
}

}  // namespace
}  // namespace splashdown::apps::frames_test
