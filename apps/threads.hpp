// Threads of the linear algebra, the only part that uses several.
#pragma once

namespace splashdown::apps {

/// One thread is fastest below some 50 000 nodes and makes the same bits on every machine.
void set_threads(int count);

}  // namespace splashdown::apps
