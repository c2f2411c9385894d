// A program started without a shell, in a process group of its own, that ends with its parent.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

class ChildProcess {
 public:
  /// A file descriptor of this process, and its number in the child.
  struct Handed {
    int ours, theirs;
  };
  /// Both outputs go to the end of `log`; the input is empty, unless something is handed over for it. The child gets SIGTERM
  /// when this process dies, even of SIGKILL. Throws std::runtime_error if no process can be made.
  ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log,
               const std::vector<Handed>& handed = {});

  struct End {
    int code = -1;   ///< exit code; -1: ended by a signal
    int signal = 0;  ///< which one
  };
  /// Nothing while it runs.
  std::optional<End> end();
  End wait();
  void ask_to_stop() const;  ///< SIGTERM
  void kill_group() const;   ///< SIGKILL to it and what it has started

 private:
  pid_t id_ = 0;
};

/// The last line that a process wrote to its log.
std::string last_line(const std::filesystem::path& log);

/// A program of this name on the PATH.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// The path of the program that runs.
std::filesystem::path own_program();

}  // namespace splashdown::apps
