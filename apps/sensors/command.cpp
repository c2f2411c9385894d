#include "apps/sensors/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "apps/process/exit.hpp"
#include "apps/sensors/places.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

int sensors_command(const SensorsOptions& options) {
  try {
    auto places = rank_places(read_candidates(options.reference, options.other, options.kind),
                              static_cast<std::size_t>(options.count));
    const auto candidates = places.size();
    if (!options.all) std::erase_if(places, [](const SensorPlace& place) { return place.rank == 0; });
    std::ranges::stable_sort(places, {}, [](const SensorPlace& place) {
      return place.rank > 0 ? place.rank : std::numeric_limits<std::size_t>::max();
    });
    fmt::print("{} candidates, signal {}; differences over the strongest signal of {}\n", candidates, options.kind,
               options.reference.string());
    fmt::print("{:>4}  {:20}{:>12}{:>12}{:>14}{:>14}{:>12}\n", "rank", "place", "difference", "new", "arrival", "there",
               "later by");
    for (const auto& place : places)
      fmt::print("{:>4}  {:20}{:>12}{:>12}{:>14}{:>14}{:>12}\n", place.rank ? std::to_string(place.rank) : "-",
                 place.name, percent(place.distance), place.rank ? percent(place.new_share) : "-",
                 with_unit(place.arrival_reference, "s"), with_unit(place.arrival_other, "s"),
                 with_unit(place.arrival_other - place.arrival_reference, "s"));
    return exit_code::done;
  } catch (const std::runtime_error& error) {
    return bad_input(trouble(error));
  }
}

}  // namespace splashdown::apps
