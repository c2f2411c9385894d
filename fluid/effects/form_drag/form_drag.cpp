#include "fluid/effects/form_drag/form_drag.hpp"

#include <algorithm>

namespace splashdown::fluid {
namespace {

constexpr double tiny = 1e-9;  // of the hull: no direction
// Of the coefficient: what the fluid has off the edges of plates and boxes that sink, on elements of a seventh and a fourteenth of their
// breadth. Read off their speeds, which still swing: 1.6 to 1.9 of 2 and 2.05; the middle.
constexpr double by_itself = 0.87;
constexpr double closed =
    2. / 3;  // q from which on the flow counts as closed: that of a circle on elements as coarse as 0.3 R

double developed(double way, double length) {
  if (length == 0) return 1;
  const double q = std::clamp(way / length, 0.0, 1.0);
  return q * q * (3 - 2 * q);
}

/// A way or an angle at the end of a step; from zero where the motion turns.
template <int n>
Vec<n> gone_on(const Vec<n>& before, const Vec<n>& rate, double dt, double most) {
  Vec<n> now = before + dt * rate;
  if (!(now.dot(rate) > 0)) now.setZero();
  if (now.norm() > most) now *= most / now.norm();
  return now;
}

}  // namespace

template <int d>
Status FormDrag<d>::begin(const StepView<d>& step) {
  if (spheres_.empty())
    for (std::size_t w = 0; w < hulls_.size(); ++w) spheres_.push_back(sphere_around<d>(step.walls[w].surface));
  now_.assign(hulls_.size(), {});
  for (std::size_t w = 0; w < hulls_.size(); ++w) now_[w].centre = step.poses[w] * spheres_[w].centre;
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0 || static_cast<std::size_t>(f.wall) >= hulls_.size() || hulls_[f.wall].coefficient == 0) continue;
    Vec<d> centre = Vec<d>::Zero();
    for (int n : f.nodes) centre += step.nodes.x[n] / d;
    Hull& hull = now_[f.wall];
    hull.wetted.push_back({f.nodes, centre - hull.centre, area_vector_of<d>(f, step.nodes.x)});
  }
  return {};
}

template <int d>
Wrench<d> FormDrag<d>::drag(std::size_t hull, const Twist<d>& through, double density) const {
  const double length = hulls_[hull].develops * spheres_[hull].breadth,
               factor = 0.5 * density * hulls_[hull].coefficient;
  Wrench<d> sum = Wrench<d>::Zero();
  for (const Wetted& f : now_[hull].wetted) {
    const Vec<d> v = rigid_velocity<d>(through, f.arm);
    const double leaves = v.dot(f.area);
    if (leaves <= 0) continue;
    const double share = developed(rigid_velocity<d>(way(hull), f.arm).dot(v) / v.norm(), length);
    sum -= wrench_of<d>(f.arm, Vec<d>(factor * share * leaves * v));
  }
  return sum;
}

template <int d>
double FormDrag<d>::closing(std::size_t hull, const Twist<d>& through, const Twist<d>& own,
                            std::span<const Vec<d>> v) const {
  Vec<d> centre = Vec<d>::Zero();  // of the rear
  double all = 0, speeds = 0, closes = 0;
  const auto rear = [&](const Wetted& f) { return std::max(0.0, rigid_velocity<d>(through, f.arm).dot(f.area)); };
  for (const Wetted& f : now_[hull].wetted) all += rear(f), centre += rear(f) * f.arm;
  if (all == 0) return 0;
  centre /= all;
  if (mirror_) centre[mirror_->axis] = 0;  // with the rear's other half
  for (const Wetted& f : now_[hull].wetted) {
    if (rear(f) == 0) continue;
    const Vec<d> normal = f.area.normalized(), inward = centre - f.arm - normal * normal.dot(centre - f.arm);
    Vec<d> past = -rigid_velocity<d>(own, f.arm);
    for (int n : f.nodes) past += v[n] / d;
    speeds += rear(f) * rigid_velocity<d>(through, f.arm).norm();
    if (inward.norm() > tiny * spheres_[hull].radius) closes += rear(f) * past.dot(inward.normalized());
  }
  return std::clamp(closes / speeds, 0.0, 1.0);
}

template <int d>
void FormDrag<d>::act(std::size_t w, const StepView<d>& step, const Carried<d>& carried,
                      const Predicted<d>& predicted) {
  const Hull& hull = now_[w];
  Eigen::Map<Twist<d>> all_ways(&next_[freedoms<d> * w]);
  all_ways.setZero();
  Surroundings<d> water(step, hull.centre, spheres_[w].radius, static_cast<int>(w), mirror_);
  if (hull.wetted.empty() || water.empty()) return;
  const Vec<d> arm = hull.centre - step.poses[w].translation();
  Twist<d> through = carried.walls[w].rigid;
  through.template head<d>() = rigid_velocity<d>(carried.walls[w].rigid, arm);
  const Twist<d> own = through;
  for (int k = 0; k < 2; ++k) {  // first with even weights
    through = own - water.ahead(carried.v);
    water.face(through.template head<d>());
  }
  through = own - water.ahead(carried.v);
  const Vec<d> v = through.template head<d>();
  const double far = 2 * hulls_[w].develops * spheres_[w].breadth;
  all_ways << gone_on<d>(way(w).template head<d>(), v, step.dt, far),
      gone_on<rotations<d>>(way(w).template tail<rotations<d>>(), through.template tail<rotations<d>>(), step.dt,
                            far / (0.5 * spheres_[w].breadth));
  closing_ = closing(w, through, own, carried.v);
  const double missing = 1 - by_itself * (1 - std::min(1.0, closing_ / closed));
  Wrench<d> impulse = step.kick * missing * drag(w, through, step.density);
  if (mirror_) impulse = mirror_->kept<d>().cwiseProduct(impulse);
  if (impulse.isZero(0)) return;
  double fastest = 0;
  auto changes = water.behind(-impulse, fastest);
  const double speed = v.norm() + spheres_[w].radius * through.template tail<rotations<d>>().norm();
  const double share = std::min(1.0, speed / fastest);  // of what little water there is, none runs ahead of the hull
  impulse *= share;
  for (auto& [n, change] : changes) {
    change *= share;
    predicted.v[n] += change;
    power_ += 0.5 * step.density * step.lumped_volume[n] * change.dot(2 * carried.v[n] + change) / step.kick;
  }
  power_ += impulse.dot(own) / step.kick;
  force_ += impulse.template head<d>() / step.kick;
  predicted.on_walls[w].rigid += impulse;
  predicted.on_walls[w].rigid.template tail<rotations<d>>() += moment(arm, Vec<d>(impulse.template head<d>()));
}

template <int d>
Status FormDrag<d>::predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) {
  power_ = closing_ = 0;
  force_.setZero();
  for (std::size_t w = 0; w < hulls_.size(); ++w)
    if (hulls_[w].coefficient > 0) act(w, step, carried, predicted);
  return {};
}

template <int d>
void FormDrag<d>::commit(const StepView<d>&) {
  ways_ = next_;
}

template <int d>
std::vector<Diagnostic> FormDrag<d>::diagnostics(const Nodes<d>&, std::span<const double>) const {
  std::vector<Diagnostic> out{{"power", power_}, {"closing", closing_}};
  for (int k = 0; k < d; ++k) out.emplace_back(std::string("f") + "xyz"[k], force_[k]);
  return out;
}

template class FormDrag<2>;
template class FormDrag<3>;

}  // namespace splashdown::fluid
