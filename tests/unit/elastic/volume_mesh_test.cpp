// Meshes of bodies in space from their shapes: what they enclose, how good their cells are, and what is refused.
#include "elastic/mesh/volume_mesh.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/surface/surface_file.hpp"
#include "elastic/mesh/boundary.hpp"
#include "elastic/mesh/thickness.hpp"
#include "rigid/shapes/solids.hpp"
#include "solids.hpp"

namespace splashdown::elastic::volume_mesh_test {
namespace {

/// Volume, centre times volume and second moments about the origin, exact for straight cells.
struct Moments {
  double volume = 0;
  Vec<3> first = Vec<3>::Zero();
  Mat<3> second = Mat<3>::Zero();
};

Moments moments_of(const SolidMesh<3>& mesh) {
  Moments sum;
  for (const auto& cell : mesh.cells) {
    Mat<3> sides;
    for (int i = 0; i < 3; ++i) sides.col(i) = mesh.nodes.col(cell[i + 1]) - mesh.nodes.col(cell[0]);
    for (const auto& point : rule<3>()) {
      const double weight = point.weight * sides.determinant() / 6;
      const Vec<3> x = mesh.nodes.col(cell[0]) + sides * point.at.tail<3>();
      sum.volume += weight;
      sum.first += weight * x;
      sum.second += weight * x * x.transpose();
    }
  }
  return sum;
}

/// Area, and length of the edges where facets turn by more than 30 degrees.
struct Skin {
  double area = 0, creases = 0;
};

/// Of the part above a height.
Skin skin_of(const SolidMesh<3>& mesh, double above = -1e9) {
  Skin skin;
  std::map<std::pair<int, int>, std::vector<Vec<3>>> sides;
  for (const auto& facet : mesh.facets) {
    const Vec<3> a = mesh.nodes.col(facet[0]), b = mesh.nodes.col(facet[1]), c = mesh.nodes.col(facet[2]);
    const Vec<3> area = 0.5 * (b - a).cross(c - a);
    skin.area += area.norm();
    for (int i = 0; i < 3; ++i) sides[std::minmax(facet[i], facet[(i + 1) % 3])].push_back(area.normalized());
  }
  for (const auto& [ends, normals] : sides) {
    EXPECT_EQ(normals.size(), 2u) << "an edge of a closed surface";
    const bool counts = std::min(mesh.nodes(2, ends.first), mesh.nodes(2, ends.second)) > above;
    if (counts && normals.size() == 2 && normals[0].dot(normals[1]) < std::cos(std::numbers::pi / 6))
      skin.creases += (mesh.nodes.col(ends.first) - mesh.nodes.col(ends.second)).norm();
  }
  return skin;
}

/// int n dA = 0, int x . n dA = 3 V.
void expect_outward(const SolidMesh<3>& mesh, double volume) {
  Vec<3> sum = Vec<3>::Zero();
  double flux = 0;
  for (const auto& facet : mesh.facets) {
    const Vec<3> a = mesh.nodes.col(facet[0]), b = mesh.nodes.col(facet[1]), c = mesh.nodes.col(facet[2]);
    const Vec<3> area = 0.5 * (b - a).cross(c - a);
    sum += area;
    flux += area.dot(a + b + c) / 3;
  }
  const double size = std::cbrt(volume);
  EXPECT_LT(sum.norm(), 1e-12 * size * size);
  EXPECT_NEAR(flux, 3 * volume, 1e-11 * volume);
}

/// Whatever the shape: edges as short as asked, no cell flatter than this. A regular one has 1; the least of two hundred random
/// shapes was 0.075.
constexpr double least_ratio = 0.05;
void expect_good(const SolidMesh<3>& mesh, double size) {
  EXPECT_LE(longest_edge(mesh), size * (1 + 1e-12));
  EXPECT_GT(least_quality(mesh), least_ratio);
}

TEST(VolumeMesh, of_a_box_is_exact_whatever_its_proportions) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> logarithm(-1, 1), share(0.2, 1);
  for (int member = 0; member < 12; ++member) {
    const Vec<3> edges(std::pow(10, logarithm(random)), 1, std::pow(10, 0.5 * logarithm(random)));
    const double size = share(random) * 2 * edges.minCoeff();
    SCOPED_TRACE(testing::Message() << "edges " << edges.transpose() << ", size " << size);
    const auto mesh = volume_mesh(rigid::box(edges).surface, size);
    expect_good(mesh, size);
    const auto [volume, first, second] = moments_of(mesh);
    EXPECT_NEAR(volume, edges.prod(), 1e-12 * edges.prod());
    EXPECT_LT(first.norm(), 1e-12 * volume * edges.norm());
    const Mat<3> exact = volume / 12 * edges.cwiseAbs2().asDiagonal().toDenseMatrix();
    EXPECT_LT((second - exact).norm(), 1e-11 * exact.norm());
    expect_outward(mesh, volume);
    const auto skin = skin_of(mesh);
    EXPECT_NEAR(skin.area, 2 * (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]), 1e-11 * skin.area);
    EXPECT_NEAR(skin.creases, 4 * edges.sum(), 1e-11 * skin.creases);
  }
}

/// Chords lie in the surface's own chords by a twentieth of the size at most, and lose no more than that times the area; moments
/// lose so much of their farthest.
void expect_shape(const SolidMesh<3>& mesh, const rigid::Shape<3>& shape, double size, double area) {
  expect_good(mesh, size);
  const auto [volume, first, second] = moments_of(mesh);
  const auto exact = rigid::mass_properties<3>(shape.surface);
  const double lost = 0.05 * size * area, reach = extent(mesh);
  EXPECT_NEAR(volume, exact.mass, lost);
  EXPECT_LT((first - volume * exact.centre).norm(), 2 * lost * reach);
  const Mat<3> about = second - first * first.transpose() / volume;
  const Mat<3> inertia = about.trace() * Mat<3>::Identity() - about;
  EXPECT_LT((inertia - exact.inertia).norm(), 4 * lost * reach * reach);
  expect_outward(mesh, volume);
  skin_of(mesh);
}

TEST(VolumeMesh, of_round_shapes_loses_no_more_than_its_chords) {
  const double pi = std::numbers::pi;
  expect_shape(volume_mesh(rigid::sphere(1).surface, 0.5), rigid::sphere(1), 0.5, 4 * pi);
  const auto capsule = rigid::capsule_of_revolution(0.3, 1);
  expect_shape(volume_mesh(capsule.surface, 0.25), capsule, 0.25, 2 * pi * 0.3 * (1 + 0.6));
  const auto cone = rigid::cone(pi / 6, 0.5);
  const auto mesh = volume_mesh(cone.surface, 0.2);
  expect_shape(mesh, cone, 0.2, pi * 0.25 * (1 + 1 / std::cos(pi / 6)));
  // Its rim is an edge of the mesh, chords of which each lie a twentieth of the size inside the circle at most.
  EXPECT_NEAR(skin_of(mesh, 0.5 * std::tan(pi / 6) - 1e-9).creases, pi, 0.02 * pi);
}

TEST(VolumeMesh, chords_lose_volume_in_second_order) {
  const auto sphere = rigid::sphere(1);
  const double exact = rigid::mass_properties<3>(sphere.surface).mass;
  const auto lost = [&](double size) { return 1 - moments_of(volume_mesh(sphere.surface, size)).volume / exact; };
  EXPECT_NEAR(std::log2(lost(0.5) / lost(0.25)), 2, 0.3);
}

TEST(VolumeMesh, random_profiles_and_capsules_are_filled) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  for (int member = 0; member < 6; ++member) {
    const auto u = [&] { return uniform(random); };
    const std::vector<Vec<2>> profile{{0, 0}, {u(), 0.3 * u()}, {u(), 0.5 + 0.3 * u()}, {0.5 * u(), 1 + u()}, {0, 2.2}};
    const auto shape = member % 2 == 0 ? rigid::revolved(profile) : rigid::capsule_of_revolution(0.5 * u(), 2 * u());
    const double size = 0.2 + 0.2 * u();
    SCOPED_TRACE(testing::Message() << "member " << member << ", size " << size);
    const Eigen::AlignedBox3d box(shape.surface.vertices.rowwise().minCoeff(),
                                  shape.surface.vertices.rowwise().maxCoeff());
    const Vec<3> s = box.sizes();
    expect_shape(volume_mesh(shape.surface, size), shape, size, 2 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]));
  }
}

TEST(VolumeMesh, of_a_hull_from_a_file_has_its_volume) {
  const auto hull = read_surface_file(std::string(SPLASHDOWN_EXAMPLES) + "/uav_landing/uav.stl").surface;
  const auto mesh = volume_mesh(hull, 0.2);
  expect_good(mesh, 0.2);
  const double volume = moments_of(mesh).volume;
  EXPECT_NEAR(volume / rigid::mass_properties<3>(hull).mass, 1, 0.03) << "blunt wings a few elements thick";
  expect_outward(mesh, volume);
  skin_of(mesh);
}

TEST(VolumeMesh, is_the_same_for_the_same_surface) {
  const auto cone = rigid::cone(0.5, 1).surface;
  const auto one = volume_mesh(cone, 0.4), other = volume_mesh(cone, 0.4);
  EXPECT_EQ(one.nodes, other.nodes);
  EXPECT_EQ(one.cells, other.cells);
}

TEST(VolumeMesh, of_a_cantilever_bends_as_timoshenko_says) {
  const double length = 10, height = 1, width = 0.8, force = 1e-6;
  const Isotropic moduli{.young_modulus = 1, .poisson_ratio = 0};  // ends that are held warp by nothing
  Solid<3> solid(volume_mesh(rigid::box({length, width, height}).surface, 0.8), small_strain<3>(moduli), 1);
  solid.clamp([&](const Vec<3>& X) { return X.x() < -length / 2 + 1e-9; });
  const Field load = solid.traction([&](const Vec<3>& X, const Vec<3>&) -> Vec<3> {
    return X.x() > length / 2 - 1e-9 ? Vec<3>(0, 0, force / (width * height)) : Vec<3>::Zero();
  });
  const Field u = equilibrium(solid, load);
  const double I = width * std::pow(height, 3) / 12, shear = 0.5 * width * height * 5 / 6;
  const double exact = force * std::pow(length, 3) / (3 * I) + force * length / shear;
  const auto tip = locate<3>(solid.mesh(), {length / 2, 0, 0}, 1e-9);
  EXPECT_NEAR(solid.value(u, *tip).z() / exact, 1, 2e-3);
}

TEST(VolumeMesh, walls_of_it_are_closed_and_lie_on_the_shape) {
  const auto wall = boundary_of(volume_mesh(rigid::box({1, 0.5, 0.2}).surface, 0.2)).surface;
  EXPECT_NEAR(rigid::mass_properties<3>(wall).mass, 0.1, 1e-13);
}

/// A tub without a lid, walls and floor of one thickness.
Surface<3> tub(double outside, double thickness) {
  const double a = outside / 2, b = a - thickness;
  Surface<3> s;
  s.vertices.resize(3, 16);
  for (int ring = 0; ring < 4; ++ring)
    for (int k = 0; k < 4; ++k) {
      const double r = ring < 2 ? a : b, z = ring == 0 ? 0 : ring == 3 ? thickness : outside / 2;
      s.vertices.col(4 * ring + k) << (k == 0 || k == 3 ? -r : r), (k < 2 ? -r : r), z;
    }
  std::vector<std::array<int, 3>> facets{{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}};
  for (int ring = 0; ring < 3; ++ring)
    for (int k = 0; k < 4; ++k) {
      const int p = 4 * ring + k, q = 4 * ring + (k + 1) % 4;
      facets.push_back({p, q, q + 4});
      facets.push_back({p, q + 4, p + 4});
    }
  s.facets.resize(3, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < 3; ++k) s.facets(k, static_cast<Eigen::Index>(f)) = facets[f][static_cast<std::size_t>(k)];
  return s;
}

TEST(VolumeMesh, hollow_shells_are_as_fine_as_they_are_thin) {
  const auto shell = tub(1, 0.1);
  const double exact = rigid::mass_properties<3>(shell).mass;
  ASSERT_NEAR(exact, 1 * 1 * 0.5 - 0.8 * 0.8 * 0.4, 1e-12);
  const auto told = forecast(shell, 0.3);
  EXPECT_NEAR(told.thin, 0.1, 0.02) << "thinner at its edges";
  const auto mesh = volume_mesh(shell, 0.3);
  expect_good(mesh, 0.3);
  EXPECT_NEAR(moments_of(mesh).volume, exact, 1e-12);
  EXPECT_NEAR(std::log(told.elements / static_cast<double>(mesh.cells.size())), 0, std::log(3));
}

TEST(VolumeMesh, shells_too_thin_for_any_mesh_are_foreseen) { EXPECT_GT(forecast(tub(1, 0.001), 0.3).elements, 1e7); }

TEST(VolumeMesh, parts_that_elements_miss_are_refused) {
  try {
    volume_mesh(rigid::capsule_of_revolution(0.01, 1, 16).surface, 0.5);
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_NE(error.cure.find("smaller elements"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace splashdown::elastic::volume_mesh_test
