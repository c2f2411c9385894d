// Pictures as an MP4 file (H.264), by ffmpeg.
#pragma once

#include <filesystem>
#include <string_view>

#include "apps/process/channel.hpp"
#include "apps/process/child_process.hpp"

namespace splashdown::apps {

class Film {
 public:
  /// ffmpeg writes beside `path`; its log goes to `log`.
  Film(const std::filesystem::path& program, std::filesystem::path path, double pictures_a_second,
       std::filesystem::path log);
  ~Film();  ///< unless it is finished, nothing is left
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void add(std::string_view png);  ///< throws std::runtime_error with ffmpeg's words, Interrupted
  void finish();                   ///< the file is there, or std::runtime_error

 private:
  [[noreturn]] void fail();

  std::filesystem::path path_, part_, log_;
  Channel channel_;
  ChildProcess process_;
  bool ended_ = false;
};

}  // namespace splashdown::apps
