// How the mass of a body is spread, as far as sections through it need it.
//
//   rho(r) = a + g . r within the hull, and point masses:   sum m_i + integral rho dV = m,   sum m_i r_i + integral rho r dV = 0
//
// r from the centre of mass, body axes; a and g are what makes the mass and its centre those of the body: g = 0 for a homogeneous one. The
// moments of inertia are those that follow. Hulls are cut exactly, and integrals of the third degree are exact.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/types.hpp"

namespace splashdown::apps {

/// Of the part of a body ahead of a section, about the body's centre of mass, body axes; z = 0 in two dimensions.
struct SectionMass {
  double mass = 0;                                   ///< [kg, kg/m]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< sum of m r [kg m]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum of m r r^T [kg m^2]
};

template <int d>
struct PointMass {
  double mass = 0;             ///< [kg, kg/m]
  Vec<d> at = Vec<d>::Zero();  ///< from the centre of mass, body axes [m]
};

template <int d>
struct MassDistribution {
  Surface<d> hull;                   ///< body frame
  double mean = 0;                   ///< a [kg/m^3]
  Vec<d> gradient = Vec<d>::Zero();  ///< g [kg/m^4]
  std::vector<PointMass<d>> points;
};

/// Of a body of this mass with these heavy parts: the rest fills the hull.
template <int d>
MassDistribution<d> distributed(const Surface<d>& hull, double mass, std::vector<PointMass<d>> points);

/// The lowest density in the hull [kg/m^3]: negative where no filling of it has such a centre of mass.
template <int d>
double lowest_density(const MassDistribution<d>& body);

/// What lies where axis . r >= station; `axis`: of unit length.
template <int d>
SectionMass mass_ahead(const MassDistribution<d>& body, const Vec<d>& axis, double station);

}  // namespace splashdown::apps
