// The functions of check.toml's expressions. y, x: columns of equal length; x increasing where it says so.
//
//   abs sqrt exp log sin cos            element by element
//   first last min max sum count rms    of y
//   mean(y), mean(y, x)                 of the rows; of the trapezoidal integral over x
//   std(y)                              standard deviation about the mean of the rows
//   slope(y, x)                         least squares line
//   argmax(y, x)                        x where y is largest
//   interp(x, y, at)                    linear, x increasing; nan more than 1 % of the range outside
//   smooth(y, x, width)                 local least squares parabola, evaluated in its middle
//   windows(y, x, width)                means over adjoining full windows of x, x increasing
//   largest_mean(y, x, width)           over a window of x, wherever it lies; x in any order
//   crossings(y, x)                     x of upward zeros; a first positive value after nan is one
//   peaks(y, x)                         heights of local maxima (parabola through three points)
//   lag(y, x, f), delay(y, x, f)        of the tone f: phase by which it is late [0, 2 pi), time when its packet passes
//   envelope(y, x), arrival(y, x)       of a signal; x where the envelope first reaches half of its largest value
//   group_max(y, key), group_argmax(y, key, x)   per run of equal keys
//   bins(y, x, low, high, n), bin_centres(low, high, n)   mean of y in n equal bins of x
//   column(a, b, ...), index(y), select(y, mask)
//
// nan is never hidden: it passes through every one of them, and a check that measures nan fails.
#pragma once

#include <string>
#include <vector>

#include "apps/quantity/value.hpp"

namespace splashdown::quantity {

/// Throws std::runtime_error for an unknown name, a wrong number of arguments, columns that do not fit.
Value call_function(const std::string& name, const std::vector<Value>& arguments);

}  // namespace splashdown::quantity
