#include "rigid/shapes/mass_properties.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rigid/embedding.hpp"
#include "rigid/message.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

using std::numbers::pi;

MassProperties<2> planar(double mass, double height_of_centre, double polar_inertia) {
  MassProperties<2> p;
  p.mass = mass;
  p.centre.y() = height_of_centre;
  p.inertia(0, 0) = polar_inertia;
  return p;
}

}  // namespace

template <int d>
MassProperties<d> mass_properties(const Surface<d>& surface) {
  // Cones from a point amid the surface, so that a far origin costs no digits.
  const Vec<d> apex = surface.vertices.rowwise().mean();
  double volume = 0;
  Vec<d> first = Vec<d>::Zero();
  Eigen::Matrix<double, d, d> second = Eigen::Matrix<double, d, d>::Zero();
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    FacetCorners<d> corners = facet_corners(surface, f);
    for (Vec<d>& x : corners) x -= apex;
    const CornerSums<d> sums(corners);
    const double cone = cone_measure<d>(corners);
    volume += cone;
    first += cone / (d + 1) * sums.first;
    second += cone / ((d + 1) * (d + 2)) * sums.second;
  }
  if (!(volume > 0))
    throw std::invalid_argument(message("surface: encloses ", volume, " m^", d,
                                        "; it must be closed, with normals that point out of the body"));
  const Vec<d> centre = first / volume;
  second -= volume * centre * centre.transpose();

  // I = tr(S) 1 - S in 3D; a planar body has S_zz = 0 and keeps the entry about z.
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  s.topLeftCorner<d, d>() = second;
  const Eigen::Matrix3d inertia = s.trace() * Eigen::Matrix3d::Identity() - s;
  MassProperties<d> p;
  p.mass = volume;
  p.centre = apex + centre;
  p.inertia = inertia.bottomRightCorner<rotations<d>, rotations<d>>();
  return p;
}

template <int d>
MassProperties<d> with_density(const MassProperties<d>& unit_density, double density) {
  if (!(density >= 0 && std::isfinite(density)))
    throw std::invalid_argument(message("density is ", density, " kg/m^3; it must not be negative"));
  return {density * unit_density.mass, unit_density.centre, density * unit_density.inertia};
}

template <int d>
MassProperties<d> with_mass(const MassProperties<d>& any_density, double mass) {
  if (!(mass >= 0 && std::isfinite(mass)))
    throw std::invalid_argument(message("mass is ", mass, "; it must not be negative"));
  return {mass, any_density.centre, mass / any_density.mass * any_density.inertia};
}

MassProperties<2> box_mass_properties(double width, double height) {
  const double area = width * height;
  return planar(area, 0, area * (width * width + height * height) / 12);
}

MassProperties<2> ellipse_mass_properties(double a, double b) {
  const double area = pi * a * b;
  return planar(area, 0, area * (a * a + b * b) / 4);
}

MassProperties<2> capsule_mass_properties(double radius, double straight) {
  // Two half discs about the centres of their flats, shifted by straight / 2; a half disc's centroid lies
  // 4 r / (3 pi) from its flat.
  const MassProperties<2> middle = box_mass_properties(straight, 2 * radius);
  const double r2 = radius * radius, discs = pi * r2;
  const double polar = discs * r2 / 2 + discs * straight * straight / 4 + 4. / 3. * r2 * radius * straight;
  return planar(middle.mass + discs, 0, middle.inertia(0, 0) + polar);
}

MassProperties<2> wedge_mass_properties(double deadrise, double breadth, double side) {
  const double height = breadth / 2 * std::tan(deadrise);
  const double below = breadth * height / 2, above = breadth * side;
  const double below_centre = 2 * height / 3, above_centre = height + side / 2;
  const double below_inertia = below * (height * height / 18 + breadth * breadth / 24);
  const double above_inertia = above * (breadth * breadth + side * side) / 12;
  const double area = below + above;
  const double distance = above_centre - below_centre;
  return planar(area, (below * below_centre + above * above_centre) / area,
                below_inertia + above_inertia + below * above / area * distance * distance);
}

template MassProperties<2> mass_properties<2>(const Surface<2>&);
template MassProperties<3> mass_properties<3>(const Surface<3>&);
template MassProperties<2> with_density<2>(const MassProperties<2>&, double);
template MassProperties<3> with_density<3>(const MassProperties<3>&, double);
template MassProperties<2> with_mass<2>(const MassProperties<2>&, double);
template MassProperties<3> with_mass<3>(const MassProperties<3>&, double);

}  // namespace splashdown::rigid
