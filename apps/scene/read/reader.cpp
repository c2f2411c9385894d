#include "apps/scene/read/reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "apps/scene/read/dimensions.hpp"
#include "apps/scene/read/units.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

const char* type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return node.is_array_of_tables() ? "an array of tables" : "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    default:
      return "a date";
  }
}

/// Of something else where a number is wanted; the rule's own cure is for numbers.
std::string cure_of_number(const toml::node& node, const Rule& rule) {
  if (const auto text = node.value<std::string>(); text && node.is_string()) return cure_of_text(*text, rule);
  return "Write one number" + (rule.unit.empty() ? std::string(".") : ", in " + rule.unit + ".");
}

}  // namespace

bool is_exact(const toml::node& node) { return !node.is_integer() || node.value<double>().has_value(); }

std::string written(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* text = node.as_string()) return toml_text(text->get());
  if (const auto* array = node.as_array()) {
    std::string list;
    for (const auto& element : *array) list += (list.empty() ? "" : ", ") + written(element);
    return "[" + list + "]";
  }
  if (node.is_table()) return "{...}";
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
}

std::string written_short(const toml::node& node) {
  if (node.is_table() || node.is_array_of_tables()) return {};
  constexpr std::size_t longest = 60;
  const auto text = written(node);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

Place place_of(const toml::node& node) {
  const auto& source = node.source();
  if (!source.path) return {};
  // Overrides carry their argument as the source; they have no lines.
  return {*source.path, source.path->starts_with("--") ? 0 : static_cast<long>(source.begin.line)};
}

Reader::Reader(ReadContext& context, const toml::table& table, std::string path, std::string header, bool in_array)
    : context_(&context),
      table_(&table),
      path_(std::move(path)),
      header_(std::move(header)),
      section_(context.echo.open(header_.empty() ? ""
                                 : in_array      ? "[[" + header_ + "]]"
                                                 : "[" + header_ + "]")) {
  if (const auto place = place_of(table); !place.source.empty()) context_->problems.note(path_, place, {});
  if (context_->sketch) visit_ = &context_->sketch->open(header_);
}

Reader::Reader(Reader&& other) noexcept
    : context_(other.context_),
      table_(std::exchange(other.table_, nullptr)),
      path_(std::move(other.path_)),
      header_(std::move(other.header_)),
      section_(other.section_),
      visit_(other.visit_),
      known_(std::move(other.known_)),
      ignored_(std::move(other.ignored_)) {}

Reader::~Reader() {
  if (!table_) return;
  const Names valid(known_.begin(), known_.end());
  for (const auto& [name, node] : *table_) {
    if (known_.contains(name.str()) || ignored_.contains(name.str())) continue;
    context_->problems.note(key(name), place_of(node), written_short(node));
    context_->problems.add_unknown(key(name), valid, elsewhere(context_->dimension, header_, name.str()));
  }
}

bool Reader::holds(std::string_view name) const {
  if (visit_) return context_->sketch->decide("holds " + header_of(name), 2, 0) == 1;
  return table_->contains(name);
}

void Reader::skip(std::string_view name) {
  known_.emplace(name);
  if (visit_) visit_->at(name);
}

void Reader::ignore(std::string_view name) {
  ignored_.emplace(name);
  note(name, {});
}

void Reader::refuse(std::string_view name, const std::string& rule, const std::string& cure) {
  skip(name);
  if (visit_) visit_->at(name).refused = true;
  const auto* node = table_->get(name);
  if (!node) return;
  context_->problems.note(key(name), place_of(*node), {});
  context_->problems.add(key(name), rule, cure);
}

void Reader::note(std::string_view name, Wanted wanted, Need need) {
  if (!visit_) return;
  auto& noted = visit_->at(name);
  noted.any_of.push_back(std::move(wanted));
  noted.required = noted.required || need == Need::required;
}

void Reader::skip_all() {
  for (const auto& [name, node] : *table_) ignore(name.str());
}

std::string Reader::key(std::string_view name) const {
  return path_.empty() ? std::string(name) : fmt::format("{}.{}", path_, name);
}

std::string Reader::header_of(std::string_view name) const {
  return header_.empty() ? std::string(name) : fmt::format("{}.{}", header_, name);
}

const toml::node* Reader::find(std::string_view name, Need need, const std::string& meaning, const std::string& cure) {
  known_.emplace(name);
  const toml::node* node = table_->get(name);
  if (node)
    context_->problems.note(key(name), place_of(*node), written_short(*node));
  else if (need == Need::required)
    context_->problems.add_missing(key(name), meaning, cure);
  return node;
}

void Reader::wrong_type(const std::string& key, const std::string& wanted, const toml::node& node,
                        const std::string& cure) {
  context_->problems.add(key, fmt::format("must be {}, not {}", wanted, type_name(node)), cure);
}

std::optional<double> Reader::number_of(const toml::node& node, const std::string& key, const Rule& rule) {
  if (!node.is_number()) {
    wrong_type(key, "a number" + rule.in_unit(), node, cure_of_number(node, rule));
    return {};
  }
  if (!is_exact(node)) {
    context_->problems.add(key, "whole numbers beyond 2^53 are not kept exactly", "Write it with a point, e.g. 1e16.");
    return {};
  }
  const double value = *node.value<double>();
  if (!std::isfinite(value)) {
    context_->problems.add(key, "must be finite" + rule.in_unit(), rule.cure);
    return {};
  }
  if (!rule.holds(value)) {
    context_->problems.add(key, rule.law(), rule.cure);
    return {};
  }
  if (rule.unit == "m" && std::abs(value) > largest_length) {
    context_->problems.add(key, fmt::format("must not be beyond {:g} m", largest_length),
                           "Scenes are in metres; no tank is that large.");
    return {};
  }
  if (rule.unit == "m" && rule.low_open && value < smallest_length) {
    context_->problems.add(key, fmt::format("must not be below {:g} m", smallest_length), rule.cure);
    return {};
  }
  if (rule.divisor == 1) return value;
  const double in_force = value / rule.divisor;
  if (!rule.holds(in_force) || (rule.unit == "m" && (in_force > largest_length || in_force < smallest_length))) {
    context_->problems.add(key,
                           fmt::format("{}, and so must what fluid.size.refine = {:g} makes of it, {:g}", rule.law(),
                                       rule.divisor, in_force),
                           "Use a refine nearer to 1.");
    return {};
  }
  context_->problems.note_in_force(key, in_force, rule.divisor);
  return in_force;
}

std::optional<std::vector<double>> Reader::list_of(const toml::node& node, const std::string& key, std::size_t length,
                                                   const Rule& rule) {
  const auto* array = node.as_array();
  if (!array || (length > 0 && array->size() != length)) {
    const auto wanted = length > 0 ? fmt::format("a list of {} numbers", length) : "a list of numbers";
    if (array)
      context_->problems.add(key, fmt::format("must be {}{}, not {}", wanted, rule.in_unit(), array->size()),
                             rule.cure);
    else
      wrong_type(key, wanted + rule.in_unit(), node, rule.cure);
    return {};
  }
  std::vector<double> values;
  for (const auto& element : *array) {
    const auto value = number_of(element, key, rule);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::optional<Point> Reader::point_of(const toml::node& node, const std::string& key, const Rule& rule) {
  const auto values = list_of(node, key, static_cast<std::size_t>(context_->dimension), rule);
  if (!values) return {};
  Point point = Point::Zero();
  for (std::size_t i = 0; i < values->size(); ++i) point[static_cast<Eigen::Index>(i)] = (*values)[i];
  return point;
}

std::string Reader::echo_of(const Point& point) const {
  return toml_list(std::vector<double>(point.data(), point.data() + context_->dimension));
}

void Reader::number(std::string_view name, double& target, const Rule& rule, Need need) {
  note(name, {.type = Wanted::Type::number, .rule = rule}, need);
  if (const auto* node = find(name, need, "a number" + rule.in_unit(), rule.cure))
    target = number_of(*node, key(name), rule).value_or(target);
  echo(name, target);
}

void Reader::number(std::string_view name, std::optional<double>& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::number, .rule = rule});
  if (visit_ && holds(name)) target = 1;  // for the keys that hang on it
  if (const auto* node = find(name, Need::optional, {}, {})) target = number_of(*node, key(name), rule);
  if (target) echo(name, *target);
}

double Reader::divisor(std::string_view name, const Rule& rule, std::span<const Preset> named) {
  Names words;
  for (const auto& preset : named) words.emplace_back(preset.name);
  note(name, {.type = Wanted::Type::number, .rule = rule});
  note(name, {.type = Wanted::Type::word, .words = words});
  double value = 1;
  if (const auto* node = find(name, Need::optional, {}, {})) {
    if (const auto word = node->value<std::string>()) {
      const auto found = std::ranges::find(named, *word, &Preset::name);
      if (found != named.end())
        value = found->refine;
      else
        context_->problems.add(
            key(name), "must be a number or " + listing(words),
            nearest(*word, words).empty() ? rule.cure : fmt::format("Did you mean '{}'?", nearest(*word, words)));
    } else {
      value = number_of(*node, key(name), rule).value_or(1.);
    }
  }
  echo(name, 1.);
  return value;
}

void Reader::integer(std::string_view name, int& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::whole, .rule = rule});
  if (const auto* node = find(name, Need::optional, {}, {})) {
    if (!node->is_integer())
      wrong_type(key(name), "a whole number", *node, "Write it without quotes and without a point, e.g. 50.");
    else if (const auto value = number_of(*node, key(name), rule))
      target = static_cast<int>(*value);
  }
  echo(name, target);
}

const toml::node* Reader::node(std::string_view name, Need need, const std::string& meaning, const std::string& cure,
                               std::vector<Wanted::Type> wanted) {
  for (const auto type : wanted) note(name, {.type = type, .hint = cure}, need);
  return find(name, need, meaning, cure);
}

const toml::node* Reader::named_node(const std::string& name) {
  if (!visit_) return find(name, Need::optional, {}, {});
  visit_->others = Wanted{};
  return nullptr;
}

}  // namespace splashdown::apps
