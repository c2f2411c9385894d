// Text that others wrote, made harmless where another program reads it: a terminal, a shell's comment, gnuplot.
#pragma once

#include <string>

namespace splashdown::apps {

/// One line: control characters (C0, DEL and C1, which terminals obey too) become spaces.
inline std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    const bool c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080 to U+009F in UTF-8
    line += c1 || byte < 0x20 || byte == 0x7F ? ' ' : text[i];
    if (c1) ++i;
  }
  return line;
}

}  // namespace splashdown::apps
