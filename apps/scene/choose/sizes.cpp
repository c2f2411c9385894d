#include "apps/scene/choose/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/scene/choose/round_numbers.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

template <int d>
struct Rules;
template <>
struct Rules<2> {
  static constexpr double entering = 50, wetted_fraction = 0.02, wet = 30, growth = 0.2;
};
template <>
struct Rules<3> {
  static constexpr double entering = 33, wetted_fraction = 0.03, wet = 14, growth = 0.25;
};
constexpr double of_calm_surface = 5, of_waves = 20, of_liquid = 30, a_wave = 40, far_of_liquid = 8;
constexpr double wet_from = 0.02;           // of its height under water at the start: more than a touch
constexpr double rounding = 1.05;           // what two digits make of a size
constexpr double of_root = 0.2, a_jet = 2;  // elements on a root's radius; across a jet
constexpr double finest_root = 8;           // times smaller than the hull's: steps shrink with it
constexpr double gentle_froude2 = 0.1;      // V^2 / (g c): a hull that is put down, not thrown

double two_digits(double value) { return rounded(value, 2); }

template <int d>
struct Hull {
  double breadth = 0;  ///< in space the mean of both horizontal extents [m]
  double half = 0;     ///< c of an entering hull, half of the breadth of a wet one [m]
  bool enters = false;
  std::string why;

  double size() const { return half / (enters ? Rules<d>::entering : Rules<d>::wet); }
};

/// How much larger than the rules' the elements of an entering hull may be: in space twice where those at the root of its jet
/// are half as large at most (docs/performance.md, "A cone").
template <int d>
double allowance(const Sizes& size, const Hull<d>& hull) {
  const bool fine_root = d == 3 && hull.enters && size.hollow && size.hollow_min <= hull.size() / 2;
  return fine_root ? 2 * rounding : rounding;
}

/// Speed at the water, downward [m/s].
template <int d>
double entry_speed(const Scene& scene, const Body& body, double fall) {
  if (!body.path.empty() || body.motion == Motion::fixed) return 0;
  const double g = scene.gravity && body.motion == Motion::free ? -scene.gravity->acceleration[d - 1] : 0;
  const double down = -body.velocity[d - 1];
  return std::sqrt(std::max(0., (down > 0 ? down * down : 0) + 2 * std::max(0., g) * fall));
}

template <int d>
double peak_half_width(const Scene& scene, const Body& body) {
  const double volume = shape_of<d>(body.shape).at_unit_density.mass, rho = scene.fluid->density;
  const double mass = body.mass ? *body.mass : body.density.value_or(0) * volume;
  if constexpr (d == 2) return std::sqrt(2 * mass / (5 * pi * rho));
  return std::cbrt(3 * mass / (32 * rho));
}

/// Half of the breadth just above the lowest point, of a flat bottom.
template <int d>
double flat_half_width(const rigid::Surface<d>& hull, double height) {
  const double top = hull.vertices.row(d - 1).minCoeff() + 1e-3 * height;
  Extents<d> below;
  for (Eigen::Index v = 0; v < hull.vertices.cols(); ++v)
    if (hull.vertices(d - 1, v) <= top) below.extend(rigid::Vec<d>(hull.vertices.col(v)));
  return below.isEmpty() ? 0 : below.sizes().template head<d - 1>().minCoeff() / 2;
}

template <int d>
Hull<d> hull_of(const Scene& scene, const Body& body) {
  const auto surface = outline<d>(body);
  const auto box = extents<d>(surface);
  Hull<d> hull;
  hull.breadth = std::pow(box.sizes().template head<d - 1>().prod(), 1. / (d - 1));
  const double height = box.sizes()[d - 1], level = still_water_level<d>(scene).value_or(box.min()[d - 1]);
  const double above = box.min()[d - 1] - level, speed = entry_speed<d>(scene, body, std::max(0., above));
  const double g = scene.gravity ? scene.gravity->acceleration.norm() : 0;
  const bool moves = speed * speed > gentle_froude2 * g * hull.breadth / 2 || !body.path.empty();
  hull.enters = above > -wet_from * height && moves;
  hull.half = hull.breadth / 2;
  hull.why = "half of its breadth";
  if (!hull.enters) return hull;
  double c = body.becomes_free() ? peak_half_width<d>(scene, body) : wetted_half<d>(scene, body, scene.time.end);
  c = std::max(c, flat_half_width<d>(surface, height));
  if (!(c > 0 && c < hull.half)) return hull;
  hull.half = c;
  hull.why =
      body.becomes_free() ? "half of the wetted width at the largest load" : "half of the wetted width at the end";
  return hull;
}

/// Of a hull that enters beside a jet thinner than one of its elements: the root of a jet has that thickness as its only
/// length.
template <int d>
std::optional<double> thin_jet(const Body& body, const Hull<d>& hull) {
  const auto jet = hull.enters ? jet_thickness<d>(body, hull.half) : std::nullopt;
  return jet && *jet <= hull.size() ? jet : std::nullopt;
}

template <int d>
std::optional<std::string> jet_against_rules(const Scene& scene, const Body& body, const Hull<d>& hull) {
  const auto jet = thin_jet(body, hull);
  if (!jet) return {};
  const auto& size = scene.fluid->size;
  const double most = *jet / a_jet, finest = size.hollow ? std::min(size.hollow_min, body.size) : body.size;
  if (finest <= rounding * most) return {};
  const std::string given =
      size.hollow ? fmt::format("fluid.size.hollow_min = {:.3g} m", size.hollow_min)
                  : fmt::format("body.{}.size = {:.3g} m without fluid.size.hollow", body.name, body.size);
  return fmt::format(
      "{} leaves the jet of {}, {:.2g} m thick, fewer than two elements: use hollow = {:g}, hollow_min = {:.2g} m",
      given, body.name, *jet, of_root, two_digits(most));
}

template <int d>
double least_liquid_extent(const Scene& scene) {
  double least = 0;
  for (const auto& region : scene.fluid->regions) {
    auto box = extents<d>(outline<d>(region));
    if (scene.tank) box = box.intersection(extents<d>(*scene.tank));
    const double side = box.isEmpty() ? 0 : box.sizes().minCoeff();
    if (side > 0 && (least == 0 || side < least)) least = side;
  }
  return least;
}

template <int d>
struct Choice {
  std::vector<Hull<d>> hulls;
  double surface = 0, far = 0;
  std::string surface_why, far_why;
  bool enters = false;
};

std::optional<WantedSize> finest_wish(const Scene& scene) {
  std::optional<WantedSize> finest;
  for (const auto* kind : effect_kinds())
    if (auto wish = kind->surface_size(scene); wish && (!finest || wish->size < finest->size)) finest = std::move(wish);
  return finest;
}

/// Of a scene without hulls: what its effects ask for, if any does.
template <int d>
void choose_for_liquid(const Scene& scene, double least, Choice<d>& choice) {
  choice.surface = least / of_liquid;
  choice.surface_why = fmt::format("{:g} elements on the liquid's least extent of {:.3g} m", of_liquid, least);
  for (const auto& region : scene.fluid->regions)
    if (const auto* box = std::get_if<BoxRegion>(&region.shape); box && box->surface_amplitude != 0) {
      choice.surface = std::min(choice.surface, box->surface_wavelength / a_wave);
      choice.surface_why = fmt::format("{:g} elements on a wave of {:.3g} m", a_wave, box->surface_wavelength);
    }
  if (const auto wish = finest_wish(scene)) {
    choice.surface = std::min(wish->size, least / far_of_liquid);
    choice.surface_why = choice.surface < wish->size
                             ? fmt::format("{:g} elements on the depth or length of {:.3g} m", far_of_liquid, least)
                             : wish->why;
  }
  choice.far = choice.surface;
  choice.far_why = "that of the surface";
}

/// What effects ask for, where it is finer.
template <int d>
void choose_for_effects(const Scene& scene, Choice<d>& choice) {
  const auto wish = finest_wish(scene);
  if (!wish || wish->size >= choice.surface) return;
  choice.surface = wish->size;
  choice.surface_why = wish->why;
}

template <int d>
Choice<d> choose_for_bodies(const Scene& scene) {
  Choice<d> choice;
  const double least = least_liquid_extent<d>(scene), g = scene.gravity ? scene.gravity->acceleration.norm() : 0;
  double breadth = 0;
  bool waves = false;
  for (const auto& body : scene.bodies) {
    if (body.makes_waves) {
      choice.hulls.emplace_back();
      continue;
    }
    const auto& hull = choice.hulls.emplace_back(hull_of<d>(scene, body));
    choice.enters = choice.enters || hull.enters;
    breadth = breadth == 0 ? hull.breadth : std::min(breadth, hull.breadth);
    const auto box = extents<d>(outline<d>(body));
    const double level = still_water_level<d>(scene).value_or(0);
    const bool pierces = box.min()[d - 1] < level && box.max()[d - 1] > level;
    waves = waves || (g > 0 && ((!hull.enters && pierces) || scene.time.end > pi * std::sqrt(hull.breadth / g)));
  }
  if (breadth == 0) {
    choose_for_liquid<d>(scene, least, choice);
    return choice;
  }
  choice.surface = std::min(breadth / (waves ? of_waves : of_calm_surface), least / far_of_liquid);
  choice.surface_why =
      fmt::format("a {} of the hull's breadth of {:.3g} m{}", waves ? "twentieth" : "fifth", breadth,
                  waves ? ", forty elements on a wave of two breadths" : "; near the hull the hull's size decides");
  choice.far = std::max(choice.surface, std::min(breadth, least / far_of_liquid));
  choice.far_why = fmt::format("the hull's breadth, at most an eighth of the liquid's least extent of {:.3g} m", least);
  return choice;
}

template <int d>
Choice<d> choose(const Scene& scene) {
  auto choice = choose_for_bodies<d>(scene);
  choose_for_effects<d>(scene, choice);
  return choice;
}

/// The smallest elements at the roots of thin jets, and why. Of bodies that are pushed in until the run ends: a free one
/// goes on after its peak, and small elements in every hollow of what it leaves behind cost up to twenty times the run
/// without changing the peak's filtered loads.
template <int d>
std::optional<std::pair<double, std::string>> root_size(const Scene& scene, const std::vector<Hull<d>>& hulls) {
  std::optional<std::pair<double, std::string>> finest;
  for (std::size_t b = 0; b < hulls.size(); ++b) {
    const auto& body = scene.bodies[b];
    const auto jet = thin_jet(body, hulls[b]);
    const double hull = body.size > 0 ? body.size : hulls[b].size();
    const bool is_pushed = body.motion == Motion::prescribed && hulls[b].half < hulls[b].breadth / 2;
    if (!jet || !is_pushed || hull <= rounding * *jet / a_jet) continue;
    const double two = *jet / a_jet, least = hulls[b].size() / finest_root, size = std::max(two, least);
    if (finest && finest->first <= size) continue;
    finest.emplace(
        size, two >= least
                  ? fmt::format("{:g} elements across the jet of {}, {:.2g} m thick", a_jet, body.name, *jet)
                  : fmt::format("an eighth of the hull's at least; the jet of {} is {:.2g} m thick", body.name, *jet));
  }
  return finest;
}

}  // namespace

template <int d>
std::vector<ChosenSize> size_rules(const Scene& scene) {
  const auto choice = choose<d>(scene);
  if (!(choice.surface > 0)) return {};
  std::vector<ChosenSize> list;
  const auto fluid = [&](const char* key, double value, const std::string& why, const char* unit = " m") {
    list.push_back({"fluid.size", 0, key, value, unit, why});
  };
  const double surface = two_digits(choice.surface);
  fluid("surface", surface, choice.surface_why);
  fluid("far", std::max(surface, two_digits(choice.far)), choice.far_why);
  fluid("growth", Rules<d>::growth, d == 2 ? "in the plane" : "in space", "");
  if (choice.enters)
    fluid("wetted_fraction", Rules<d>::wetted_fraction,
          fmt::format("{:.2g} elements on half of the wetted width once the hull is wetted farther",
                      1 / Rules<d>::wetted_fraction),
          "");
  if (const auto root = root_size<d>(scene, choice.hulls)) {
    fluid("hollow", of_root, "of the radius of a jet's root", "");
    fluid("hollow_min", two_digits(root->first), root->second);
  }
  for (std::size_t b = 0; b < choice.hulls.size(); ++b) {
    const auto& hull = choice.hulls[b];
    if (scene.bodies[b].makes_waves) continue;
    const double size = two_digits(hull.size());
    list.push_back({"body", b, "size", std::min(size, surface), " m",
                    size < surface
                        ? fmt::format("{:g} elements on {}, {:.2g} m", hull.half / hull.size(), hull.why, hull.half)
                        : "that of the surface"});
  }
  return list;
}

template <int d>
std::vector<std::string> sizes_against_rules(const Scene& scene) {
  std::vector<std::string> list;
  const auto choice = choose<d>(scene);
  const auto& size = scene.fluid->size;
  for (std::size_t b = 0; b < choice.hulls.size(); ++b) {
    const auto& hull = choice.hulls[b];
    const auto& body = scene.bodies[b];
    if (body.makes_waves) continue;
    const double most = allowance<d>(size, hull);
    if (body.size > most * hull.size())
      list.push_back(fmt::format(
          "body.{}.size = {:.3g} m puts {:.2g} elements on {} ({:.2g} m), not {:g}: use {:.2g} m", body.name, body.size,
          hull.half / body.size, hull.why, hull.half, hull.half / hull.size(), two_digits(hull.size())));
    if (hull.enters && size.wetted_fraction > most * Rules<d>::wetted_fraction)
      list.push_back(fmt::format(
          "fluid.size.wetted_fraction = {:g} leaves {:.2g} elements on half of the wetted width, "
          "not {:.2g}: use {:g}",
          size.wetted_fraction, 1 / size.wetted_fraction, 1 / Rules<d>::wetted_fraction, Rules<d>::wetted_fraction));
    if (auto jet = jet_against_rules(scene, body, hull)) list.push_back(std::move(*jet));
  }
  if (choice.surface > 0 && size.surface > rounding * choice.surface)
    list.push_back(fmt::format("fluid.size.surface = {:.3g} m is more than {}: use {:.2g} m", size.surface,
                               choice.surface_why, two_digits(choice.surface)));
  const double most_growth = 0.3;  // of the examples
  if (size.growth > most_growth)
    list.push_back(fmt::format("fluid.size.growth = {:g} is more than {:g}: use {:g}", size.growth, most_growth,
                               Rules<d>::growth));
  return list;
}

template std::vector<ChosenSize> size_rules<2>(const Scene&);
template std::vector<ChosenSize> size_rules<3>(const Scene&);
template std::vector<std::string> sizes_against_rules<2>(const Scene&);
template std::vector<std::string> sizes_against_rules<3>(const Scene&);

}  // namespace splashdown::apps
