#include "apps/run/threads.hpp"

#include "fluid/pfem/parallel.hpp"

namespace splashdown::apps {

void set_threads(std::optional<int> count, int dimension) {
  fluid::use_threads(count.value_or(dimension == 2 ? 1 : 0));
}

}  // namespace splashdown::apps
