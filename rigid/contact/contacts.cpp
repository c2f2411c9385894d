#include "rigid/contact/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid/contact/hull.hpp"
#include "rigid/contact/touches.hpp"

namespace splashdown::rigid {

namespace {

// Beyond this share of a body's size, and twice what the step moves it, nothing can touch within the step.
constexpr double near = 0.05;

template <int d>
Contact<d> contact(std::size_t a, std::size_t b, const Vec<d>& centre_a, const Vec<d>& centre_b, const Touch<d>& touch,
                   double dt) {
  return {{a, b, wrench_of<d>(touch.point - centre_a, touch.normal), -wrench_of<d>(touch.foot - centre_b, touch.normal),
           -touch.gap / dt},
          0.5 * (touch.point + touch.foot),
          touch.normal};
}

}  // namespace

template <int d>
Contacts<d>::Contacts(ContactSpec<d> spec, std::span<const BodySpec<d>> bodies)
    : spec_(std::move(spec)), bodies_(bodies) {
  for (const auto& body : bodies) hulls_.emplace_back(body.surface);
}

template <int d>
Contacts<d>::~Contacts() = default;
template <int d>
Contacts<d>::Contacts(Contacts&&) noexcept = default;

template <int d>
std::vector<Contact<d>> Contacts<d>::within_reach(std::span<const BodyState<d>> states, double dt) const {
  std::vector<Placed<d>> hulls;
  for (std::size_t i = 0; i < hulls_.size(); ++i) hulls.emplace_back(hulls_[i], states[i], dt);
  const auto centre = [&](std::size_t i) -> Vec<d> { return states[i].pose.translation(); };
  std::vector<Contact<d>> all;
  for (std::size_t a = 0; a < hulls.size(); ++a) {
    for (std::size_t b = 0; b < hulls.size(); ++b) {
      if (a == b || !(bodies_[a].becomes_free() || bodies_[b].becomes_free())) continue;
      if (spec_.apart.contains(std::minmax(a, b))) continue;
      const double reach = near * std::min(hulls[a].size, hulls[b].size) + 2 * (hulls[a].moves + hulls[b].moves);
      if (!hulls[a].is_near(hulls[b], reach)) continue;
      for (const auto& touch : touches_of_vertices<d>(hulls[a], hulls[b], reach))
        all.push_back(contact<d>(a, b, centre(a), centre(b), touch, dt));
      if constexpr (d == 3)
        if (a < b)
          for (const auto& touch : touches_of_edges(hulls[a], hulls[b], reach))
            all.push_back(contact<3>(a, b, centre(a), centre(b), touch, dt));
    }
    if (!bodies_[a].becomes_free()) continue;
    for (const auto& plane : spec_.planes)
      for (int v = 0; v < hulls[a].x.cols(); ++v) {
        Vec<d> x = hulls[a].x.col(v);
        if (plane.normal.dot(x - plane.point) > near * hulls[a].size + 2 * hulls[a].moves) continue;
        if (const auto& round = hulls_[a].round(v); round.radius > 0) {
          if (!reaches_farthest<d>(hulls[a], v, -plane.normal)) continue;
          x = hulls[a].pose * round.centre - round.radius * plane.normal;
        }
        const double gap = plane.normal.dot(x - plane.point);
        all.push_back(
            {{a, {}, wrench_of<d>(x - centre(a), plane.normal), Wrench<d>::Zero(), -gap / dt}, x, plane.normal});
      }
  }
  return all;
}

template <int d>
std::array<Condition<d>, d - 1> rubbing(const Contact<d>& contact, std::span<const BodyState<d>> states) {
  Eigen::Matrix<double, d, d - 1> along;
  along.col(0) = contact.normal.unitOrthogonal();
  if constexpr (d == 3) along.col(1) = contact.normal.cross(along.col(0));
  std::array<Condition<d>, d - 1> all;
  for (int k = 0; k < d - 1; ++k) {
    Condition<d>& rate = all[static_cast<std::size_t>(k)];
    rate = {contact.body, contact.other,
            wrench_of<d>(contact.point - states[contact.body].pose.translation(), along.col(k))};
    if (contact.other)
      rate.second = -wrench_of<d>(contact.point - states[*contact.other].pose.translation(), along.col(k));
  }
  return all;
}

template <int d>
double rate_of(const Condition<d>& condition, std::span<const BodyState<d>> states) {
  double rate = condition.first.dot(states[condition.body].velocity);
  if (condition.other) rate += condition.second.dot(states[*condition.other].velocity);
  return rate;
}

template <int d>
double rebound(const Condition<d>& contact, std::span<const BodyState<d>> states, double restitution) {
  const double rate = rate_of(contact, states);
  return rate < std::min(contact.rate, 0.0) ? -restitution * rate : -std::numeric_limits<double>::infinity();
}

template std::array<Condition<2>, 1> rubbing(const Contact<2>&, std::span<const BodyState<2>>);
template std::array<Condition<3>, 2> rubbing(const Contact<3>&, std::span<const BodyState<3>>);
template double rate_of(const Condition<2>&, std::span<const BodyState<2>>);
template double rate_of(const Condition<3>&, std::span<const BodyState<3>>);
template double rebound(const Condition<2>&, std::span<const BodyState<2>>, double);
template double rebound(const Condition<3>&, std::span<const BodyState<3>>, double);
template class Contacts<2>;
template class Contacts<3>;

}  // namespace splashdown::rigid
