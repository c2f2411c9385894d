#include "reader.hpp"

#include <unistd.h>

#include <cstdio>
#include <fstream>

namespace splashdown::fuzz {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path;
  // Not the working folder: libFuzzer keeps what crashed there.
  Folder()
      : path((fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
             ("splashdown-fuzz-" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

const fs::path& folder() {
  static const Folder folder;
  return folder.path;
}

fs::path file_of(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const auto path = folder() / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace splashdown::fuzz
