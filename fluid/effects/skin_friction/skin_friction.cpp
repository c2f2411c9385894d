#include "fluid/effects/skin_friction/skin_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense.hpp"

namespace splashdown::fluid {

template <int d>
Status SkinFriction<d>::begin(const StepView<d>& step) {
  wetted_.clear();
  nodes_of_.assign(spec_.hulls, {});
  std::vector<char> seen(step.nodes.size(), 0);
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0 || static_cast<std::size_t>(f.wall) >= spec_.hulls) continue;
    const Vec<d> area = area_vector_of<d>(f, step.nodes.x);
    if (area.isZero(0)) continue;
    Vec<d> centre = Vec<d>::Zero();
    for (int n : f.nodes) {
      centre += step.nodes.x[n] / d;
      if (!seen[n]) nodes_of_[f.wall].push_back(n);
      seen[n] = 1;
    }
    int inner = f.nodes[0];
    for (const auto [c, k] : step.around.around(f.nodes[0])) {
      auto of_facet = [&](int n) { return std::find(f.nodes.begin(), f.nodes.end(), n) != f.nodes.end(); };
      const auto& cell = step.mesh.cells[c];
      if (std::count_if(cell.begin(), cell.end(), of_facet) == d)
        inner = *std::find_if_not(cell.begin(), cell.end(), of_facet);
    }
    wetted_.push_back({f.nodes, inner, f.wall, centre, area.normalized(), area.norm()});
  }
  return {};
}

template <int d>
Vec<d> SkinFriction<d>::past(const StepView<d>& step, const Wetted& f, const Carried<d>& carried) const {
  const Vec<d> hull = velocity_at<d>(step.poses[f.wall], carried.walls[f.wall], f.centre);
  Vec<d> at_hull = Vec<d>::Zero();
  for (int n : f.nodes) at_hull += carried.v[n] / d;
  const auto along = [&](const Vec<d>& v) -> Vec<d> { return v - hull - f.normal * f.normal.dot(v - hull); };
  const Vec<d> near = along(at_hull), off = along(carried.v[f.inner]);
  return near.squaredNorm() > off.squaredNorm() ? near : off;
}

template <int d>
double SkinFriction<d>::length(const StepView<d>& step, int wall, const Vec<d>& direction) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int n : nodes_of_[wall]) {
    const double s = direction.dot(step.nodes.x[n]);
    low = std::min(low, s), high = std::max(high, s);
    if (!spec_.mirror) continue;
    const double image = direction.dot(spec_.mirror->template image<d>(step.nodes.x[n]));
    low = std::min(low, image), high = std::max(high, image);
  }
  return high - low;
}

// With Z^T f = M y, the change y of the motions that friction alone would make, C y . y / M y . y says by how much it goes beyond the
// water's velocity, C being the slope of the friction. Only bodies next to nothing get there.
template <int d>
double SkinFriction<d>::limit(const StepView<d>& step, std::size_t wall, std::span<const Rubbed> rubbed) const {
  if (!step.answers || step.answers->modes.cols() == 0 || step.layout.deforms(wall)) return 1;
  const Eigen::MatrixXd modes = step.answers->modes.middleRows(step.layout.first(wall), freedoms<d>);
  const Vec<d> origin = step.poses[wall].translation();
  if (modes.isZero(0)) return 1;
  Wrench<d> impulse = Wrench<d>::Zero();
  for (std::size_t k = 0; k < wetted_.size(); ++k)
    if (static_cast<std::size_t>(wetted_[k].wall) == wall)
      impulse += wrench_of<d>(wetted_[k].centre - origin, rubbed[k].impulse);
  const Eigen::VectorXd on_modes = modes.transpose() * impulse;
  const Eigen::VectorXd y = algebra::least_squares(step.answers->inertia, on_modes);
  const Twist<d> change = modes * y;
  double slope = 0;
  for (std::size_t k = 0; k < wetted_.size(); ++k)
    if (static_cast<std::size_t>(wetted_[k].wall) == wall) {
      const Vec<d> v = rigid_velocity<d>(change, wetted_[k].centre - origin);
      slope += rubbed[k].rate * (v.squaredNorm() - std::pow(wetted_[k].normal.dot(v), 2));
    }
  const double inertia = y.dot(on_modes);
  return slope > inertia ? inertia / slope : 1;
}

// The nodes of a facet first; what would drive them against the hull, its inner node; what would drive that one, nobody: it is
// taken off the friction.
template <int d>
void SkinFriction<d>::rub(const StepView<d>& step, const Carried<d>& carried, std::span<const Rubbed> rubbed,
                          const Predicted<d>& predicted) {
  const std::size_t count = step.nodes.size();
  std::vector<Vec<d>> asked(count, Vec<d>::Zero()), rest(count, Vec<d>::Zero()), hull(count, Vec<d>::Zero());
  std::vector<double> share(count, 1), rest_share(count, 1);
  const auto mass = [&](int n) { return step.density * std::max(0.0, step.lumped_volume[n]); };
  const auto taken = [&](int n, const Vec<d>& impulse) {
    const double has = -mass(n) * impulse.dot(carried.v[n] - hull[n]), wants = impulse.squaredNorm();
    return wants == 0 ? 1.0 : std::clamp(has / wants, 0.0, 1.0);
  };
  for (std::size_t k = 0; k < wetted_.size(); ++k) {
    const Wetted& f = wetted_[k];
    const WallPlace<d>& place = step.poses[f.wall];
    for (int n : f.nodes) asked[n] -= rubbed[k].impulse / d;
    for (int n : f.nodes) hull[n] = velocity_at<d>(place, carried.walls[f.wall], step.nodes.x[n]);
    hull[f.inner] = velocity_at<d>(place, carried.walls[f.wall], step.nodes.x[f.inner]);
  }
  for (const Wetted& f : wetted_)
    for (int n : f.nodes) share[n] = taken(n, asked[n]);
  for (std::size_t k = 0; k < wetted_.size(); ++k)
    for (int n : wetted_[k].nodes) rest[wetted_[k].inner] -= (1 - share[n]) / d * rubbed[k].impulse;
  for (const Wetted& f : wetted_) rest_share[f.inner] = taken(f.inner, rest[f.inner]);
  for (std::size_t k = 0; k < wetted_.size(); ++k) {
    const Wetted& f = wetted_[k];
    const auto act_at = [&](int n, double part) {
      const Vec<d> impulse = part / d * rubbed[k].impulse;
      WallImpulse<d> on_hull;
      add_impulse<d>(step.poses[f.wall], step.nodes.x[n], impulse, on_hull);
      predicted.on_walls[f.wall] += on_hull;
      power_ += on_hull.dot(carried.walls[f.wall]) / step.kick;
      force_ += impulse / step.kick;
    };
    for (int n : f.nodes) act_at(n, share[n]), act_at(f.inner, (1 - share[n]) * rest_share[f.inner]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double m = mass(static_cast<int>(i));
    if (m == 0) continue;
    const Vec<d> change = (share[i] * asked[i] + rest_share[i] * rest[i]) / m;
    predicted.v[i] += change;
    power_ += 0.5 * m * change.dot(2 * carried.v[i] + change) / step.kick;
  }
}

template <int d>
Status SkinFriction<d>::predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) {
  power_ = 0;
  force_.setZero();
  if (wetted_.empty()) return {};
  std::vector<Rubbed> rubbed(wetted_.size());
  in_parallel(wetted_.size(), [&](std::size_t k) {
    const Vec<d> u = past(step, wetted_[k], carried);
    const double speed = u.norm();
    const double reynolds =
        speed == 0 ? 0 : step.density * speed * length(step, wetted_[k].wall, u / speed) / spec_.dynamic_viscosity;
    const double coefficient = reynolds > 0 ? friction_coefficient(spec_.line, reynolds) : 0;
    rubbed[k].rate = step.kick * 0.5 * step.density * coefficient * wetted_[k].area * speed;
    rubbed[k].impulse = rubbed[k].rate * u;
  });
  for (std::size_t w = 0; w < spec_.hulls; ++w) {
    if (nodes_of_[w].empty()) continue;
    const double most = limit(step, w, rubbed);
    for (std::size_t k = 0; k < wetted_.size(); ++k)
      if (static_cast<std::size_t>(wetted_[k].wall) == w) rubbed[k].impulse *= most;
  }
  rub(step, carried, rubbed, predicted);
  return {};
}

template <int d>
std::vector<Diagnostic> SkinFriction<d>::diagnostics(const Nodes<d>&, std::span<const double>) const {
  std::vector<Diagnostic> out{{"power", power_}};
  for (int k = 0; k < d; ++k) out.emplace_back(std::string("f") + "xyz"[k], force_[k]);
  return out;
}

template class SkinFriction<2>;
template class SkinFriction<3>;

}  // namespace splashdown::fluid
