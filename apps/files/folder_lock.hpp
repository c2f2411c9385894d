// One run a folder: two that write the same files would leave neither.
#pragma once

#include <chrono>
#include <filesystem>

namespace splashdown::apps {

class FolderLock {
 public:
  /// Throws std::runtime_error if another process holds the folder for longer than `patience`. The system lets go of it at exit or
  /// kill; but what a run had just started when it was killed holds its lock until it becomes another program, a moment.
  explicit FolderLock(const std::filesystem::path& folder,
                      std::chrono::milliseconds patience = std::chrono::milliseconds(2000));
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace splashdown::apps
