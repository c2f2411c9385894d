// The curve of static stability: a body's balance in trim, followed as it heels.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rigid/shapes/hydrostatics.hpp"
#include "rigid/shapes/inclined_hull.hpp"

namespace splashdown::rigid {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A body that heels about an axis and is free to sink and to trim.
class Heeling {
 public:
  Heeling(const Surface<3>& surface, const Floating<3>& rest, double volume, double water_level, const Slope<3>& axis)
      : hull_(surface, rest.hollow),
        rest_(rest.pose),
        volume_(volume),
        water_level_(water_level),
        along_(axis),
        across_(-axis.y(), axis.x()) {}

  Heeled at_rest(const Floating<3>& rest) const {
    return described(InclinedHull<3>(hull_, rest.pose.linear()), {water_level_ - rest.pose.translation().z()}, 0, 0);
  }
  /// Newton's method for volume and trim at a heel, from a guess of the trim. Nothing if it does not come to a balance nearby.
  std::optional<Heeled> balance(const Heeled& before, double heel, double trim) const;
  /// Downhill in trim to where it is stable; nothing if the body sinks.
  std::optional<Heeled> descended(const Heeled& before, double heel);

 private:
  Mat<3> attitude(double heel, double trim) const {
    return tilt<3>(trim * along_) * tilt<3>(heel * across_) * rest_.linear();
  }
  Heeled described(const InclinedHull<3>& inclined, const Immersion& at, double heel, double trim) const;

  FloatingHull<3> hull_;
  Isometry<3> rest_;
  double volume_, water_level_;
  Slope<3> along_, across_;
};

Heeled Heeling::described(const InclinedHull<3>& inclined, const Immersion& at, double heel, double trim) const {
  Heeled h;
  h.heel = heel;
  h.trim = trim;
  Isometry<3> pose = rest_;
  pose.linear() = attitude(heel, trim);
  h.floating = assessed<3>(inclined, pose, at, water_level_);
  h.floating.hollow = hull_.state;
  // The axis of heel is inclined by the trim; moments of still water have no vertical part.
  h.lever = -lever(h.floating).dot(across_) * std::cos(trim);
  h.trim_height = metacentric_height<3>(h.floating, along_);
  return h;
}

std::optional<Heeled> Heeling::balance(const Heeled& before, double heel, double trim) const {
  const double neutral = facets_share * hull_.extent, stride = 2 * degree, farthest = 10 * degree;
  const double arrived = 1e-10;  // [rad], and of the extent
  const double begin = trim;
  double level = water_level_ - before.floating.pose.translation().z();
  for (int i = 0; i < 40 && std::abs(trim - begin) <= farthest; ++i) {
    const InclinedHull<3> inclined(hull_, attitude(heel, trim));
    Submerged<3> s = inclined.submerged(level, no_rim);
    if (!(s.waterline > 0 && s.volume > 0) || !inclined.rims().empty()) {
      const auto at = balanced<3>(inclined, volume_, level);
      if (!at || at->flooded > no_rim) return {};
      level = at->level;
      s = inclined.submerged(level, no_rim);
    }
    // V(level, tau) = V_0 and int p dV = 0, p the distance along: water planes move, volumes turn.
    const double offset = along_.dot(s.waterline_centre), excess = s.volume - volume_;
    const double height = along_.dot(s.waterline_moment * along_) / s.volume + s.centre.z();
    const double arm = along_.dot(s.centre.head<2>()) - offset * excess / s.volume;
    const bool indifferent = std::abs(height) <= neutral && std::abs(arm) <= 0.1 * neutral;
    double turn = indifferent ? 0 : arm / std::copysign(std::max(std::abs(height), neutral), height);
    turn = std::clamp(turn, -stride, stride);
    const double rise = offset * turn - excess / s.waterline;
    if (std::abs(turn) <= arrived && std::abs(rise) <= arrived * hull_.extent)
      return described(inclined, {level, no_rim}, heel, trim);
    trim += turn;
    level += rise;
  }
  return {};
}

std::optional<Heeled> Heeling::descended(const Heeled& before, double heel) {
  Isometry<3> pose = before.floating.pose;
  // Off an unstable balance, to the side to which it was going.
  pose.linear() = attitude(heel, before.trim);
  const auto f = settled<3, 1>(hull_, pose, volume_, water_level_, along_);
  if (!f || f->hollow != Hollow::dry) return {};
  const Vec<3> now =
      (f->pose.linear() * (tilt<3>(heel * across_) * rest_.linear()).transpose()) * Vec<3>(along_.x(), along_.y(), 0);
  const double trim = std::atan2(now.z(), now.head<2>().dot(along_));
  auto h = balance({heel, 0, trim, 0, false, *f}, heel, trim);
  if (h) h->jumped = true;
  return h;
}

}  // namespace

std::vector<Heeled> righting_levers(const Surface<3>& surface, const Floating<3>& rest, double mass, double density,
                                    double water_level, const Slope<3>& axis, std::span<const double> heels) {
  Heeling body(surface, rest, mass / density, water_level, axis);
  const double most = 5 * degree, least = degree / 64, on_end = 85 * degree;
  Heeled now = body.at_rest(rest);
  double slope = 0, step = most;
  bool jumped = false;
  std::vector<Heeled> curve;
  for (const double heel : heels) {
    while (now.heel < heel) {
      const double next = std::min(heel, now.heel + step), turned = next - now.heel, guess = now.trim + slope * turned;
      auto found = body.balance(now, next, guess);
      // As far beside the tangent as the curve may bend; more, and it is another balance.
      if (found && std::abs(found->trim - guess) > std::max(0.25 * degree, 0.25 * turned)) found.reset();
      if (!found && step > least) {
        step = 0.5 * step;
        continue;
      }
      if (found) {
        slope = (found->trim - now.trim) / turned;
        step = std::min(most, 2 * step);
      } else {
        found = body.descended(now, next);
        slope = 0;
        jumped = true;
      }
      if (!found || std::abs(found->trim) > on_end) {
        curve.push_back(now);
        return curve;
      }
      now = *found;
    }
    now.jumped = std::exchange(jumped, false);
    curve.push_back(now);
  }
  return curve;
}

}  // namespace splashdown::rigid
