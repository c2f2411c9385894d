#include "fluid/vortex/wide.hpp"

#include <algorithm>

namespace splashdown::vortex {

SPLASHDOWN_WIDE bool all_zero(const double* numbers, std::size_t count) {
  constexpr std::size_t few = 32;  // most rows that are not zero show it at once
  std::uint64_t any = 0;
  std::size_t i = 0;
  for (; i + few <= count && any == 0; i += few) {
    for (std::size_t k = i; k < i + few; ++k) any |= std::bit_cast<std::uint64_t>(numbers[k]);
    any <<= 1;  // the sign apart
  }
  for (; i < count && any == 0; ++i) any = std::bit_cast<std::uint64_t>(numbers[i]) << 1;
  return any == 0;
}

SPLASHDOWN_WIDE void add_row(double factor, const double* __restrict from, std::size_t count, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += factor * from[i];
}

void clear_row(double* to, std::size_t count) { std::fill_n(to, count, 0.0); }

}  // namespace splashdown::vortex
