// A verdict as an engineer reads it: what is trusted, what is not, what to do. Console, summary.json, report and price take their
// words from here.
//
//   trusted   a number that is resolved          "peak acceleration 12.3 g (CFC 60, within 4 %)"
//   doubted   any other one, with the largest    "peak pressure on belly 18 kPa (may be off by a third: only 3 elements across it)"
//             of its errors
//   advice    what findings ask for, then the next step
//
// Each headline number (grades.hpp) is in exactly one of the first two; so are the water's volume and energy where there is water.
#pragma once

#include <string>
#include <vector>

#include "apps/statistics/summary.hpp"
#include "apps/statistics/verdict/grades.hpp"

namespace splashdown::apps {

/// Of a relative band: "within 4 %", "may be off by a third", "may be off by half and more", "tells no more than the order of magnitude",
/// "has no band". The fraction that is named is never less than the band; above a half none is.
std::string band_words(double band);

/// The same beside a number: "+- 4 %", "half and more", "order of magnitude", "no band".
std::string band_mark(double band, const std::string& sign = "+- ");

/// A share of error that may be large: "3 %", "more than half".
std::string part_words(double share);

/// A headline of a body, with its body where `several` have some.
std::string statement_of(const Summary& summary, const std::string& body, const Headline& headline, bool several);

/// The causes that its statement leaves out, "peak force (also its steps are long for the filter)"; empty: there are none.
std::string further_causes(const Summary& summary, const std::string& body, const Headline& headline, bool several);

/// Neighbours in the same brackets share them, and their body: "peak force 3 N, peak acceleration 2 g (within 4 %)".
std::vector<std::string> grouped(const std::vector<std::string>& statements);

/// Of a judged run, never empty: last stands the next step, if there is one.
std::vector<std::string> advice_of(const Summary& summary);

}  // namespace splashdown::apps
