#include "apps/scene/read/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "apps/quantity/expression.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/study/study.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {
namespace {

const char* const set_cure = "Write --set texts, e.g. set = [\"time.end=0.1\"].";

/// Letters, digits and _, so that expressions can use it.
bool is_name(const std::string& text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// Names of columns and constants, each of which may stand once.
class Columns {
 public:
  explicit Columns(Problems& problems) : problems_(problems), taken_(outcome_columns()) {}

  void take(const Reader& reader, const std::string& name) {
    const auto key = reader.key("name");
    const char* const cure = "Use another name of letters, digits and _, e.g. density_ratio.";
    if (name.empty()) return;  // missing, and told
    if (!is_name(name))
      problems_.add(key, "must be a name that expressions can use", cure);
    else if (std::ranges::find(taken_, name) != taken_.end())
      problems_.add(key, "there is a column of this name already", cure);
    taken_.push_back(name);
  }
  const std::vector<std::string>& taken() const { return taken_; }

 private:
  Problems& problems_;
  std::vector<std::string> taken_;
};

/// A key and its value for --set; none of a key that is missing, which is told already.
std::vector<std::string> set_text(const std::string& key, const std::string& value) {
  if (key.empty()) return {};
  return {key + "=" + value};
}

/// Splitmix64 (Steele, Lea and Flood 2014): the same numbers on every machine, which those of <random> need not be.
class Random {
 public:
  /// A stream of its own for each axis, whatever axes there are beside it (FNV-1a of the name).
  Random(int seed, const std::string& name) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const unsigned char c : name) hash = (hash ^ c) * 0x100000001b3;
    state_ = hash ^ (static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15);
  }
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // [0, 1)

 private:
  std::uint64_t state_ = 0;
};

/// One value in each of `number` equal parts of the range, the parts in random order: with the other axes of a range a
/// Latin hypercube (McKay, Beckman and Conover 1979).
std::vector<double> sampled_values(double low, double high, bool log, int number, Random random) {
  std::vector<double> values;
  for (int i = 0; i < number; ++i) {
    const double share = (i + random.share()) / number;
    values.push_back(log ? low * std::pow(high / low, share) : low + share * (high - low));
  }
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[static_cast<std::size_t>(random.share() * static_cast<double>(i))]);
  return values;
}

void read_range(Reader& reader, Axis& axis, const std::string& key, const std::string& spacing, const Study& study) {
  Problems& problems = reader.context().problems;
  double scale = 1;
  std::vector<double> range;
  reader.number("scale", scale, any("", "Use the factor from these values to the scene's key."));
  reader.numbers("range", range, any("", "Use the lowest and the highest value, e.g. range = [-5, 5]."));
  axis.sampled = true;
  if (problems.found_in(reader.key("range"))) return;
  const bool log = spacing == "log";
  if (range.size() != 2 || range[0] >= range[1] || (log && range[0] <= 0))
    return problems.add(
        reader.key("range"),
        log ? "must be two positive numbers, the lower one first" : "must be two numbers, the lower one first",
        "Use e.g. range = [1, 5].");
  if (!study.samples) {
    if (!problems.found_in("samples"))
      problems.add(reader.key("range"), "needs [samples], which says how many values are drawn",
                   "Write [samples] with number = 20.");
    return;
  }
  const auto values = sampled_values(range[0], range[1], log, study.samples->number, {study.samples->seed, axis.name});
  for (const double value : values) {
    const auto text = fmt::format("{:.6g}", value);  // tables and folders show what is run
    const double number = std::stod(text);
    axis.values.push_back({.text = text,
                           .number = number,
                           .set = set_text(key, toml_text(number * scale)),
                           .place = reader.place("range")});
  }
}

void read_values(Reader& reader, Axis& axis, const std::string& key) {
  Problems& problems = reader.context().problems;
  double scale = 1;
  const bool scaled = reader.holds("scale");
  reader.number("scale", scale, any("", "Use the factor from these values to the scene's key."));
  const std::string cure = "Use a list, e.g. values = [1000, 100, 10].";
  const auto* node = reader.node("values", Need::required, "the values that the key takes", cure);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array || array->empty()) return problems.add(reader.key("values"), "must be a list of at least one value", cure);
  for (const auto& entry : *array) {
    if (entry.is_table())
      return problems.add(reader.key("values"), "holds a table", "Use [[axis.case]] with set instead.");
    if (!is_exact(entry))
      return problems.add(reader.key("values"), "whole numbers beyond 2^53 are not kept exactly",
                          "Write them with a point, e.g. 1e16.");
    if (scaled && !entry.is_number())
      return problems.add(reader.key("values"), "must be numbers, since there is a scale", "Drop the scale.");
    AxisValue value{.text = written(entry), .number = {}, .set = {}, .place = place_of(entry)};
    if (entry.is_number()) value.number = *entry.value<double>();
    value.set = set_text(key, scaled ? toml_text(*value.number * scale) : value.text);
    if (entry.is_string()) value.text = *entry.value<std::string>();
    if (axis.find(value.text))
      return problems.add(reader.key("values"), "holds " + value.text + " twice", "Name each value once.");
    axis.values.push_back(std::move(value));
  }
}

void read_case(Reader& reader, Axis& axis) {
  AxisValue value;
  reader.text("name", value.text, "Use a short word, e.g. \"aitken\".", Need::required);
  reader.texts("set", value.set, set_cure, Need::required);
  value.place = reader.place("name");
  if (!value.text.empty() && axis.find(value.text))
    reader.context().problems.add(reader.key("name"), "there is a case of this name already", "Use another name.");
  axis.values.push_back(std::move(value));
}

/// Which axis the last one varies together with: that of its `zip`, or the first random one.
void read_company(Reader& reader, Study& study) {
  auto& axes = study.axes;
  auto& axis = axes.back();
  axis.leader = axes.size() - 1;
  Problems& problems = reader.context().problems;
  if (axis.sampled) {
    reader.skip("zip");
    if (reader.holds("zip")) problems.add(reader.key("zip"), "random axes vary together as it is", "Remove zip.");
    const auto first = std::ranges::find_if(axes, &Axis::sampled);
    axis.leader = static_cast<std::size_t>(first - axes.begin());
    return;
  }
  if (!reader.holds("zip")) return reader.skip("zip");
  std::vector<std::string> valid;
  for (std::size_t a = 0; a + 1 < axes.size(); ++a) valid.push_back(axes[a].name);
  std::string name;
  reader.node("zip", Need::optional, {}, {});  // so that its value is known to messages
  if (valid.empty())
    return problems.add(reader.key("zip"), "there is no axis before this one",
                        "Put zip into the later one of the two.");
  if (!reader.choice("zip", name, valid)) return;
  const auto& other = axes[static_cast<std::size_t>(std::ranges::find(valid, name) - valid.begin())];
  if (!axis.values.empty() && !other.values.empty() && other.values.size() != axis.values.size())
    return problems.add(
        reader.key("zip"),
        fmt::format("this axis has {} values, {} has {}", axis.values.size(), name, other.values.size()),
        "Axes that vary together have as many values.");
  axis.leader = other.leader;
}

void read_axis(Reader& reader, Study& study, Columns& columns) {
  auto& axis = study.axes.emplace_back();
  Problems& problems = reader.context().problems;
  const bool cases = reader.holds("case"), ranged = reader.holds("range"),
             listed = reader.holds("key") || reader.holds("values");
  std::string key;
  reader.text("name", axis.name, "Use a short word; it becomes a column.", Need::required);
  if (listed || !cases) {
    reader.text("key", key, "Name a key of the scene as for --set, e.g. body.wedge.mass.", Need::required);
    std::string spacing = "linear";
    reader.choice("spacing", spacing, {"linear", "log"});
    if (reader.holds("spacing") && !ranged)
      problems.add(reader.key("spacing"), "has no range to space", "Remove it, or use range instead of values.");
    ranged ? read_range(reader, axis, key, spacing, study) : read_values(reader, axis, key);
  }
  if (ranged && reader.holds("values"))
    problems.add(reader.key("values"), "must not stand beside range", "Use one of the two.");
  if (listed && cases) problems.add(reader.path(), "has both a key with values and cases", "Use one of the two.");
  reader.each_table("case", [&](Reader& one) { read_case(one, axis); });
  axis.label = axis.name;
  reader.text("label", axis.label, "Use a short text with the unit, e.g. \"body density (kg/m^3)\".");
  columns.take(reader, axis.name);
  read_company(reader, study);
}

void check_expression(Reader& reader, std::string_view key, const std::string& text) {
  try {
    if (!text.empty()) quantity::check_syntax(text);
  } catch (const std::runtime_error& error) {
    reader.context().problems.add(reader.key(key), error.what(),
                                  "Use columns, summary.PATH and functions, e.g. \"max(fy)\".");
  }
}

/// Axis name -> text of the value where the reference run stands.
void read_reference(Reader& reader, const Study& study, StudyQuantity& quantity) {
  auto table = reader.table("reference");
  if (!table) return;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const auto& axis = study.axes[a];
    const auto* node = table->named_node(axis.name);
    if (!node) continue;
    const auto text = node->is_string() ? *node->value<std::string>() : written(*node);
    std::vector<std::string> valid;
    for (const auto& value : axis.values) valid.push_back(value.text);
    if (const auto found = axis.find(text))
      quantity.reference[a] = *found;
    else
      reader.context().problems.add(table->key(axis.name), "is no value of this axis", "Use " + listing(valid) + ".");
  }
}

void read_quantity(Reader& reader, Study& study, Columns& columns) {
  StudyQuantity quantity;
  reader.text("name", quantity.name, "Use a short word; it becomes a column.", Need::required);
  reader.text("quantity", quantity.quantity, "Write an expression, e.g. \"summary.coupling.passes_mean\".",
              Need::required);
  reader.text("table", quantity.table, "Name a file of the run's folder, e.g. \"bodies.csv:wedge\".");
  reader.text("where", quantity.where, "Write an expression of columns, e.g. \"time > 0.01\".");
  reader.text("unit", quantity.unit, "Use a short text, e.g. \"m/s^2\".");
  if (reader.holds("quantity")) quantity.place = reader.place("quantity");
  quantity.label = quantity.name;
  reader.text("label", quantity.label, "Use a few words.");
  check_expression(reader, "quantity", quantity.quantity);
  check_expression(reader, "where", quantity.where);
  const std::string cure = "Use a number or an expression of axes and constants.";
  if (const auto* node = reader.node("exact", Need::optional, {}, cure, {Wanted::Type::number, Wanted::Type::text})) {
    if (node->is_string() || node->is_number())
      quantity.exact = node->is_string() ? *node->value<std::string>() : written(*node);
    else
      reader.context().problems.add(reader.key("exact"), "must be a number or an expression", cure);
    check_expression(reader, "exact", quantity.exact.value_or(""));
  }
  read_reference(reader, study, quantity);
  reader.text("scale", quantity.scale, "Use what deviations are to be divided by, e.g. \"9.81\".");
  check_expression(reader, "scale", quantity.scale);
  if (!quantity.scale.empty() && !reader.holds("exact") && !reader.holds("reference"))
    reader.context().problems.add(reader.key("scale"), "has nothing to scale", "Add exact or reference.");
  reader.number("limit", quantity.limit, positive("", "Use the largest error that is still a solution, e.g. 1."));
  if (quantity.limit && !reader.holds("exact") && !reader.holds("reference"))
    reader.context().problems.add(reader.key("limit"), "has nothing to limit", "Add exact or reference.");
  if (quantity.exact && reader.holds("reference"))
    reader.context().problems.add(reader.key("reference"), "must not stand beside exact",
                                  "An error refers to one of the two.");
  columns.take(reader, quantity.name);
  study.quantities.push_back(std::move(quantity));
}

void read_samples(Reader& reader, Samples& samples) {
  const bool given = reader.holds("number");
  reader.integer("number", samples.number, within(1, most_runs, "", "Use e.g. 20: combinations that are drawn."));
  if (!given)
    reader.context().problems.add_missing(reader.key("number"), "how many combinations are drawn", "Use e.g. 20.");
  reader.integer("seed", samples.seed, within(0, 1e9, "", "Use a whole number; another one draws other values."));
}

/// The axis of a name, or a problem.
std::optional<std::size_t> read_axis_name(Reader& reader, std::string_view key, const Study& study, Need need) {
  std::vector<std::string> valid;
  for (const auto& axis : study.axes) valid.push_back(axis.name);
  std::string name;
  if (valid.empty()) {  // a mistake that has been told
    reader.text(key, name, "Name an axis.", need);
    return {};
  }
  if (!reader.reference(key, name, valid, need) || name.empty()) return {};
  return static_cast<std::size_t>(std::ranges::find(valid, name) - valid.begin());
}

void read_chart(Reader& reader, Study& study) {
  auto& chart = study.chart.emplace();
  Problems& problems = reader.context().problems;
  if (const auto x = read_axis_name(reader, "x", study, Need::required)) chart.x = *x;
  chart.series = read_axis_name(reader, "series", study, Need::optional);
  chart.panels = read_axis_name(reader, "panels", study, Need::optional);
  auto valid = number_columns();
  for (const auto& quantity : study.quantities) {
    valid.push_back(quantity.name);
    if (quantity.has_error()) valid.push_back(quantity.error_name());
  }
  chart.y = {"passes_mean", "wall_seconds"};
  reader.references("y", chart.y, valid);
  std::string scale_x = "log", scale_y = "log";
  reader.choice("scale_x", scale_x, {"log", "linear"});
  reader.choice("scale_y", scale_y, {"log", "linear"});
  chart.log_x = scale_x == "log" && !study.axes.empty() && study.axes[chart.x].is_of_numbers();
  chart.log_y = scale_y == "log";
  if (chart.log_x && std::ranges::any_of(study.axes[chart.x].values, [](const auto& v) { return *v.number <= 0; }))
    problems.add(reader.key("x"), "has values that a logarithmic scale cannot show", "Use scale_x = \"linear\".");
}

void read_root(Reader& root, Study& study) {
  Problems& problems = root.context().problems;
  Columns columns(problems);
  std::string scene;
  root.text("title", study.title, "Use a short text in quotes.");
  root.text("scene", scene, "Name the scene file, relative to this file.", Need::required);
  study.scene = (study.file.parent_path() / scene).lexically_normal();
  std::error_code unusable;  // a name that no file system takes: too long, say
  if (!scene.empty() && !std::filesystem::is_regular_file(study.scene, unusable))
    problems.add("scene", "there is no such file: " + study.scene.string(),
                 "Name the scene file, relative to this file.");
  root.texts("set", study.set, set_cure);
  root.number("budget", study.budget, positive("s", "Use wall seconds for a run, e.g. 60."));
  root.number("until", study.until, positive("s", "Use the simulated time at which every run shall stop."));
  if (root.holds("until")) study.until_place = root.place("until");
  root.numbers_by_name("constants", study.constants, "g = 9.81");
  if (auto samples = root.table("samples")) read_samples(*samples, study.samples.emplace());
  root.each_table("axis", [&](Reader& reader) { read_axis(reader, study, columns); });
  if (study.axes.empty() && !problems.noted("axis"))
    problems.add_missing("axis", "what varies", "Write [[axis]] with name, key and values.");
  root.each_table("quantity", [&](Reader& reader) { read_quantity(reader, study, columns); });
  if (auto chart = root.table("chart")) read_chart(*chart, study);
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  Problems problems(file.string());
  auto study = read_study(file, problems);
  problems.throw_if_any();
  return study;
}

Study read_study(const std::filesystem::path& file, Problems& problems) {
  const auto table =
      read_toml(read_text(file, "a study file, e.g. examples/coupling_schemes/study.toml"), file.string());
  if (!table.contains("scene") && (table["fluid"].is_table() || table["body"].is_array_of_tables()))
    throw SceneError(
        {fmt::format("{0}: is a scene, not a study. Use splashdown run {0}, or name it in a study: scene = \"{1}\".",
                     file.string(), file.filename().string())});
  Study study;
  study.file = file;
  {
    Echo echo;
    ReadContext context{problems, echo};
    Reader root(context, table, "", "");
    read_root(root, study);
  }
  return study;
}

void sketch_study(Sketch& sketch) {
  sketch.explore([&] {
    Problems nobody_told("");
    Echo unused;
    ReadContext context{.problems = nobody_told, .echo = unused, .sketch = &sketch};
    const toml::table empty;
    Reader root(context, empty, "", "");
    Study study;
    read_root(root, study);
  });
}

}  // namespace splashdown::apps
