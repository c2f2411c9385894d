#include "tests/validation/check.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string_view>

namespace splashdown::validation {

namespace {

/// A table of check.toml whose keys are all to be asked for.
class Section {
 public:
  Section(const toml::table& table, std::filesystem::path file) : table_(table), file_(std::move(file)) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", file_.string(), node.source().begin.line, what));
  }

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        fail(node, fmt::format("unknown key '{}'; known: {}", key.str(), fmt::join(keys, ", ")));
  }

  template <class T>
  std::optional<T> find(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<T>();
    if (!value) fail(*node, fmt::format("'{}' has the wrong type", key));
    return *value;
  }

  std::string text(std::string_view key, const std::string& otherwise = "") const {
    return find<std::string>(key).value_or(otherwise);
  }

  std::string required_text(std::string_view key) const {
    const auto value = find<std::string>(key);
    if (!value) fail(table_, fmt::format("'{}' is missing", key));
    return *value;
  }

  /// A number or an expression that gives one.
  std::optional<std::string> number_or_expression(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    if (node->is_string()) return node->value<std::string>();
    return fmt::format("{}", *find<double>(key));
  }

  std::vector<std::string> texts(std::string_view key) const {
    std::vector<std::string> result;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return result;
    if (!node->is_array()) fail(*node, fmt::format("'{}' has to be a list of strings", key));
    for (const toml::node& entry : *node->as_array()) {
      const auto value = entry.value<std::string>();
      if (!value) fail(entry, fmt::format("'{}' has to be a list of strings", key));
      result.push_back(*value);
    }
    return result;
  }

  std::vector<Section> sections(std::string_view key) const {
    std::vector<Section> result;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return result;
    if (!node->is_array_of_tables()) fail(*node, fmt::format("write [[{}]]", key));
    for (const toml::node& entry : *node->as_array()) result.emplace_back(*entry.as_table(), file_);
    return result;
  }

  const toml::table& table() const { return table_; }

 private:
  const toml::table& table_;
  std::filesystem::path file_;
};

Label read_label(const Section& section) {
  const std::string label = section.text("label", "ci");
  if (label == "ci") return Label::ci;
  if (label == "nightly") return Label::nightly;
  section.fail(*section.table().get("label"), "label is \"ci\" or \"nightly\"");
}

RunSpec read_run(const Section& section) {
  section.allow_only({"name", "scene", "set", "until", "exit_code", "label"});
  RunSpec run;
  run.name = section.required_text("name");
  run.scene = section.text("scene", run.scene);
  for (const std::string& assignment : section.texts("set"))
    run.arguments.insert(run.arguments.end(), {"--set", assignment});
  if (const auto until = section.number_or_expression("until"))
    run.arguments.insert(run.arguments.end(), {"--until", *until});
  run.exit_code = section.find<int>("exit_code").value_or(run.exit_code);
  run.label = read_label(section);
  return run;
}

Bound read_bound(const Section& section) {
  Bound bound;
  bound.expected = section.number_or_expression("expected");
  const auto relative = section.find<double>("tolerance");
  const auto absolute = section.find<double>("tolerance_absolute");
  bound.absolute = absolute.has_value();
  bound.tolerance = absolute.value_or(relative.value_or(0));
  bound.at_most = section.find<double>("at_most");
  bound.at_least = section.find<double>("at_least");
  if (bound.expected.has_value() != (relative.has_value() != absolute.has_value()))
    section.fail(section.table(), "'expected' needs one of 'tolerance' (relative) and 'tolerance_absolute'");
  return bound;
}

CheckSpec read_check(const Section& section, const Example& example) {
  section.allow_only({"name", "run", "table", "where", "reference", "quantity", "expected", "tolerance",
                      "tolerance_absolute", "at_most", "at_least", "unit", "why", "label"});
  CheckSpec check;
  check.name = section.required_text("name");
  check.run = section.text("run", example.runs.front().name);
  check.table = section.text("table");
  check.where = section.text("where");
  check.reference = section.text("reference");
  check.quantity = section.required_text("quantity");
  check.bound = read_bound(section);
  check.unit = section.text("unit", "-");
  check.why = section.required_text("why");
  check.label = read_label(section);
  const bool known =
      std::any_of(example.runs.begin(), example.runs.end(), [&](const RunSpec& run) { return run.name == check.run; });
  if (!known) section.fail(*section.table().get("run"), fmt::format("there is no [[run]] '{}'", check.run));
  if (example.run(check.run).label == Label::nightly) check.label = Label::nightly;
  return check;
}

std::map<std::string, double> read_constants(const Section& section) {
  std::map<std::string, double> constants;
  const toml::node* node = section.table().get("constants");
  if (node == nullptr) return constants;
  if (!node->is_table()) section.fail(*node, "write [constants]");
  for (const auto& [key, entry] : *node->as_table()) {
    const auto value = entry.value<double>();
    if (!value) section.fail(entry, fmt::format("constant '{}' has to be a number", key.str()));
    constants.emplace(key.str(), *value);
  }
  return constants;
}

}  // namespace

const RunSpec& Example::run(const std::string& name) const {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const RunSpec& run) { return run.name == name; });
  if (found == runs.end()) throw std::runtime_error(fmt::format("there is no [[run]] '{}'", name));
  return *found;
}

Example read_example(const std::filesystem::path& folder) {
  const auto file = folder / "check.toml";
  toml::table root;
  try {
    root = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  const Section top(root, file);
  top.allow_only({"title", "constants", "run", "check"});
  Example example;
  example.folder = folder;
  example.title = top.required_text("title");
  example.constants = read_constants(top);
  for (const Section& section : top.sections("run")) example.runs.push_back(read_run(section));
  if (example.runs.empty()) top.fail(root, "there is no [[run]]");
  std::set<std::string> names;
  for (const Section& section : top.sections("check")) {
    example.checks.push_back(read_check(section, example));
    if (!names.insert(example.checks.back().name).second)
      section.fail(section.table(), fmt::format("check '{}' stands twice", example.checks.back().name));
  }
  return example;
}

}  // namespace splashdown::validation
