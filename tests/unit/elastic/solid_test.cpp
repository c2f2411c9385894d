#include <gtest/gtest.h>

#include "solids.hpp"

namespace splashdown::elastic::solid_test {
namespace {

template <int d>
SolidMesh<d> crooked_box() {
  if constexpr (d == 2)
    return shaken(box_mesh<2>({2, 1}, {4, 3}), 0.08);
  else
    return shaken(box_mesh<3>({2, 1, 1}, {3, 3, 3}), 0.08);
}

template <int d>
std::vector<std::unique_ptr<const Law<d>>> laws() {
  std::vector<std::unique_ptr<const Law<d>>> all;
  all.push_back(st_venant_kirchhoff<d>(soft));
  all.push_back(neo_hookean<d>(soft));
  all.push_back(small_strain<d>(soft));
  all.push_back(orthotropic<d>(
      {.E1 = 10, .E2 = 1, .E3 = 1, .nu12 = 0.3, .nu13 = 0.3, .nu23 = 0.4, .G12 = 0.5, .G13 = 0.5, .G23 = 0.4}));
  return all;
}

/// Nodes of the boundary are moved by a uniform gradient: the others, which begin somewhere near, go where it has them, and the
/// stress is the same everywhere.
template <int d>
void expect_patch() {
  Mat<d> gradient = Mat<d>::Zero();
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) gradient(i, j) = 0.1 * std::cos(1. + i + 3 * j);
  for (auto& law : laws<d>()) {
    Solid<d> solid(crooked_box<d>(), std::move(law), 1);
    SolidState start = at_rest(solid), end;
    for (int a = 0; a < solid.mesh().size(); ++a)
      start.u.segment<d>(d * a) = gradient * solid.mesh().nodes.col(a) + Vec<d>::Constant(0.005 * std::cos(a));
    for (const auto& facet : solid.mesh().facets)
      for (const int a : facet)
        for (int k = 0; k < d; ++k) {
          solid.hold(d * a + k);
          start.u.segment<d>(d * a) = gradient * solid.mesh().nodes.col(a);
        }
    const auto status = steady({.system = &solid, .load = unloaded(solid)})->step(start, 1, end);
    ASSERT_TRUE(status.ok()) << status.cause;
    for (int a = 0; a < solid.mesh().size(); ++a)
      EXPECT_LT((end.u.template segment<d>(d * a) - gradient * solid.mesh().nodes.col(a)).norm(), 1e-13);
    const Mat<3> stress = solid.law().cauchy(Mat<d>::Identity() + gradient);
    for (const double x : {0.1, 0.9, 1.7}) {
      const auto place = locate<d>(solid.mesh(), Vec<d>::Constant(0.5) + (x - 0.5) * Vec<d>::UnitX(), 1e-9);
      EXPECT_LT((solid.stress(end.u, *place) - stress).norm(), 1e-12 * stress.norm());
    }
    EXPECT_NEAR(solid.peak(end.u).value, von_mises(stress), 1e-12 * stress.norm());
    EXPECT_LT(solid.stress_error(end.u, solid.peak(end.u)), 1e-11 * stress.norm());
  }
}

/// Of a wavy displacement at nodes, at its largest stress: true error and estimated one, both over the stress.
template <int d>
std::array<double, 2> stress_errors(int n) {
  std::array<int, d> cells;
  cells.fill(n);
  const Solid<d> solid(shaken(box_mesh<d>(Vec<d>::Ones(), cells), 0.1 / n), small_strain<d>(soft), 1);
  // u_x = sin(3x) cos(2y)/1000
  const auto u_x = [](const Vec<d>& X) { return 1e-3 * std::sin(3 * X.x()) * std::cos(2 * X.y()); };
  Field u = Field::Zero(solid.size());
  for (int a = 0; a < solid.mesh().size(); ++a) u[d * a] = u_x(solid.mesh().nodes.col(a));
  const auto peak = solid.peak(u);
  Mat<d> F = Mat<d>::Identity();
  F(0, 0) += 3e-3 * std::cos(3 * peak.at.x()) * std::cos(2 * peak.at.y());
  F(0, 1) -= 2e-3 * std::sin(3 * peak.at.x()) * std::sin(2 * peak.at.y());
  const auto place = locate<d>(solid.mesh(), peak.at, 1e-9);
  const Mat<3> difference = solid.stress(u, *place) - solid.law().cauchy(F);
  return {von_mises(difference) / peak.value, solid.stress_error(u, peak) / peak.value};
}

// Stresses of quadratic elements are of second order, and means at nodes of third inside: what they disagree about is the error.
TEST(Solid, stress_error_is_of_the_true_size_and_of_second_order) {
  for (const auto errors : {&stress_errors<2>, &stress_errors<3>}) {
    const auto coarse = errors(4), fine = errors(8);
    for (const auto& [is, told] : {coarse, fine}) {
      EXPECT_GT(told, is / 3);
      EXPECT_LT(told, is * 3);
    }
    EXPECT_LT(fine[1], coarse[1] / 2.5);
  }
}

TEST(Solid, a_patch_of_uniform_strain_is_exact) {
  expect_patch<2>();
  expect_patch<3>();
}

template <int d>
void expect_consistent() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  for (auto& law : laws<d>()) {
    const Solid<d> solid(crooked_box<d>(), std::move(law), 1);
    Field u(solid.size()), along(solid.size());
    for (double& x : u) x = uniform(random);
    for (double& x : along) x = uniform(random);
    Sparse K;
    solid.stiffness(u, K);
    const double step = 1e-4;
    const double power = (solid.strain_energy(u + step * along) - solid.strain_energy(u - step * along)) / (2 * step);
    const Field f = solid.internal_force(u);
    EXPECT_NEAR(power, f.dot(along), 1e-6 * f.norm() * along.norm());
    const Field slope = (solid.internal_force(u + step * along) - solid.internal_force(u - step * along)) / (2 * step);
    EXPECT_LT((slope - K * along).norm(), 1e-7 * slope.norm());
    // What is inside neither pushes nor turns the whole; small-strain laws turn it by what their strain does not see.
    Vec<d> push = Vec<d>::Zero();
    for (int a = 0; a < solid.mesh().size(); ++a) push += f.segment<d>(d * a);
    EXPECT_LT(push.norm(), 1e-13 * f.cwiseAbs().sum());
  }
}

TEST(Solid, force_is_the_slope_of_energy_and_stiffness_that_of_force) {
  expect_consistent<2>();
  expect_consistent<3>();
}

/// The error in L2 of an exact solution u(x), on meshes of h and h/2: -div P(u) is the load.
template <int d>
double manufactured_error(int n, const std::function<std::unique_ptr<const Law<d>>()>& law) {
  std::array<int, d> counts;
  counts.fill(n);
  Solid<d> solid(box_mesh<d>(Vec<d>::Ones(), counts), law(), 1);
  const double amplitude = 0.05, k = 2;
  const auto exact = [=](const Vec<d>& X) -> Vec<d> {
    Vec<d> u;
    for (int i = 0; i < d; ++i) u[i] = amplitude * std::sin(k * X[(i + 1) % d] + i) * std::cos(k * X[0]);
    return u;
  };
  const auto gradient = [=](const Vec<d>& X) -> Mat<d> {
    Mat<d> F = Mat<d>::Identity();
    for (int i = 0; i < d; ++i) {
      F(i, (i + 1) % d) += amplitude * k * std::cos(k * X[(i + 1) % d] + i) * std::cos(k * X[0]);
      F(i, 0) -= amplitude * k * std::sin(k * X[(i + 1) % d] + i) * std::sin(k * X[0]);
    }
    return F;
  };
  const auto load = solid.body_force([&](const Vec<d>& X) -> Vec<d> {
    const double step = 1e-4;  // central differences of the stress: 1e-8 of the load, far below the errors looked for
    Vec<d> b = Vec<d>::Zero();
    for (int J = 0; J < d; ++J) {
      const Vec<d> e = step * Vec<d>::Unit(J);
      b -= (solid.law().stress(gradient(X + e)) - solid.law().stress(gradient(X - e))).col(J) / (2 * step);
    }
    return b;
  });
  SolidState start = at_rest(solid), end;
  for (int a = 0; a < solid.mesh().size(); ++a) start.u.segment<d>(d * a) = exact(solid.mesh().nodes.col(a));
  for (const auto& facet : solid.mesh().facets)
    for (const int a : facet)
      for (int i = 0; i < d; ++i) solid.hold(d * a + i);
  const auto status = steady({.system = &solid, .load = always(load)})->step(start, 1, end);
  EXPECT_TRUE(status.ok()) << status.cause;
  return std::sqrt(solid.squared_difference(end.u, exact));
}

TEST(Solid, displacements_converge_with_order_3) {
  for (const auto& law :
       {std::function([] { return st_venant_kirchhoff<2>(soft); }), std::function([] { return neo_hookean<2>(soft); }),
        std::function([] { return small_strain<2>(soft); })})
    EXPECT_GT(std::log2(manufactured_error<2>(8, law) / manufactured_error<2>(16, law)), 2.9);
  const auto law = [] { return neo_hookean<3>(soft); };
  EXPECT_GT(std::log2(manufactured_error<3>(3, law) / manufactured_error<3>(6, law)),
            2.8);  // coarser: not yet at the limit
}

/// The tip's deflection of a cantilever ten times as long as high, by a parabola of shear at its end.
double deflection(double nu, int over_height, double F) {
  const double L = 10, height = 1;
  Solid<2> solid(box_mesh<2>({L, height}, {10 * over_height, over_height}), small_strain<2>({1, nu}), 1);
  solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
  const auto load = solid.traction([&](const Vec<2>& X, const Vec<2>&) -> Vec<2> {
    return {0, X.x() > L - 1e-9 ? 6 * F * X.y() * (height - X.y()) / std::pow(height, 3) : 0.};
  });
  return solid.value(equilibrium(solid, load), *locate<2>(solid.mesh(), {L, height / 2}, 1e-9)).y();
}

TEST(Solid, a_small_cantilever_is_timoshenkos_beam) {
  // F L^3/(3 E I) + F L/(5/6 G A); Poisson's ratio 0, so that the clamp holds nothing that a beam's does not.
  const double F = 1e-6, L = 10, beam = F * L * L * L / (3. / 12) + F * L / (5. / 6 * 0.5);
  EXPECT_NEAR(deflection(0, 4, F) / beam, 1, 0.001);
}

TEST(Solid, quadratic_elements_do_not_lock) {
  // What two elements over the height lose is the clamp's corners. It stays the same as Poisson's ratio goes to 1/2, where
  // elements that lock lose everything, and goes away with refinement.
  const auto lost = [](double nu, int over_height) {
    return 1 - deflection(nu, over_height, 1e-6) / deflection(nu, 8, 1e-6);
  };
  EXPECT_NEAR(lost(0.4999, 2), lost(0.499999, 2), 0.001);
  EXPECT_LT(lost(0.499999, 2), 0.04);
  EXPECT_LT(lost(0.499999, 4), 0.5 * lost(0.499999, 2));
}

TEST(Solid, a_cantilever_bent_far_follows_the_elastica) {
  // Tip load P L^2/(E I) = 1, 2, 5: deflections over L of the elastica (Mattiasson 1981, Int. J. Num. Meth. Eng. 17, table I).
  struct {
    double load, across, along;
  } const rows[] = {{1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}};
  const double L = 1, height = 0.01, Y = 1e6;  // Poisson's ratio 0: a beam's modulus, and nothing at the clamp
  for (const auto& row : rows) {
    Solid<2> solid(box_mesh<2>({L, height}, {60, 1}), st_venant_kirchhoff<2>({Y, 0}), 1);
    solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
    const double P = row.load * Y * std::pow(height, 3) / 12 / (L * L);
    const auto tip = locate<2>(solid.mesh(), {L, height / 2}, 1e-9);
    const Vec<2> moved = solid.value(equilibrium(solid, solid.point_force(*tip, {0, P})), *tip);
    // Shear and stretch of a beam 100 times as long as high: (h/L)^2 and P/(E A L), both 1e-4 at most, and the mesh.
    EXPECT_NEAR(moved.y() / L, row.across, 5e-4) << row.load;
    EXPECT_NEAR(-moved.x() / L, row.along, 5e-4) << row.load;
  }
}

TEST(Solid, point_masses_weigh_where_they_are) {
  Solid<2> solid(box_mesh<2>({2, 1}, {2, 1}), small_strain<2>(soft), 1);
  solid.add_point_mass(*locate<2>(solid.mesh(), {1.7, 0.3}, 1e-9), 2);
  EXPECT_NEAR(solid.total_mass(), 4, 1e-14);
  EXPECT_LT((solid.centre(Field::Zero(solid.size())) - Vec<2>(1.35, 0.4)).norm(), 1e-14);
}

TEST(Solid, a_density_is_positive) {
  EXPECT_THROW(Solid<2>(box_mesh<2>({1, 1}, {1, 1}), small_strain<2>(soft), 0), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::elastic::solid_test
