#include "apps/quantity/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "apps/quantity/curves.hpp"
#include "apps/quantity/signals.hpp"

namespace splashdown::quantity {

namespace {

using Column = std::vector<double>;
using Arguments = std::vector<Value>;

struct Function {
  std::size_t least, most;  ///< number of arguments
  std::function<Value(const Arguments&)> body;
};

double sum(const Column& y) { return std::accumulate(y.begin(), y.end(), 0.0); }
double mean(const Column& y) { return sum(y) / double(y.size()); }

double deviation(const Column& y) {
  const double centre = mean(y);
  double squares = 0;
  for (const double value : y) squares += (value - centre) * (value - centre);
  return std::sqrt(squares / double(y.size()));
}

double root_mean_square(const Column& y) {
  return std::sqrt(std::inner_product(y.begin(), y.end(), y.begin(), 0.0) / double(y.size()));
}

/// Index of the extreme entry, or of the first nan.
template <class Better>
std::size_t place_of(const Column& y, Better better) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (std::isnan(y[i])) return i;
    if (better(y[i], y[best])) best = i;
  }
  return best;
}

double largest(const Column& y) { return y[place_of(y, std::greater<>())]; }
double smallest(const Column& y) { return y[place_of(y, std::less<>())]; }

Function elementwise(double (*apply)(double)) {
  return {1, 1, [apply](const Arguments& a) {
            Value result = a[0];
            for (double& number : result.numbers) number = apply(number);
            return result;
          }};
}

Function reduction(double (*apply)(const Column&)) {
  return {1, 1, [apply](const Arguments& a) { return Value::number(apply(a[0].numbers)); }};
}

double scalar(const Value& value) {
  if (value.numbers.size() != 1) throw std::runtime_error("a single number is needed here");
  return value.numbers.front();
}

std::size_t whole_number(const Value& value) {
  const double number = scalar(value);
  if (!(number >= 1 && number <= double(most_pieces)))
    throw std::runtime_error(fmt::format("a number from 1 to {} is needed here, not {}", most_pieces, number));
  return static_cast<std::size_t>(number);
}

Value group_extremes(const Column& y, const Column& key, const Column& x) {
  if (x.size() != y.size()) throw std::runtime_error("the columns differ in length");
  Column result;
  for (std::size_t begin = 0; begin < y.size();) {
    std::size_t end = begin;
    while (end < y.size() && key[end] == key[begin]) ++end;
    if (end == begin) throw std::runtime_error("a key is not a number");
    const Column group(y.begin() + std::ptrdiff_t(begin), y.begin() + std::ptrdiff_t(end));
    result.push_back(x[begin + place_of(group, std::greater<>())]);
    begin = end;
  }
  return Value::column(result);
}

Value selected(const Column& y, const Column& mask) {
  Column result;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (mask[i] != 0) result.push_back(y[i]);
  return Value::column(result);
}

Value gathered(const Arguments& arguments) {
  Column result;
  for (const Value& value : arguments) result.push_back(scalar(value));
  return Value::column(result);
}

Value counted(const Column& y) {
  Column result(y.size());
  std::iota(result.begin(), result.end(), 0.0);
  return Value::column(result);
}

/// A function of two columns of equal length, and what follows them.
template <class Body>
Function of_pair(std::size_t further, Body body) {
  return {2 + further, 2 + further, [body](const Arguments& a) {
            if (a[0].numbers.size() != a[1].numbers.size())
              throw std::runtime_error("the first two columns differ in length");
            return body(a);
          }};
}

const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> table = {
      {"abs", elementwise([](double x) { return std::abs(x); })},
      {"sqrt", elementwise([](double x) { return std::sqrt(x); })},
      {"exp", elementwise([](double x) { return std::exp(x); })},
      {"log", elementwise([](double x) { return std::log(x); })},
      {"sin", elementwise([](double x) { return std::sin(x); })},
      {"cos", elementwise([](double x) { return std::cos(x); })},
      {"first", reduction([](const Column& y) { return y.front(); })},
      {"last", reduction([](const Column& y) { return y.back(); })},
      {"min", reduction(smallest)},
      {"max", reduction(largest)},
      {"sum", reduction(sum)},
      {"count", reduction([](const Column& y) { return double(y.size()); })},
      {"rms", reduction(root_mean_square)},
      {"std", reduction(deviation)},
      {"mean",
       {1, 2,
        [](const Arguments& a) {
          if (a.size() == 1) return Value::number(mean(a[0].numbers));
          const Column& x = a[1].numbers;
          return Value::number(integral(a[0].numbers, x) / (x.back() - x.front()));
        }}},
      {"slope", of_pair(0, [](const Arguments& a) { return Value::number(slope(a[0].numbers, a[1].numbers)); })},
      {"argmax", of_pair(0,
                         [](const Arguments& a) {
                           return Value::number(a[1].numbers[place_of(a[0].numbers, std::greater<>())]);
                         })},
      {"interp", of_pair(1,
                         [](const Arguments& a) {
                           return Value{interpolated(a[0].numbers, a[1].numbers, a[2].numbers), a[2].scalar};
                         })},
      {"smooth",
       of_pair(1,
               [](const Arguments& a) { return Value::column(smoothed(a[0].numbers, a[1].numbers, scalar(a[2]))); })},
      {"windows", of_pair(1,
                          [](const Arguments& a) {
                            return Value::column(window_means(a[0].numbers, a[1].numbers, scalar(a[2])));
                          })},
      {"largest_mean", of_pair(1,
                               [](const Arguments& a) {
                                 return Value::number(largest_mean(a[0].numbers, a[1].numbers, scalar(a[2])));
                               })},
      {"crossings",
       of_pair(0, [](const Arguments& a) { return Value::column(upward_crossings(a[0].numbers, a[1].numbers)); })},
      {"peaks", of_pair(0, [](const Arguments& a) { return Value::column(peak_heights(a[0].numbers, a[1].numbers)); })},
      {"lag",
       of_pair(1, [](const Arguments& a) { return Value::number(lag(a[0].numbers, a[1].numbers, scalar(a[2]))); })},
      {"delay",
       of_pair(1, [](const Arguments& a) { return Value::number(delay(a[0].numbers, a[1].numbers, scalar(a[2]))); })},
      {"envelope", of_pair(0, [](const Arguments& a) { return Value::column(envelope(a[0].numbers, a[1].numbers)); })},
      {"arrival", of_pair(0, [](const Arguments& a) { return Value::number(arrival(a[0].numbers, a[1].numbers)); })},
      {"group_max",
       of_pair(0, [](const Arguments& a) { return group_extremes(a[0].numbers, a[1].numbers, a[0].numbers); })},
      {"group_argmax",
       of_pair(1, [](const Arguments& a) { return group_extremes(a[0].numbers, a[1].numbers, a[2].numbers); })},
      {"bins", of_pair(3,
                       [](const Arguments& a) {
                         return Value::column(
                             bin_means(a[0].numbers, a[1].numbers, scalar(a[2]), scalar(a[3]), whole_number(a[4])));
                       })},
      {"bin_centres",
       {3, 3,
        [](const Arguments& a) { return Value::column(bin_centres(scalar(a[0]), scalar(a[1]), whole_number(a[2]))); }}},
      {"column", {1, std::numeric_limits<std::size_t>::max(), gathered}},
      {"index", {1, 1, [](const Arguments& a) { return counted(a[0].numbers); }}},
      {"select", of_pair(0, [](const Arguments& a) { return selected(a[0].numbers, a[1].numbers); })},
  };
  return table;
}

}  // namespace

Value call_function(const std::string& name, const std::vector<Value>& arguments) {
  const auto found = functions().find(name);
  if (found == functions().end()) throw std::runtime_error(fmt::format("unknown function '{}'", name));
  const Function& function = found->second;
  if (arguments.size() < function.least || arguments.size() > function.most)
    throw std::runtime_error(fmt::format("{}() does not take {} arguments", name, arguments.size()));
  for (const Value& value : arguments)
    if (value.numbers.empty()) throw std::runtime_error(fmt::format("{}() of an empty column", name));
  return function.body(arguments);
}

}  // namespace splashdown::quantity
