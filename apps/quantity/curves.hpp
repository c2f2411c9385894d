// Curves given by points (x, y): integrals, fits, interpolation, extrema.
//
// Where x need not increase it says so; others throw std::runtime_error where it does not.
#pragma once

#include <cstddef>
#include <vector>

namespace splashdown::quantity {

/// Of windows and bins: a mistyped width must not fill the memory.
inline constexpr std::size_t most_pieces = 1'000'000;

double integral(const std::vector<double>& y, const std::vector<double>& x);  ///< trapezoidal
double slope(const std::vector<double>& y, const std::vector<double>& x);     ///< least squares

/// Linear; up to 1 % of x's range outside it the end's value, beyond that nan.
std::vector<double> interpolated(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& at);

/// Savitzky-Golay on uneven points: a parabola fitted within width/2 of each x, evaluated there.
/// Leaves a parabola, hence the curvature of a smooth peak, as it is.
std::vector<double> smoothed(const std::vector<double>& y, const std::vector<double>& x, double width);

/// Means of the piecewise linear curve over adjoining windows from the first x on; a rest is dropped.
std::vector<double> window_means(const std::vector<double>& y, const std::vector<double>& x, double width);

/// The largest mean, over windows that begin or end at a point, of the piecewise linear curve through the points in the order of
/// their x, which may come in any.
double largest_mean(const std::vector<double>& y, const std::vector<double>& x, double width);

std::vector<double> upward_crossings(const std::vector<double>& y, const std::vector<double>& x);
std::vector<double> peak_heights(const std::vector<double>& y, const std::vector<double>& x);

std::vector<double> bin_centres(double low, double high, std::size_t count);
std::vector<double> bin_means(const std::vector<double>& y, const std::vector<double>& x, double low, double high,
                              std::size_t count);

}  // namespace splashdown::quantity
