#include "apps/threads.hpp"

#include <dlfcn.h>

namespace splashdown::apps {

void set_threads(int count) {
  // OpenBLAS comes with the fluid; asking the loader keeps its headers and its linkage out of this room.
  if (auto* const function = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(function)(count);
}

}  // namespace splashdown::apps
