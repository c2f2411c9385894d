// Chromium's DevTools protocol over a channel: JSON messages that end with a zero byte (--remote-debugging-pipe).
// Source: Chrome DevTools Protocol, "Remote debugging over pipes".
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "apps/process/channel.hpp"

namespace splashdown::apps {

/// Messages from bytes that arrive in any pieces.
class MessageStream {
 public:
  void add(std::string_view bytes) { bytes_ += bytes; }
  std::optional<std::string> next();  ///< without its zero

 private:
  std::string bytes_;
  std::size_t searched_ = 0;  // of bytes_: no zero before
};

/// Asks one thing at a time.
class DevTools {
 public:
  /// `patience`: for one answer.
  DevTools(Channel& channel, std::chrono::milliseconds patience) : channel_(channel), patience_(patience) {}

  /// The result. Throws std::runtime_error if it is an error, if none comes in time, or if the other side has gone.
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  /// From here on calls are about this page.
  void attach(const std::string& session) { session_ = session; }
  /// Value of a JavaScript expression; waits for promises. Throws what it throws.
  nlohmann::json value_of(const std::string& expression);

 private:
  Channel& channel_;
  std::chrono::milliseconds patience_;
  MessageStream messages_;
  std::string session_;
  int last_ = 0;
};

}  // namespace splashdown::apps
