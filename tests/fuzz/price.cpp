// Price lists.
#include <stdexcept>

#include "apps/price/write.hpp"
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  try {
    // What was read has to be written, and to be read again.
    const auto price = apps::read_price(fuzz::file_of("price.json", data, size));
    const auto text = apps::price_json(price);
    apps::read_price(fuzz::file_of("again.json", reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
