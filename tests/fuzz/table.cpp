// Tables of comma separated values. The first line is the key of the rows that count; empty: all.
#include "apps/quantity/table.hpp"

#include <stdexcept>

#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  const auto text = fuzz::text_of(data, size);
  const auto line = std::min(text.find('\n'), size);
  const auto key = text.substr(0, line);
  fuzz::file_of("table.csv", data + line, size - line);
  try {
    const auto table = quantity::read_table(fuzz::folder(), "table.csv" + (key.empty() ? key : ":" + key));
    for (const auto& column : table.columns)
      if (column.size() != table.rows()) __builtin_trap();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
