// The one kind of value in a check's quantity: a number, or a column of numbers.
#pragma once

#include <vector>

namespace splashdown::quantity {

struct Value {
  std::vector<double> numbers;
  bool scalar = false;  ///< one number that fits any column's length

  static Value number(double x) { return {{x}, true}; }
  static Value column(std::vector<double> numbers) { return {std::move(numbers), false}; }
};

}  // namespace splashdown::quantity
