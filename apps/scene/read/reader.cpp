#include "apps/scene/read/reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "apps/cli/plain_text.hpp"

namespace splashdown::apps {
namespace {

const toml::table no_table;

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

/// Short enough for a message; nothing for tables.
std::string value_text(const toml::node& node) {
  if (node.is_table() || node.is_array_of_tables()) return {};
  constexpr std::size_t longest = 60;
  const auto text = written(node);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
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

Place place_of(const toml::node& node) {
  const auto& source = node.source();
  if (!source.path) return {};
  // Overrides carry their argument as the source; they have no lines.
  return {*source.path, source.path->starts_with("--set") ? 0 : static_cast<long>(source.begin.line)};
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
    context_->problems.note(key(name), place_of(node), value_text(node));
    context_->problems.add_unknown(key(name), valid);
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
    context_->problems.note(key(name), place_of(*node), value_text(*node));
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
    wrong_type(key, "a number" + rule.in_unit(), node, rule.cure);
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

double Reader::divisor(std::string_view name, const Rule& rule) {
  note(name, {.type = Wanted::Type::number, .rule = rule});
  double value = 1;
  if (const auto* node = find(name, Need::optional, {}, {})) value = number_of(*node, key(name), rule).value_or(1.);
  echo(name, 1.);
  return value;
}

void Reader::integer(std::string_view name, int& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::whole, .rule = rule});
  if (const auto* node = find(name, Need::optional, {}, {})) {
    if (!node->is_integer())
      wrong_type(key(name), "a whole number", *node, rule.cure);
    else if (const auto value = number_of(*node, key(name), rule))
      target = static_cast<int>(*value);
  }
  echo(name, target);
}

void Reader::text(std::string_view name, std::string& target, const std::string& cure, Need need) {
  note(name, {.type = Wanted::Type::text, .hint = cure}, need);
  if (const auto* node = find(name, need, "a string", cure)) {
    if (node->is_string())
      target = *node->value<std::string>();
    else
      wrong_type(key(name), "a string", *node, cure);
  }
  echo(name, target);
}

void Reader::file(std::string_view name, std::string& target, const std::string& cure) {
  note(name, {.type = Wanted::Type::text, .hint = cure}, Need::required);
  if (const auto* node = find(name, Need::required, "the name of a file", cure)) {
    if (node->is_string())
      target = std::filesystem::absolute(context_->folder / *node->value<std::string>()).lexically_normal().string();
    else
      wrong_type(key(name), "a string", *node, cure);
  }
  echo(name, target);
}

bool Reader::choice(std::string_view name, std::string& target, const Names& valid, Need need) {
  if (visit_) {
    note(name, {.type = Wanted::Type::word, .words = valid}, need);
    const auto found = std::find(valid.begin(), valid.end(), target);
    const std::size_t usual = found == valid.end() ? 0 : static_cast<std::size_t>(found - valid.begin());
    const auto picked = context_->sketch->decide("word " + header_of(name), valid.size(), usual);
    visit_->usual[std::string(name)] = need == Need::optional && picked == usual;
    visit_->picked[std::string(name)] = target = valid[picked];
    return true;
  }
  const auto cure = "Use " + listing(valid) + ".";
  const auto* node = find(name, need, "one of " + listing(valid), cure);
  bool good = need == Need::optional;
  if (node) {
    const auto word = node->value<std::string>();
    good = node->is_string() && std::find(valid.begin(), valid.end(), *word) != valid.end();
    const auto near = node->is_string() ? nearest(*word, valid) : std::string();
    if (good)
      target = *word;
    else if (!node->is_string())
      wrong_type(key(name), "a string", *node, cure);
    else
      context_->problems.add(key(name), "must be " + listing(valid),
                             near.empty() ? cure : "Did you mean '" + near + "'?");
  }
  echo(name, target);
  return good;
}

void Reader::choices(std::string_view name, Names& target, const Names& valid) {
  note(name, {.type = Wanted::Type::words, .words = valid});
  const auto cure = "Use a list of " + listing(valid) + ".";
  if (const auto* node = find(name, Need::optional, {}, {})) {
    Names words;
    bool good = node->is_array();
    if (good)
      for (const auto& element : *node->as_array()) {
        const auto word = element.value<std::string>();
        good = good && word && std::find(valid.begin(), valid.end(), *word) != valid.end() &&
               std::find(words.begin(), words.end(), *word) == words.end();
        if (word) words.push_back(*word);
      }
    if (good)
      target = words;
    else
      context_->problems.add(key(name), "must be a list of " + listing(valid) + ", each once", cure);
  }
  context_->echo.add(section_, name, toml_list(target));
}

bool Reader::reference(std::string_view name, std::string& target, const Names& valid, Need need) {
  if (!visit_) return choice(name, target, valid, need);
  note(name, {.type = Wanted::Type::text}, need);
  return false;
}

void Reader::references(std::string_view name, Names& target, const Names& valid) {
  if (!visit_) return choices(name, target, valid);
  note(name, {.type = Wanted::Type::texts});
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

void Reader::numbers_by_name(std::string_view name, std::map<std::string, double>& target, const std::string& example) {
  if (visit_) {
    note(name,
         {.type = Wanted::Type::table, .hint = "Names with numbers, e.g. " + example + ".", .header = header_of(name)});
    context_->sketch->open(header_of(name)).others = Wanted{.type = Wanted::Type::number};
    return;
  }
  const auto* node = find(name, Need::optional, {}, {});
  if (!node) return;
  const auto* table = node->as_table();
  if (!table)
    return context_->problems.add(key(name), "must be a table",
                                  fmt::format("Write [{}] with NAME = NUMBER.", header_of(name)));
  for (const auto& [entry, value] : *table) {
    const auto where = fmt::format("{}.{}", key(name), entry.str());
    context_->problems.note(where, place_of(value), value_text(value));
    if (!value.is_number()) context_->problems.add(where, "must be a number", "Use e.g. " + example + ".");
    if (!is_exact(value))
      context_->problems.add(where, "whole numbers beyond 2^53 are not kept exactly",
                             "Write it with a point, e.g. 1e16.");
    target.emplace(entry.str(), value.value<double>().value_or(0));
  }
}

std::optional<Reader> Reader::table(std::string_view name, Need need) {
  if (visit_) {
    note(name, {.type = Wanted::Type::table, .header = header_of(name)}, need);
    return Reader(*context_, no_table, key(name), header_of(name));
  }
  const auto cure = "Write [" + header_of(name) + "] with its keys below.";
  const auto* node = find(name, need, "a table", cure);
  if (!node) return {};
  if (const auto* table = node->as_table()) return Reader(*context_, *table, key(name), header_of(name));
  wrong_type(key(name), "a table", *node, cure);
  return {};
}

Reader Reader::table_or_defaults(std::string_view name) {
  if (!visit_)
    if (auto reader = table(name)) return std::move(*reader);
  note(name, {.type = Wanted::Type::table, .header = header_of(name), .even_absent = true});
  return Reader(*context_, no_table, key(name), header_of(name));
}

void Reader::each_table(std::string_view name, const std::function<void(Reader&)>& read) {
  if (visit_) {
    note(name, {.type = Wanted::Type::tables, .header = header_of(name)});
    Reader reader(*context_, no_table, fmt::format("{}[0]", key(name)), header_of(name), true);
    return read(reader);
  }
  const auto cure = "Write [[" + header_of(name) + "]], once for each.";
  const auto* node = find(name, Need::optional, {}, {});
  if (!node) return;
  const auto* array = node->as_array();
  if (!array || !std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_table(); })) {
    wrong_type(key(name), "an array of tables", *node, cure);
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto& table = *array->get(i)->as_table();
    const auto own = one_line(table["name"].value<std::string>().value_or(""));
    const bool by_name = !own.empty() && names.insert(own).second;
    // One at a time: its sub-tables must be echoed before the next element opens.
    Reader reader(*context_, table, by_name ? key(name) + "." + own : fmt::format("{}[{}]", key(name), i),
                  header_of(name), true);
    read(reader);
  }
}

}  // namespace splashdown::apps
