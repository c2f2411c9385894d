#include "apps/scene/read/echo.hpp"

#include <fmt/format.h>

namespace splashdown::apps {

Echo::Section Echo::open(std::string header) {
  tables_.push_back({std::move(header), {}});
  return tables_.size() - 1;
}

void Echo::add(Section section, std::string_view key, const std::string& value) {
  tables_[section].lines += fmt::format("{} = {}\n", key, value);
}

std::string Echo::text() const {
  std::string result;
  for (const auto& table : tables_) {
    if (!table.header.empty()) result += "\n" + table.header + "\n";
    result += table.lines;
  }
  return result;
}

std::string toml_text(double value) {
  auto text = fmt::format("{}", value);  // shortest text that reads back to the same bits
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(int value) { return fmt::format("{}", value); }

std::string toml_text(const std::string& value) {
  std::string result = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

}  // namespace splashdown::apps
