// What [waves] needs of a scene, what `check` asks about it, and what it says.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "apps/effects/absorber/absorber.hpp"
#include "apps/effects/waves/sea.hpp"
#include "apps/effects/waves/waves.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/problems.hpp"
#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/waves.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

// What there has to be before a sea can be made.
bool has_a_tank_of_water(const Scene& scene, Problems& problems) {
  const auto fail = [&](const std::string& rule, const std::string& cure) {
    problems.add("waves", rule, cure);
    return false;
  };
  if (!scene.fluid) return fail("needs a [fluid]", "Add [fluid] or remove the table.");
  if (!scene.tank)
    return fail("needs a [tank]: the sea is kept alive along its sides", "Add [tank] or remove the table.");
  if (!scene.gravity) return fail("needs [gravity]", "Add [gravity] or remove the table.");
  if (!straight_pull(scene))
    return fail("needs gravity that points straight down", "Turn the scene so that the last axis is up.");
  if (scene.effects.find<Absorber>()) return fail("absorbs other waves itself", "Remove [fluid.absorber].");
  if (wavy_region(scene) < 0)
    return fail("needs a fluid.region of shape box over the whole floor of the tank, with a flat top",
                "Let one box reach from the tank's floor to the still level, and from wall to wall.");
  return true;
}

template <int d>
void check_zones(const Scene& scene, const fluid::WaveField<d>& sea, Problems& problems) {
  const auto zones = zones_of<d>(scene, sea);
  for (int k = 0; k < d - 1; ++k) {
    const double length = zones.max[k] - zones.min[k];
    if (2 * zones.width[k] < length) continue;
    problems.add(
        scene.effects.find<Waves>()->zone ? "waves.zone" : "tank.max",
        fmt::format("two zones of {:.4g} m leave nothing of the tank's {:.4g} m along {}", zones.width[k], length,
                    "xy"[k]),
        fmt::format("Make it {:.3g} m long: zones of 1.5 wavelengths and two between them.", 5 * sea.length()));
  }
}

template <int d>
void check_sea(const Scene& scene, Problems& problems) {
  const auto& table = *scene.effects.find<Waves>();
  const char* key = table.touchdown           ? "waves.touchdown"
                    : table.type == "regular" ? "waves.height"
                                              : "waves.peak_period";
  try {
    Scene alone = scene;  // the waves first
    alone.effects.table<Waves>().touchdown.reset();
    key = table.type == "regular" ? "waves.height" : "waves.current";
    const auto sea = sea_of<d>(alone);
    check_zones<d>(scene, *sea, problems);
    if (!table.touchdown) return;
    key = "waves.touchdown";
    sea_of<d>(scene);
  } catch (const std::invalid_argument& error) {
    problems.add(key, error.what(),
                 table.touchdown && key == std::string("waves.touchdown")
                     ? "Start the body above the water with a velocity downward, or end the run later."
                     : "Use a lower or a longer wave, or deeper water.");
  }
}

/// Of the heights of a sea: what may break.
double steepness_height(const Waves& table) {
  return table.type == "regular" ? table.height : table.type == "focused" ? 2 * table.crest : table.significant_height;
}

template <int d>
void ask_about(const Scene& scene, std::vector<std::string>& questions) {
  const auto& table = *scene.effects.find<Waves>();
  const auto sea = sea_of<d>(scene);
  const auto zones = zones_of<d>(scene, *sea);
  const double h = scene.fluid->size.surface, length = sea->length();
  constexpr double coarse = 20, guide = 40;  // elements a wave
  if (length < coarse * h)
    questions.push_back(fmt::format(
        "fluid.size.surface = {:g} m: {:.2g} elements on waves of {:.3g} m, which lose height: did you mean "
        "{:.2g} m, {:g} a wave?",
        h, length / h, length, length / guide, guide));
  if (steepness_height(table) < h / 5)
    questions.push_back(fmt::format("waves: {:g} m high on elements of {:g} m: did you mean {:g} m?",
                                    steepness_height(table), h, 1000 * steepness_height(table)));
  const double depth = still_water_level<d>(scene).value_or(0) - scene.tank->min[d - 1];
  // Irregular seas break in their highest waves, twice the significant height.
  const double highest = table.type == "irregular" ? 2 * table.significant_height : steepness_height(table);
  const double breaks = fluid::breaking_height(length, depth);
  if (table.type != "regular" && highest > breaks)
    questions.push_back(fmt::format(
        "waves: the highest waves, {:.3g} m, break at {:.3g} m: did you mean a longer peak_period?", highest, breaks));
  for (int k = 0; k < d - 1; ++k) {
    const double room = zones.max[k] - zones.min[k] - 2 * zones.width[k];
    if (zones.width[k] > 0 && room < length)
      questions.push_back(
          fmt::format("tank: {:.3g} m between the zones of the waves, less than a wavelength of {:.3g} m: did you mean "
                      "{:.3g} m along {}?",
                      room, length, 2 * zones.width[k] + 2 * length, "xy"[k]));
    if (zones.width[k] > 0 && zones.width[k] < 0.9 * length)
      questions.push_back(fmt::format(
          "waves.zone = {:g} m: shorter than a wavelength, {:.3g} m: it throws waves back: did you mean {:.3g} m?",
          zones.width[k], length, 1.5 * length));
  }
  for (const auto& body : scene.bodies) {
    const auto box = extents<d>(outline<d>(body));
    bool reached = false;
    for (int k = 0; k < d - 1; ++k)
      reached = reached || (zones.width[k] > 0 && (box.min()[k] < zones.min[k] + zones.width[k] ||
                                                   box.max()[k] > zones.max[k] - zones.width[k]));
    if (reached)
      questions.push_back(
          fmt::format("body.{}: stands in a zone of the waves at t = 0, where the water moves as if it were not there: "
                      "did you mean a place between the zones, {} m?",
                      body.name, text<d>(Extents<d>(zones.min + zones.width, zones.max - zones.width))));
    const rigid::Vec<d> at = box.center();
    const bool floats = box.min()[d - 1] < sea->elevation(at, 0) + still_water_level<d>(scene).value_or(0);
    if (floats && table.ramp == 0 && body.motion == Motion::free && body.velocity.isZero(0))
      questions.push_back(fmt::format("body.{}.velocity: at rest in water that moves with {} m/s: did you mean that?",
                                      body.name, text<d>(sea->velocity(at, 0), 3)));
  }
}

}  // namespace

void WavesKind::check(const Scene& scene, Problems& problems) const {
  if (!present(scene)) return;
  for (const char* key : {"waves", "tank", "fluid", "gravity", "body", "time"})
    if (problems.found_in(key)) return;
  if (!has_a_tank_of_water(scene, problems)) return;
  scene.dimension == 2 ? check_sea<2>(scene, problems) : check_sea<3>(scene, problems);
}

void WavesKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  if (!present(asked.scene)) return;
  asked.scene.dimension == 2 ? ask_about<2>(asked.scene, questions) : ask_about<3>(asked.scene, questions);
}

namespace {

template <int d>
std::string words(const Scene& scene, const Scales& s) {
  const auto sea = sea_of<d>(scene);
  const auto zones = zones_of<d>(scene, *sea);
  const auto& table = *scene.effects.find<Waves>();
  const double height = steepness_height(table), k = 2 * pi / sea->length(), depth = s.level - scene.tank->min[d - 1];
  std::string out = fmt::format("{:.4g} m long, {:.4g} s, H/L = {:.3g}, kd = {:.3g}, H/L of the body = {:.3g}",
                                sea->length(), sea->period(), height / sea->length(), k * depth, height / s.length);
  out += fmt::format("; zones of {:.3g} m at {:.3g} /s, {:.2g} elements a wave", zones.width.maxCoeff(), zones.rate,
                     sea->length() / scene.fluid->size.surface);
  if (!table.touchdown) return out;
  const auto& body = scene.bodies[table.touchdown->body];
  if (const auto contact = first_contact<d>(scene, body, *sea, s.level, scene.time.end))
    out += fmt::format("; {} touches the water at {:.4g} s, {:.3g} deg behind a crest", body.name, contact->time,
                       sea->phase(contact->place, contact->time) * 180 / pi);
  return out;
}

}  // namespace

std::optional<EffectNote> WavesKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid || s.gravity == 0) return {};
  if (!present(scene))
    return EffectNote{
        "waves", false,
        fmt::format("the sea is calm; waves {:.3g} m long, of the body's length, have a period of {:.3g} s", s.length,
                    std::sqrt(2 * pi * s.length / s.gravity))};
  return EffectNote{"waves", true, scene.dimension == 2 ? words<2>(scene, s) : words<3>(scene, s)};
}

// Waves look the same from both sides of a line that they run along.
std::optional<std::string> WavesKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  constexpr double roundoff = 1e-9;
  const auto& table = *scene.effects.find<Waves>();
  const double turn = table.direction_deg * radians, along = mirror.axis == 0 ? std::cos(turn) : std::sin(turn);
  if (table.spreading == 0 && std::abs(along) < roundoff) return {};
  return "has waves that cross the plane";
}

std::optional<WantedSize> WavesKind::surface_size(const Scene& scene) const {
  if (!present(scene) || !scene.tank || !scene.gravity || wavy_region(scene) < 0) return {};
  // Heights within 1 to 2 %; a spectrum has waves a third as long that lose some of theirs: docs/waves.md.
  const double a_wave = scene.effects.find<Waves>()->type == "regular" ? 40 : 60;
  const double length = scene.dimension == 2 ? sea_of<2>(scene)->length() : sea_of<3>(scene)->length();
  return WantedSize{length / a_wave, fmt::format("{:g} elements on waves of {:.3g} m", a_wave, length)};
}

}  // namespace splashdown::apps
