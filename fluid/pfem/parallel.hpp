// Threads as the fluid room names them: those of all rooms.
#pragma once

#include "core/parallel.hpp"

namespace splashdown::fluid {

using splashdown::in_parallel;
using splashdown::in_pieces;
using splashdown::least_in_parallel;
using splashdown::PerThread;
using splashdown::sum_in_parallel;
using splashdown::threads;
using splashdown::use_threads;
using splashdown::worthwhile;

}  // namespace splashdown::fluid
