// Numbers of a command line: lists, rules, and round ones for people to read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace splashdown::apps {

/// "1.2,0.4,0.3": so many finite numbers. Throws NewError with the option's name.
std::vector<double> numbers_of_list(const std::string& option, const std::string& text, std::size_t count);

/// To the next number of so many digits upward, away from 0.
double rounded_up(double value, int digits = 2);
/// To the nearest.
double rounded(double value, int digits);

}  // namespace splashdown::apps
