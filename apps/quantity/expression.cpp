#include "apps/quantity/expression.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "apps/quantity/functions.hpp"

namespace splashdown::quantity {

namespace {

using Binary = double (*)(double, double);

struct Operator {
  std::string_view sign;
  Binary apply;
};

// Weakest first; within a level the longer sign stands before its own beginning.
const std::vector<std::vector<Operator>> levels = {
    {{"or", [](double a, double b) { return double(a != 0 || b != 0); }}},
    {{"and", [](double a, double b) { return double(a != 0 && b != 0); }}},
    {{"<=", [](double a, double b) { return double(a <= b); }},
     {">=", [](double a, double b) { return double(a >= b); }},
     {"==", [](double a, double b) { return double(a == b); }},
     {"<", [](double a, double b) { return double(a < b); }},
     {">", [](double a, double b) { return double(a > b); }}},
    {{"+", [](double a, double b) { return a + b; }}, {"-", [](double a, double b) { return a - b; }}},
    {{"*", [](double a, double b) { return a * b; }}, {"/", [](double a, double b) { return a / b; }}},
};

class Parser {
 public:
  /// Without a lookup only the syntax counts: names and calls are worth zero.
  Parser(std::string_view text, const Lookup* lookup, std::vector<std::string>* names = nullptr)
      : text_(text), lookup_(lookup), names_(names) {}

  Value parse() {
    Value value = binary(0);
    skip_space();
    if (at_ != text_.size()) fail("unexpected text");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{} at character {} of \"{}\"", what, at_ + 1, text_));
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  bool word_at(std::size_t i) const {
    return i < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[i])) || text_[i] == '_');
  }

  bool take(std::string_view sign) {
    skip_space();
    if (text_.substr(at_, sign.size()) != sign) return false;
    const bool is_word = std::isalpha(static_cast<unsigned char>(sign.front())) != 0;
    if (is_word && word_at(at_ + sign.size())) return false;
    at_ += sign.size();
    return true;
  }

  Value combine(const Value& a, const Value& b, Binary apply) const {
    if (!a.scalar && !b.scalar && a.numbers.size() != b.numbers.size())
      fail(fmt::format("columns of {} and {} rows do not fit", a.numbers.size(), b.numbers.size()));
    const std::size_t n = a.scalar ? b.numbers.size() : a.numbers.size();
    Value result{std::vector<double>(n), a.scalar && b.scalar};
    for (std::size_t i = 0; i < n; ++i)
      result.numbers[i] = apply(a.numbers[a.scalar ? 0 : i], b.numbers[b.scalar ? 0 : i]);
    return result;
  }

  Value binary(std::size_t level) {
    if (level == levels.size()) return unary();
    Value value = binary(level + 1);
    for (bool found = true; found;) {
      found = false;
      for (const auto& candidate : levels[level]) {
        if (!take(candidate.sign)) continue;
        value = combine(value, binary(level + 1), candidate.apply);
        found = true;
        break;
      }
    }
    return value;
  }

  /// Expressions are read by functions that call each other; the stack is not endless.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      constexpr int deepest = 100;  // far beyond what anybody writes
      if (++parser_.depth_ > deepest) parser_.fail("brackets and signs in each other too deep");
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  Value unary() {
    const Level level(*this);
    if (take("-")) return combine(Value::number(0), unary(), [](double a, double b) { return a - b; });
    const Value base = primary();
    if (!take("^")) return base;
    return combine(base, unary(), [](double a, double b) { return std::pow(a, b); });
  }

  Value primary() {
    if (take("(")) {
      Value value = binary(0);
      if (!take(")")) fail("expected ')'");
      return value;
    }
    skip_space();
    if (at_ == text_.size()) fail("expected a value");
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return literal();
    if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') return named();
    fail("expected a value");
  }

  Value literal() {
    double number = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc()) fail("not a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return Value::number(number);
  }

  Value named() {
    const std::size_t start = at_;
    while (word_at(at_) || (at_ < text_.size() && text_[at_] == '.')) ++at_;
    const std::string name(text_.substr(start, at_ - start));
    if (take("(")) return call(name);
    if (names_) names_->push_back(name);
    if (!lookup_) return Value::number(0);
    if (auto value = (*lookup_)(name)) return *value;
    fail(fmt::format("unknown name '{}'", name));
  }

  Value call(const std::string& name) {
    std::vector<Value> arguments;
    if (!take(")")) {
      do arguments.push_back(binary(0));
      while (take(","));
      if (!take(")")) fail("expected ')'");
    }
    if (!lookup_) return Value::number(0);
    try {
      return call_function(name, arguments);
    } catch (const std::runtime_error& error) {
      fail(error.what());
    }
  }

  std::string_view text_;
  const Lookup* lookup_;
  std::vector<std::string>* names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Value evaluate(const std::string& expression, const Lookup& lookup) { return Parser(expression, &lookup).parse(); }

std::vector<std::string> names_in(const std::string& expression) {
  std::vector<std::string> names;
  Parser(expression, nullptr, &names).parse();
  return names;
}

void check_syntax(const std::string& expression) { Parser(expression, nullptr).parse(); }

double evaluate_number(const std::string& expression, const Lookup& lookup) {
  const Value value = evaluate(expression, lookup);
  if (value.numbers.size() != 1)
    throw std::runtime_error(fmt::format("\"{}\" gives {} numbers instead of one", expression, value.numbers.size()));
  return value.numbers.front();
}

}  // namespace splashdown::quantity
