// Every value a scene was read to, defaults included, as TOML text that reads to the same scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splashdown::apps {

class Echo {
 public:
  using Section = std::size_t;

  /// Opens a table. `header` is what stands in its line, brackets included; empty for the root.
  Section open(std::string header);
  void add(Section section, std::string_view key, const std::string& value);
  std::string text() const;

 private:
  struct Table {
    std::string header;
    std::string lines;
  };
  std::vector<Table> tables_;
};

// Values as TOML writes them; numbers with all digits that a double needs.
std::string toml_text(double value);
std::string toml_text(int value);
std::string toml_text(const std::string& value);

template <class Range>
std::string toml_list(const Range& values) {
  std::string result = "[";
  for (const auto& value : values) result += (result.size() > 1 ? ", " : "") + toml_text(value);
  return result + "]";
}

}  // namespace splashdown::apps
