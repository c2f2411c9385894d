#include "apps/scene/numbers.hpp"

#include <fmt/format.h>

#include "apps/scene/channel_classes.hpp"
#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {
namespace {

class Numbers {
 public:
  explicit Numbers(const Scene& scene) : scene_(scene) {}

  std::vector<NamedNumber> all() && {
    for (const auto& body : scene_.bodies) add_body(body);
    if (scene_.ale)
      for (const auto& goal : scene_.ale->goals) {
        const auto of = "goals." + goal.body + "." + goal.direction;
        numbers_.push_back({.name = of, .unit = "N/m", .paths = {of + ".value"}, .body = goal.body, .peak = false});
      }
    for (const auto* kind : effect_kinds())
      for (auto& number : kind->numbers(scene_)) numbers_.push_back(std::move(number));
    for (const auto& record : scene_.records) std::visit([this](const auto& entry) { add(entry); }, record);
    return std::move(numbers_);
  }

 private:
  void one(const std::string& name, const std::string& unit, const std::string& path, const std::string& body) {
    numbers_.push_back({.name = name, .unit = unit, .paths = {path}, .body = body});
  }
  /// "NAME", "NAME_raw", "NAME_cfc60" ..., with the folder of each in summary.json.
  void pulses(const std::string& name, const std::string& unit, const std::string& raw, const std::string& filtered,
              const std::string& body) {
    const auto of_class = [&](int cfc) { return fmt::format("{}.cfc{}.value", filtered, cfc); };
    numbers_.push_back(
        {.name = name, .unit = unit, .paths = {of_class(structures_class), raw + ".value"}, .body = body});
    one(name + "_raw", unit, raw + ".value", body);
    for (const int cfc : channel_frequency_classes) one(fmt::format("{}_cfc{}", name, cfc), unit, of_class(cfc), body);
  }

  void add_body(const Body& body) {
    const auto& name = body.name;
    const std::string of = "bodies." + name + ".";
    if (body.becomes_free())
      pulses(name + ".peak_g", "g", of + "peak_acceleration_g.raw", of + "peak_acceleration_g", name);
    if (!scene_.has_fluid()) return;
    const std::string force = scene_.dimension == 2 ? "N/m" : "N", impulse = scene_.dimension == 2 ? "N s/m" : "N s";
    pulses(name + ".peak_force", force, of + "peak_force", of + "peak_force_filtered", name);
    numbers_.push_back({.name = name + ".impulse",
                        .unit = impulse,
                        .paths = {fmt::format("{}impulse.{}", of, scene_.dimension - 1)},
                        .body = name,
                        .peak = false});
    one(name + ".greatest_submergence", "m", of + "maximum_submergence.value", name);
    one(name + ".maximum_wetted", scene_.dimension == 2 ? "m" : "m^2", of + "maximum_wetted.value", name);
    one(name + ".maximum_tilt", "deg", of + "maximum_tilt_deg.value", name);
  }
  void add(const PatchEntry& patch) {
    one(patch.name + ".peak_pressure", "Pa", "patches." + patch.name + ".peak_pressure.value", body_of(patch.body));
  }
  void add(const PressureEntry& point) {
    one(point.name + ".peak_pressure", "Pa", "probes." + point.name + ".peak_pressure.value",
        point.body ? body_of(*point.body) : "");
  }
  void add(const AccelerationEntry& point) {
    const auto of = "equipment." + point.name;
    pulses(point.name + ".peak_g", "g", of + ".raw", of, body_of(point.body));
  }
  void add(const MaximumPressureEntry& map) {
    const auto name = body_of(map.body);
    one(name + ".maximum_pressure", "Pa", "bodies." + name + ".maximum_pressure.value", name);
  }
  template <class Other>
  void add(const Other&) {}  // curves and matrices: no single number is the one that is meant

  /// Nothing where the record names none, which is told.
  std::string body_of(std::size_t index) const { return index < scene_.bodies.size() ? scene_.bodies[index].name : ""; }

  const Scene& scene_;
  std::vector<NamedNumber> numbers_;
};

}  // namespace

std::vector<NamedNumber> numbers_of(const Scene& scene) { return Numbers(scene).all(); }

}  // namespace splashdown::apps
