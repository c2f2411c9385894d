#include "apps/record/sections/section_mass.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "apps/scene/patch_region.hpp"

namespace splashdown::apps {
namespace {

template <int d>
Eigen::Vector3d with_depth(const Vec<d>& v) {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  all.template head<d>() = v;
  return all;
}

template <int d>
using Corners = std::array<Vec<d>, d + 1>;

/// Of integrals over a simplex, exact to the third degree (Strang and Fix 1973; Keast 1986): weight and barycentric coordinates of one
/// corner, those of the others being equal; the first is the centroid.
template <int d>
constexpr double weight_of_centroid = d == 2 ? -27. / 48 : -4. / 5;
template <int d>
constexpr double weight_of_corner = d == 2 ? 25. / 48 : 9. / 20;
template <int d>
constexpr double share_of_corner = d == 2 ? 3. / 5 : 1. / 2;

template <int d>
void add_mass(SectionMass& sum, double mass, const Vec<d>& at) {
  const auto r = with_depth<d>(at);
  sum.mass += mass;
  sum.first += mass * r;
  sum.second += mass * r * r.transpose();
}

template <int d>
void add_mass(SectionMass& sum, const MassDistribution<d>& body, const Corners<d>& corners) {
  const double volume = splashdown::volume<d>([&](int k) { return corners[static_cast<std::size_t>(k)]; });
  Vec<d> whole = Vec<d>::Zero();
  for (const auto& corner : corners) whole += corner;
  const auto at = [&](double weight, const Vec<d>& r) {
    add_mass<d>(sum, weight * volume * (body.mean + body.gradient.dot(r)), r);
  };
  at(weight_of_centroid<d>, whole / (d + 1));
  for (const auto& corner : corners) {
    const double others = (1 - share_of_corner<d>) / d;
    at(weight_of_corner<d>, others * whole + (share_of_corner<d> - others) * corner);
  }
}

/// The hull's part ahead: simplices between its facets and a point of the section, where the section itself has no volume.
template <int d>
void add_hull(SectionMass& sum, const MassDistribution<d>& body, const Vec<d>& axis, double station) {
  const typename PatchRegion<d>::Side behind{-axis, -station};
  const auto& [vertices, facets] = body.hull;
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    patch_detail::Piece<d> piece;
    for (int k = 0; k < d; ++k) {
      typename patch_detail::Piece<d>::Corner corner;
      corner << vertices.col(facets(k, f)), 0;
      piece.add(corner);
    }
    piece = patch_detail::cut<d>(piece, behind);
    for (std::size_t k = d - 1; k < piece.size; ++k) {
      Corners<d> corners;
      corners[0] = station * axis;
      for (std::size_t j = 0; j < d; ++j) corners[j + 1] = piece.corners[j == 0 ? 0 : k + j + 1 - d].template head<d>();
      add_mass<d>(sum, body, corners);
    }
  }
}

template <int d>
double lowest_place(const Surface<d>& hull, const Vec<d>& axis) {
  return hull.vertices.cols() > 0 ? (axis.transpose() * hull.vertices).minCoeff() : 0;
}

}  // namespace

template <int d>
MassDistribution<d> distributed(const Surface<d>& hull, double mass, std::vector<PointMass<d>> points) {
  MassDistribution<d> body{hull, 1, Vec<d>::Zero(), std::move(points)};
  SectionMass volume, heavy;
  add_hull<d>(volume, body, Vec<d>::UnitX(), lowest_place<d>(hull, Vec<d>::UnitX()));
  for (const auto& point : body.points) add_mass<d>(heavy, point.mass, point.at);
  Eigen::Matrix<double, d + 1, d + 1> moments;
  moments << volume.mass, volume.first.head<d>().transpose(), volume.first.head<d>(),
      volume.second.template topLeftCorner<d, d>();
  Eigen::Matrix<double, d + 1, 1> wanted;
  wanted << mass - heavy.mass, -heavy.first.head<d>();
  const Eigen::Matrix<double, d + 1, 1> density = moments.fullPivLu().solve(wanted);
  body.mean = density(0);
  body.gradient = density.template tail<d>();
  return body;
}

template <int d>
double lowest_density(const MassDistribution<d>& body) {
  double low = std::numeric_limits<double>::infinity();
  for (Eigen::Index v = 0; v < body.hull.vertices.cols(); ++v)
    low = std::min(low, body.mean + body.gradient.dot(body.hull.vertices.col(v)));
  return low;
}

template <int d>
SectionMass mass_ahead(const MassDistribution<d>& body, const Vec<d>& axis, double station) {
  SectionMass sum;
  add_hull<d>(sum, body, axis, station);
  for (const auto& point : body.points)
    if (axis.dot(point.at) >= station) add_mass<d>(sum, point.mass, point.at);
  return sum;
}

#define SPLASHDOWN_INSTANTIATE(d)                                                                    \
  template MassDistribution<d> distributed<d>(const Surface<d>&, double, std::vector<PointMass<d>>); \
  template double lowest_density<d>(const MassDistribution<d>&);                                     \
  template SectionMass mass_ahead<d>(const MassDistribution<d>&, const Vec<d>&, double);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::apps
