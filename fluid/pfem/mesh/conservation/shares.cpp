#include "fluid/pfem/mesh/conservation/shares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace splashdown::fluid {

template <int d>
std::vector<double> shares_about(const Vec<d>& lost_at, std::span<const SurfacePlace<d>> places) {
  constexpr double e = 0.01;        // the mean place is met to a hundredth of the box where a is one
  constexpr double longest = 3;     // step of Newton's method: shares change by e^3 at most
  constexpr double precise = 1e-2;  // shares change by less than a hundredth
  constexpr int most_iterations = 20;
  std::vector<double> shares(places.size(), 1.0);
  Eigen::AlignedBox<double, d> box;
  for (const auto& place : places) box.extend(place.x);
  if (places.size() < 2 || !(box.diagonal().norm() > 0)) return shares;
  const double L = box.diagonal().norm();
  const Vec<d> origin = lost_at.cwiseMax(box.min()).cwiseMin(box.max());
  Vec<d> a = Vec<d>::Zero();
  const auto share = [&](const SurfacePlace<d>& place) { return std::exp(a.dot(place.x - origin) / L); };
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Vec<d> mean = Vec<d>::Zero();
    Mat<d> square = Mat<d>::Zero();
    double weighed = 0;
    for (const auto& place : places) {
      const Vec<d> y = (place.x - origin) / L;
      const double weight = place.room * share(place);
      weighed += weight, mean += weight * y, square += weight * y * y.transpose();
    }
    if (!(weighed > 0)) return shares;
    mean /= weighed;
    const Mat<d> curvature = square / weighed - mean * mean.transpose() + e * Mat<d>::Identity();
    const Vec<d> step = curvature.ldlt().solve(mean + e * a);
    a -= std::min(1.0, longest / step.norm()) * step;
    if (step.norm() < precise) break;
  }
  std::ranges::transform(places, shares.begin(), share);
  double whole = 0, weighed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) whole += places[i].room, weighed += places[i].room * shares[i];
  for (double& one : shares) one = one * whole / weighed;
  return shares;
}

template std::vector<double> shares_about(const Vec<2>&, std::span<const SurfacePlace<2>>);
template std::vector<double> shares_about(const Vec<3>&, std::span<const SurfacePlace<3>>);

}  // namespace splashdown::fluid
