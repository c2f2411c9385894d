#include "apps/check/questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/check/questions/prepared_scene.hpp"
#include "apps/check/walls.hpp"
#include "apps/check/words.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/rules/rules.hpp"
#include "apps/scene/scales.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

// Who mistakes a unit is wrong by a thousand: mm for m, ms for s, g/cm^3 for kg/m^3.
constexpr double unit_slip = 1000;

void ask_about_density(const Scene& scene, Questions& list) {
  const double lightest = 70, heaviest = 13600;  // liquid hydrogen, mercury [kg/m^3]
  const double density = scene.fluid->density;
  const double other = density < lightest ? density * unit_slip : density / unit_slip;
  if (density >= lightest && density <= heaviest) return;
  list.push_back(fmt::format(
      "fluid.density = {:g}: {} than any liquid (liquid hydrogen {:g}, mercury {:g} kg/m^3): did you mean {:g}?",
      density, density < lightest ? "lighter" : "heavier", lightest, heaviest,
      other >= lightest && other <= heaviest ? other : 1000));
}

template <int d>
void ask_about_gravity(const Scene& scene, Questions& list) {
  auto pull = scene.gravity->acceleration;
  if (pull[d - 1] > 0) {
    const auto given = fmt::format("{:g}", pull[d - 1]);
    list.push_back(fmt::format("gravity.acceleration points upward ({} along {}): did you mean {}?", given,
                               d == 2 ? "y" : "z", axis_example(d, -pull[d - 1])));
  }
  const bool held = std::ranges::any_of(scene.bodies, [](const Body& body) { return body.motion != Motion::free; });
  if (scene.fluid && !scene.tank && !held)
    list.emplace_back(
        "there is gravity, but nothing holds the liquid: it falls freely, and what floats in it too: did you mean to "
        "write a [tank] with min and max?");
}

template <int d>
void ask_about_extent(const Body& body, Questions& list) {
  const double ship = 460, insect = 1e-3;  // [m] larger and smaller things than these do not land on water
  const double extent = extents<d>(outline<d>(body)).sizes().maxCoeff();
  if (extent <= ship && extent >= insect) return;
  const double factor = extent > ship ? 1 / unit_slip : unit_slip;
  const char* unit = extent > ship ? "in millimetres" : "in metres already";
  if (const auto* file = std::get_if<SurfaceShape>(&body.shape))
    list.push_back(fmt::format(
        "body.{} is {:.3g} m long: is its file {}? Did you mean shape.scale = {:g}, which makes it {:.3g} m long?",
        body.name, extent, unit, file->scale * factor, extent * factor));
  else
    list.push_back(fmt::format("body.{} is {:.3g} m long: are its lengths {}? Did you mean {:.3g} m?", body.name,
                               extent, unit, extent * factor));
}

/// In the plane a mass is one per metre of depth, in space one of the whole body.
template <int d>
void ask_about_mass(const Body& body, Questions& list) {
  const double lightest = 1, heaviest = 22600;  // below air, 1.2, and a thousandth of water; osmium [kg/m^3]
  const double mass = mass_properties<d>(body).mass, volume = shape_of<d>(body.shape).at_unit_density.mass;
  const double density = mass / volume;
  if (mass == 0 || body.without_mass || (density >= lightest && density <= heaviest)) return;
  const bool light = density < lightest;
  const double other = light ? unit_slip : 1 / unit_slip;
  list.push_back(fmt::format("body.{} has a mean density of {:.3g} kg/m^3: {}: did you mean {} = {:.4g}?", body.name,
                             density, light ? "lighter than air" : "denser than any matter (osmium 22600)",
                             body.mass ? "mass" : "density", (body.mass ? mass : density) * other));
}

template <int d>
void ask_about_velocity(const Body& body, double water_level, Questions& list) {
  const double up = body.velocity[d - 1], lowest = extents<d>(outline<d>(body)).min()[d - 1];
  if (body.motion != Motion::free || up <= 0 || lowest < water_level) return;
  std::vector<double> down(body.velocity.data(), body.velocity.data() + d);
  down.back() = -up;
  list.push_back(fmt::format("body.{}.velocity points upward, away from the water ({:g} along {}): did you mean {}?",
                             body.name, up, d == 2 ? "y" : "z", toml_list(down)));
}

void ask_about_frames(const Scene& scene, Questions& list) {
  const double a_film = 100;  // frames
  if (!scene.output.frames || *scene.output.frames <= scene.time.end) return;
  list.push_back(
      fmt::format("output.frames = {:g} s is the time from frame to frame, and the run ends at {:g} s: did "
                  "you mean {:g}, for {:g} frames?",
                  *scene.output.frames, scene.time.end, scene.time.end / a_film, a_film));
}

template <int d>
void ask_about_sizes(const Scene& scene, Questions& list) {
  // The finest of the shipped examples has 2000 elements across a body, 6000 across a tank.
  const double most_across_body = 1e4, most_across_liquid = 1e5;
  const auto ask = [&](const std::string& key, double size, double extent, double most, const std::string& what) {
    if (extent / size > most)
      list.push_back(fmt::format("{} = {:g} m: {} elements across {} of {:g} m: did you mean {:g} m?", key, size,
                                 rough(extent / size), what, extent, size * unit_slip));
  };
  Extents<d> liquid;
  for (const auto& region : scene.fluid->regions) liquid.extend(extents<d>(outline<d>(region)));
  ask("fluid.size.surface", scene.fluid->size.surface, liquid.sizes().maxCoeff(), most_across_liquid, "the liquid");
  for (const auto& body : scene.bodies)
    if (body.size != scene.fluid->size.surface)
      ask("body." + body.name + ".size", body.size, extents<d>(outline<d>(body)).sizes().maxCoeff(), most_across_body,
          "the body");
}

template <int d>
void ask_about_end(const Scene& scene, const Cost& cost, Questions& list) {
  const double many_steps = 1e5, many_times = 1e3;  // twenty and ten times those of the longest example
  const auto s = scales<d>(scene);
  const double turnover = s.speed > 0 ? s.length / s.speed : 0;
  if (turnover == 0 || cost.steps < many_steps || scene.time.end < many_times * turnover) return;
  list.push_back(
      fmt::format("time.end = {:g} s: about {} steps, {} times the {} in which things move by their length: did you "
                  "mean {:g} s?",
                  scene.time.end, rough(cost.steps), rough(scene.time.end / turnover), with_unit(turnover, "s"),
                  scene.time.end / unit_slip));
}

}  // namespace

template <int d>
Questions questions(const Scene& scene, const Cost& cost) {
  Questions list;
  if (scene.gravity) ask_about_gravity<d>(scene, list);
  const auto level = still_water_level<d>(scene);
  for (const auto& body : scene.bodies) {
    ask_about_extent<d>(body, list);
    if (body.mass || body.density) ask_about_mass<d>(body, list);
    if (level) ask_about_velocity<d>(body, *level, list);
  }
  if (scene.fluid) {
    ask_about_density(scene, list);
    ask_about_sizes<d>(scene, list);
  }
  const auto before_end = list.size();
  ask_about_end<d>(scene, cost, list);
  // Who means another end may never get to a wall.
  if (list.size() == before_end)
    for (auto& question : questions_about_walls<d>(scene)) list.push_back(std::move(question));
  ask_about_frames(scene, list);
  const auto prepared = prepared_scene<d>(scene, cost);
  ask_about_liquid(prepared, list);
  ask_about_bodies(prepared, list);
  ask_about_places(prepared, list);
  ask_about_times(prepared, list);
  return list;
}

std::optional<std::string> too_large(const Cost& cost) {
  if (cost.bytes <= memory_unasked) return {};
  return fmt::format("the run takes {} {} of memory for {} nodes, more than the {} that are taken unasked",
                     cost.at_least ? "more than" : "about", with_unit(cost.bytes, "B"), rough(cost.nodes_most),
                     with_unit(memory_unasked, "B"));
}

template Questions questions<2>(const Scene&, const Cost&);
template Questions questions<3>(const Scene&, const Cost&);

}  // namespace splashdown::apps
