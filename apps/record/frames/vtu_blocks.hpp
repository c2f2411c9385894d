// Arrays as blocks of zlib streams in base64, as they stand in a .vtu file: vtu.hpp.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace splashdown::apps {

/// One zlib stream in base64: as browsers unpack it.
std::string stream_of(std::string_view bytes);

/// Header and blocks of an array's bytes.
std::string blocks_of(std::string_view bytes);

/// The bytes again. Throws std::runtime_error if the text is cut short or damaged.
std::string read_blocks(std::string_view text);

/// The same as numbers.
template <class Value>
std::vector<Value> read_blocks(std::string_view text) {
  const std::string bytes = read_blocks(text);
  if (bytes.size() % sizeof(Value) != 0) throw std::runtime_error("an array ends within a number");
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) bytes.copy(reinterpret_cast<char*>(values.data()), bytes.size());
  return values;
}

}  // namespace splashdown::apps
