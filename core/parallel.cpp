#include "core/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <memory>

namespace splashdown {

void use_threads(int count) {
  static std::unique_ptr<tbb::global_control> limit;
  const int threads = count > 0 ? count : tbb::this_task_arena::max_concurrency();
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(threads));
}

int threads() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace splashdown
