// Outlines and flows that tests of the moving mesh share.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "fluid/ale/fluid.hpp"
#include "tests/unit/core/outlines.hpp"

namespace splashdown::ale::scenes {

using outlines::box;
using outlines::polygon;
inline Surface<2> circle(double radius, int corners = 400) { return outlines::circle(radius, corners); }
inline Isometry<2> at(double x, double y, double angle = 0) {
  Isometry<2> pose = Isometry<2>::Identity();
  pose.linear() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  pose.translation() = Vec<2>(x, y);
  return pose;
}

/// A step of a flow with its own leapfrog clock. Throws std::runtime_error where it is refused.
inline void step(AleFlow& flow, double dt, double& before, const Eigen::VectorXd& rates = {},
                 const Eigen::VectorXd& placements = {}) {
  auto status = flow.begin(0.5 * (before + dt), dt);
  if (status.ok()) status = flow.solve(rates);
  if (!status.ok()) throw std::runtime_error(status.cause);
  flow.commit(placements);
  before = dt;
}

/// L2 norm of what differs from a field, at nodes that carry it at a time; `axis` -1: both components.
template <class Exact>
double error(const FlowMesh& mesh, const Nodes& places, const Nodes& values, Exact exact) {
  Nodes difference = values;
  for (Eigen::Index a = 0; a < values.cols(); ++a) difference.col(a) -= exact(Vec<2>(places.col(a)));
  return std::sqrt(2 * FlowEquations(mesh, 1, 1, {}).kinetic_energy(places, difference));
}

}  // namespace splashdown::ale::scenes
