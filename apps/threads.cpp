#include "apps/threads.hpp"

#include <dlfcn.h>

#include "fluid/parallel.hpp"

namespace splashdown::apps {

void set_threads(std::optional<int> count, int dimension) {
  fluid::use_threads(count.value_or(dimension == 2 ? 1 : 0));
  // OpenBLAS comes with the fluid; asking the loader keeps its headers and its linkage out of this room.
  if (auto* const function = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(function)(count.value_or(1));
}

}  // namespace splashdown::apps
