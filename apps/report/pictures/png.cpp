#include "apps/report/pictures/png.hpp"

#include <png.h>

#include <stdexcept>
#include <string_view>

namespace splashdown::apps {

std::string png_of(std::span<const std::uint8_t> pixels, int width, std::span<const Colour> palette) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(pixels.size() / image.width);
  image.format = PNG_FORMAT_RGBA_COLORMAP;
  image.flags = PNG_IMAGE_FLAG_FAST;
  image.colormap_entries = static_cast<png_uint_32>(palette.size());
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t count = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &count, 0, pixels.data(), 0, palette.data()) == 0)
    throw std::runtime_error(std::string("no picture: ") + image.message);
  bytes.resize(count);
  return bytes;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * bytes.size() / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k < bytes.size() + 1 ? alphabet[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

}  // namespace splashdown::apps
