#include "apps/process/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace splashdown::apps {
namespace {

constexpr int could_not_start = 127;  // as shells have it

/// In the child between fork and exec: calls that are safe after a fork only.
[[noreturn]] void become(const char* log, char* const* arguments, pid_t parent,
                         const std::vector<ChildProcess::Handed>& handed) {
  ::setpgid(0, 0);  // the terminal's Ctrl-C is for the parent, who passes it on once
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(could_not_start);  // it died before the line above
  const int out = ::open(log, O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int in = ::open("/dev/null", O_RDONLY);
  if (out < 0 || in < 0) ::_exit(could_not_start);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  for (const auto& [ours, theirs] : handed)
    if (::dup2(ours, theirs) < 0) ::_exit(could_not_start);
  ::execv(arguments[0], arguments);
  ::_exit(could_not_start);
}

}  // namespace

// posix_spawn, which the rest of this room uses, cannot tie a child's life to its parent's.
ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log,
                           const std::vector<Handed>& handed) {
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  // Out of the way of the child's numbers.
  constexpr int beyond = 64;
  std::vector<Handed> copies;
  for (const auto& [ours, theirs] : handed) copies.push_back({::fcntl(ours, F_DUPFD_CLOEXEC, beyond), theirs});
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ == 0) become(log.c_str(), arguments.data(), parent, copies);
  const int trouble = errno;
  if (id_ > 0) ::setpgid(id_, id_);  // whoever comes first: the group is there before anybody signals it
  for (const auto& copy : copies) ::close(copy.ours);
  if (id_ < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(trouble)));
}

std::optional<ChildProcess::End> ChildProcess::end() {
  int status = 0;
  const pid_t ended = ::waitpid(id_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return {};
  if (ended < 0) return End{};
  if (WIFEXITED(status)) return End{.code = WEXITSTATUS(status)};
  return End{.signal = WTERMSIG(status)};
}

ChildProcess::End ChildProcess::wait() {
  for (;;) {
    if (const auto ended = end()) return *ended;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void ChildProcess::ask_to_stop() const { ::kill(id_, SIGTERM); }

void ChildProcess::kill_group() const { ::kill(-id_, SIGKILL); }

std::string last_line(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const auto file = std::filesystem::path(folder) / name; ::access(file.c_str(), X_OK) == 0) return file;
  return {};
}

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace splashdown::apps
