// Loops over rows of the grid in the registers that a machine has: four numbers at a time where it has AVX2, else two.
// No multiplication is fused with a sum, so that both give the same bits.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
/// Before a function: compiled twice, the better one is taken where the program runs.
#define SPLASHDOWN_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
/// Before a function: as it is.
#define SPLASHDOWN_WIDE
#endif

namespace splashdown::vortex {

/// Sums and greatest values of a row that do not wait for each other.
constexpr std::size_t lanes = 8;

/// Whether all numbers are zero, of either sign.
bool all_zero(const double* numbers, std::size_t count);

/// to += factor from.
void add_row(double factor, const double* from, std::size_t count, double* to);

/// to = 0: +, in one call for a row.
void clear_row(double* to, std::size_t count);

}  // namespace splashdown::vortex
