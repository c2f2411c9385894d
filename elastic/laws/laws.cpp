#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <stdexcept>

#include "elastic/laws/law.hpp"

namespace splashdown::elastic {
namespace {

struct Lame {
  double lambda, mu;
};

Lame lame_of(const Isotropic& moduli) {
  const double Y = moduli.young_modulus, nu = moduli.poisson_ratio;
  if (!(Y > 0 && std::isfinite(Y))) throw std::invalid_argument("young_modulus must be positive");
  if (!(nu > -1 && nu < 0.5)) throw std::invalid_argument("poisson_ratio must be between -1 and 0.5, both excluded");
  return {nu * Y / ((1 + nu) * (1 - 2 * nu)), Y / (2 * (1 + nu))};
}

/// The plane as a slice of space, where nothing happens across it.
template <int d>
Mat<3> in_space(const Mat<d>& plane, double across) {
  Mat<3> all = Mat<3>::Zero();
  all(2, 2) = across;
  all.topLeftCorner<d, d>() = plane;
  return all;
}

/// A(iJ, kL) = entry(i, J, k, L).
template <int d, class Entry>
Tangent<d> tangent_of(const Entry& entry) {
  Tangent<d> A;
  for (int L = 0; L < d; ++L)
    for (int k = 0; k < d; ++k)
      for (int J = 0; J < d; ++J)
        for (int i = 0; i < d; ++i) A(i + d * J, k + d * L) = entry(i, J, k, L);
  return A;
}

constexpr double delta(int i, int j) { return i == j ? 1 : 0; }

template <int d>
class StVenantKirchhoff final : public Law<d> {
 public:
  explicit StVenantKirchhoff(const Lame& lame) : lambda_(lame.lambda), mu_(lame.mu) {}
  double energy(const Mat<d>& F) const override {
    const Mat<d> E = strain(F);
    return lambda_ / 2 * E.trace() * E.trace() + mu_ * E.squaredNorm();
  }
  Mat<d> stress(const Mat<d>& F) const override { return F * second_piola(F); }
  Mat<d> stress_between(const Mat<d>& before, const Mat<d>& middle) const override {
    const Mat<d> half = middle - before;  // (E_before + E_after)/2 = E_middle + half^T half / 2
    return second_piola_of(strain(middle) + 0.5 * half.transpose() * half);
  }
  Mat<d> stress_change(const Mat<d>& before, const Mat<d>& middle) const override {
    const Mat<d> rate = middle.transpose() * (middle - before);  // E_after - E_before, once more transposed
    return second_piola_of(rate + rate.transpose());
  }
  Mat<d> second_piola(const Mat<d>& F) const override { return second_piola_of(strain(F)); }
  Tangent<d> tangent(const Mat<d>& F) const override {
    const Mat<d> S = second_piola(F), b = F * F.transpose();
    return tangent_of<d>([&](int i, int J, int k, int L) {
      return delta(i, k) * S(J, L) + lambda_ * F(i, J) * F(k, L) + mu_ * (F(i, L) * F(k, J) + delta(J, L) * b(i, k));
    });
  }
  Mat<3> cauchy(const Mat<d>& F) const override {
    const Mat<d> in_plane = F * second_piola(F) * F.transpose();
    return in_space<d>(in_plane, lambda_ * strain(F).trace()) / F.determinant();
  }
  double wave_modulus() const override { return lambda_ + 2 * mu_; }

 private:
  static Mat<d> strain(const Mat<d>& F) { return 0.5 * (F.transpose() * F - Mat<d>::Identity()); }
  Mat<d> second_piola_of(const Mat<d>& E) const { return lambda_ * E.trace() * Mat<d>::Identity() + 2 * mu_ * E; }
  double lambda_, mu_;
};

template <int d>
class NeoHookean final : public Law<d> {
 public:
  explicit NeoHookean(const Lame& lame) : lambda_(lame.lambda), mu_(lame.mu) {}
  double energy(const Mat<d>& F) const override {
    const double log_J = std::log(F.determinant());
    return mu_ / 2 * (F.squaredNorm() - d - 2 * log_J) + lambda_ / 2 * log_J * log_J;
  }
  Mat<d> stress(const Mat<d>& F) const override {
    const Mat<d> back = F.inverse().transpose();
    return mu_ * (F - back) + lambda_ * std::log(F.determinant()) * back;
  }
  Tangent<d> tangent(const Mat<d>& F) const override {
    const Mat<d> back = F.inverse().transpose();
    const double rest = mu_ - lambda_ * std::log(F.determinant());
    return tangent_of<d>([&](int i, int J, int k, int L) {
      return mu_ * delta(i, k) * delta(J, L) + rest * back(i, L) * back(k, J) + lambda_ * back(i, J) * back(k, L);
    });
  }
  Mat<3> cauchy(const Mat<d>& F) const override {
    const double J = F.determinant();
    const Mat<d> in_plane = stress(F) * F.transpose();
    return in_space<d>(in_plane, lambda_ * std::log(J)) / J;
  }
  double wave_modulus() const override { return lambda_ + 2 * mu_; }

 private:
  double lambda_, mu_;
};

/// Any moduli, c_ijkl of space by 9 x 9 with pairs taken by columns.
template <int d>
class SmallStrain final : public Law<d> {
 public:
  explicit SmallStrain(const Eigen::Matrix<double, 9, 9>& moduli) : c_(moduli) {
    in_plane_ = tangent_of<d>([&](int i, int J, int k, int L) { return c_(i + 3 * J, k + 3 * L); });
  }
  double energy(const Mat<d>& F) const override { return 0.5 * strain(F).cwiseProduct(stress(F)).sum(); }
  Mat<d> stress(const Mat<d>& F) const override {
    const Mat<d> e = strain(F);
    Mat<d> sigma;
    sigma.reshaped() = in_plane_ * e.reshaped();
    return sigma;
  }
  Tangent<d> tangent(const Mat<d>&) const override { return in_plane_; }
  Mat<3> cauchy(const Mat<d>& F) const override {
    const Mat<3> e = in_space<d>(strain(F), 0.);
    Mat<3> sigma;
    sigma.reshaped() = c_ * e.reshaped();
    return sigma;
  }
  bool linear() const override { return true; }
  double wave_modulus() const override { return std::max({c_(0, 0), c_(4, 4), c_(8, 8)}); }

 private:
  static Mat<d> strain(const Mat<d>& F) { return 0.5 * (F + F.transpose()) - Mat<d>::Identity(); }
  Eigen::Matrix<double, 9, 9> c_;
  Tangent<d> in_plane_;
};

/// c_ijkl in the frame of the body, from Voigt's 6 x 6 along the axes of the material.
Eigen::Matrix<double, 9, 9> turned(const Eigen::Matrix<double, 6, 6>& voigt, const Mat<3>& axes) {
  constexpr int of[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  Eigen::Matrix<double, 9, 9> own, turn;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < 3; ++l)
        for (int k = 0; k < 3; ++k) {
          own(i + 3 * j, k + 3 * l) = voigt(of[i][j], of[k][l]);
          turn(i + 3 * j, k + 3 * l) = axes(i, k) * axes(j, l);
        }
  return turn * own * turn.transpose();
}

Eigen::Matrix<double, 6, 6> stiffness_of(const Orthotropic& m) {
  for (const double modulus : {m.E1, m.E2, m.E3, m.G12, m.G13, m.G23})
    if (!(modulus > 0 && std::isfinite(modulus))) throw std::invalid_argument("moduli must be positive");
  Mat<3> compliance;
  compliance << 1 / m.E1, -m.nu12 / m.E1, -m.nu13 / m.E1, -m.nu12 / m.E1, 1 / m.E2, -m.nu23 / m.E2, -m.nu13 / m.E1,
      -m.nu23 / m.E2, 1 / m.E3;
  if (Eigen::LLT<Mat<3>> positive(compliance); !compliance.allFinite() || positive.info() != Eigen::Success)
    throw std::invalid_argument(
        "Poisson's ratios must leave the energy positive: nu_ij^2 < E_i/E_j for each pair, and for all together");
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>() = compliance.inverse();
  C(3, 3) = m.G23, C(4, 4) = m.G13, C(5, 5) = m.G12;
  return C;
}

}  // namespace

template <int d>
std::unique_ptr<const Law<d>> st_venant_kirchhoff(const Isotropic& moduli) {
  return std::make_unique<StVenantKirchhoff<d>>(lame_of(moduli));
}
template <int d>
std::unique_ptr<const Law<d>> neo_hookean(const Isotropic& moduli) {
  return std::make_unique<NeoHookean<d>>(lame_of(moduli));
}
template <int d>
std::unique_ptr<const Law<d>> small_strain(const Isotropic& moduli) {
  const auto [lambda, mu] = lame_of(moduli);
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  C.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  return std::make_unique<SmallStrain<d>>(turned(C, Mat<3>::Identity()));
}
template <int d>
std::unique_ptr<const Law<d>> orthotropic(const Orthotropic& moduli) {
  return std::make_unique<SmallStrain<d>>(turned(stiffness_of(moduli), moduli.axes));
}

template std::unique_ptr<const Law<2>> st_venant_kirchhoff<2>(const Isotropic&);
template std::unique_ptr<const Law<3>> st_venant_kirchhoff<3>(const Isotropic&);
template std::unique_ptr<const Law<2>> neo_hookean<2>(const Isotropic&);
template std::unique_ptr<const Law<3>> neo_hookean<3>(const Isotropic&);
template std::unique_ptr<const Law<2>> small_strain<2>(const Isotropic&);
template std::unique_ptr<const Law<3>> small_strain<3>(const Isotropic&);
template std::unique_ptr<const Law<2>> orthotropic<2>(const Orthotropic&);
template std::unique_ptr<const Law<3>> orthotropic<3>(const Orthotropic&);

}  // namespace splashdown::elastic
