// SIGINT and SIGTERM as a request that the step loop polls. A second signal ends the program at once.
#pragma once

namespace splashdown::apps {

void catch_interrupts();
/// Name of the signal that arrived, or nothing.
const char* interrupt_received();

}  // namespace splashdown::apps
