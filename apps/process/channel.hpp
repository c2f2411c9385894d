// A line to a child process in both directions, whose other end it finds under file descriptors of its own.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace splashdown::apps {

class Channel {
 public:
  Channel();  ///< throws std::runtime_error
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  int other_end() const { return theirs_; }  ///< for ChildProcess
  void hand_over();  ///< once the child has its end: closes ours of it, so that the child's end is noticed

  /// False: nobody reads any more. Throws Interrupted.
  bool send(std::string_view bytes);
  void finish();  ///< nothing more is sent
  /// Some bytes; none where nothing is written any more; nothing within this time. Throws Interrupted.
  std::optional<std::string> receive(std::chrono::milliseconds patience);

 private:
  bool ready(short events, std::chrono::milliseconds patience) const;
  int ours_ = -1, theirs_ = -1;
};

}  // namespace splashdown::apps
