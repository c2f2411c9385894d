#include "apps/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

constexpr char magic[] = "splashdown checkpoint 3";  // the number changes with the layout

template <class Archive, class State>
void archive_all(Archive& archive, State& c) {
  archive(c.scene, c.loop.dt_previous, c.loop.dt_cap, c.loop.steps, c.loop.rejected, c.time, c.wall_seconds, c.phases,
          c.stepper, c.recorder);
}

/// FNV-1a (Fowler, Noll, Vo): finds a file that was cut or changed; not meant against malice.
std::uint64_t digest(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
  return hash;
}

[[noreturn]] void refuse(const char* what, const fs::path& path) {
  throw std::runtime_error(std::string(what) + " " + path.string() + ": " + std::strerror(errno));
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : path_(path), descriptor_(::open(path.c_str(), flags, 0644)) {
    if (descriptor_ < 0) refuse("cannot open", path);
  }
  ~Descriptor() { ::close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void write(const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const auto count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno != EINTR) refuse("cannot write", path_);
      if (count > 0) done += static_cast<std::size_t>(count);
    }
  }
  void sync() {
    if (::fsync(descriptor_) != 0) refuse("cannot sync", path_);
  }

 private:
  fs::path path_;
  int descriptor_;
};

std::optional<Checkpoint> read_one(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  try {
    std::string head, body;
    std::uint64_t expected = 0;
    cereal::BinaryInputArchive frame(file);
    frame(head);
    if (head != magic) return {};
    frame(expected, body);
    if (digest(body) != expected) return {};
    std::istringstream stream(body);
    cereal::BinaryInputArchive archive(stream);
    Checkpoint checkpoint;
    archive_all(archive, checkpoint);
    return checkpoint;
  } catch (const std::exception&) {  // cut short: lengths that make no sense
    return {};
  }
}

}  // namespace

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  std::ostringstream body, whole;
  {
    cereal::BinaryOutputArchive archive(body);
    archive_all(archive, checkpoint);
    cereal::BinaryOutputArchive frame(whole);
    frame(std::string(magic), digest(body.str()), body.str());
  }
  fs::create_directories(folder);
  const fs::path fresh = folder / "state.new", state = folder / "state", previous = folder / "previous";
  {
    Descriptor file(fresh, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(whole.str());
    file.sync();
  }
  if (fs::exists(state)) fs::rename(state, previous);
  fs::rename(fresh, state);
  Descriptor(folder, O_RDONLY | O_DIRECTORY).sync();
}

std::optional<Checkpoint> read_checkpoint(const fs::path& folder) {
  // A kill between the two renames leaves only the complete new file and the previous one.
  for (const auto* name : {"state", "state.new", "previous"})
    if (auto checkpoint = read_one(folder / name)) return checkpoint;
  return {};
}

}  // namespace splashdown::apps
