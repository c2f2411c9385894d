// Pictures of few colours as PNG (Portable Network Graphics, ISO/IEC 15948), by libpng.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace splashdown::apps {

/// Red, green, blue, opacity.
using Colour = std::array<std::uint8_t, 4>;

/// The file's bytes; a pixel is an index of `palette`, rows from the top. Throws std::runtime_error.
std::string png_of(std::span<const std::uint8_t> pixels, int width, std::span<const Colour> palette);

std::string base64(std::string_view bytes);

}  // namespace splashdown::apps
