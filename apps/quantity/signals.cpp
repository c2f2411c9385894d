#include "apps/quantity/signals.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "apps/quantity/curves.hpp"

namespace splashdown::quantity {
namespace {

using Column = std::vector<double>;
constexpr double whole_turn = 2 * std::numbers::pi;

/// Of x^power y.
std::complex<double> transform(const Column& y, const Column& x, double frequency, int power) {
  Column real(x.size()), imaginary(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto wave = std::polar(power == 1 ? x[i] * y[i] : y[i], -whole_turn * frequency * x[i]);
    real[i] = wave.real();
    imaginary[i] = wave.imag();
  }
  return {integral(real, x), integral(imaginary, x)};
}

}  // namespace

double lag(const Column& y, const Column& x, double frequency) {
  const double late = -std::arg(transform(y, x, frequency, 0));
  return late < 0 ? late + whole_turn : late;
}

double delay(const Column& y, const Column& x, double frequency) {
  return (transform(y, x, frequency, 1) / transform(y, x, frequency, 0)).real();
}

Column envelope(const Column& y, const Column& x) {
  if (x.size() < 2) throw std::runtime_error("an envelope needs two rows");
  const std::size_t rows = x.size();
  Column even(rows);
  for (std::size_t i = 0; i < rows; ++i) even[i] = x.front() + double(i) / double(rows - 1) * (x.back() - x.front());
  Column signal = interpolated(x, y, even);
  std::size_t length = 2;
  while (length < 2 * rows) length *= 2;
  signal.resize(length, 0.0);
  Eigen::FFT<double> fourier;
  std::vector<std::complex<double>> spectrum, analytic;
  fourier.fwd(spectrum, signal);
  // Twice the positive frequencies; that of no and of the highest frequency once.
  for (std::size_t k = 1; k < length / 2; ++k) spectrum[k] *= 2;
  std::fill(spectrum.begin() + std::ptrdiff_t(length / 2) + 1, spectrum.end(), 0.0);
  fourier.inv(analytic, spectrum);
  Column heights(rows);
  for (std::size_t i = 0; i < rows; ++i) heights[i] = std::abs(analytic[i]);
  return interpolated(even, heights, x);
}

double arrival(const Column& y, const Column& x) {
  Column rises = envelope(y, x);
  const double half = 0.5 * *std::ranges::max_element(rises);
  for (std::size_t i = 0; i < rises.size(); ++i) {
    if (std::isnan(rises[i])) return rises[i];
    if (rises[i] < half) continue;
    if (i == 0) return x[0];
    return x[i - 1] + (half - rises[i - 1]) / (rises[i] - rises[i - 1]) * (x[i] - x[i - 1]);
  }
  return x.back();
}

}  // namespace splashdown::quantity
