// Where a falling body meets a sea.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "apps/effects/waves/sea.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "fluid/effects/waves/wave_field.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;

/// The hull as it moves through the air: free fall and spin, or as prescribed, without turning.
template <int d>
class Flight {
 public:
  Flight(const Scene& scene, const Body& body) : scene_(scene), hull_(outline<d>(body)) {
    if (body.motion != Motion::free) path_ = guessed_body<d>(scene, body);
    const auto free = freedom_names(d);
    const auto moves = [&](std::size_t k) { return std::ranges::find(body.free, free[k]) != body.free.end(); };
    centre_ = shape_pose<d>(body) * mass_properties<d>(body).centre;
    for (int k = 0; k < d; ++k) {
      if (!moves(static_cast<std::size_t>(k))) continue;
      velocity_[k] = body.velocity[k];
      if (scene.gravity) pull_[k] = scene.gravity->acceleration[k];
    }
    spin_ = body.spin_deg * radians;
    for (int k = 0; k < rotations; ++k)
      if (!moves(static_cast<std::size_t>(d + k))) spin_[d == 2 ? 2 : k] = 0;
  }

  Eigen::Matrix<double, d, Eigen::Dynamic> at(double time) const {
    if (path_) return hull_.vertices.colwise() + guessed_motion<d>(scene_, *path_, time);
    const Vec<d> now = centre_ + time * velocity_ + 0.5 * time * time * pull_;
    Eigen::Matrix<double, d, d> turn = Eigen::Matrix<double, d, d>::Identity();
    if (const double rate = spin_.norm(); rate > 0) {
      const Eigen::Matrix3d turned(Eigen::AngleAxisd(rate * time, spin_ / rate));
      turn = turned.topLeftCorner<d, d>();
    }
    return (turn * (hull_.vertices.colwise() - centre_)).colwise() + now;
  }

 private:
  static constexpr int rotations = d * (d - 1) / 2;
  const Scene& scene_;
  std::optional<GuessedBody<d>> path_;  // of what goes where it is told to
  rigid::Surface<d> hull_;
  Vec<d> centre_, velocity_ = Vec<d>::Zero(), pull_ = Vec<d>::Zero();
  Point spin_;
};

}  // namespace

template <int d>
std::optional<FirstContact<d>> first_contact(const Scene& scene, const Body& body, const fluid::WaveField<d>& sea,
                                             double level, double end) {
  const Flight<d> flight(scene, body);
  // Least height of the hull above the sea, and where.
  const auto gap = [&](double time, Vec<d>& place) {
    const auto hull = flight.at(time);
    const double lowest = hull.row(d - 1).minCoeff(), reach = lowest + sea.highest() - sea.lowest();
    double least = std::numeric_limits<double>::infinity();
    if (lowest > level + sea.highest()) return lowest - level - sea.highest();
    for (Eigen::Index v = 0; v < hull.cols(); ++v) {
      if (hull(d - 1, v) > reach) continue;
      const double above = hull(d - 1, v) - level - sea.elevation(hull.col(v), time);
      if (above < least) least = above, place = hull.col(v);
    }
    return least;
  };
  Vec<d> place = Vec<d>::Zero();
  const double step = std::min(sea.period() / 100, end / 100);
  if (!(gap(0, place) > 0)) return {};
  for (double before = 0; before < end; before += step) {
    double in_air = before, wet = before + step;
    if (gap(wet, place) > 0) continue;
    for (int pass = 0; pass < 50; ++pass) {
      const double middle = 0.5 * (in_air + wet);
      (gap(middle, place) > 0 ? in_air : wet) = middle;
    }
    gap(wet, place);
    return FirstContact<d>{place, wet};
  }
  return {};
}

template std::optional<FirstContact<2>> first_contact(const Scene&, const Body&, const fluid::WaveField<2>&, double,
                                                      double);
template std::optional<FirstContact<3>> first_contact(const Scene&, const Body&, const fluid::WaveField<3>&, double,
                                                      double);

}  // namespace splashdown::apps
