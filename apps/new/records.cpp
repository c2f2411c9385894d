#include "apps/new/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "apps/new/numbers.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/patch.hpp"

namespace splashdown::apps {
namespace {

/// The lowest height of a hull at a place, and how thick it is there.
struct Skin {
  double low = 0, thickness = 0;  ///< [m]
};

/// Where the upright line through x leaves the outline, from below.
std::vector<double> heights(const rigid::Surface<2>& hull, const Eigen::Vector2d& at) {
  std::vector<double> found;
  for (const Eigen::Vector2i facet : hull.facets.colwise()) {
    const rigid::Vec<2> a = hull.vertices.col(facet[0]), b = hull.vertices.col(facet[1]);
    const double share = (at.x() - a.x()) / (b.x() - a.x());
    if (share >= 0 && share <= 1) found.push_back(a.y() + share * (b.y() - a.y()));
  }
  std::ranges::sort(found);
  return found;
}

/// The same through (x, y) and the facets of a hull in space.
std::vector<double> heights(const rigid::Surface<3>& hull, const Eigen::Vector2d& at) {
  std::vector<double> found;
  for (const Eigen::Vector3i facet : hull.facets.colwise()) {
    const rigid::Vec<3> a = hull.vertices.col(facet[0]), b = hull.vertices.col(facet[1]),
                        c = hull.vertices.col(facet[2]);
    Eigen::Matrix2d edges;
    edges << b.head<2>() - a.head<2>(), c.head<2>() - a.head<2>();
    if (edges.determinant() == 0) continue;
    const Eigen::Vector2d share = edges.inverse() * (at - a.head<2>());
    if (share.minCoeff() >= 0 && share.sum() <= 1)
      found.push_back(a.z() + share.x() * (b.z() - a.z()) + share.y() * (c.z() - a.z()));
  }
  std::ranges::sort(found);
  return found;
}

template <int d>
std::optional<Skin> skin_at(const rigid::Surface<d>& hull, const Eigen::Vector2d& at, double height) {
  const auto found = heights(hull, at);
  if (found.empty()) return {};
  const double apart = 1e-6 * height;  // the same edge of two facets
  const auto next = std::ranges::find_if(found, [&](double z) { return z > found.front() + apart; });
  return Skin{found.front(), next == found.end() ? height : *next - found.front()};
}

struct Spot {
  Eigen::Vector2d at;
  Skin skin;
};

/// The lowest of a section, in the middle of it where that is as low but for a fiftieth of the height.
template <int d>
std::optional<Spot> lowest_spot(const rigid::Surface<d>& hull, const Extents<d>& box, double x) {
  const double height = box.sizes()[d - 1], as_low = 0.02 * height;
  const double middle = d == 3 ? box.center()[1] : 0, breadth = d == 3 ? box.sizes()[1] : 0;
  // Off the lines that modellers like to put vertices on.
  const double aside = 1e-4;
  std::optional<Spot> best;
  const int lines = d == 3 ? 41 : 1;
  for (int i = 0; i < lines; ++i) {
    const int step = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);  // from the middle to both sides
    const Eigen::Vector2d at(x, middle + breadth * (step / static_cast<double>(lines) + (d == 3 ? aside : 0)));
    const auto skin = skin_at<d>(hull, at, height);
    if (skin && (!best || skin->low < best->skin.low - as_low)) best = {at, *skin};
  }
  if (best && std::abs(best->at.y() - middle) < 1e-3 * breadth) best->at.y() = middle;
  return best;
}

std::string panel_name(int panel, int count) {
  if (count == 3) return panel == 0 ? "tail" : panel == 1 ? "middle" : "nose";
  return fmt::format("panel_{}", panel + 1);
}

/// A box around the lowest point of a section; nothing where the hull has none.
template <int d>
std::optional<PatchEntry> panel(const rigid::Surface<d>& hull, const Extents<d>& box, double x,
                                const Eigen::Vector2d& half) {
  const auto spot = lowest_spot<d>(hull, box, x);
  if (!spot) return {};
  const double step = std::pow(10., std::round(std::log10(1e-4 * box.sizes()[0])));
  const auto written = [&](double value) {
    return std::round(value / step) / std::max(1., std::round(1 / step)) + 0.;  // no -0
  };
  // Not the deck; the rise of floors and bows.
  const double up = std::min(half.maxCoeff(), 0.5 * spot->skin.thickness), down = half.maxCoeff();
  Point min = Point::Zero(), max = Point::Zero();
  min.head<2>() = (spot->at - half).unaryExpr(written);
  max.head<2>() = (spot->at + half).unaryExpr(written);
  min[d - 1] = written(spot->skin.low - down);
  max[d - 1] = written(spot->skin.low + up);
  PatchEntry patch{.name = {}, .body = 0, .centre = {}, .radius = {}, .min = min, .max = max};
  const bool holds = (max - min).head<d>().minCoeff() > 0 &&
                     patch_area<d>(patch_region<d>(patch, hull, rigid::Vec<d>::Zero()), hull) > 0;
  return holds ? std::optional(patch) : std::nullopt;
}

template <int d>
void add_panels(const NewOptions& options, LandingPlan& plan) {
  const auto hull = shape_of<d>(plan.scene.bodies.front().shape).surface;
  const auto box = extents<d>(hull);
  const double length = box.sizes()[0], breadth = d == 3 ? box.sizes()[1] : 0;
  const Eigen::Vector2d half(std::min(0.1 * length, 0.4 * length / options.panels), 0.15 * breadth);
  int made = 0;
  for (int i = 0; i < options.panels; ++i) {
    auto patch = panel<d>(hull, box, box.min()[0] + length * (i + 0.5) / options.panels, half);
    if (!patch) continue;
    patch->name = panel_name(i, options.panels);
    plan.scene.records.emplace_back(*patch);
    ++made;
  }
  const std::string across = d == 3 ? fmt::format(" by {:.2g} m", 2 * half.y()) : "";
  plan.told.push_back(
      {"panels", fmt::format("mean pressures of {} patches of {:.2g} m{} along the bottom, from tail to nose; the "
                             "highest pressure all over the hull",
                             made, 2 * half.x(), across)});
}

void refuse_taken(const std::string& name, const NewOptions& options, std::set<std::string>& taken) {
  bool panel = false;
  for (int i = 0; i < options.panels; ++i) panel = panel || panel_name(i, options.panels) == name;
  if (panel || !taken.insert(name).second)
    throw NewError(
        fmt::format("--point {}=: {} has this name. Use another one", name, panel ? "a panel" : "another point"));
}

/// "NAME=x,y,z"
template <int d>
AccelerationEntry equipment(const std::string& text) {
  const auto sign = text.find('=');
  if (sign == std::string::npos || sign == 0)
    throw NewError(
        fmt::format("--point {}: must read NAME={}, in metres of the hull's frame. Use e.g. --point autopilot={}", text,
                    d == 3 ? "x,y,z" : "x,y", d == 3 ? "0.3,0,0.05" : "0.1,0.05"));
  AccelerationEntry entry{.name = text.substr(0, sign), .body = 0, .point = Point::Zero()};
  const auto numbers = numbers_of_list("--point " + entry.name + "=", text.substr(sign + 1), d);
  for (int k = 0; k < d; ++k) entry.point[k] = numbers[static_cast<std::size_t>(k)];
  return entry;
}

template <int d>
AccelerationEntry at_centre_of_mass(const Body& body) {
  AccelerationEntry entry{.name = "centre", .body = 0, .point = Point::Zero()};
  const rigid::Vec<d> at = mass_properties<d>(body).centre;
  const double roundoff = 1e-8 * extents<d>(shape_of<d>(body.shape).surface).sizes().maxCoeff();  // of sums over facets
  for (int k = 0; k < d; ++k) entry.point[k] = std::abs(at[k]) < roundoff ? 0 : rounded(at[k], 4);
  return entry;
}

}  // namespace

template <int d>
void add_records(const NewOptions& options, LandingPlan& plan) {
  if (options.panels < 0 || options.panels > 50)
    throw NewError(fmt::format("--panels {}: must be from 0 to 50", options.panels));
  auto& records = plan.scene.records;
  const auto& body = plan.scene.bodies.front();
  std::set<std::string> taken;
  for (const auto& point : options.points) {
    const auto entry = equipment<d>(point);
    refuse_taken(entry.name, options, taken);
    records.emplace_back(entry);
  }
  if (options.points.empty()) records.emplace_back(at_centre_of_mass<d>(body));
  plan.told.push_back(
      {"points",
       options.points.empty()
           ? "acceleration at the centre of mass (--point NAME=x,y,z adds equipment)"
           : fmt::format("accelerations at {} of equipment, in metres of the hull's frame; those of the centre of mass "
                         "are recorded anyway",
                         options.points.size() == 1 ? "a point" : "points")});
  records.emplace_back(MaximumPressureEntry{.body = 0, .size = 0});
  if (options.panels > 0) add_panels<d>(options, plan);
}

template void add_records<2>(const NewOptions&, LandingPlan&);
template void add_records<3>(const NewOptions&, LandingPlan&);

}  // namespace splashdown::apps
