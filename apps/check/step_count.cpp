#include "apps/check/step_count.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "apps/build/build.hpp"
#include "apps/check/hull_elements.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;

/// Edges that bound a step, over h. In space the fast water beside a contact line has edges of half of it; in the plane sheets, which
/// are what is fast, bound no step. From runs (tests/benchmark/landing_cost.py).
template <int d>
constexpr double bounding_edge = d == 2 ? 1 : 0.5;

/// Smallest elements but those that follow how far a hull is wetted [m].
template <int d>
double finest_fixed(const Scene& scene) {
  double h = scene.fluid->size.surface;
  for (const auto& body : scene.bodies)
    for (const auto& spot : hull_spots<d>(scene, body)) h = std::min(h, spot.size);
  return h;
}

/// Speeds of what is in the water, or of the water, in equal parts of the run: of bodies as they are guessed to move once
/// they have met it, and what gravity makes of it beside them.
template <int d>
std::vector<double> speeds_in_parts(const Scene& scene, const std::vector<GuessedBody<d>>& bodies, int parts) {
  constexpr double of_waves = 0.5;  // of sqrt(g L)
  const auto s = scales<d>(scene);
  const auto still = [](const Region& region) { return region.velocity.isZero() && region.velocity_gradient.isZero(); };
  if (scene.bodies.empty() || !std::ranges::all_of(scene.fluid->regions, still))
    return std::vector<double>(static_cast<std::size_t>(parts), s.speed);
  std::vector<double> speeds(static_cast<std::size_t>(parts),
                             std::min(s.speed, of_waves * std::sqrt(s.gravity * s.length)));
  for (const auto& guessed : bodies) {
    const double above = extents<d>(guessed.hull).min()[d - 1] - still_water_level<d>(scene).value_or(0);
    Vec<d> before = Vec<d>::Zero();
    for (int i = 0; i < parts; ++i) {
      const Vec<d> after = guessed_motion<d>(scene, guessed, scene.time.end * (i + 1) / parts);
      auto& speed = speeds[static_cast<std::size_t>(i)];
      if (above + after[d - 1] <= 0)
        speed = std::min(s.speed, std::max(speed, (after - before).norm() / (scene.time.end / parts)));
      before = after;
    }
  }
  return speeds;
}

/// Each body's wetted ends at a time; none where it is dry.
template <int d>
struct WettedAt {
  double time = 0;
  std::vector<std::optional<WettedEnds<d>>> ends;
  std::vector<double> length;
};

template <int d>
class StepCount {
 public:
  StepCount(const Scene& scene, const std::vector<GuessedBody<d>>& bodies)
      : scene_(scene), fixed_(finest_fixed<d>(scene)), bodies_(bodies) {}

  double count() {
    constexpr int parts = 24;
    const auto speeds = speeds_in_parts<d>(scene_, bodies_, parts);
    double count = 0;
    auto from = wetted_at(0);
    was_wet_ = from.ends;
    for (int i = 0; i < parts; ++i) {
      auto to = wetted_at(scene_.time.end * (i + 1) / parts);
      count += between(from, to, speeds[static_cast<std::size_t>(i)], most_halvings);
      from = std::move(to);
    }
    return count;
  }

 private:
  static constexpr int most_halvings = 8;
  static constexpr double share_of_hull = 1. / 16;  // times are halved until less of it is wetted between them

  WettedAt<d> wetted_at(double time) const {
    WettedAt<d> wetted{time, {}, {}};
    for (const auto& body : bodies_) {
      wetted.ends.push_back(wetted_ends<d>(scene_, body, time));
      wetted.length.push_back(wetted_length<d>(scene_, body, time));
    }
    return wetted;
  }

  /// How far a contact line runs along the hull where it never was before: from where it was dry, one that begins somewhere within [m].
  /// What comes out and goes in again has turned, and is wetted without such a run.
  double run_of(std::size_t body, const WettedAt<d>& to) const {
    if (!to.ends[body]) return 0;
    if (!was_wet_[body]) return wetted_width<d>(*to.ends[body]);
    const WettedEnds<d> grown = *to.ends[body] - *was_wet_[body];
    return std::max({0., -grown.template head<d - 1>().minCoeff(), grown.template tail<d - 1>().maxCoeff()});
  }

  void remember(std::size_t body, const std::optional<WettedEnds<d>>& ends) {
    auto& all = was_wet_[body];
    if (!all || !ends) {
      if (ends) all = ends;
      return;
    }
    all->template head<d - 1>() = all->template head<d - 1>().cwiseMin(ends->template head<d - 1>());
    all->template tail<d - 1>() = all->template tail<d - 1>().cwiseMax(ends->template tail<d - 1>());
  }

  double between(const WettedAt<d>& from, const WettedAt<d>& to, double speed, int halvings) {
    const double cfl = scene_.time.cfl * bounding_edge<d>;
    double h = fixed_, dt = scene_.time.dt_max;
    const double time = to.time - from.time;
    const auto is_far = [&](std::size_t b) {
      return run_of(b, to) > share_of_hull * extents<d>(bodies_[b].hull).sizes().template head<d - 1>().maxCoeff();
    };
    for (std::size_t b = 0; b < bodies_.size() && halvings > 0; ++b)
      if (is_far(b)) {
        const auto half = wetted_at(0.5 * (from.time + to.time));
        return between(from, half, speed, halvings - 1) + between(half, to, speed, halvings - 1);
      }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      // A flat bottom is wet all at once: no contact line runs over it.
      const double run = is_far(b) ? 0 : run_of(b, to);
      const auto& body = scene_.bodies[b];
      const double wet = 0.25 * ((from.ends[b] ? wetted_width<d>(*from.ends[b]) : 0) +
                                 (to.ends[b] ? wetted_width<d>(*to.ends[b]) : 0));
      const double on_hull = size_on_hull(scene_, body, 0.5 * (from.length[b] + to.length[b]));
      h = std::min(h, on_hull);
      remember(b, to.ends[b]);
      if (run > 0) dt = std::min(dt, cfl * std::min(on_hull, size_at_root<d>(scene_, body, wet)) * time / run);
    }
    if (speed > 0) dt = std::min(dt, cfl * h / speed);
    return time / dt;
  }

  const Scene& scene_;
  double fixed_;
  const std::vector<GuessedBody<d>>& bodies_;
  std::vector<std::optional<WettedEnds<d>>> was_wet_;  // of each, so far
};

}  // namespace

template <int d>
double predicted_steps(const Scene& scene, const std::vector<GuessedBody<d>>& bodies) {
  return StepCount<d>(scene, bodies).count();
}

template double predicted_steps<2>(const Scene&, const std::vector<GuessedBody<2>>&);
template double predicted_steps<3>(const Scene&, const std::vector<GuessedBody<3>>&);

}  // namespace splashdown::apps
