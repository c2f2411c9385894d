#include "apps/effects/wavemaker/wavemaker.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/effects/absorber/absorber.hpp"
#include "apps/effects/wavemaker/flume.hpp"
#include "apps/effects/waves/waves.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/scene/scales.hpp"
#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/wavemaker.hpp"

namespace splashdown::apps {
namespace {

/// The absorber's zone stands where the paddle does.
bool is_damped(const Absorber& zone, const Wavemaker& table) { return zone.ends == "both" || zone.ends == table.end; }

void read_regular(Reader& reader, Wavemaker& table) {
  reader.number("period", table.period, positive("s", "Use the time from crest to crest."), Need::required);
  reader.number("height", table.height, positive("m", "Use that of a crest above a trough, or give the stroke."));
  reader.number("stroke", table.stroke,
                positive("m", "Use the paddle's way at the still level from end to end, or give the height."));
  if (table.height.has_value() == table.stroke.has_value())
    reader.context().problems.add(reader.key(table.stroke ? "stroke" : "height"),
                                  "the waves have a height, or the paddle has a stroke",
                                  table.stroke ? "Remove one of them." : "Give one of them.");
}

void read_irregular(Reader& reader, Wavemaker& table) {
  double height = 0;
  reader.number("significant_height", height, positive("m", "Use the mean height of the highest third of the waves."),
                Need::required);
  table.significant_height = height;
  reader.number("peak_period", table.peak_period, positive("s", "Use the period of the largest waves."),
                Need::required);
  reader.number("gamma", table.gamma, within(1, 20, "", "Use 3.3 for JONSWAP, 1 for Pierson and Moskowitz."));
  reader.integer("seed", table.seed, within(0, 2e9, "", "Use any whole number; the same seed gives the same sea."));
  reader.integer("repeat", table.repeat, within(10, 5000, "", "Use at least as many peak periods as the run lasts."));
  for (const char* key : {"period", "height", "stroke"})
    reader.refuse(key, "belongs to regular waves, significant_height and peak_period to an irregular sea",
                  "Remove it, or the two.");
}

std::string end_words(const Wavemaker& table) { return table.end == "lower" ? "upper" : "lower"; }

void check_waves(const Scene& scene, const Wavemaker& table, const Flume& flume, Problems& problems) {
  const auto of = forecast(table, flume);
  const double limit = fluid::breaking_height(of.length(), flume.depth);
  const char* given = table.significant_height ? "wavemaker.significant_height"
                      : table.stroke           ? "wavemaker.stroke"
                                               : "wavemaker.height";
  if (of.height >= limit)
    problems.add(given,
                 fmt::format("waves of {:.3g} m, {:.3g} m long on {:.3g} m of water, break: they end at {:.3g} m",
                             of.height, of.length(), flume.depth, limit),
                 fmt::format("Use at most {:.2g} m{}.", 0.8 * limit * (table.stroke ? of.stroke / of.height : 1),
                             table.stroke ? "" : ", or a longer period"));
  else if (flume.free * share_of_freeboard < of.highest)
    problems.add("tank.max",
                 fmt::format("the tank ends {:.3g} m above the still level: waves of {:.3g} m run over the paddle",
                             flume.free, of.highest),
                 fmt::format("Let it reach {:.3g} m above.", 2 * of.highest));
  if (const auto* zone = scene.effects.find<Absorber>(); zone && is_damped(*zone, table))
    problems.add("fluid.absorber.ends", fmt::format("its zone at the {} end damps what the paddle makes", table.end),
                 fmt::format("Use ends = \"{}\".", end_words(table)));
}

void check_room(const Scene& scene, const Wavemaker& table, const Flume& flume, Problems& problems) {
  if (!(table.hinge < flume.depth)) return;
  const auto paddle =
      std::ranges::find_if(scene.bodies, [](const Body& body) { return !body.path.empty() && body.makes_waves; });
  if (paddle == scene.bodies.end()) return;
  const double room = room_behind(table, flume, paddle->path);
  if (flume.behind < room)
    problems.add(
        table.end == "lower" ? "tank.min" : "tank.max",
        fmt::format("the paddle needs {:.3g} m of dry tank behind its face at x = {:.4g} m, there are {:.3g} m", room,
                    flume.face, flume.behind),
        fmt::format("Let the tank {} at x = {:.4g}; the region stays where it is.",
                    table.end == "lower" ? "begin" : "end", flume.face - flume.inward * 1.1 * room));
}

/// What of a flap's wall may be fixed: the part above it swings by a right angle at most, and has to send waves.
constexpr double highest_hinge = 0.8;

}  // namespace

void WavemakerKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Wavemaker>();
  using Names = std::vector<std::string>;
  const bool known = reader.choice("type", table.type, scene.dimension == 2 ? Names{"piston", "flap"} : Names{"piston"},
                                   Need::required);
  reader.choice("end", table.end, {"lower", "upper"});
  if (table.type == "flap")
    reader.number("hinge", table.hinge, not_negative("m", "Use its height above the tank's floor; 0 is on the floor."));
  else
    reader.refuse("hinge", "a piston has none", "Remove it, or use type = \"flap\".");
  if (reader.holds("significant_height") || reader.holds("peak_period"))
    read_irregular(reader, table);
  else
    read_regular(reader, table);
  reader.number("ramp", table.ramp, not_negative("s", "Use two periods."));
  if (!known || reader.context().problems.found_in(reader.path()) || !(scene.time.end > 0)) return;
  const auto flume = flume_of(scene, table);
  if (!flume || table.hinge >= flume->depth) return;
  for (auto& part : paddle_and_sill(scene, table, *flume)) scene.bodies.push_back(std::move(part));
}

void WavemakerKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<Wavemaker>();
  if (!table) return;
  for (const char* key : {"wavemaker", "tank", "fluid", "gravity", "time"})
    if (problems.found_in(key)) return;
  if (scene.effects.find<Waves>())
    return problems.add("wavemaker", "the sea of [waves] is there without it", "Remove one of the two tables.");
  const auto flume = flume_of(scene, *table);
  if (!flume)
    return problems.add("wavemaker",
                        fmt::format("needs [gravity] straight down and a fluid.region of shape box, at rest with a "
                                    "flat top, from the tank's floor up "
                                    "and from the paddle to the tank's {} end{}",
                                    end_words(*table), scene.dimension == 3 ? ", over the tank's whole breadth" : ""),
                        "The region begins at the face of the paddle; behind it the tank is dry.");
  if (table->hinge > highest_hinge * flume->depth)
    return problems.add(
        "wavemaker.hinge",
        fmt::format("{:g} m of {:.3g} m of water leave no paddle that sends waves", table->hinge, flume->depth),
        fmt::format("Use at most {:.2g} m.", highest_hinge * flume->depth));
  check_waves(scene, *table, *flume, problems);
  check_room(scene, *table, *flume, problems);
}

void WavemakerKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const auto* table = asked.scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(asked.scene, *table) : std::nullopt;
  if (!flume) return;
  constexpr double shallow = 0.3, steep = 0.05;
  const auto of = forecast(*table, *flume);
  const double kd = of.wave_number * flume->depth;
  const char* key = table->significant_height ? "peak_period" : "period";
  if (kd < shallow && of.height > steep * flume->depth)
    questions.push_back(fmt::format(
        "wavemaker.{} = {:g} s: waves of {:.3g} m, {:.3g} m long on {:.3g} m of water, change their "
        "form as they run (kd = {:.2g}): "
        "did you mean a shorter period?",
        key, table->significant_height ? table->peak_period : table->period, of.height, of.length(), flume->depth, kd));
  const double breaks = fluid::breaking_height(of.length(), flume->depth);
  if (table->significant_height && of.highest > breaks)
    questions.push_back(
        fmt::format("wavemaker: the highest waves, {:.3g} m, break at {:.3g} m: did you mean a longer peak_period?",
                    of.highest, breaks));
}

std::optional<EffectNote> WavemakerKind::note(const Scene& scene, const Scales&) const {
  const auto* table = scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(scene, *table) : std::nullopt;
  if (!flume) return {};
  const auto of = forecast(*table, *flume);
  const double speed = fluid::group_velocity(of.wave_number, flume->depth, flume->gravity);
  const double length = scene.tank->max.x() - scene.tank->min.x() - flume->behind;
  auto words = fmt::format(
      "{}, stroke {:.3g} m: waves of {:.3g} m, {:.4g} m long, H/L = {:.3g}, kd = {:.3g}, {:.2g} elements a wave; they "
      "reach the other end "
      "in {:.3g} s",
      table->type, of.stroke, of.height, of.length(), of.height / of.length(), of.wave_number * flume->depth,
      of.length() / scene.fluid->size.surface, length / speed);
  if (!scene.effects.find<Absorber>() && scene.time.end > length / speed)
    words += ", and come back: [fluid.absorber] lets them out";
  return EffectNote{"wavemaker", true, std::move(words)};
}

std::optional<WantedSize> WavemakerKind::surface_size(const Scene& scene) const {
  const auto* table = scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(scene, *table) : std::nullopt;
  if (!flume) return {};
  // Heights within 2 %, as in docs/waves.md; a spectrum has waves a third as long.
  const double a_wave = table->significant_height ? 60 : 40, length = forecast(*table, *flume).length();
  return WantedSize{length / a_wave, fmt::format("{:g} elements on waves of {:.3g} m", a_wave, length)};
}

std::vector<KnownSignal> WavemakerKind::signals(const Scene& scene) const {
  const auto& table = *scene.effects.find<Wavemaker>();
  const auto flume = flume_of(scene, table);
  if (!flume || !table.significant_height) return {};
  const auto sea = sea_of(table, *flume);
  const double level = scene.tank->min[scene.dimension - 1] + flume->depth;
  std::vector<KnownSignal> list;
  for (const auto& record : scene.records)
    if (const auto* gauge = std::get_if<ElevationEntry>(&record))
      list.push_back({gauge->name + ".undisturbed", [=, x = flume->inward * (gauge->x - flume->face)](double t) {
                        return level + sea->elevation(x, t);
                      }});
  return list;
}

}  // namespace splashdown::apps
