// SIGINT and SIGTERM as a request that the step loop polls. A second signal ends the program at once.
#pragma once

#include <string>

namespace splashdown::apps {

/// `answer`: written to the standard error stream the moment the signal arrives, for a step may take seconds.
void catch_interrupts(const std::string& answer = {});
/// From here on SIGINT ends the program at once with exit code 130 and these words: nothing is left that could be lost, and
/// a terminal's Ctrl-C ends the programs that it has started, too. SIGTERM, which does not, still lets it end what it does.
void leave_at_interrupt(const std::string& farewell);
/// Thrown by what waits for others when a signal arrives.
struct Interrupted {};
/// Name of the signal that arrived, or nothing.
const char* interrupt_received();

}  // namespace splashdown::apps
