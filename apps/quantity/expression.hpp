// The language in which check.toml and studies state what is measured, e.g. "mean(fy / (density*speed^3*time), time)".
//
//   or, and, < <= > >= ==, + -, * /, unary -, ^ (right to left), calls, names with dots, numbers
//
// Columns combine element by element, a single number with every element; comparisons give 1 and 0.
// functions.hpp lists the functions. A name means what the `lookup` says: a column of the run's table, of
// the reference (ref.x), an entry of summary.json (summary.wall_seconds), a constant, an earlier quantity.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/quantity/value.hpp"

namespace splashdown::quantity {

using Lookup = std::function<std::optional<Value>(const std::string&)>;

/// Throws std::runtime_error that quotes the expression and the place.
Value evaluate(const std::string& expression, const Lookup& lookup);

/// The same for an expression that has to come out as one number.
double evaluate_number(const std::string& expression, const Lookup& lookup);

/// The names that an expression asks its lookup for, in order; functions are none.
std::vector<std::string> names_in(const std::string& expression);

/// Throws like evaluate() where the text is not an expression, whatever its names stand for.
void check_syntax(const std::string& expression);

}  // namespace splashdown::quantity
