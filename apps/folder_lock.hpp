// One run a folder: two that write the same files would leave neither.
#pragma once

#include <filesystem>

namespace splashdown::apps {

class FolderLock {
 public:
  /// Throws std::runtime_error if another process holds the folder. The system lets go of it at exit or kill.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace splashdown::apps
