#include "fluid/effects/form_drag/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense.hpp"

namespace splashdown::fluid {
namespace {

// From -1 behind to 1 ahead, odd, level at both ends.
double side(double cosine) {
  const double squared = cosine * cosine;
  return cosine * (15 - 10 * squared + 3 * squared * squared) / 8;
}

}  // namespace

template <int d>
HullSphere<d> sphere_around(const Surface<d>& surface) {
  HullSphere<d> sphere;
  sphere.centre = 0.5 * (surface.vertices.rowwise().minCoeff() + surface.vertices.rowwise().maxCoeff());
  sphere.radius = (surface.vertices.colwise() - sphere.centre).colwise().norm().maxCoeff();
  double volume_sum = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = surface.vertices.col(surface.facets(k, f));
    volume_sum += (corner[0] - sphere.centre).dot(area_vector(corner)) / d;
  }
  const double of_unit = d == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;
  sphere.breadth = std::pow(std::abs(volume_sum) / of_unit, 1.0 / d);
  return sphere;
}

template <int d>
Surroundings<d>::Surroundings(const StepView<d>& step, const Vec<d>& centre, double radius, int wall,
                              const std::optional<Mirror>& mirror) {
  if (mirror) kept_ = mirror->kept<d>();
  for (std::size_t i = 0; i < step.nodes.size(); ++i) {
    if (step.nodes.spray[i] || step.nodes.tie[i].wall == wall) continue;
    const Vec<d> arm = step.nodes.x[i] - centre;
    const double squared = arm.squaredNorm(), mass = step.density * step.lumped_volume[i];
    if (mass > 0 && squared > radius * radius && squared < 4 * radius * radius)
      around_.push_back({static_cast<int>(i), arm, mass});
  }
}

template <int d>
void Surroundings<d>::face(const Vec<d>& direction) {
  const double length = direction.norm();
  for (Around& one : around_) one.side = length > 0 ? side(direction.dot(one.arm) / (length * one.arm.norm())) : 0;
}

template <int d>
template <class Weight>
Eigen::Matrix<double, freedoms<d>, freedoms<d>> Surroundings<d>::inertia(Weight weight) const {
  Eigen::Matrix<double, freedoms<d>, freedoms<d>> sum = Eigen::Matrix<double, freedoms<d>, freedoms<d>>::Zero();
  for (const Around& one : around_)
    for (int k = 0; k < freedoms<d>; ++k)
      sum.col(k) += weight(one) * wrench_of<d>(one.arm, rigid_velocity<d>(Twist<d>::Unit(k), one.arm));
  return sum;
}

template <int d>
Twist<d> Surroundings<d>::motion_of(const Eigen::Matrix<double, freedoms<d>, freedoms<d>>& inertia,
                                    const Wrench<d>& momentum) const {
  return algebra::least_squares(kept_.asDiagonal() * inertia * kept_.asDiagonal(), kept_.cwiseProduct(momentum));
}

template <int d>
Twist<d> Surroundings<d>::ahead(std::span<const Vec<d>> v) const {
  const auto weight = [](const Around& one) { return one.mass * (1 + one.side); };
  Wrench<d> momentum = Wrench<d>::Zero();
  for (const Around& one : around_) momentum += weight(one) * wrench_of<d>(one.arm, v[one.node]);
  return motion_of(inertia(weight), momentum);
}

template <int d>
std::vector<std::pair<int, Vec<d>>> Surroundings<d>::behind(const Wrench<d>& impulse, double& fastest) const {
  const auto weight = [](const Around& one) { return one.mass * (1 - one.side); };
  const Twist<d> change = motion_of(inertia(weight), impulse);
  std::vector<std::pair<int, Vec<d>>> changes;
  fastest = 0;
  for (const Around& one : around_) {
    changes.emplace_back(one.node, (1 - one.side) * rigid_velocity<d>(change, one.arm));
    fastest = std::max(fastest, changes.back().second.norm());
  }
  return changes;
}

template HullSphere<2> sphere_around(const Surface<2>&);
template HullSphere<3> sphere_around(const Surface<3>&);
template class Surroundings<2>;
template class Surroundings<3>;

}  // namespace splashdown::fluid
