// Base64, RFC 4648, section 4.
#pragma once

#include <string>
#include <string_view>

namespace splashdown::apps {

/// Appends the encoded bytes, padded.
void append_base64(std::string& text, std::string_view bytes);

/// Throws std::runtime_error if the text is not what append_base64 writes of some bytes.
std::string from_base64(std::string_view text);

/// Characters of so many bytes.
constexpr std::size_t base64_length(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace splashdown::apps
