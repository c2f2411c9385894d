// Solids of several materials, and plane meshes with edges where they meet.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "elastic/goals/goals.hpp"
#include "elastic/modes/modes.hpp"
#include "solids.hpp"

namespace splashdown::elastic::parts_test {
namespace {

template <int d>
std::vector<int> part_where(const SolidMesh<d>& mesh, const std::function<bool(const Vec<d>&)>& inside) {
  std::vector<int> part;
  for (const auto& cell : mesh.cells) {
    Vec<d> middle = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) middle += mesh.nodes.col(cell[k]) / (d + 1);
    part.push_back(inside(middle));
  }
  return part;
}

constexpr Isotropic weak{.young_modulus = 1, .poisson_ratio = 0}, strong{.young_modulus = 7, .poisson_ratio = 0};

template <int d>
std::vector<Material<d>> two(const Isotropic& one, const Isotropic& other, double density = 1,
                             double other_density = 1) {
  return {{small_strain<d>(one), density}, {small_strain<d>(other), other_density}};
}

template <int d>
Vec<d> box_of(double length) {
  Vec<d> size = Vec<d>::Ones();
  size[0] = length;
  return size;
}

/// A bar along x, pulled by a unit traction: how far its end goes.
template <int d>
double pulled(const std::vector<Material<d>>& materials, int across) {
  std::array<int, d> counts;
  counts.fill(2);
  counts[0] = 4;
  const auto mesh = box_mesh<d>(box_of<d>(3), counts);
  const double half = across == 0 ? 1.5 : 0.5;
  Solid<d> solid(mesh, materials, part_where<d>(mesh, [&](const Vec<d>& x) { return x[across] > half; }));
  solid.clamp([](const Vec<d>& X) { return X[0] == 0; });
  const Field load = solid.traction([&](const Vec<d>& X, const Vec<d>&) -> Vec<d> {
    return X[0] > 3 - 1e-9 ? Vec<d>(Vec<d>::Unit(0)) : Vec<d>(Vec<d>::Zero());
  });
  Vec<d> end = Vec<d>::Constant(0.5);
  end[0] = 3;
  return solid.value(equilibrium(solid, load), *locate<d>(mesh, end, 1e-9))[0];
}

TEST(Parts, in_series_add_their_compliances) {
  EXPECT_NEAR(pulled<2>(two<2>(weak, strong), 0), 1.5 / 1 + 1.5 / 7, 1e-9);
  EXPECT_NEAR(pulled<3>(two<3>(weak, strong), 0), 1.5 / 1 + 1.5 / 7, 1e-9);
}

/// Strained alike they share a load by their stiffness, and nothing pulls on nodes inside.
template <int d>
void expect_parallel() {
  std::array<int, d> counts;
  counts.fill(2);
  const auto mesh = box_mesh<d>(Vec<d>::Ones(), counts);
  const Solid<d> solid(mesh, two<d>(weak, strong), part_where<d>(mesh, [](const Vec<d>& x) { return x[1] > 0.5; }));
  Field u = Field::Zero(solid.size());
  for (int a = 0; a < mesh.size(); ++a) u[d * a] = mesh.nodes(0, a);
  const Field f = solid.internal_force(u);
  double pull = 0;
  for (int a = 0; a < mesh.size(); ++a) {
    if (mesh.nodes(0, a) == 1) pull += f[d * a];
    if (mesh.nodes(0, a) > 0 && mesh.nodes(0, a) < 1) {
      EXPECT_LT(f.segment<d>(d * a).norm(), 1e-13);
    }
  }
  EXPECT_NEAR(pull, 0.5 * 1 + 0.5 * 7, 1e-12);
}

TEST(Parts, side_by_side_add_their_stiffnesses) {
  expect_parallel<2>();
  expect_parallel<3>();
}

/// Uniform strains on both sides of x = 1/2 with one displacement and one traction there are an exact solution.
template <int d>
void expect_patch() {
  std::array<int, d> counts;
  counts.fill(4);
  const auto mesh = box_mesh<d>(Vec<d>::Ones(), counts);
  const auto materials =
      two<d>({.young_modulus = 2, .poisson_ratio = 0.3}, {.young_modulus = 9, .poisson_ratio = 0.45});
  const Solid<d> solid(mesh, materials, part_where<d>(mesh, [](const Vec<d>& x) { return x[0] > 0.5; }));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  Mat<d> H;
  for (double& entry : H.reshaped()) entry = uniform(random);
  const Mat<d> one = Mat<d>::Identity();
  const Vec<d> jump = (materials[0].law->stress(one + H) - materials[1].law->stress(one + H)).col(0);
  const Mat<d> acoustic = materials[1].law->tangent(one).template topLeftCorner<d, d>();  // along the normal, both ways
  Mat<d> other = H;
  other.col(0) += acoustic.inverse() * jump;
  Field u(solid.size());
  for (int a = 0; a < mesh.size(); ++a) {
    const Vec<d> X = mesh.nodes.col(a), at = Vec<d>::Unit(0) * 0.5;
    u.segment<d>(d * a) = H * at + (X[0] > 0.5 ? other : H) * (X - at);
  }
  const Field f = solid.internal_force(u);
  for (int a = 0; a < mesh.size(); ++a)
    if ((mesh.nodes.col(a).array() > 0).all() && (mesh.nodes.col(a).array() < 1).all()) {
      EXPECT_LT(f.segment<d>(d * a).norm(), 1e-13);
    }
}

TEST(Parts, uniform_strains_on_both_sides_of_an_interface_are_exact) {
  expect_patch<2>();
  expect_patch<3>();
}

struct Layers {
  double stiffness, mass, neutral;  // EI, rho A, height of the axis
};
/// Of 0.4 of `one` below 0.6 of `other`.
Layers layers_of(double E, double F, double rho, double sigma) {
  const double a = 0.4, b = 0.6, neutral = (E * a * a / 2 + F * b * (a + b / 2)) / (E * a + F * b);
  const auto part = [&](double modulus, double height, double middle) {
    return modulus * (std::pow(height, 3) / 12 + height * std::pow(middle - neutral, 2));
  };
  return {part(E, a, a / 2) + part(F, b, a + b / 2), rho * a + sigma * b, neutral};
}

TEST(Parts, a_beam_of_two_layers_bends_as_composite_beams_do) {
  const double length = 8, curvature = 1e-3;
  const auto mesh = box_mesh<2>({length, 1}, {8, 5});
  Solid<2> solid(mesh, two<2>(weak, strong), part_where<2>(mesh, [](const Vec<2>& x) { return x[1] > 0.4; }));
  solid.clamp([](const Vec<2>& X) { return X[0] == 0; });
  const double neutral = layers_of(1, 7, 1, 1).neutral;
  // The stress of pure bending on its end; it jumps at the interface, where no point of the rule lies.
  const Field load = solid.traction([&](const Vec<2>& X, const Vec<2>&) -> Vec<2> {
    if (X[0] < length - 1e-9) return Vec<2>::Zero();
    return {-(X[1] > 0.4 ? 7 : 1) * curvature * (X[1] - neutral), 0};
  });
  const auto tip = locate<2>(mesh, {length, 0.5}, 1e-9);
  EXPECT_NEAR(solid.value(equilibrium(solid, load), *tip).y() / (curvature * length * length / 2), 1, 1e-9);
}

TEST(Parts, a_beam_of_two_layers_vibrates_as_composite_beams_do) {
  const double length = 60, root = 1.875104;  // of a cantilever
  const auto mesh = box_mesh<2>({length, 1}, {30, 5});
  Solid<2> solid(mesh, two<2>(weak, strong, 1, 3), part_where<2>(mesh, [](const Vec<2>& x) { return x[1] > 0.4; }));
  solid.clamp([](const Vec<2>& X) { return X[0] == 0; });
  const auto [stiffness, mass, neutral] = layers_of(1, 7, 1, 3);
  const double exact = std::pow(root / length, 2) * std::sqrt(stiffness / mass);
  const auto modes = lowest_modes(solid, 1, Field::Zero(solid.size()));
  // Shear and rotary inertia take some 3 (height/length)^2.
  EXPECT_NEAR(modes.angular_frequencies[0] / exact, 1, 3 / (length * length) + 1e-3);
}

TEST(Parts, have_their_mass_and_their_centre) {
  const auto mesh = box_mesh<2>({2, 1}, {4, 2});
  const Solid<2> solid(mesh, two<2>(weak, weak, 1, 3), part_where<2>(mesh, [](const Vec<2>& x) { return x[0] > 1; }));
  EXPECT_NEAR(solid.total_mass(), 4, 1e-14);
  EXPECT_NEAR(solid.centre(Field::Zero(solid.size())).x(), (0.5 * 1 + 1.5 * 3) / 4, 1e-14);
}

/// Second moments about the centre: of the halves about their own, and of the way between them.
TEST(Parts, have_their_moments_and_those_of_point_masses) {
  const auto mesh = box_mesh<3>({2, 1, 0.5}, {4, 2, 1});
  Solid<3> solid(mesh, two<3>(weak, weak, 1, 3), part_where<3>(mesh, [](const Vec<3>& x) { return x[0] > 1; }));
  const Vec<3> at(2, 1, 0.5);
  solid.add_point_mass(*locate<3>(mesh, at, 1e-9), 0.7);
  struct Piece {
    double mass;
    Vec<3> centre, sides;
  };
  const std::array<Piece, 3> pieces{
      {{0.5, {0.5, 0.5, 0.25}, {1, 1, 0.5}}, {1.5, {1.5, 0.5, 0.25}, {1, 1, 0.5}}, {0.7, at, Vec<3>::Zero()}}};
  double mass = 0;
  Vec<3> centre = Vec<3>::Zero();
  for (const auto& piece : pieces) mass += piece.mass, centre += piece.mass * piece.centre;
  centre /= mass;
  Mat<3> moments = Mat<3>::Zero();
  for (const auto& piece : pieces) {
    const Vec<3> arm = piece.centre - centre;
    moments += piece.mass * (arm * arm.transpose() + piece.sides.cwiseAbs2().asDiagonal().toDenseMatrix() / 12);
  }
  EXPECT_NEAR(solid.total_mass(), mass, 1e-13);
  EXPECT_LT((solid.centre(Field::Zero(solid.size())) - centre).norm(), 1e-13);
  EXPECT_LT((solid.second_moments() - moments).norm(), 1e-13);
}

/// Strained alike, two materials side by side have uniform stresses each: no node may have their mean.
template <int d>
void expect_no_mean_across() {
  std::array<int, d> counts;
  counts.fill(2);
  const auto mesh = box_mesh<d>(Vec<d>::Ones(), counts);
  const Solid<d> solid(mesh, two<d>(weak, strong), part_where<d>(mesh, [](const Vec<d>& x) { return x[1] > 0.5; }));
  Field u = Field::Zero(solid.size());
  for (int a = 0; a < mesh.size(); ++a) u[d * a] = 1e-3 * mesh.nodes(0, a);
  const auto stress = solid.nodal_stress(u);
  for (int a = 0; a < mesh.size(); ++a)
    EXPECT_NEAR(stress[static_cast<std::size_t>(a)](0, 0), mesh.nodes(1, a) < 0.5 - 1e-9 ? 1e-3 : 7e-3, 1e-14)
        << "the stiffer one tells the stress at the interface";
}

TEST(Parts, have_stresses_of_their_own_at_nodes) {
  expect_no_mean_across<2>();
  expect_no_mean_across<3>();
}

/// Ends of a clamp have the exponent of what is clamped: what lies far from them changes no order.
TEST(Parts, corners_have_the_order_of_their_own_material) {
  const auto mesh = box_mesh<2>({3, 1}, {12, 4});
  const Isotropic stiff{.young_modulus = 1, .poisson_ratio = 0.45};
  const auto far = part_where<2>(mesh, [](const Vec<2>& x) { return x[0] > 1.5; });
  const auto orders = [&](Solid<2> solid) {
    solid.clamp([](const Vec<2>& X) { return X[0] == 0; });
    return whole_errors(solid);
  };
  EXPECT_EQ(orders({mesh, two<2>(weak, stiff), far}), orders({mesh, two<2>(weak, weak), far}));
  EXPECT_NE(orders({mesh, two<2>(stiff, weak), far}), orders({mesh, two<2>(weak, weak), far}));
}

TEST(Parts, that_are_equal_are_one_bit_by_bit) {
  const auto mesh = box_mesh<2>({2, 1}, {4, 2});
  for (const auto& law : {&st_venant_kirchhoff<2>, &small_strain<2>}) {
    const std::shared_ptr<const Law<2>> whole = law(soft), same = law(soft);
    const Solid<2> one(mesh, whole, 2);
    const Solid<2> both(mesh, {{whole, 2}, {same, 2}}, part_where<2>(mesh, [](const Vec<2>& x) { return x[0] > 1; }));
    Field u(one.size());
    for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 0.01 * std::sin(3. * static_cast<double>(k));
    Sparse K, L;
    one.stiffness(u, K);
    both.stiffness(u, L);
    EXPECT_EQ(Eigen::MatrixXd(K), Eigen::MatrixXd(L));
    EXPECT_EQ(Eigen::MatrixXd(one.mass()), Eigen::MatrixXd(both.mass()));
    EXPECT_EQ(one.internal_force(u), both.internal_force(u));
    EXPECT_EQ(one.strain_energy(u), both.strain_energy(u));
    EXPECT_EQ(one.peak(u).value, both.peak(u).value);
  }
}

TEST(Parts, stay_what_they_are_where_cells_are_divided) {
  const auto mesh = box_mesh<2>({2, 1}, {4, 2});
  const Solid<2> solid(mesh, two<2>(weak, strong, 1, 3), part_where<2>(mesh, [](const Vec<2>& x) { return x[0] > 1; }));
  const auto fine = solid.divided().first;
  EXPECT_NEAR(fine.total_mass(), solid.total_mass(), 1e-14);
  Field u = Field::Zero(solid.size()), v = Field::Zero(fine.size());
  for (int a = 0; a < mesh.size(); ++a) u[2 * a] = std::pow(mesh.nodes(0, a), 2);
  for (int a = 0; a < fine.mesh().size(); ++a) v[2 * a] = std::pow(fine.mesh().nodes(0, a), 2);
  EXPECT_NEAR(fine.strain_energy(v), solid.strain_energy(u), 1e-12 * solid.strain_energy(u));
}

/// Area of the elements whose middle is inside.
double area_where(const SolidMesh<2>& mesh, const std::function<bool(const Vec<2>&)>& inside) {
  const auto part = part_where<2>(mesh, inside);
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Vec<2> a = mesh.nodes.col(mesh.cells[c][0]), b = mesh.nodes.col(mesh.cells[c][1]) - a,
                 e = mesh.nodes.col(mesh.cells[c][2]) - a;
    if (part[c]) sum += 0.5 * (b.x() * e.y() - b.y() * e.x());
  }
  return sum;
}

InnerLines box_lines(const Vec<2>& low, const Vec<2>& high) {
  const Vec<2> right(high.x(), low.y()), left(low.x(), high.y());
  return {{low, right}, {right, high}, {high, left}, {left, low}};
}

/// A slanting hull over boxes that lie inside, cross its sides, share a side with it, and cross each other.
TEST(InnerLines, elements_of_the_plane_end_where_parts_do) {
  const auto hull = polygon({{0, 0}, {2, 0.4}, {2, 1}, {-2, 1}, {-2, 0.4}});
  struct Box {
    Vec<2> low, high;
    double area;
  };
  for (const auto& [low, high, area] :
       {Box{{-0.5, 0.5}, {0.5, 0.75}, 0.25}, Box{{-0.5, 0.5}, {0.5, 2}, 0.5}, Box{{1, -1}, {3, 3}, 1 * (1 - 0.3)},
        Box{{-2, 0.6}, {2, 1}, 1.6}, Box{{-2.5, 0.8}, {0, 1}, 0.4}}) {
    SCOPED_TRACE(testing::Message() << low.transpose() << " to " << high.transpose());
    auto lines = box_lines(low, high);
    const auto more = box_lines({-0.2, 0.3}, {0.2, 0.9});
    lines.insert(lines.end(), more.begin(), more.end());
    const auto mesh = outline_mesh(hull, 0.3, lines);
    EXPECT_NEAR(area_where(mesh, [](const Vec<2>&) { return true; }), 4 * 1 - 2 * 0.4, 1e-12);
    const auto within = [](const Vec<2>& a, const Vec<2>& b) {
      return [=](const Vec<2>& x) { return (x.array() > a.array()).all() && (x.array() < b.array()).all(); };
    };
    EXPECT_NEAR(area_where(mesh, within(low, high)), area, 1e-12);
    EXPECT_NEAR(area_where(mesh, within({-0.2, 0.3}, {0.2, 0.9})), 0.24, 1e-12);
  }
}

TEST(InnerLines, outside_an_outline_leave_its_mesh_alone) {
  const auto hull = polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  const auto plain = outline_mesh(hull, 0.3), far = outline_mesh(hull, 0.3, box_lines({-1, -1}, {3, 3}));
  EXPECT_EQ(plain.nodes, far.nodes);
}

}  // namespace
}  // namespace splashdown::elastic::parts_test
