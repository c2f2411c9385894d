#include "apps/scene/read/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "apps/quantity/expression.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/study/read_axes.hpp"
#include "apps/study/read_runs.hpp"
#include "apps/study/study.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {
namespace {

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
    if (!axis.product.empty()) {
      reader.context().problems.add(table->key(axis.name), "follows the signs of other axes", "Name one of those.");
      continue;
    }
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

void read_study_limit(Reader& reader, Study& study, Columns& columns) {
  StudyLimit limit;
  Problems& problems = reader.context().problems;
  reader.text("name", limit.name, "Use a short word; its column is limit.NAME.", Need::required);
  reader.text("quantity", limit.quantity, "Write an expression of quantities, e.g. \"peak_g\".", Need::required);
  check_expression(reader, "quantity", limit.quantity);
  if (reader.holds("quantity")) limit.place = reader.place("quantity");
  limit.above = !reader.holds("below");
  if (reader.holds("above") && reader.holds("below"))
    problems.add(reader.key("below"), "above and below exclude each other", "Remove one of them, or write two limits.");
  if (!reader.holds("above") && !reader.holds("below"))
    problems.add_missing(reader.key("above"), "a limit asks whether its number is above or below a value",
                         "Use e.g. above = 12.");
  reader.number(limit.above ? "above" : "below", limit.value, any("", "Use the value that is asked about."));
  reader.skip(limit.above ? "below" : "above");
  columns.take(reader, limit.name);
  study.limits.push_back(std::move(limit));
}

void read_derived(Reader& reader, Study& study) {
  DerivedKey derived;
  Problems& problems = reader.context().problems;
  const char* const cure = "Use an expression of axes and constants, e.g. \"0.5*density\".";
  reader.text("key", derived.key, "Name a key of the scene as for --set, e.g. body.wedge.mass.", Need::required);
  reader.text("value", derived.value, cure, Need::required);
  if (reader.holds("value")) derived.place = reader.place("value");
  check_expression(reader, "value", derived.value);
  if (derived.key.empty() || derived.value.empty() || problems.found_in(reader.key("value"))) return;
  auto valid = std::vector<std::string>();
  for (const auto& axis : study.axes)
    if (axis.is_of_numbers()) valid.push_back(axis.name);
  for (const auto& [name, value] : study.constants) valid.push_back(name);
  for (const auto& name : quantity::names_in(derived.value)) {
    if (std::ranges::find(valid, name) != valid.end()) continue;
    const auto near = nearest(name, valid);
    return problems.add(reader.key("value"), fmt::format("'{}' is neither an axis of numbers nor a constant", name),
                        near.empty() ? cure : "Did you mean '" + near + "'?");
  }
  study.derived.push_back(std::move(derived));
}

/// Axes without a key of their own set nothing unless derived keys use them.
void check_axes_without_keys(const Study& study, Problems& problems) {
  for (const auto& axis : study.axes) {
    const bool has_keys = std::ranges::any_of(axis.values, [](const AxisValue& value) { return !value.set.empty(); });
    if (has_keys || axis.values.empty() || !axis.is_of_numbers()) continue;
    const bool used = std::ranges::any_of(study.derived, [&](const DerivedKey& derived) {
      const auto names = quantity::names_in(derived.value);
      return std::ranges::find(names, axis.name) != names.end();
    });
    if (!used)
      problems.add_missing(
          "axis." + axis.name + ".key", "what its values are set in",
          "Name a key of the scene as for --set, e.g. body.wedge.mass, or use the axis in [[derived]].");
  }
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

/// Axes by whose values statistics are told apart.
void read_group(Reader& reader, Study& study) {
  std::vector<std::string> valid, by;
  for (const auto& axis : study.axes)
    if (!axis.sampled && !axis.replicates) valid.push_back(axis.name);
  if (!reader.holds("by"))
    reader.context().problems.add_missing(reader.key("by"), "the axes that tell its runs apart",
                                          "Name axes that are not random, e.g. by = [\"mass\"].");
  reader.references("by", by, valid);
  std::vector<std::size_t> axes;
  for (const auto& name : by)
    if (const auto found = std::ranges::find(study.axes, name, &Axis::name); found != study.axes.end())
      axes.push_back(static_cast<std::size_t>(found - study.axes.begin()));
  if (!axes.empty()) study.groups.push_back(std::move(axes));
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
  root.texts("set", study.set, set_texts_cure);
  root.number("budget", study.budget, positive("s", "Use wall seconds for a run, e.g. 60."));
  root.number("until", study.until, positive("s", "Use the simulated time at which every run shall stop."));
  if (root.holds("until")) study.until_place = root.place("until");
  root.numbers_by_name("constants", study.constants, "g = 9.81");
  if (auto samples = root.table("samples")) read_samples(*samples, study.samples.emplace());
  read_axes(root, study, columns);
  if (study.axes.empty() && !problems.noted("axis"))
    problems.add_missing("axis", "what varies", "Write [[axis]] with name, key and values.");
  root.each_table("derived", [&](Reader& reader) { read_derived(reader, study); });
  check_axes_without_keys(study, problems);
  root.each_table("quantity", [&](Reader& reader) { read_quantity(reader, study, columns); });
  root.each_table("limit", [&](Reader& reader) { read_study_limit(reader, study, columns); });
  root.each_table("group", [&](Reader& reader) { read_group(reader, study); });
  if (auto stop = root.table("stop")) read_stop(*stop, study);
  if (auto envelope = root.table("envelope")) read_envelope(*envelope, study);
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
