// A page in Chromium without a display: its pictures. WebGL is drawn by the processor (SwiftShader), so that any machine will do.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/process/channel.hpp"
#include "apps/process/child_process.hpp"
#include "apps/render/devtools.hpp"

namespace splashdown::apps {

/// A Chromium on the PATH.
std::optional<std::filesystem::path> find_chromium();

class Browser {
 public:
  /// Its profile and log go to `folder`, which nobody else uses. All calls throw std::runtime_error, with the browser's last
  /// words, and Interrupted.
  Browser(const std::filesystem::path& program, const std::filesystem::path& folder, std::array<int, 2> size);
  ~Browser();

  /// Shows a file, once, and waits until `ready`, an expression, is neither false nor empty: its value.
  nlohmann::json open(const std::filesystem::path& page, const std::string& ready);
  nlohmann::json value_of(const std::string& expression);
  /// Bytes of a PNG file; `quick`: larger, in a third of the time.
  std::string picture(bool quick);

 private:
  template <class Ask>
  auto asked(const Ask& ask);

  std::array<int, 2> size_;
  std::filesystem::path log_;
  Channel channel_;
  ChildProcess process_;
  DevTools tools_;
};

}  // namespace splashdown::apps
