// Small scenes shared by the tests of the rigid-body room.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "rigid/bodies.hpp"
#include "rigid/forces/gravity.hpp"
#include "rigid/shapes/mass_properties.hpp"
#include "rigid/shapes/shapes.hpp"

namespace splashdown::rigid {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

template <int d>
BodySpec<d> free_body(double mass, const Inertia<d>& inertia) {
  BodySpec<d> spec;
  spec.name = "hull";
  spec.mass = mass;
  spec.inertia = inertia;
  spec.free.fill(true);
  return spec;
}

/// 2D body with all freedoms, 3 kg/m and 0.7 kg m.
inline BodySpec<2> planar_body() { return free_body<2>(3, Inertia<2>(0.7)); }

/// 3D body with three different moments of inertia about axes that are not the body axes.
inline BodySpec<3> skew_body() {
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return free_body<3>(2, axes * Eigen::Vector3d(1, 2, 2.6).asDiagonal() * axes.transpose());
}

template <int d>
Bodies<d> alone(const BodySpec<d>& spec, std::vector<std::unique_ptr<Force<d>>> forces = {}) {
  return Bodies<d>({spec}, std::move(forces));
}

template <int d>
BodySpec<d> of_shape(const Shape<d>& shape, const Vec<d>& centre, double mass = 2) {
  const auto properties = with_mass<d>(shape.at_unit_density, mass);
  BodySpec<d> spec = free_body<d>(mass, properties.inertia);
  spec.surface = centred<d>(shape.surface, properties.centre);
  spec.pose.translation() = centre;
  return spec;
}

/// A sphere of 0.5 m without forces on it.
template <int d>
BodySpec<d> lump(double mass, const Vec<d>& centre) {
  BodySpec<d> spec = free_body<d>(mass, Inertia<d>::Identity() * 0.1 * mass);
  spec.surface.vertices = 0.5 * Eigen::Matrix<double, d, d>::Identity();
  spec.pose.translation() = centre;
  return spec;
}

template <int d>
std::vector<std::unique_ptr<Force<d>>> pull(const Vec<d>& acceleration) {
  std::vector<std::unique_ptr<Force<d>>> forces;
  forces.push_back(std::make_unique<Gravity<d>>(acceleration));
  return forces;
}

/// Steps without a load; `first`: of a run, with half a kick.
template <int d>
void run(Bodies<d>& bodies, int steps, double dt = 1e-3, bool first = true) {
  for (int i = 0; i < steps; ++i) {
    bodies.begin(first && i == 0 ? dt / 2 : dt, dt);
    bodies.solve(std::vector<Wrench<d>>(bodies.size(), Wrench<d>::Zero()));
    bodies.commit();
  }
}

/// One step under a load on the only body.
template <int d>
void step(Bodies<d>& bodies, double kick, double dt, const Wrench<d>& load = Wrench<d>::Zero()) {
  bodies.begin(kick, dt);
  bodies.solve(std::vector{load});
  bodies.commit();
}

/// Velocity change of all bodies per unit impulse, Z (Z^T M Z)^-1 Z^T: of a begun step.
template <int d>
Eigen::MatrixXd compliance(const Bodies<d>& bodies) {
  const auto all = bodies.response();
  const Eigen::MatrixXd modes = all.modal.modes * all.contacts.directions;
  return modes * (all.contacts.directions.transpose() * all.modal.inertia * all.contacts.directions).inverse() *
         modes.transpose();
}

/// Same bits, NaN included.
template <int d>
bool identical(const BodyState<d>& a, const BodyState<d>& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::equal(x.data(), x.data() + x.size(), y.data(),
                      [](double s, double t) { return s == t || (s != s && t != t); });
  };
  return same(a.pose.matrix(), b.pose.matrix()) && same(a.velocity, b.velocity);
}

inline double angle(const Isometry<2>& pose) { return std::atan2(pose(1, 0), pose(0, 0)); }

/// What `make` is refused with; empty: it is not.
template <class Make>
std::string failure(Make make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace splashdown::rigid
