#include "apps/record/frames/vtu_blocks.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/parallel.hpp"

namespace splashdown::apps {

namespace {

// Twice zlib's window: what each block loses at its beginning is below a per cent, and frames of ten thousand nodes have a
// block for each of some cores.
constexpr std::size_t block_bytes = 1 << 16;
// Digits hardly compress: the slower levels take up to three times as long for one or two per cent.
constexpr int level = 1;

std::string deflated(std::string_view block) {
  uLongf size = compressBound(block.size());
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
                block.size(), level) != Z_OK)
    throw std::runtime_error("zlib has no memory");
  result.resize(size);
  return result;
}

void append(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Takes numbers and blocks from the front of what is there.
class Front {
 public:
  explicit Front(std::string_view data) : data_(data) {}
  std::string_view take(std::uint64_t size) {
    if (size > data_.size()) throw std::runtime_error("ends before its arrays");
    const auto taken = data_.substr(0, size);
    data_.remove_prefix(size);
    return taken;
  }
  std::uint64_t number() {
    std::uint64_t value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }

 private:
  std::string_view data_;
};

}  // namespace

void append_blocks(std::string& appended, std::string_view bytes) {
  const std::size_t count = (bytes.size() + block_bytes - 1) / block_bytes;
  std::vector<std::string> blocks(count);
  in_pieces(count, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) blocks[i] = deflated(bytes.substr(i * block_bytes, block_bytes));
  });
  append(appended, count);
  append(appended, block_bytes);
  append(appended, bytes.size() % block_bytes);
  for (const auto& block : blocks) append(appended, block.size());
  for (const auto& block : blocks) appended += block;
}

std::string read_blocks(std::string_view data) {
  Front front(data);
  const auto count = front.number(), whole = front.number(), rest = front.number();
  if (count == 0) return {};
  if (whole == 0 || whole > block_bytes || rest >= whole) throw std::runtime_error("an array is damaged");
  Front blocks(
      data.substr(std::min<std::uint64_t>(data.size(), (3 + std::min<std::uint64_t>(count, data.size())) * 8)));
  std::string bytes;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto block = blocks.take(front.number());
    const std::uint64_t size = i + 1 == count && rest > 0 ? rest : whole;
    const auto begin = bytes.size();
    bytes.resize(begin + size);
    uLongf got = size;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data() + begin), &got, reinterpret_cast<const Bytef*>(block.data()),
                   block.size()) != Z_OK ||
        got != size)
      throw std::runtime_error("an array is damaged");
  }
  return bytes;
}

}  // namespace splashdown::apps
