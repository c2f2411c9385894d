#include "rigid/lines/anchored.hpp"

#include <algorithm>

namespace splashdown::rigid {

template <int d>
AnchoredEnd<d> anchored_end(const CatenarySpec& line, const Vec<d>& offset) {
  const Vec<d> up = Vec<d>::Unit(d - 1);
  const Vec<d> sideways = offset - offset.dot(up) * up;
  const double x = sideways.norm();
  const Vec<d> outward = x > 0 ? Vec<d>(sideways / x) : Vec<d>::Unit(0);
  const CatenaryEnd end = catenary_end(line, {x, offset.dot(up)});
  Eigen::Matrix<double, d, 2> plane;
  plane << outward, up;
  AnchoredEnd<d> all;
  all.force = plane * end.force;
  // The floor's friction has no energy; what of the slope is not symmetric is left out.
  const Eigen::Matrix2d symmetric = 0.5 * (end.stiffness + end.stiffness.transpose());
  all.stiffness = plane * symmetric * plane.transpose();
  if (x > 0) all.stiffness += end.force.x() / x * (Mat<d>::Identity() - plane * plane.transpose());
  return all;
}

template <int d>
AnchoredEnd<d> stepped_end(const CatenarySpec& line, const FairleadStep<d>& step) {
  const double dt_before = 2 * step.kick - step.dt;
  const Vec<d> before = step.offset - dt_before / 2 * step.velocity;
  AnchoredEnd<d> end = anchored_end<d>(line, before);
  const Vec<d> way = 0.5 * (step.dt + dt_before) * step.velocity;
  const Vec<d> gain = anchored_end<d>(line, before + way).force - end.force;
  const Vec<d> expected = end.stiffness * way;
  const double gained = gain.dot(way), foreseen = expected.dot(way);
  if (!(gained > foreseen)) return end;
  if (foreseen > 0) end.stiffness -= expected * expected.transpose() / foreseen;
  end.stiffness += gain * gain.transpose() / gained;
  return end;
}

template struct AnchoredEnd<2>;
template struct AnchoredEnd<3>;
template AnchoredEnd<2> anchored_end<2>(const CatenarySpec&, const Vec<2>&);
template AnchoredEnd<3> anchored_end<3>(const CatenarySpec&, const Vec<3>&);
template AnchoredEnd<2> stepped_end<2>(const CatenarySpec&, const FairleadStep<2>&);
template AnchoredEnd<3> stepped_end<3>(const CatenarySpec&, const FairleadStep<3>&);

}  // namespace splashdown::rigid
