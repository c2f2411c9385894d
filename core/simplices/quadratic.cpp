#include "core/simplices/quadratic.hpp"

#include <cmath>

namespace splashdown {
namespace {

/// All corners but one have the coordinate `a`.
template <int d>
void add_star(std::vector<RulePoint<d>>& points, double a, double weight) {
  for (int i = 0; i <= d; ++i) {
    Barycentric<d> at = Barycentric<d>::Constant(a);
    at[i] = 1 - d * a;
    points.push_back({at, weight});
  }
}

std::vector<RulePoint<1>> segment_rule() {
  const double away = 0.5 * std::sqrt(0.6);
  std::vector<RulePoint<1>> points;
  for (const double x : {0.5 - away, 0.5, 0.5 + away}) points.push_back({{1 - x, x}, x == 0.5 ? 4. / 9 : 5. / 18});
  return points;
}

std::vector<RulePoint<2>> triangle_rule() {
  std::vector<RulePoint<2>> points;
  add_star<2>(points, 0.44594849091596488632, 0.22338158967801146570);
  add_star<2>(points, 0.09157621350977074346, 0.10995174365532186764);
  return points;
}

std::vector<RulePoint<3>> tetrahedron_rule() {
  std::vector<RulePoint<3>> points;
  add_star<3>(points, 0.31088591926330060980, 0.11268792571801585080);
  add_star<3>(points, 0.09273525031089122640, 0.07349304311636194934);
  const double a = 0.04550370412564964949, weight = 0.04254602077708146644;
  for (const auto [i, j] : cell_edges) {
    Barycentric<3> at = Barycentric<3>::Constant(0.5 - a);
    at[i] = at[j] = a;
    points.push_back({at, weight});
  }
  return points;
}

}  // namespace

template <>
const std::vector<RulePoint<1>>& rule<1>() {
  static const auto points = segment_rule();
  return points;
}
template <>
const std::vector<RulePoint<2>>& rule<2>() {
  static const auto points = triangle_rule();
  return points;
}
template <>
const std::vector<RulePoint<3>>& rule<3>() {
  static const auto points = tetrahedron_rule();
  return points;
}

}  // namespace splashdown
