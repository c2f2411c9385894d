// What a run says to the limits that its scene asks about: yes, no, or within the band.
//
//   "above":  yes  value - band > limit       no  value + band < limit       ("below" the other way round)
//
// The band of an expression is that of its numbers together: sum of |change| as each goes to the ends of its own band; one of
// them without a band, and it has none. Neither yes nor no, with the reason told, is
//
//   a number that the run does not have, or that has no band
//   anything about a body, or a place, that stayed dry, or in water that is unphysical
//   "not above" in a run that ended before the scene's end, or whose peak lies in its last 2 %: what is larger may come yet
//
// A peak that is above before such a run ends is above: it never falls.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "apps/scene/limit.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// The summary must have been judged. `end`: the scene's [s].
std::vector<LimitAnswer> answered(std::span<const Limit> limits, std::span<const NamedNumber> numbers,
                                  const Summary& summary, double end);

/// A number that several runs know better than one.
struct MeanNumber {
  double value = 0, band = 0;  ///< to either side, unit of the number
  int runs = 0;
};
/// By its path in summary.json.
using MeanNumbers = std::map<std::string, MeanNumber>;
/// The same of a run whose summary.json is this, with means in place of its own numbers where there are some.
std::vector<LimitAnswer> answered(std::span<const Limit> limits, std::span<const NamedNumber> numbers,
                                  const nlohmann::json& summary, double end, const MeanNumbers& means);

/// "13.2 kPa": metric prefixes only where the unit takes them.
std::string value_text(double value, const std::string& unit);
/// "belly: above 20 kPa? no, 13.2 kPa +- 1.1 kPa"
std::string text_of(const LimitAnswer& limit);

}  // namespace splashdown::apps
