#include "elastic/loads/patch.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace splashdown::elastic {
namespace {

/// Points of a facet's parts with their share of it.
template <int d>
std::vector<RulePoint<d - 1>> points_of_parts();

/// Sixteen equal parts: a patch ends within a thirty-second of a facet.
template <>
std::vector<RulePoint<1>> points_of_parts<2>() {
  constexpr int parts = 16;
  std::vector<RulePoint<1>> all;
  for (int k = 0; k < parts; ++k)
    for (const auto& point : rule<1>()) {
      const double along = (k + point.at[1]) / parts;
      all.push_back({{1 - along, along}, point.weight / parts});
    }
  return all;
}

/// Each edge in four, sixteen equal parts.
template <>
std::vector<RulePoint<2>> points_of_parts<3>() {
  constexpr int parts = 4;
  std::vector<RulePoint<2>> all;
  const auto add = [&](double i, double j, double turn) {
    for (const auto& point : rule<2>()) {
      const double a = (i + turn * point.at[1]) / parts, b = (j + turn * point.at[2]) / parts;
      all.push_back({{1 - a - b, a, b}, point.weight / (parts * parts)});
    }
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      add(i, j, 1);
      if (i + j + 1 < parts) add(i + 1, j + 1, -1);
    }
  return all;
}

inline Vec<2> area_along(const Eigen::Matrix<double, 2, 1>& along) { return {along.y(), -along.x()}; }
inline Vec<3> area_along(const Eigen::Matrix<double, 3, 2>& along) { return 0.5 * along.col(0).cross(along.col(1)); }

/// `each(facet, shape functions, place, area vector)` at all points where `on(place, normal)` holds.
template <int d, class On, class Each>
void at_points(const SolidMesh<d>& mesh, const On& on, const Each& each) {
  const auto points = points_of_parts<d>();
  for (const auto& facet : mesh.facets)
    for (const auto& point : points) {
      const auto N = shapes<d - 1>(point.at);
      const auto slopes = shape_slopes<d - 1>(point.at);
      Vec<d> X = Vec<d>::Zero();
      Eigen::Matrix<double, d, d - 1> along = decltype(along)::Zero();
      for (int a = 0; a < facet_nodes<d>; ++a) {
        X += N[a] * mesh.nodes.col(facet[a]);
        along += mesh.nodes.col(facet[a]) * slopes.col(a).transpose();
      }
      const Vec<d> area = point.weight * area_along(along);
      if (on(X, area.normalized())) each(facet, N, X, area);
    }
}

template <int d, class On>
double area_where(const SolidMesh<d>& mesh, const On& on) {
  double sum = 0;
  at_points<d>(mesh, on, [&](const auto&, const auto&, const Vec<d>&, const Vec<d>& area) { sum += area.norm(); });
  return sum;
}

template <int d, class On, class Traction>
Field force_where(const SolidMesh<d>& mesh, const On& on, const Traction& traction) {
  Field F = Field::Zero(d * mesh.size());
  at_points<d>(mesh, on, [&](const auto& facet, const auto& N, const Vec<d>& X, const Vec<d>& area) {
    const Vec<d> force = area.norm() * traction(X, area.normalized());
    for (int a = 0; a < facet_nodes<d>; ++a) F.segment<d>(d * facet[a]) += N[a] * force;
  });
  return F;
}

template <int d>
auto whatever_normal(const OnPatch<d>& on) {
  return [&on](const Vec<d>& X, const Vec<d>&) { return on(X); };
}

}  // namespace

template <int d>
double patch_area(const SolidMesh<d>& mesh, const OnPatch<d>& on) {
  return area_where<d>(mesh, whatever_normal<d>(on));
}

template <int d>
Field patch_force(const SolidMesh<d>& mesh, const OnPatch<d>& on,
                  const std::function<Vec<d>(const Vec<d>&, const Vec<d>&)>& traction) {
  return force_where<d>(mesh, whatever_normal<d>(on), traction);
}

template <int d>
Field stretch_force(const SolidMesh<d>& mesh, const Vec<d>& centre, double radius) {
  constexpr double rim = 0.1;   // of the radius: less than a wave sees, more than a part of a facet
  constexpr double side = 0.3;  // sine of 17 degrees: curvature under a disc, not the other side of a thin plate
  const auto on_rim = [&](const Vec<d>& X, const Vec<d>& normal) {
    const Vec<d> out = X - centre;
    const double away = out.norm();
    return away <= radius && away >= (1 - rim) * radius && std::abs(out.dot(normal)) <= side * away;
  };
  const double area = area_where<d>(mesh, on_rim);
  if (!(area > 0)) return Field::Zero(d * mesh.size());
  // As much in all as a unit along the rim: two ends in the plane, a circle in space.
  const double edge = d == 3 ? 2 * std::numbers::pi * radius : 2;
  return force_where<d>(mesh, on_rim, [&](const Vec<d>& X, const Vec<d>& normal) -> Vec<d> {
    const Vec<d> out = X - centre, along = out - out.dot(normal) * normal;
    return edge / area * along.normalized();
  });
}

double ToneBurst::at(double t) const {
  const double phase = 2 * std::numbers::pi * frequency * (t - start);
  if (!(phase > 0 && phase < 2 * std::numbers::pi * cycles)) return 0;
  return 0.5 * (1 - std::cos(phase / cycles)) * std::sin(phase);
}

template double patch_area<2>(const SolidMesh<2>&, const OnPatch<2>&);
template double patch_area<3>(const SolidMesh<3>&, const OnPatch<3>&);
template Field patch_force<2>(const SolidMesh<2>&, const OnPatch<2>&,
                              const std::function<Vec<2>(const Vec<2>&, const Vec<2>&)>&);
template Field patch_force<3>(const SolidMesh<3>&, const OnPatch<3>&,
                              const std::function<Vec<3>(const Vec<3>&, const Vec<3>&)>&);
template Field stretch_force<2>(const SolidMesh<2>&, const Vec<2>&, double);
template Field stretch_force<3>(const SolidMesh<3>&, const Vec<3>&, double);

}  // namespace splashdown::elastic
