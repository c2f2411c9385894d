// What a part is of a whole, where there is a whole.
//
// A ratio with nothing below its line says nothing, however many digits it has: the repair part of an impulse that cancels out, a
// band over a value that is zero. Whoever prints a ratio takes it from here.
#pragma once

#include <optional>
#include <string>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// |part / whole|; nothing where there is no meaningful one: the whole is no number or within `noise` of zero [unit of both], or
/// the part is larger than the whole, of which it then is none.
std::optional<double> share_of(double part, double whole, double noise = 0);

/// The same of values that may be larger than what they are held against, a band or a change: no upper bound but `most`.
std::optional<double> ratio_of(double value, double reference, double noise = 0, double most = 10);

/// Loads to and fro whose impulse is less than this share of what they are one by one cancel each other: nothing is a share of
/// what is left. A tenth: the share of a part that is known to 1 % is then known to 10 %.
inline constexpr double cancels_below = 0.1;

/// Of the impulse of the load on a body, what repairs brought.
std::optional<double> repair_share(const BodySummary& body);

/// "2.1 %", two digits without an exponent, "less than 0.1 %"; "no meaningful share" for nothing.
std::string share_text(const std::optional<double>& share);

}  // namespace splashdown::apps
