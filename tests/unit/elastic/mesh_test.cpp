#include <gtest/gtest.h>

#include <sstream>

#include "core/geometry.hpp"
#include "elastic/mesh/gmsh_file.hpp"
#include "solids.hpp"

namespace splashdown::elastic::mesh_test {
namespace {

/// int over the unit simplex of the product of L_k^n_k: d! prod n_k! / (sum n + d)!
template <int d>
double exact_mean(const std::array<int, d + 1>& powers) {
  double sum = d, product = std::tgamma(d + 1.);
  for (const int n : powers) {
    sum += n;
    product *= std::tgamma(n + 1.);
  }
  return product / std::tgamma(sum + 1);
}

template <int d>
void expect_exact_rule(int degree) {
  std::array<int, d + 1> powers{};
  const std::function<void(int, int)> all = [&](int k, int left) {
    if (k == d) {
      powers[d] = left;
      double sum = 0;
      for (const auto& point : rule<d>()) {
        double value = point.weight;
        for (int i = 0; i <= d; ++i) value *= std::pow(point.at[i], powers[i]);
        sum += value;
      }
      EXPECT_NEAR(sum, exact_mean<d>(powers), 1e-15);
      return;
    }
    for (int n = 0; n <= left; ++n) {
      powers[k] = n;
      all(k + 1, left - n);
    }
  };
  all(0, degree);
}

TEST(Mesh, rules_are_exact_to_their_degree) {
  expect_exact_rule<1>(5);
  expect_exact_rule<2>(4);
  expect_exact_rule<3>(5);
}

template <int d>
void expect_closed(const SolidMesh<d>& mesh, double volume) {
  const Solid<d> solid(mesh, small_strain<d>(soft), 2);
  EXPECT_NEAR(solid.total_mass(), 2 * volume, 1e-13 * volume);
  // Gauss: int n dA = 0, int x . n dA = d V, with normals that point out.
  Vec<d> sum = Vec<d>::Zero();
  const Field n = solid.traction([](const Vec<d>&, const Vec<d>& normal) { return normal; });
  const Field all = Eigen::Map<const Field>(mesh.nodes.data(), mesh.nodes.size());
  for (int a = 0; a < mesh.size(); ++a) sum += n.segment<d>(d * a);
  EXPECT_LT(sum.norm(), 1e-13);
  EXPECT_NEAR(n.dot(all), d * volume, 1e-12 * volume);
}

TEST(Mesh, boundaries_are_closed_and_point_out) {
  expect_closed<2>(box_mesh<2>({2, 1}, {3, 2}), 2);
  expect_closed<3>(box_mesh<3>({2, 1, 0.5}, {3, 2, 2}), 1);
}

TEST(Mesh, cells_that_are_wound_the_other_way_are_turned) {
  auto mesh = box_mesh<3>({1, 1, 1}, {1, 1, 1});
  auto cells = mesh.cells;
  for (auto& cell : cells) {  // mirrored by exchanging corners 2 and 3
    std::swap(cell[2], cell[3]);
    std::swap(cell[5], cell[9]);
    std::swap(cell[6], cell[7]);
  }
  expect_closed<3>(solid_mesh<3>(mesh.nodes, cells), 1);
}

TEST(Mesh, an_outline_is_filled_to_its_size) {
  const auto mesh = outline_mesh(polygon({{0, 0}, {2, 0}, {2, 1}, {1, 0.5}, {0, 1}}), 0.2);
  expect_closed<2>(mesh, 1.5);
  for (const auto& cell : mesh.cells)
    for (int i = 0; i < 3; ++i)
      EXPECT_LE((mesh.nodes.col(cell[i]) - mesh.nodes.col(cell[(i + 1) % 3])).norm(), 0.2 * (1 + 1e-12));
}

TEST(Mesh, an_outline_that_crosses_itself_is_refused) {
  EXPECT_THROW(outline_mesh(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), 0.2), MeshError);
}

TEST(Mesh, what_is_no_solid_is_refused) {
  Points<2> corners(2, 6);
  corners << 0, 1, 0, 1, 2, 3, 0, 0, 1, 1, 1, 1;
  EXPECT_THROW(quadratic_mesh<2>(corners, {}), MeshError) << "empty";
  EXPECT_THROW(quadratic_mesh<2>(corners, {{3, 4, 5}}), MeshError) << "flat";
  Points<2> butterfly(2, 5);
  butterfly << 0, -1, -1, 1, 1, 0, 1, -1, 1, -1;
  EXPECT_THROW(quadratic_mesh<2>(butterfly, {{0, 1, 2}, {0, 4, 3}}), MeshError) << "hangs by a corner";
  EXPECT_THROW(quadratic_mesh<2>(corners, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), MeshError) << "three at a side";
  auto folded = box_mesh<2>({1, 1}, {1, 1});
  folded.nodes.col(folded.cells[0][3]) << 0.5, 0.9;  // the middle of the lower side, beyond the element's own middle
  EXPECT_THROW(solid_mesh<2>(folded.nodes, folded.cells), MeshError) << "folded";
}

TEST(Mesh, points_are_found_in_their_cells) {
  const auto mesh = shaken(box_mesh<3>({2, 1, 1}, {3, 2, 2}), 0.05);
  const Solid<3> solid(mesh, small_strain<3>(soft), 1);
  const Field X = Eigen::Map<const Field>(mesh.nodes.data(), mesh.nodes.size());
  for (const Vec<3>& x : {Vec<3>(0.1, 0.2, 0.3), Vec<3>(2, 1, 1), Vec<3>(0, 0.5, 0.99)}) {
    const auto place = locate<3>(mesh, x, 1e-9);
    ASSERT_TRUE(place);
    EXPECT_LT((solid.value(X, *place) - x).norm(), 1e-12);
  }
  EXPECT_FALSE(locate<3>(mesh, Vec<3>(2.1, 0.5, 0.5), 0.01));
}

// A unit square of two triangles, with a point and a line that are passed over, and a node that nothing uses.
const char* const version_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 7 "plate"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1000 0 0
3 1000 1000 0
4 0 1000 0
9 500 3000 0
$EndNodes
$Elements
4
1 15 2 0 1 1
2 1 2 0 1 1 2
3 2 2 7 1 1 2 3
4 2 2 7 1 1 3 4
$EndElements
)";
const char* const version_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 1 1 0 0 0
$EndEntities
$Nodes
2 4 1 4
1 1 0 2
1
2
0 0 0
1000 0 0
2 1 0 2
3
4
1000 1000 0
0 1000 0
$EndNodes
$Elements
2 3 1 3
1 1 1 1
1 1 2
2 1 2 2
2 1 2 3
3 1 3 4
$EndElements
)";

TEST(GmshFile, both_versions_give_the_same_solid) {
  for (const char* text : {version_22, version_41}) {
    std::istringstream in(text);
    const auto mesh = read_gmsh<2>(in, "plate.msh", 1e-3);
    EXPECT_EQ(mesh.size(), 9);
    expect_closed<2>(mesh, 1);
  }
}

TEST(GmshFile, tetrahedra_of_second_order_keep_their_nodes) {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 "
          "0\n7 0 .5 0\n"
          "8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n1\n1 11 2 0 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  std::istringstream in(text.str());
  expect_closed<3>(read_gmsh<3>(in, "tetrahedron.msh"), 1. / 6);
}

std::string complaint(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  std::istringstream in(text);
  try {
    read_gmsh<2>(in, "plate.msh");
  } catch (const MeshError& error) {
    EXPECT_FALSE(error.cure.empty());
    return error.what();
  }
  return "none";
}

TEST(GmshFile, mistakes_are_named_with_file_and_line) {
  EXPECT_EQ(complaint(version_22, "2.2 0 8", "2.2 1 8"), "plate.msh:2: the file is binary");
  EXPECT_EQ(complaint(version_22, "2.2 0 8", "1.0 0 8"), "plate.msh:2: version 1.0 0 8 is not read");
  EXPECT_EQ(complaint(version_22, "2 1000 0 0", "2 1000 x 0"), "plate.msh:11: expected a coordinate");
  EXPECT_EQ(complaint(version_22, "2 1000 0 0", "1 1000 0 0"), "plate.msh:11: node 1 occurs twice");
  EXPECT_EQ(complaint(version_22, "7 1 1 2 3", "7 1 1 2 33"),
            "plate.msh:20: an element has node 33, which is not in the file");
  EXPECT_EQ(complaint(version_22, "3 2 2 7 1 1 2 3", "3 3 2 7 1 1 2 3 4"),
            "plate.msh:20: elements of type 3 are no triangles");
  EXPECT_EQ(complaint(version_22, "$MeshFormat", "solid cube"),
            "plate.msh:1: is no mesh of Gmsh: it does not begin with $MeshFormat");
  EXPECT_EQ(complaint(version_41, "2 3 1 3\n1 1 1 1", "9 3 1 3\n1 1 1 1"),
            "plate.msh:28: expected dimension and number of an entity");
  EXPECT_NE(complaint(version_22, "3 1000 1000 0", "3 1000 1000 5").find("not plane"), std::string::npos);
  EXPECT_NE(complaint(version_22, "3 1000 1000 0", "3 500 0 0").find("folded or flat"), std::string::npos);
  std::istringstream empty;
  EXPECT_THROW(read_gmsh<2>(empty, "plate.msh"), MeshError);
}

TEST(GmshFile, counts_that_the_file_does_not_hold_allocate_nothing) {
  EXPECT_EQ(complaint(version_22, "$Nodes\n5", "$Nodes\n999999999999"), "plate.msh:15: expected the number of a node");
}

}  // namespace
}  // namespace splashdown::elastic::mesh_test
