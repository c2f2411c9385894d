// Arrays as blocks of zlib streams, as they stand behind the head of a .vtu file: vtu.hpp.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace splashdown::apps {

/// Appends header and blocks of an array's bytes.
void append_blocks(std::string& appended, std::string_view bytes);

/// The bytes of the array that begins at the front of `data`. Throws std::runtime_error if it is cut short or damaged.
std::string read_blocks(std::string_view data);

/// The same as numbers.
template <class Value>
std::vector<Value> read_blocks(std::string_view data) {
  const std::string bytes = read_blocks(data);
  if (bytes.size() % sizeof(Value) != 0) throw std::runtime_error("an array ends within a number");
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) bytes.copy(reinterpret_cast<char*>(values.data()), bytes.size());
  return values;
}

}  // namespace splashdown::apps
