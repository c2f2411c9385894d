#include "apps/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace splashdown::apps {

FolderLock::FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  constexpr std::chrono::milliseconds pause(50);
  for (auto left = patience;; left -= pause) {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    if (errno != EWOULDBLOCK) return;  // file systems without locks
    if (left < pause) break;
    std::this_thread::sleep_for(pause);
  }
  ::close(descriptor_);
  throw std::runtime_error(folder.string() + ": another run is writing here. Wait for it, or use another --out.");
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace splashdown::apps
