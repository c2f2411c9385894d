// How a solid resists: energy, stress and tangent at a deformation gradient F = dx/dX. With E = (F^T F - 1)/2,
// e = sym(F) - 1 and Lame's lambda = nu Y/((1 + nu)(1 - 2 nu)), mu = Y/(2 (1 + nu)) of Young's modulus Y
//
//   St. Venant-Kirchhoff  psi = lambda/2 (tr E)^2 + mu E : E                            S = lambda tr(E) 1 + 2 mu E
//   neo-Hookean           psi = mu/2 (tr F^T F - 3 - 2 ln J) + lambda/2 (ln J)^2        (Bonet, Wood 2008, eq. 6.27)
//   small strain          psi = lambda/2 (tr e)^2 + mu e : e                            sigma = lambda tr(e) 1 + 2 mu e
//   orthotropic           psi = e : C : e / 2, nine moduli along axes of the material   (Jones 1999, eq. 2.23-2.26)
//
// P = d psi/dF = F S is the first Piola stress, S the second, sigma = P F^T / J Cauchy's. In the plane, strain is plane:
// F_33 = 1. The first two are objective, psi(QF) = psi(F); the others are for small rotations.
#pragma once

#include <memory>

#include "core/types.hpp"

namespace splashdown::elastic {

/// dP/dF of F and P taken by columns, symmetric [Pa].
template <int d>
using Tangent = Eigen::Matrix<double, d * d, d * d>;

/// A law, the same everywhere in a solid.
template <int d>
class Law {
 public:
  virtual ~Law() = default;
  /// psi [J/m^3]; not finite where F cannot be.
  virtual double energy(const Mat<d>& F) const = 0;
  /// P = d psi/dF [Pa].
  virtual Mat<d> stress(const Mat<d>& F) const = 0;
  /// S of a step from `before` through `middle`, for P = F_middle S. Where psi is quadratic in E its work over the step is the
  /// change of psi, exactly: S((E_before + E_after)/2) (Simo, Tarnow 1992). Else S(F_middle) [Pa].
  virtual Mat<d> stress_between(const Mat<d>& /*before*/, const Mat<d>& middle) const { return second_piola(middle); }
  /// S after that step less S before it [Pa].
  virtual Mat<d> stress_change(const Mat<d>& before, const Mat<d>& middle) const {
    return second_piola(2 * middle - before) - second_piola(before);
  }
  /// S = F^-1 P [Pa].
  virtual Mat<d> second_piola(const Mat<d>& F) const { return F.inverse() * stress(F); }
  /// dP/dF [Pa].
  virtual Tangent<d> tangent(const Mat<d>& F) const = 0;
  /// sigma [Pa], with what plane strain needs across the plane.
  virtual Mat<3> cauchy(const Mat<d>& F) const = 0;
  /// Whether the stress is linear in F, so that the tangent is the same everywhere.
  virtual bool linear() const { return false; }
  /// Of waves of compression, the fastest in the unloaded solid, squared and times the density [Pa].
  virtual double wave_modulus() const = 0;
};

/// Young's modulus [Pa] and Poisson's ratio.
struct Isotropic {
  double young_modulus = 0;
  double poisson_ratio = 0;
};

/// Moduli along the axes of a material [Pa]; nu_ij: strain along j, negative, for one along i.
struct Orthotropic {
  double E1 = 0, E2 = 0, E3 = 0;
  double nu12 = 0, nu13 = 0, nu23 = 0;
  double G12 = 0, G13 = 0, G23 = 0;
  Mat<3> axes = Mat<3>::Identity();  ///< a column each in the frame of the body; the third is z in the plane
};

/// Large rotations, moderate strain. Throws std::invalid_argument, as all here, with the rule, unless the moduli make psi
/// positive: Y > 0, -1 < nu < 1/2.
template <int d>
std::unique_ptr<const Law<d>> st_venant_kirchhoff(const Isotropic& moduli);
/// Large rotations and strains; resists being crushed without limit.
template <int d>
std::unique_ptr<const Law<d>> neo_hookean(const Isotropic& moduli);
/// Small rotations and strains.
template <int d>
std::unique_ptr<const Law<d>> small_strain(const Isotropic& moduli);
/// The same of an orthotropic material, a ply for example: positive moduli, positive compliance.
template <int d>
std::unique_ptr<const Law<d>> orthotropic(const Orthotropic& moduli);

/// sqrt(3/2 s : s), s the deviator of Cauchy's stress [Pa].
inline double von_mises(const Mat<3>& sigma) {
  const Mat<3> s = sigma - sigma.trace() / 3 * Mat<3>::Identity();
  return std::sqrt(1.5) * s.norm();
}

}  // namespace splashdown::elastic
