#include "apps/study/design/replicates.hpp"

#include <vector>

namespace splashdown::apps {

double replicate_refine(double refine, int k) {
  // 2, 1, 3 %, then the middles between offsets that are there, again and again.
  static const std::vector<double> offsets = [] {
    std::vector<double> all = {replicate_offset, 0.01, 0.03};
    for (double step = 0.005; step > 0.001; step /= 2)
      for (double offset = step; offset < 0.03; offset += 2 * step) all.push_back(offset);
    return all;
  }();
  return refine * (1 + (k % 2 == 0 ? -1 : 1) * offsets.at(static_cast<std::size_t>(k / 2)));
}

}  // namespace splashdown::apps
