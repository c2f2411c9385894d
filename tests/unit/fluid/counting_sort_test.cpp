#include "fluid/pfem/linear/counting_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace splashdown::fluid::counting_sort_test {
namespace {

using Item = std::pair<int, int>;  // key and number

struct Sorted {
  std::vector<int> start;
  std::vector<Item> items;
  bool operator==(const Sorted&) const = default;
};

// Three items a source, none from every fifth; keys repeat in no order.
int key_of(int item, int keys) { return static_cast<int>((item * 7919LL) % keys); }

Sorted sorted(int sources, int keys) {
  Sorted out;
  counting_sort(
      sources, keys, out.start,
      [&](std::size_t s, auto put) {
        if (s % 5 == 0) return;
        for (int k = 0; k < 3; ++k) {
          const int item = 3 * static_cast<int>(s) + k, key = key_of(item, keys);
          put(key, Item{key, item});
        }
      },
      [&](std::size_t count) { out.items.resize(count); }, [&](int to, const Item& item) { out.items[to] = item; });
  return out;
}

TEST(CountingSort, sorts_by_key_and_keeps_the_order_of_each_key_on_any_number_of_threads) {
  for (const int sources : {0, 1, 7, 30000}) {
    constexpr int keys = 101;
    use_threads(1);
    const auto one = sorted(sources, keys);
    use_threads(3);
    const auto three = sorted(sources, keys);
    use_threads(0);
    EXPECT_EQ(one, three);
    EXPECT_EQ(one.items.size(), 3 * static_cast<std::size_t>(sources - (sources + 4) / 5));
    EXPECT_TRUE(std::is_sorted(one.items.begin(), one.items.end()));  // items of a key came in ascending order
    ASSERT_EQ(one.start.size(), keys + 1U);
    EXPECT_EQ(one.start.front(), 0);
    EXPECT_EQ(one.start.back(), static_cast<int>(one.items.size()));
    for (int key = 0; key < keys; ++key)
      for (int i = one.start[key]; i < one.start[key + 1]; ++i) EXPECT_EQ(one.items[i].first, key);
  }
}

}  // namespace
}  // namespace splashdown::fluid::counting_sort_test
