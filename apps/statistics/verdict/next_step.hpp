// What would make a verdict better, and whether that is known or only likely.
//
//   the load still rises, or no body met the water   a longer run
//   the band is of elements                          finer ones: 1.4 to 8 times, the first that makes the grade better
//   it is of long steps, too                         and steps no longer than J211 asks for, 1/(10 CFC); alone where that is enough
//
// What is predicted of a band: its mesh's share falls as 1/n, that of sampling becomes that of J211's steps, the others stay as they
// are. A better grade is promised where that leaves a tenth to spare and shares that neither changes are not the largest; elsewhere
// the text says that it may not come. An impulse has no cure, no mesh gives its peak a value.
#pragma once

#include <optional>
#include <string>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// Of a graded summary; nothing to do if every headline is resolved.
std::optional<NextStep> next_step(const Summary& summary);

/// As they stand on a command line: "--refine 2 --set time.dt_max=0.0033", "--set time.end=0.05".
std::string options_of(const NextStep& next);

/// "--refine 2, about 3 min: brings the bands within 10 %", with the whole command if there is one.
std::string text_of(const NextStep& next);

/// Wall time over refinement: all sizes divided by r cost r^this. Middle of what docs/guide.md, "The band", measures; elements of
/// one size everywhere would have 3 and 4.
constexpr double cost_exponent(int dimension) { return dimension == 2 ? 2 : 3; }

}  // namespace splashdown::apps
