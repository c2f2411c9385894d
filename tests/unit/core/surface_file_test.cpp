// Hulls from files: what is read, and what is refused with what, where and how to repair.
#include "core/surface/surface_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>

#include "core/surface/cut.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::surface_file_test {
namespace {

namespace fs = std::filesystem;

class SurfaceFileTest : public ::testing::Test, protected ScratchFolder {
 protected:
  std::string told(const fs::path& file) const {
    try {
      read_surface_file(file);
    } catch (const SurfaceFileError& error) {
      EXPECT_FALSE(error.cure().empty());
      EXPECT_EQ(error.cure().back(), '.');
      return error.what();
    }
    return "was accepted";
  }
  std::string told(const std::string& stl) const { return told(write("hull.stl", stl)); }
};

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Surface<3> cube(const Vec<3>& at = Vec<3>::Zero(), double size = 2) {
  const Vec<3> half = Vec<3>::Constant(0.5 * size);
  return scenes::block(at - half, at + half);
}

Surface<3> without(Surface<3> surface, std::initializer_list<int> facets) {
  Eigen::Matrix<int, 3, Eigen::Dynamic> left(3, surface.facets.cols());
  int kept = 0;
  for (int f = 0; f < surface.facets.cols(); ++f)
    if (std::find(facets.begin(), facets.end(), f) == facets.end()) left.col(kept++) = surface.facets.col(f);
  surface.facets = left.leftCols(kept);
  return surface;
}

Surface<3> turned(Surface<3> surface, int first, int count) {
  for (int f = first; f < first + count; ++f) std::swap(surface.facets(1, f), surface.facets(2, f));
  return surface;
}

/// `shake`: every corner is written by itself, off by so much.
std::string ascii(const Surface<3>& s, double shake = 0) {
  std::string text = "solid hull\n";
  int sign = 1;
  for (int f = 0; f < s.facets.cols(); ++f) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec<3> x = s.vertices.col(s.facets(k, f)) + Vec<3>::Constant((sign = -sign) * shake);
      std::ostringstream line;
      line.precision(17);
      line << "      vertex " << x.x() << " " << x.y() << " " << x.z() << "\n";
      text += line.str();
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid hull\n";
}

std::string binary(const Surface<3>& s, const std::string& header = "made by a test") {
  std::string text = header;
  text.resize(80);
  const auto count = static_cast<std::uint32_t>(s.facets.cols());
  text.append(reinterpret_cast<const char*>(&count), 4);
  for (int f = 0; f < s.facets.cols(); ++f) {
    text.append(12, '\0');
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f x = s.vertices.col(s.facets(k, f)).cast<float>();
      text.append(reinterpret_cast<const char*>(x.data()), 12);
    }
    text.append(2, '\0');
  }
  return text;
}

std::string obj(const Surface<3>& s) {
  std::ostringstream text;
  text << "# a hull\no hull\n";
  for (const Vec<3> x : s.vertices.colwise()) text << "v " << x.x() << " " << x.y() << " " << x.z() << "\n";
  for (const Eigen::Vector3i f : s.facets.colwise())
    text << "f " << f[0] + 1 << "//1 " << f[1] + 1 << "//1 " << f[2] + 1 << "//1\n";
  return text.str();
}

/// Integral of X X^T, X = (1, x), over what the surface encloses: volume, centre and second moments, summed over the
/// tetrahedra from the origin to the facets, V/20 (sum_i X_i X_i^T + S S^T) with S = sum_i X_i.
Eigen::Matrix4d moments(const Surface<3>& s) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Eigen::Vector3i f : s.facets.colwise()) {
    Eigen::Matrix4d corners = Eigen::Matrix4d::Zero();
    corners.row(0).setOnes();
    for (int k = 0; k < 3; ++k) corners.col(k + 1).tail<3>() = s.vertices.col(f[k]);
    const double volume = corners.bottomRightCorner<3, 3>().determinant() / 6;
    const Eigen::Vector4d all = corners.rowwise().sum();
    sum += volume / 20 * (corners * corners.transpose() + all * all.transpose());
  }
  return sum;
}

double volume(const Surface<3>& s) { return moments(s)(0, 0); }

TEST_F(SurfaceFileTest, the_same_body_comes_from_every_format) {
  const auto hull = scenes::cone(0.3, 1, 64);
  struct Given {
    std::string name, text;
    double digits;
  };
  for (const auto& [name, text, digits] :
       {Given{"a.stl", ascii(hull), 1e-12}, Given{"b.STL", binary(hull), 1e-6},
        Given{"solid.stl", binary(hull, "solid but binary"), 1e-6}, Given{"c.obj", obj(hull), 1e-5}}) {
    const auto file = read_surface_file(write(name, text));
    EXPECT_EQ(file.parts, 1);
    EXPECT_EQ(file.surface.vertices.cols(), hull.vertices.cols()) << name << ": points are merged";
    EXPECT_NEAR((moments(file.surface) - moments(hull)).norm(), 0, digits) << name;
  }
}

TEST_F(SurfaceFileTest, polygons_become_triangles) {
  const auto file = read_surface_file(write("box.obj",
                                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                            "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"));
  EXPECT_EQ(file.surface.facets.cols(), 12);
  EXPECT_NEAR(volume(file.surface), 1, 10 * scenes::eps);
}

TEST_F(SurfaceFileTest, points_that_rounding_has_parted_are_one) {
  const auto file = read_surface_file(write("shaken.stl", ascii(scenes::cone(1, 1, 64), 1e-7)));
  EXPECT_EQ(file.surface.vertices.cols(), scenes::cone(1, 1, 64).vertices.cols());
}

TEST_F(SurfaceFileTest, parts_beside_each_other_are_one_body) {
  const auto file = read_surface_file(write("catamaran.stl", ascii(scenes::together(cube(), cube({5, 0, 0})))));
  EXPECT_EQ(file.parts, 2);
  EXPECT_NEAR(volume(file.surface), 16, 1e-12);
}

TEST_F(SurfaceFileTest, an_open_surface_is_told_with_its_holes) {
  EXPECT_EQ(told(ascii(without(cube(), {2, 3}))), "is not closed: 1 hole, around (0, 0, 1) with 4 edges");
  EXPECT_TRUE(says(told(ascii(without(cube(), {0, 1, 2}))), "2 holes, around (0, 0, -1) with 4 edges, around ("));
}

TEST_F(SurfaceFileTest, holes_that_touch_in_a_point_are_holes) {
  const int facets = 12;
  for (int a = 0; a < facets; ++a)
    for (int b = a + 1; b < facets; ++b)
      for (int c = b + 1; c < facets; ++c)
        EXPECT_TRUE(says(told(ascii(without(cube(), {a, b, c}))), "is not closed: ")) << a << " " << b << " " << c;
}

TEST_F(SurfaceFileTest, an_inverted_surface_is_refused_whole_or_in_part) {
  EXPECT_EQ(told(ascii(turned(cube(), 0, 12))), "is inside out: all its normals point inward");
  EXPECT_TRUE(says(told(ascii(turned(cube(), 5, 1))), "facets turned against their neighbours, 1 of 12, at ("));
  EXPECT_TRUE(
      says(told(ascii(turned(scenes::together(cube(), cube({5, 0, 0})), 12, 12))), "a part that is inside out, at ("));
  EXPECT_TRUE(says(told(ascii(scenes::together(cube(), cube({0, 0, 0}, 1)))), "a part inside another one"));
}

// One message, and what it asks for makes the file good: whichever way the skins are turned, inner ones are to go.
TEST_F(SurfaceFileTest, shells_are_told_once_with_the_right_cure) {
  const auto inner = cube({0, 0, 0}, 1), core = cube({0, 0, 0}, 0.3), beside = cube({5, 0, 0});
  const auto inverted = [](const Surface<3>& s) { return turned(s, 0, static_cast<int>(s.facets.cols())); };
  const auto two = [](const Surface<3>& a, const Surface<3>& b) { return scenes::together(a, b); };
  struct Row {
    Surface<3> hull;
    std::string rule, cure;
  };
  const std::vector<Row> table = {
      {two(cube(), beside), "was accepted", ""},
      {two(cube(), inverted(beside)), "has a part that is inside out, at (", "Flip it"},
      {two(inverted(cube()), inverted(beside)), "is inside out: all its normals", "Flip it"},
      {two(two(cube(), inverted(beside)), inverted(cube({10, 0, 0}))), "has 2 parts that are inside out", "Flip it"},
      {two(cube(), inner), "has a part inside another one", "Delete it alone"},
      {two(cube(), inverted(inner)), "has a part inside another one", "Delete it alone"},
      {two(inner, cube()), "has a part inside another one", "Delete it alone"},
      {two(inverted(cube()), inner), "outside is inside out", "Delete it alone"},
      {two(inverted(cube()), inverted(inner)), "outside is inside out", "Flip it"},
      {two(two(cube(), inverted(inner)), core), "has 2 parts inside other ones", "Delete them alone"},
      {two(cube(), turned(inner, 3, 2)), "has a part inside another one", "Delete it alone"},
      {two(turned(cube(), 3, 2), beside), "facets turned against their neighbours", "Flip it"},
      {two(without(cube(), {2, 3}), without(inverted(inner), {2, 3})), "of two skins, one inside the other",
       "Join the rims"},
      {two(without(cube(), {2, 3}), without(beside, {2, 3})), "is not closed: 2 holes", "Close it"},
  };
  for (const auto& [hull, rule, cure] : table) {
    try {
      read_surface_file(write("hull.stl", ascii(hull)));
      EXPECT_EQ(rule, "was accepted");
    } catch (const SurfaceFileError& error) {
      EXPECT_TRUE(says(error.what(), rule)) << rule << ": " << error.what();
      EXPECT_TRUE(says(error.cure(), cure)) << rule << ": " << error.cure();
    }
  }
}

TEST_F(SurfaceFileTest, a_surface_that_crosses_itself_is_told_where) {
  const auto text = told(ascii(scenes::together(cube(), cube({1.5, 0.3, 0.2}))));
  EXPECT_TRUE(says(text, "crosses itself: ")) << text;
  EXPECT_TRUE(says(text, "the first at (")) << text;
}

TEST_F(SurfaceFileTest, parts_that_share_an_edge_or_a_point_are_no_solid) {
  EXPECT_TRUE(says(told(ascii(scenes::together(cube(), cube({2, 2, 0})))),
                   "4 facets meet at the edge from (1, 1, 1) to (1, 1, -1)"));
  EXPECT_TRUE(says(told(ascii(scenes::together(cube(), cube({2, 2, 2})))), "touch in the point (1, 1, 1)"));
}

TEST_F(SurfaceFileTest, a_facet_without_area_is_told_with_its_number) {
  auto surface = cube();
  surface.facets.col(3) << 4, 4, 6;
  EXPECT_EQ(told(ascii(surface)).rfind("has a facet without area: number 4 at (", 0), 0u) << told(ascii(surface));
}

TEST_F(SurfaceFileTest, what_is_no_mesh_is_told_with_the_line) {
  EXPECT_TRUE(says(told(std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n")),
                   "line 4, 'vertex 0 0 zero', is no line of STL"));
  EXPECT_TRUE(says(told(std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0,1 0\n")), "line 4"));
  EXPECT_TRUE(says(told(std::string("solid a\nvertex 0 0 nan\n")), "line 2"));
  EXPECT_TRUE(says(told(std::string("Dear reader,\nthis is a letter.\n")), "line 1, 'Dear reader,'"));
  EXPECT_TRUE(says(told(write("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n")), "line 3, 'f 1 2', is no line of OBJ"));
  EXPECT_TRUE(says(told(write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\nf 1 2 9\nf 1 2 9\nf 1 2 9\n")),
                   "is not a whole mesh"));
  EXPECT_TRUE(says(told(std::string(100000, 'x')), "line 1"));
  EXPECT_TRUE(says(told(std::string()), "has 0 facets"));
  EXPECT_TRUE(says(told(std::string("solid a\nendsolid a\n")), "has 0 facets"));
}

TEST_F(SurfaceFileTest, a_facet_whose_outline_crosses_itself_is_told_before_it_is_cut) {
  // A box, but for one side's outline: it takes in a corner of the opposite side.
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
  EXPECT_TRUE(says(told(write("crossed.obj", points + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5 4\nf 1 5 7 3\nf 2 4 8 6\n")),
                   "has a facet of 5 corners whose outline crosses itself, at ("));
  // Seen along its normal, (1, 1, 0), the first corner of this one stands before the last.
  const std::string others = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 1\nv 0 1 1\nv 1 1 1\nv 1 1 0\n";
  EXPECT_TRUE(says(told(write("behind.obj", others + "f 1 3 4 2 7\nf 1 2 6 5\n")),
                   "has a facet of 5 corners whose outline crosses itself, at (0, 0, 0)"));
}

TEST_F(SurfaceFileTest, points_in_one_place_are_no_hull) {
  EXPECT_TRUE(says(told(write("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\n")),
                   "has no extent: all its points are at (1, 2, 3)"));
}

TEST_F(SurfaceFileTest, a_file_that_was_cut_off_is_told_with_its_length) {
  const auto whole = binary(cube());
  EXPECT_TRUE(says(told(whole.substr(0, 500)), "as a binary STL of 12 facets it would have 684 bytes, not 500"));
}

TEST_F(SurfaceFileTest, a_file_that_is_none_is_told_with_the_cause) {
  EXPECT_TRUE(says(told(path() / "none.stl"), "cannot be read: No such file"));
  EXPECT_TRUE(says(told(write("hull.step", "")), "must be an .stl or .obj file, not '.step'"));
}

double enclosed(const Surface<3>& s) {
  double sum = 0;
  for (int f = 0; f < s.facets.cols(); ++f) {
    const Vec<3> a = s.vertices.col(s.facets(0, f)), b = s.vertices.col(s.facets(1, f)),
                 c = s.vertices.col(s.facets(2, f));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

TEST_F(SurfaceFileTest, a_solid_is_cut_at_a_box_and_closed_there) {
  const Eigen::AlignedBox3d tank(Vec<3>(-0.5, -0.7, -3), Vec<3>(3, 3, 0.1));
  const auto part = cut_at_box(cube(), tank);
  EXPECT_NEAR(enclosed(part), 1.5 * 1.7 * 1.1, 1e-12);
  EXPECT_EQ(part.vertices.rowwise().minCoeff(), Vec<3>(-0.5, -0.7, -1)) << "exactly in the sides";
  EXPECT_EQ(part.vertices.rowwise().maxCoeff(), Vec<3>(1, 1, 0.1));
  EXPECT_EQ(told(ascii(part)), "was accepted");
  EXPECT_EQ(cut_at_box(cube({9, 0, 0}), tank).facets.cols(), 0) << "nothing of it is there";
  EXPECT_NEAR(enclosed(cut_at_box(cube({0, 0, 0}, 40), tank)), 3.5 * 3.7 * 3.1, 1e-12) << "it fills the tank";
  EXPECT_NEAR(enclosed(cut_at_box(cube(), {Vec<3>(-1, -1, -1), Vec<3>(0, 1, 1)})), 4, 1e-12) << "sides in common";
}

TEST_F(SurfaceFileTest, a_slope_that_is_cut_has_the_volume_below_it) {
  // A cone of height 2 on its base, upside down: radius and depth go to zero at the origin.
  const auto hill = scenes::cone(2, 2, 64);
  const Eigen::AlignedBox3d slab(Vec<3>(-5, -5, 0.5), Vec<3>(5, 5, 1));
  const double base = 0.5 * 64 * 4 * std::sin(2 * std::numbers::pi / 64) / 4;  // of its section at height 1
  EXPECT_NEAR(enclosed(cut_at_box(hill, slab)), base / 3 * (1 - 0.125), 1e-9);
  EXPECT_EQ(told(ascii(cut_at_box(hill, slab))), "was accepted");
}

// A file of 500 MB by its length, of nothing on the disk.
TEST_F(SurfaceFileTest, ten_million_facets_are_refused_before_they_are_read) {
  const std::uint32_t facets = 10'000'000;
  std::string head(80, ' ');
  head.append(reinterpret_cast<const char*>(&facets), 4);
  const auto file = write("fine.stl", head);
  fs::resize_file(file, 84 + 50ull * facets);
  const auto start = std::chrono::steady_clock::now();
  const auto text = told(file);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_EQ(text, "has 10000000 facets; 1000000 are the most that are read");
}

}  // namespace
}  // namespace splashdown::fluid::surface_file_test
