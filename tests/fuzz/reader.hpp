// One entry for libFuzzer and for the replay of the corpus: every reader may refuse its bytes with an exception of its own, and
// nothing else may happen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace splashdown::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process, in memory if the machine has such a place, and the one it works in.
const std::filesystem::path& folder();
/// A file in it with these bytes.
std::filesystem::path file_of(const std::string& name, const std::uint8_t* data, std::size_t size);

}  // namespace splashdown::fuzz
