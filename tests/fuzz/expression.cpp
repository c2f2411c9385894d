// Expressions, with columns and numbers for their names.
#include "apps/quantity/expression.hpp"

#include <stdexcept>

#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown::quantity;
  const auto text = splashdown::fuzz::text_of(data, size);
  const auto lookup = [](const std::string& name) -> std::optional<Value> {
    if (name == "time") return Value::column({0, 0.5, 1, 2});
    if (name == "fy") return Value::column({3, -1, 0, 7});
    if (name == "short") return Value::column({1});
    if (name == "none") return Value::column({});
    if (name == "g" || name == "summary.wall_seconds") return Value::number(9.81);
    return {};
  };
  try {
    check_syntax(text);
    evaluate(text, lookup);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
