#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splashdown::parallel_test {
namespace {

TEST(Parallel, a_sum_has_the_same_bits_on_any_number_of_threads) {
  for (const std::size_t count : {0, 1, 999, 1000, 1001, 100000}) {
    const auto value = [](std::size_t i) { return std::sin(1.0 + static_cast<double>(i)); };
    use_threads(1);
    const double one = sum_in_parallel(count, value);
    use_threads(3);
    const double three = sum_in_parallel(count, value);
    use_threads(0);
    EXPECT_EQ(one, three) << count;
    // sin 1 + ... + sin n = sin(n/2) sin((n + 1)/2) / sin(1/2)
    const auto n = static_cast<double>(count);
    EXPECT_NEAR(one, std::sin(0.5 * n) * std::sin(0.5 * (n + 1)) / std::sin(0.5), 1e-14 * (n + 1)) << count;
  }
}

}  // namespace
}  // namespace splashdown::parallel_test
