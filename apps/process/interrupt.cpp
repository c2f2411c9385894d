#include "apps/process/interrupt.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <initializer_list>

#include "apps/process/exit.hpp"

namespace splashdown::apps {
namespace {

volatile std::sig_atomic_t received = 0;

// What a handler says must stand ready: it may call next to nothing.
std::array<char, 500> words{};
volatile std::sig_atomic_t length = 0;

void prepare(const std::string& text) {
  length = 0;
  const auto size = std::min(text.size(), words.size());
  std::copy_n(text.begin(), size, words.begin());
  length = static_cast<std::sig_atomic_t>(size);
}

void speak() {
  // Whoever does not listen to it gets no answer.
  if (length > 0 && ::write(STDERR_FILENO, words.data(), static_cast<std::size_t>(length)) < 0) return;
}

void remember(int signal) {
  received = signal;
  speak();
}

void leave(int) {
  speak();
  ::_exit(exit_code::interrupted);
}

void handle(void (*handler)(int), std::initializer_list<int> signals) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the next one has the usual effect
  sigemptyset(&action.sa_mask);
  for (const int signal : signals) sigaction(signal, &action, nullptr);
}

}  // namespace

void catch_interrupts(const std::string& answer) {
  prepare(answer);
  handle(remember, {SIGINT, SIGTERM});
}

void leave_at_interrupt(const std::string& farewell) {
  prepare(farewell);
  handle(leave, {SIGINT});
}

const char* interrupt_received() {
  if (received == 0) return nullptr;
  return received == SIGTERM ? "SIGTERM" : "SIGINT";
}

}  // namespace splashdown::apps
