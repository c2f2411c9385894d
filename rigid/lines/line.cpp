#include "rigid/lines/line.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "core/geometry.hpp"
#include "rigid/contact/contacts.hpp"
#include "rigid/lines/anchored.hpp"
#include "rigid/message.hpp"

namespace splashdown::rigid {

/// Both ends at one instant, and what their distance makes of velocities.
template <int d>
struct Line<d>::Ends {
  Vec<d> from, to, from_velocity, to_velocity;
  Vec<d> from_arm, to_arm;  // from the centres of mass
  std::size_t body;
  std::optional<std::size_t> other;

  Vec<d> apart() const { return from - to; }
  /// n . (v_from - v_to)
  Condition<d> along(const Vec<d>& n) const {
    Condition<d> rate{body, other, wrench_of<d>(from_arm, n), Wrench<d>::Zero(), 0};
    if (other) rate.second = -wrench_of<d>(to_arm, n);
    return rate;
  }
};

/// A canopy under its weight and drag, without its line.
template <int d>
struct Line<d>::FreeCanopy {
  Vec<d> before, later;  // velocity at t_{n-1/2} and, without its line, at t_{n+1/2}
  double inertia;        // impulse on it that changes `later` by 1 m/s
};

template <int d>
Line<d>::Line(LineSpec<d> spec) : spec_(std::move(spec)), place_(spec_.to.point), velocity_(Vec<d>::Zero()) {
  if (spec_.catenary) rigid::check(*spec_.catenary);
}

template <int d>
bool Line<d>::holds(const BodiesAt<d>& at) const {
  return !released_ && !(spec_.release.time && at.time >= *spec_.release.time);
}

template <int d>
typename Line<d>::Ends Line<d>::ends(const BodiesAt<d>& at) const {
  Ends all;
  all.body = *spec_.from.body;
  all.other = spec_.to.body;
  const auto place = [&](const LineEnd<d>& end, Vec<d>& arm, Vec<d>& x, Vec<d>& v) {
    arm.setZero();
    x = end.point;
    v.setZero();
    if (!end.body) return;
    const BodyState<d>& state = at.states[*end.body];
    arm = state.pose.linear() * end.point;
    x = state.pose.translation() + arm;
    v = rigid_velocity<d>(state.velocity, arm);
  };
  place(spec_.from, all.from_arm, all.from, all.from_velocity);
  place(spec_.to, all.to_arm, all.to, all.to_velocity);
  if (!spec_.canopy) return all;
  all.to = place_;
  all.to_velocity = flies_ ? velocity_ : all.from_velocity;
  return all;
}

template <int d>
double Line<d>::drag_area(double time) const {
  const Canopy<d>& canopy = *spec_.canopy;
  if (canopy.inflation <= 0) return time >= canopy.start ? canopy.drag_area : 0;
  const double share = std::clamp((time - canopy.start) / canopy.inflation, 0.0, 1.0);
  return canopy.drag_area * share * share;
}

template <int d>
typename Line<d>::FreeCanopy Line<d>::free_canopy(const BodiesAt<d>& at) const {
  const Canopy<d>& canopy = *spec_.canopy;
  const Vec<d> u = ends(at).to_velocity;
  const double drag = 0.5 * canopy.air_density * drag_area(at.time) * u.norm();
  const double later = weight_of_later(at.kick * drag / canopy.mass);
  const double inertia = canopy.mass + at.kick * later * drag;
  return {u, (canopy.mass * (u + at.kick * canopy.gravity) - at.kick * (1 - later) * drag * u) / inertia, inertia};
}

template <int d>
void Line<d>::add(const BodiesAt<d>& /*at*/, std::span<Wrench<d>> /*wrenches*/) const {}

template <int d>
std::vector<Pull<d>> Line<d>::pulls(const BodiesAt<d>& at) const {
  if (!holds(at)) return {};
  const Ends now = ends(at);
  if (spec_.catenary)
    return catenary_pulls<d>(*spec_.catenary, {now.apart(), now.from_velocity, at.kick, at.dt},
                             [&](const Vec<d>& n) { return now.along(n); });
  const double length = now.apart().norm();
  if (length == 0) return {};
  const Vec<d> n = now.apart() / length;
  const Condition<d> rate = now.along(n);
  StretchAt stretch{.q = length - spec_.length,
                    .rate = n.dot(now.from_velocity - now.to_velocity),
                    .kick = at.kick,
                    .dt = at.dt,
                    .compliance = compliance<d>(rate, at.specs, at.states, at.held)};
  if (!spec_.canopy) {
    Pull<d> pull = tension_only<d>(spec_.spring, stretch);
    pull.rate = rate;
    return {pull};
  }
  // The canopy's velocity, later + J n/inertia, is eliminated.
  const FreeCanopy canopy = free_canopy(at);
  stretch.compliance += 1 / canopy.inertia;
  Pull<d> pull = tension_only<d>(spec_.spring, stretch);
  pull.rate = rate;
  const double less = 1 / (1 + pull.inertia / canopy.inertia);
  pull.impulse = less * (pull.impulse - pull.inertia * n.dot(canopy.later));
  pull.inertia *= less;
  return {pull};
}

template <int d>
void Line<d>::pull(const BodiesAt<d>& at, std::vector<Pull<d>>& all) const {
  for (Pull<d>& pull : pulls(at))
    if (pull.inertia > 0 || !pull.one_sided) all.push_back(std::move(pull));
}

namespace {

/// Impulses of pulls under the velocities that the step led to.
template <int d>
double impulse_of(const Pull<d>& pull, std::span<const BodyState<d>> next) {
  return pull.at(rate_of<d>(pull.rate, next));
}

}  // namespace

template <int d>
double Line<d>::tension(const BodiesAt<d>& at) const {
  if (at.next.empty()) return 0;
  double squared = 0;  // of directions at right angles
  for (const Pull<d>& pull : pulls(at)) squared += std::pow(impulse_of(pull, at.next) / at.kick, 2);
  return std::sqrt(squared);
}

template <int d>
void Line<d>::commit(const BodiesAt<d>& at) {
  if (spec_.canopy) {
    const FreeCanopy canopy = free_canopy(at);
    Vec<d> velocity = canopy.later;
    for (const Pull<d>& pull : pulls(at)) {
      const Vec<d> n = ends(at).apart().normalized();
      velocity += impulse_of(pull, at.next) / canopy.inertia * n;
    }
    Vec<d> place = place_ + at.dt * velocity;
    if (const auto level = spec_.canopy->water_level; level && place[d - 1] < *level) {
      place[d - 1] = *level;
      velocity.setZero();
    }
    place_ = place;
    velocity_ = velocity;
    flies_ = true;
  }
  const LineRelease& release = spec_.release;
  const bool due = release.time && at.time + at.dt >= *release.time;
  const bool broken = release.load && tension(at) > *release.load;
  const bool wet = release.wets && at.wetted_share[*release.wets] > 0;
  released_ = released_ || due || broken || wet;
}

template <int d>
std::vector<Diagnostic> Line<d>::diagnostics(const BodiesAt<d>& at) const {
  const Ends now = ends(at);
  std::vector<Diagnostic> all = {{"tension", tension(at)}, {"length", now.apart().norm()}};
  if (spec_.catenary) {
    const Vec<d> offset = now.apart();
    const CatenaryEnd end = holds(at)
                                ? catenary_end(*spec_.catenary, {offset.template head<d - 1>().norm(), offset[d - 1]})
                                : CatenaryEnd{.on_floor = spec_.catenary->length};
    all.insert(all.end(), {{"on_floor", end.on_floor}, {"anchor_tension", end.anchor_tension}});
  }
  if (spec_.canopy) {
    const char* const axes[] = {"canopy_x", "canopy_y", "canopy_z"};
    for (int k = 0; k < d; ++k) all.emplace_back(axes[k], place_[k]);
    all.emplace_back("drag_area", drag_area(at.time));
  }
  return all;
}

template <int d>
void Line<d>::save(std::ostream& out) const {
  std::array<double, 2 + 2 * d> all{released_ ? 1.0 : 0.0, flies_ ? 1.0 : 0.0};
  std::copy_n(place_.data(), d, all.begin() + 2);
  std::copy_n(velocity_.data(), d, all.begin() + 2 + d);
  out.write(reinterpret_cast<const char*>(all.data()), sizeof all);
}

template <int d>
void Line<d>::load(std::istream& in) {
  std::array<double, 2 + 2 * d> all{};
  in.read(reinterpret_cast<char*>(all.data()), sizeof all);
  const auto flag = [](double value) { return value == 0 || value == 1; };
  if (!in || !flag(all[0]) || !flag(all[1]) || !std::ranges::all_of(all, [](double x) { return std::isfinite(x); }))
    throw std::runtime_error("the state of line \"" + spec_.name + "\" is damaged");
  released_ = all[0] != 0;
  flies_ = all[1] != 0;
  std::copy_n(all.begin() + 2, d, place_.data());
  std::copy_n(all.begin() + 2 + d, d, velocity_.data());
}

template <int d>
void check(const LineSpec<d>& line, std::size_t bodies) {
  const auto require = [&](bool fine, const auto&... text) {
    if (!fine) throw std::invalid_argument(message("line \"", line.name, "\": ", text...));
  };
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  require(line.from.body.has_value(), "it begins at no body");
  for (const auto& end : {line.from, line.to}) {
    require(!end.body || *end.body < bodies, "it ties body ", end.body.value_or(0), ", there are ", bodies);
    require(end.point.allFinite(), "its ends are not finite");
  }
  require(line.from.body != line.to.body, "it ties a body to itself");
  if (line.catenary) {
    rigid::check(*line.catenary);
    require(!line.to.body && !line.canopy, "a catenary ends at an anchor");
  } else {
    require(positive(line.length), "its length must be positive, it is ", line.length);
    require(positive(line.spring.stiffness), "its stiffness must be positive, it is ", line.spring.stiffness);
    require(std::isfinite(line.spring.damping) && line.spring.damping >= 0, "its damping must not be negative");
  }
  if (!line.canopy) return;
  require(!line.to.body, "a canopy is on a free end");
  require(positive(line.canopy->mass), "the mass of its canopy must be positive, it is ", line.canopy->mass);
  require(line.canopy->drag_area >= 0 && line.canopy->air_density >= 0, "its canopy pushes");
}

template class Line<2>;
template class Line<3>;
template void check<2>(const LineSpec<2>&, std::size_t);
template void check<3>(const LineSpec<3>&, std::size_t);

}  // namespace splashdown::rigid
