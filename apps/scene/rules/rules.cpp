#include "apps/scene/rules/rules.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "apps/scene/read/echo.hpp"

namespace splashdown::apps {

std::string Rule::law() const {
  if (std::isfinite(high))
    return fmt::format("must lie in {}{:g}, {:g}]{}", low_open ? "(" : "[", low, high, in_unit());
  if (std::isfinite(low))
    return (low_open ? "must be positive" : fmt::format("must not be below {:g}", low)) + in_unit();
  return "must be a number" + in_unit();
}

Rule any(std::string unit, std::string cure) { return {.unit = std::move(unit), .cure = std::move(cure)}; }

Rule positive(std::string unit, std::string cure) {
  return {.unit = std::move(unit), .cure = std::move(cure), .low = 0, .low_open = true};
}

Rule not_negative(std::string unit, std::string cure) {
  return {.unit = std::move(unit), .cure = std::move(cure), .low = 0};
}

Rule share(std::string cure) { return {.unit = "", .cure = std::move(cure), .low = 0, .high = 1, .low_open = true}; }

std::string axis_example(int dimension, double value) {
  std::vector<double> vector(static_cast<std::size_t>(dimension));
  vector.back() = value;
  return toml_list(vector);
}

Rule place_rule(int dimension) {
  return any("m", "Use metres, one number for each axis, e.g. " + axis_example(dimension, 1) + ".");
}

Rule within(double low, double high, std::string unit, std::string cure) {
  return {.unit = std::move(unit), .cure = std::move(cure), .low = low, .high = high};
}

Rule refined(Rule rule, double refine) {
  rule.divisor = refine;
  return rule;
}

}  // namespace splashdown::apps
