#include "apps/record/frames/vtu_blocks.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "apps/record/frames/base64.hpp"
#include "core/parallel.hpp"

namespace splashdown::apps {

namespace {

// Twice zlib's window: what each block loses at its beginning is below a per cent, and frames of ten thousand nodes have a
// block for each of some cores.
constexpr std::size_t block_bytes = 1 << 16;
// Digits hardly compress: the slower levels take up to three times as long for one or two per cent.
constexpr int of_digits = 1;

std::string deflated(std::string_view block, int level = of_digits) {
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
    if (size > data_.size()) throw std::runtime_error("an array is cut short");
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

std::string stream_of(std::string_view bytes) {
  std::string text;
  append_base64(text, deflated(bytes, Z_DEFAULT_COMPRESSION));
  return text;
}

std::string blocks_of(std::string_view bytes) {
  const std::size_t count = (bytes.size() + block_bytes - 1) / block_bytes;
  std::vector<std::string> blocks(count);
  in_pieces(count, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) blocks[i] = deflated(bytes.substr(i * block_bytes, block_bytes));
  });
  std::string header, data;
  append(header, count);
  append(header, block_bytes);
  append(header, bytes.size() % block_bytes);
  for (const auto& block : blocks) append(header, block.size());
  for (const auto& block : blocks) data += block;
  std::string text;
  append_base64(text, header);
  append_base64(text, data);
  return text;
}

std::string read_blocks(std::string_view text) {
  constexpr std::size_t word = sizeof(std::uint64_t);
  const auto begin = from_base64(text.substr(0, base64_length(3 * word)));
  Front start(begin);
  const auto count = start.number(), whole = start.number(), rest = start.number();
  if (count == 0) return {};
  if (whole == 0 || whole > block_bytes || rest >= whole || count > text.size())
    throw std::runtime_error("an array is damaged");
  const auto characters = base64_length((3 + count) * word);
  if (characters > text.size()) throw std::runtime_error("an array is cut short");
  const auto header = from_base64(text.substr(0, characters)), data = from_base64(text.substr(characters));
  Front sizes(header), blocks(data);
  sizes.take(3 * word);
  std::string bytes;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto block = blocks.take(sizes.number());
    const std::uint64_t size = i + 1 == count && rest > 0 ? rest : whole;
    const auto to = bytes.size();
    bytes.resize(to + size);
    uLongf got = size;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data() + to), &got, reinterpret_cast<const Bytef*>(block.data()),
                   block.size()) != Z_OK ||
        got != size)
      throw std::runtime_error("an array is damaged");
  }
  return bytes;
}

}  // namespace splashdown::apps
