#include "apps/simulation/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "apps/files/bounded_archive.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

constexpr char magic[] = "splashdown checkpoint 20";  // the number changes with the layout

template <class Archive, class State>
void archive_all(Archive& archive, State& c) {
  archive(c.scene, c.loop.dt_previous, c.loop.dt_cap, c.loop.steps, c.loop.rejected, c.loop.released, c.loop.crawling,
          c.loop.refused_end, c.loop.refused_on_the_way, c.time, c.wall_seconds, c.processor_seconds, c.phases,
          c.stepper, c.recorder);
}

/// FNV-1a (Fowler, Noll, Vo): finds a file that was cut or changed; not meant against malice.
/// Each step maps hashes one to one, so that no single byte changes unseen.
constexpr std::uint64_t empty_digest = 14695981039346656037u;
std::uint64_t digest(std::string_view bytes, std::uint64_t hash = empty_digest) {
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
  void write(std::string_view bytes) {
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

/// Lengths are written as 64-bit numbers.
constexpr std::uint64_t longest_magic = 64;

std::uint64_t number(std::istream& in) {
  std::uint64_t value = 0;
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

/// The payload of a file; throws std::runtime_error with what is wrong. Nothing of it is believed, and no room made for
/// it, before its checksum agrees.
std::string payload_of(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw std::runtime_error("is no file");
  const std::uint64_t size = fs::file_size(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot be opened");
  const auto length = number(file);
  if (!file || length > longest_magic) throw std::runtime_error("is no checkpoint, or its first bytes are damaged");
  std::string head(length, '\0');
  file.read(head.data(), static_cast<std::streamsize>(length));
  if (head != magic) {
    const std::string family = std::string(magic).substr(0, std::string(magic).rfind(' ') + 1);
    if (file && head.starts_with(family))
      throw std::runtime_error("was written by another version of splashdown (format " +
                               one_line(head.substr(family.size())) + ", this one reads " +
                               std::string(magic).substr(family.size()) + ")");
    throw std::runtime_error("is no checkpoint, or its first bytes are damaged");
  }
  const auto expected = number(file), bytes = number(file);
  const std::uint64_t before = 3 * sizeof(std::uint64_t) + length;
  if (!file || bytes != size - before) throw std::runtime_error("is cut short, or its length is damaged");
  std::uint64_t hash = empty_digest;
  std::string block(std::size_t{1} << 20, '\0');
  for (std::uint64_t left = bytes; left > 0;) {
    const auto count = std::min<std::uint64_t>(left, block.size());
    if (!file.read(block.data(), static_cast<std::streamsize>(count))) throw std::runtime_error("cannot be read");
    hash = digest(std::string_view(block).substr(0, count), hash);
    left -= count;
  }
  if (hash != expected) throw std::runtime_error("is damaged: its checksum does not agree");
  std::string body(bytes, '\0');
  file.seekg(static_cast<std::streamoff>(before));
  if (!file.read(body.data(), static_cast<std::streamsize>(bytes))) throw std::runtime_error("cannot be read");
  return body;
}

Checkpoint read_one(const fs::path& path) {
  const auto body = payload_of(path);
  BoundedInputArchive archive(body);
  Checkpoint checkpoint;
  archive_all(archive, checkpoint);
  if (!archive.rest().empty()) throw std::runtime_error("holds more than it should");
  if (!std::isfinite(checkpoint.time)) throw std::runtime_error("holds no time");
  return checkpoint;
}

}  // namespace

void put_back(const Checkpoint& from, coupling::Stepper& stepper, LoopState& loop) {
  std::istringstream state(from.stepper);
  stepper.load(state);
  if (stepper.time() != from.time || !(from.loop.dt_previous >= 0) || !(from.loop.dt_cap >= 0))
    throw std::runtime_error("holds times that contradict each other");
  loop = from.loop;
}

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  std::ostringstream body, head;
  {
    cereal::BinaryOutputArchive archive(body);
    archive_all(archive, checkpoint);
    cereal::BinaryOutputArchive frame(head);
    frame(std::string(magic), digest(body.view()), std::uint64_t{body.view().size()});
  }
  fs::create_directories(folder);
  const fs::path fresh = folder / "state.new", state = folder / "state", previous = folder / "previous";
  {
    Descriptor file(fresh, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(head.view());
    file.write(body.view());
    file.sync();
  }
  if (fs::exists(state)) fs::rename(state, previous);
  fs::rename(fresh, state);
  Descriptor(folder, O_RDONLY | O_DIRECTORY).sync();
}

StoredCheckpoints read_checkpoints(const fs::path& folder) {
  StoredCheckpoints stored;
  // A kill between the two renames leaves only the complete new file and the previous one.
  for (const auto* name : {"state", "state.new", "previous"}) {
    const auto file = folder / name;
    if (fs::symlink_status(file).type() == fs::file_type::not_found) continue;
    try {
      stored.good.push_back({file, read_one(file)});
    } catch (const std::exception& error) {
      // A kill while it is written leaves a new file that is cut short: no loss, it never was in force.
      if (std::string_view(name) != "state.new") stored.bad.push_back(file.string() + " " + error.what());
    }
  }
  return stored;
}

}  // namespace splashdown::apps
