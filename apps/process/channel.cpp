#include "apps/process/channel.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "apps/process/interrupt.hpp"

namespace splashdown::apps {

// A pair of sockets: a pipe whose reader has died would end this process, too, unless it gives up that signal altogether.
Channel::Channel() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error(fmt::format("cannot make a channel to another program: {}", std::strerror(errno)));
  ours_ = ends[0];
  theirs_ = ends[1];
}

Channel::~Channel() {
  hand_over();
  ::close(ours_);
}

void Channel::hand_over() {
  if (theirs_ >= 0) ::close(theirs_);
  theirs_ = -1;
}

/// Waits in short pieces: a signal may arrive just before a wait.
bool Channel::ready(short events, std::chrono::milliseconds patience) const {
  constexpr std::chrono::milliseconds piece(200);
  for (const auto end = std::chrono::steady_clock::now() + patience;;) {
    if (interrupt_received()) throw Interrupted();
    pollfd entry{ours_, events, 0};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (::poll(&entry, 1, static_cast<int>(std::clamp(left, std::chrono::milliseconds(0), piece).count())) > 0)
      return true;
    if (left.count() <= 0) return false;
  }
}

bool Channel::send(std::string_view bytes) {
  constexpr std::chrono::hours patience(1);  // a film's encoder may take its time
  while (!bytes.empty()) {
    if (!ready(POLLOUT, patience)) return false;
    const auto sent = ::send(ours_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno != EAGAIN && errno != EINTR)
      return false;
  }
  return true;
}

void Channel::finish() { ::shutdown(ours_, SHUT_WR); }

std::optional<std::string> Channel::receive(std::chrono::milliseconds patience) {
  if (!ready(POLLIN, patience)) return {};
  std::string bytes(1 << 16, '\0');
  const auto got = ::recv(ours_, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (got < 0) return errno == EAGAIN || errno == EINTR ? std::optional<std::string>() : std::string();
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

}  // namespace splashdown::apps
