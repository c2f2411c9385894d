#include "apps/interrupt.hpp"

#include <csignal>

namespace splashdown::apps {
namespace {

volatile std::sig_atomic_t received = 0;

void remember(int signal) { received = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the next one has the usual effect
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const char* interrupt_received() {
  if (received == 0) return nullptr;
  return received == SIGTERM ? "SIGTERM" : "SIGINT";
}

}  // namespace splashdown::apps
