#include "apps/effects/wind/wind.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/effects/aero/aero.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {
namespace {

/// The fluid of a grid is the air, which blows everywhere alike.
void check_on_grid(const Scene& scene, const WindTable& table, Problems& problems) {
  if (table.profile == "log")
    problems.add("wind.profile", "must be \"uniform\" with fluid.formulation = \"vortex\"",
                 "Remove profile, height, roughness and level.");
  if (!scene.vortex->stream.empty())
    problems.add("wind", "and fluid.stream.velocity both say how the fluid moves", "Remove one of them.");
  if (scene.effects.find<AeroTables>())
    problems.add("body.aero", "would count the loads of the fluid on the grid twice", "Remove it.");
}

}  // namespace

template <int d>
rigid::Wind<d> wind_of(const WindTable& table, const Scene& scene) {
  rigid::Wind<d> wind;
  wind.velocity = vec<d>(table.velocity);
  wind.roughness = table.profile == "log" ? table.roughness : 0;
  wind.height = table.height;
  wind.level = table.level ? *table.level : still_water_level<d>(scene).value_or(0);
  if (!table.gust) return wind;
  wind.gust = vec<d>(table.gust->velocity);
  wind.gust_start = table.gust->start;
  wind.gust_duration = table.gust->duration;
  return wind;
}

template rigid::Wind<2> wind_of<2>(const WindTable&, const Scene&);
template rigid::Wind<3> wind_of<3>(const WindTable&, const Scene&);

void WindKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<WindTable>();
  const Rule velocity = any("m/s", "Use one number for each axis.");
  reader.point("velocity", table.velocity, velocity, Need::required);
  reader.choice("profile", table.profile, {"uniform", "log"});
  if (table.profile == "log") {
    reader.number("height", table.height, positive("m", "Use the height at which velocity is measured, e.g. 10."));
    reader.number("roughness", table.roughness, positive("m", "Use 0.0002 at sea, 0.03 over grass."));
    reader.number("level", table.level, any("m", "Leave it out for that of the water."));
  } else {
    for (const auto* key : {"height", "roughness", "level"})
      reader.refuse(key, "only a wind with profile = \"log\" has one", "Remove it, or add profile = \"log\".");
  }
  if (auto gust = reader.table("gust")) {
    auto& of = table.gust.emplace();
    gust->point("velocity", of.velocity, velocity, Need::required);
    gust->number("start", of.start, not_negative("s", "Use the time at which it begins."));
    gust->number("duration", of.duration, positive("s", "Use how long it lasts from calm to calm."), Need::required);
  }
}

void WindKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<WindTable>();
  if (!table || problems.found_in("wind")) return;
  if (table->profile == "log" && table->height <= table->roughness)
    problems.add(
        problems.noted("wind.roughness") ? "wind.roughness" : "wind.height",
        fmt::format("the height, {:g} m, must be above the roughness, {:g} m", table->height, table->roughness),
        "Use a smaller roughness.");
  if (scene.vortex) return check_on_grid(scene, *table, problems);
  if (!scene.effects.find<AeroTables>() && !problems.found_in("body"))
    problems.add("wind", "nothing feels it: no body has [body.aero]",
                 "Add [body.aero] to a body, or remove the table.");
}

std::optional<std::string> WindKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  const auto& table = *scene.effects.find<WindTable>();
  if (const double across = table.velocity[mirror.axis]; across != 0)
    return fmt::format("blows across the plane at {:g} m/s", across);
  if (table.gust && table.gust->velocity[mirror.axis] != 0)
    return fmt::format("has a gust of {:g} m/s across the plane", table.gust->velocity[mirror.axis]);
  return {};
}

// The strongest winds that were measured outside of tornadoes, Barrow Island 1996, are 113 m/s.
void WindKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  constexpr double strongest = 113, knots = 0.5144;
  const auto* table = asked.scene.effects.find<WindTable>();
  if (!table) return;
  const auto question = [&](const char* key, const Point& velocity) {
    if (velocity.norm() > strongest)
      questions.push_back(fmt::format("{}: {:.3g} m/s is more than any hurricane has: did you mean {:.3g}?", key,
                                      velocity.norm(), knots * velocity.norm()));
  };
  question("wind.velocity", table->velocity);
  if (table->gust) question("wind.gust.velocity", table->gust->velocity);
}

std::optional<EffectNote> WindKind::note(const Scene& scene, const Scales& s) const {
  const auto* table = scene.effects.find<WindTable>();
  if (!table) return {};
  const double most = table->velocity.norm() + (table->gust ? table->gust->velocity.norm() : 0);
  return EffectNote{"wind", true,
                    fmt::format("up to {:.3g} m/s, {:.3g} of the speed of what moves", most, most / s.speed)};
}

}  // namespace splashdown::apps
