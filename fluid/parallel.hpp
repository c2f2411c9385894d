// Loops whose turns do not depend on each other: the same result for any number of threads.
#pragma once

#include <cstddef>

namespace splashdown::fluid {

/// visit(i) for 0 <= i < count, on all threads of OpenMP; visit may not throw.
template <class Visit>
void in_parallel(std::size_t count, Visit visit) {
  constexpr std::size_t worthwhile = 2000;  // below, waking a thread costs more than it saves
#pragma omp parallel for schedule(static) if (count >= worthwhile)
  for (std::size_t i = 0; i < count; ++i) visit(i);
}

}  // namespace splashdown::fluid
