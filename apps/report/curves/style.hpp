// What the curves of a report have in common: colours, scaling, which components are worth a curve.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace splashdown::apps {

using Values = std::vector<double>;

inline constexpr const char* ink = "#0f2f4f";
inline constexpr const char* blue = "#2f7fc1";
inline constexpr const char* red = "#d1495b";
inline constexpr const char* green = "#3a9d7c";
inline constexpr const char* amber = "#d98e04";
inline constexpr const char* violet = "#7b5ea7";
inline constexpr const char* grey = "#b9c3cc";
inline constexpr std::array series_colours = {ink, red, blue, amber, green, violet};

/// (value - offset) scale
Values scaled(const Values& values, double scale, double offset = 0);

/// Largest magnitude; 0 for none.
double largest(const Values& values);

/// Columns that carry something, next to the largest of their group (1e-6: rounding does not).
std::vector<std::size_t> present(const std::vector<Values>& group);

}  // namespace splashdown::apps
