// Reading back what a save() wrote, from bytes that nobody vouches for.
#pragma once

#include <cstdint>
#include <istream>
#include <stdexcept>

namespace splashdown {

/// The number of elements that follow, each of at least so many bytes; 0 where nothing is stored. Throws
/// std::runtime_error for more than the rest of the bytes can hold, so that a wrong length allocates nothing.
inline std::size_t stored_count(std::istream& in, std::size_t bytes) {
  std::uint64_t count = 0;
  if (!in.read(reinterpret_cast<char*>(&count), sizeof count)) return 0;
  const auto here = in.tellg();
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(here);
  if (!in || count > static_cast<std::uint64_t>(end - here) / bytes)
    throw std::runtime_error("a length exceeds the bytes that follow it");
  return count;
}

}  // namespace splashdown
