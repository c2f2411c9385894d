#include <gtest/gtest.h>

#include "solids.hpp"

namespace splashdown::elastic::law_test {
namespace {

template <int d>
Mat<d> some_gradient(double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  Mat<d> F = Mat<d>::Identity();
  for (double& x : F.reshaped()) x += uniform(random);
  return F;
}

template <int d>
Mat<d> some_rotation() {
  if constexpr (d == 2)
    return Eigen::Rotation2Dd(0.9).toRotationMatrix();
  else
    return (Eigen::AngleAxisd(0.9, Vec<3>::UnitX()) * Eigen::AngleAxisd(-1.7, Vec<3>::UnitZ())).toRotationMatrix();
}

/// A ply of carbon fibres (Jones 1999, table 2.3, graphite-epoxy) with its fibres 30 degrees off x.
Orthotropic ply() {
  Orthotropic moduli{
      .E1 = 181, .E2 = 10.3, .E3 = 10.3, .nu12 = 0.28, .nu13 = 0.28, .nu23 = 0.5, .G12 = 7.17, .G13 = 7.17, .G23 = 3.4};
  moduli.axes = Eigen::AngleAxisd(std::numbers::pi / 6, Vec<3>::UnitZ()).toRotationMatrix();
  return moduli;
}

template <int d>
std::vector<std::unique_ptr<const Law<d>>> all_laws() {
  std::vector<std::unique_ptr<const Law<d>>> laws;
  laws.push_back(st_venant_kirchhoff<d>(soft));
  laws.push_back(neo_hookean<d>(soft));
  laws.push_back(small_strain<d>(soft));
  laws.push_back(orthotropic<d>(ply()));
  return laws;
}

template <int d>
void expect_derivatives() {
  const double step = 1e-5;
  for (const auto& law : all_laws<d>())
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Mat<d> F = some_gradient<d>(0.2, seed);
      const Mat<d> P = law->stress(F);
      const Tangent<d> A = law->tangent(F);
      // Central differences err by step^2 times a third derivative, which is of the size of the moduli, and by roundoff / step.
      const double tolerance = 1e-8 * A.cwiseAbs().maxCoeff();
      for (int k = 0; k < d * d; ++k) {
        Mat<d> more = F, less = F;
        more.reshaped()[k] += step;
        less.reshaped()[k] -= step;
        EXPECT_NEAR((law->energy(more) - law->energy(less)) / (2 * step), P.reshaped()[k], tolerance);
        const Mat<d> slope = (law->stress(more) - law->stress(less)) / (2 * step);
        for (int i = 0; i < d * d; ++i) EXPECT_NEAR(slope.reshaped()[i], A(i, k), tolerance);
      }
      EXPECT_LT((A - A.transpose()).cwiseAbs().maxCoeff(), 1e-14 * A.cwiseAbs().maxCoeff());
    }
}

TEST(Law, stress_is_the_slope_of_energy_and_tangent_that_of_stress) {
  expect_derivatives<2>();
  expect_derivatives<3>();
}

template <int d>
void expect_objective() {
  const Mat<d> Q = some_rotation<d>(), F = some_gradient<d>(0.2, 7);
  Mat<3> in_space = Mat<3>::Identity();
  in_space.topLeftCorner<d, d>() = Q;
  for (const auto& law : {st_venant_kirchhoff<d>(soft).release(), neo_hookean<d>(soft).release()}) {
    const std::unique_ptr<const Law<d>> owned(law);
    EXPECT_NEAR(law->energy(Q * F), law->energy(F), 1e-15);
    EXPECT_LT((law->stress(Q * F) - Q * law->stress(F)).norm(), 1e-15);
    EXPECT_LT((law->cauchy(Q * F) - in_space * law->cauchy(F) * in_space.transpose()).norm(), 1e-15);
    EXPECT_LT(law->stress(Q).norm(), 1e-15) << "a rotation strains nothing";
  }
}

TEST(Law, what_turns_with_the_body_is_told_in_its_frame) {
  expect_objective<2>();
  expect_objective<3>();
}

TEST(Law, cauchys_stress_is_symmetric_and_that_of_plane_strain_is_a_slice_of_space) {
  const auto planes = all_laws<2>();
  const auto spaces = all_laws<3>();
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const Mat<2> F = some_gradient<2>(0.1, 3);
    Mat<3> all = Mat<3>::Identity();
    all.topLeftCorner<2, 2>() = F;
    const Mat<3> sigma = spaces[k]->cauchy(all);
    const double size = sigma.cwiseAbs().maxCoeff();
    EXPECT_LT((planes[k]->cauchy(F) - sigma).cwiseAbs().maxCoeff(), 1e-14 * size);
    EXPECT_LT((sigma - sigma.transpose()).cwiseAbs().maxCoeff(), 1e-14 * size);
    EXPECT_NEAR(planes[k]->energy(F), spaces[k]->energy(all), 1e-14 * size);
  }
}

TEST(Law, all_are_the_same_for_small_strains) {
  const Mat<3> little = 1e-6 * (some_gradient<3>(1, 2) - Mat<3>::Identity());
  const Mat<3> F = Mat<3>::Identity() + little, linear = small_strain<3>(soft)->stress(F);
  for (const auto& law : {st_venant_kirchhoff<3>(soft).release(), neo_hookean<3>(soft).release()}) {
    const std::unique_ptr<const Law<3>> owned(law);
    EXPECT_LT((law->stress(F) - linear).norm(), 5e-6 * linear.norm()) << "of the order of the strain";
  }
}

TEST(Law, fibres_carry_as_they_lie) {
  // Pulled along the fibres by E1 e, free across: sigma = E1 e there, and -nu12 e across.
  auto moduli = ply();
  const auto law = orthotropic<3>(moduli);
  Mat<3> own = Mat<3>::Zero();
  own.diagonal() << 1e-3, -moduli.nu12 * 1e-3, -moduli.nu13 * 1e-3;
  const Mat<3> F = Mat<3>::Identity() + moduli.axes * own * moduli.axes.transpose();
  const Mat<3> sigma = moduli.axes.transpose() * law->cauchy(F) * moduli.axes;
  EXPECT_NEAR(sigma(0, 0), moduli.E1 * 1e-3, 1e-13);
  EXPECT_LT((sigma - Mat<3>(Vec<3>(sigma(0, 0), 0, 0).asDiagonal())).norm(), 1e-13);
}

TEST(Law, an_orthotropic_material_with_equal_moduli_is_isotropic) {
  const double Y = 2, nu = 0.3, G = Y / (2 * (1 + nu));
  Orthotropic moduli{.E1 = Y, .E2 = Y, .E3 = Y, .nu12 = nu, .nu13 = nu, .nu23 = nu, .G12 = G, .G13 = G, .G23 = G};
  moduli.axes = some_rotation<3>();
  const Mat<3> F = some_gradient<3>(0.1, 1);
  EXPECT_LT((orthotropic<3>(moduli)->stress(F) - small_strain<3>({Y, nu})->stress(F)).norm(), 1e-14);
}

TEST(Law, moduli_that_no_solid_has_are_refused) {
  for (const Isotropic wrong :
       {Isotropic{0, 0.3}, Isotropic{-1, 0.3}, Isotropic{1, 0.5}, Isotropic{1, -1}, Isotropic{1, NAN}}) {
    EXPECT_THROW(st_venant_kirchhoff<2>(wrong), std::invalid_argument);
    EXPECT_THROW(neo_hookean<3>(wrong), std::invalid_argument);
    EXPECT_THROW(small_strain<2>(wrong), std::invalid_argument);
  }
  auto wrong = ply();
  wrong.nu23 = 1;
  EXPECT_THROW(orthotropic<3>(wrong), std::invalid_argument);
  wrong = ply();
  wrong.G12 = 0;
  EXPECT_THROW(orthotropic<2>(wrong), std::invalid_argument);
}

TEST(Law, von_mises_stress_of_a_pulled_bar_is_the_pull) {
  Mat<3> sigma = Mat<3>::Zero();
  sigma(1, 1) = -3;
  EXPECT_DOUBLE_EQ(von_mises(sigma), 3);
  EXPECT_NEAR(von_mises(sigma + 5 * Mat<3>::Identity()), 3, 1e-15) << "pressure does not count";
}

}  // namespace
}  // namespace splashdown::elastic::law_test
