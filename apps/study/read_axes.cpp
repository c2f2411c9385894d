#include "apps/study/read_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "apps/study/design/replicates.hpp"
#include "apps/study/read_random.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {
namespace {

/// Letters, digits and _, so that expressions can use it.
bool is_name(const std::string& text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// Meshes of practically one size: refine is `around`, and a few per cent beside it.
void read_replicates(Reader& reader, Axis& axis) {
  int number = 2;
  double around = 1;
  reader.integer("replicates", number,
                 within(2, most_replicates, "", "Use how many meshes of practically one size, e.g. 4."));
  reader.number("around", around, positive("", "Use the refine that they lie about, e.g. 0.5."));
  axis.replicates = true;
  for (int k = 0; k < number; ++k) {
    const auto refine = fmt::format("{:.6g}", k == 0 ? around : replicate_refine(around, k - 1));
    axis.values.push_back({.text = std::to_string(k + 1),
                           .number = k + 1,
                           .set = {"fluid.size.refine=" + refine},
                           .place = reader.place("replicates")});
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

void read_case(Reader& reader, Axis& axis, std::vector<double>& weights) {
  AxisValue value;
  if (reader.holds("weight")) {
    weights.push_back(1);
    reader.number("weight", weights.back(), positive("", "Use how often it occurs, in any unit."));
  } else {
    reader.skip("weight");
  }
  reader.text("name", value.text, "Use a short word, e.g. \"aitken\".", Need::required);
  reader.texts("set", value.set, set_texts_cure, Need::required);
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

/// The sign of an axis as the product of those of others: a fraction of all combinations.
void read_product(Reader& reader, Study& study) {
  auto& axis = study.axes.back();
  std::vector<std::string> names, valid;
  for (std::size_t a = 0; a + 1 < study.axes.size(); ++a)
    if (const auto& other = study.axes[a];
        other.values.size() == 2 && other.leader == a && !other.sampled && other.product.empty())
      valid.push_back(other.name);
  if (!reader.holds("product")) return reader.skip("product");
  Problems& problems = reader.context().problems;
  if (valid.size() < 2) {
    reader.texts("product", names, {});
    return problems.add(reader.key("product"), "needs two axes before this one that have two values each",
                        "Put the axis behind them.");
  }
  reader.references("product", names, valid);
  if (problems.found_in(reader.key("product"))) return;
  if (names.size() < 2 || std::set(names.begin(), names.end()).size() != names.size())
    return problems.add(reader.key("product"), "must name two or more other axes, each once",
                        "Use " + listing(valid) + ".");
  if (axis.values.size() != 2 || axis.sampled || axis.leader + 1 != study.axes.size())
    return problems.add(reader.key("product"), "stands at an axis that does not have two values of its own",
                        "Give the axis two values, without range, distribution and zip.");
  for (const auto& name : names)
    axis.product.push_back(
        static_cast<std::size_t>(std::ranges::find(study.axes, name, &Axis::name) - study.axes.begin()));
}

void read_axis(Reader& reader, Study& study, Columns& columns, std::vector<RandomAxis>& randoms) {
  auto& axis = study.axes.emplace_back();
  Problems& problems = reader.context().problems;
  const bool cases = reader.holds("case"), repeated = reader.holds("replicates"),
             ranged = reader.holds("range") || reader.holds("distribution"),
             listed = reader.holds("key") || reader.holds("values");
  RandomAxis random{.axis = study.axes.size() - 1};
  reader.text("name", axis.name, "Use a short word; it becomes a column.", Need::required);
  if (repeated) {
    read_replicates(reader, axis);
    if (listed || cases || ranged)
      problems.add(reader.key("replicates"), "must not stand beside values or cases", "Make it an axis of its own.");
  } else if (listed || !cases) {
    // Without one, [[derived]] has to use it.
    reader.text("key", random.key, "Name a key of the scene as for --set, e.g. body.wedge.mass.",
                ranged || reader.holds("values") ? Need::optional : Need::required);
    std::string spacing = "linear";
    reader.choice("spacing", spacing, {"linear", "log"});
    if (reader.holds("spacing") && !reader.holds("range"))
      problems.add(reader.key("spacing"), "has no range to space", "Remove it, or use range instead of values.");
    const bool bounded = !ranged && (reader.holds("min") || reader.holds("max"));
    for (const char* bound : {"min", "max"})
      if (bounded)
        reader.refuse(bound, "is no key of an axis",
                      "Use range = [1, 5] for values between two ends, and [samples] for how many.");
    if (ranged)
      read_random(reader, study, random, spacing);
    else if (!bounded)
      read_values(reader, axis, random.key);
  }
  if (ranged) reader.refuse("values", "must not stand beside range or distribution", "Use one of the two.");
  if (listed && cases) problems.add(reader.path(), "has both a key with values and cases", "Use one of the two.");
  reader.each_table("case", [&](Reader& one) { read_case(one, axis, random.weights); });
  if (!random.weights.empty() && random.weights.size() != axis.values.size())
    problems.add(reader.key("case"), "has weights for some cases only", "Give each case a weight, or none of them.");
  axis.sampled = ranged || !random.weights.empty();
  if (axis.sampled && !study.samples && !problems.found_in("samples"))
    problems.add(
        reader.key(ranged ? random.weights.empty() && reader.holds("range") ? "range" : "distribution" : "case"),
        "needs [samples], which says how many values are drawn", "Write [samples] with number = 20.");
  if (axis.sampled && study.samples && problems.messages().empty()) randoms.push_back(random);
  axis.label = axis.name;
  reader.text("label", axis.label, "Use a short text with the unit, e.g. \"body density (kg/m^3)\".");
  columns.take(reader, axis.name);
  read_company(reader, study);
  read_product(reader, study);
}

}  // namespace

Columns::Columns(Problems& problems) : problems_(problems), taken_(outcome_columns()) {}

void Columns::take(const Reader& reader, const std::string& name) {
  const auto key = reader.key("name");
  const char* const cure = "Use another name of letters, digits and _, e.g. density_ratio.";
  if (name.empty()) return;  // missing, and told
  if (!is_name(name))
    problems_.add(key, "must be a name that expressions can use", cure);
  else if (std::ranges::find(taken_, name) != taken_.end())
    problems_.add(key, "there is a column of this name already", cure);
  taken_.push_back(name);
}

void read_axes(Reader& root, Study& study, Columns& columns) {
  std::vector<RandomAxis> randoms;
  root.each_table("axis", [&](Reader& reader) { read_axis(reader, study, columns, randoms); });
  if (!randoms.empty()) draw_random(root, study, randoms);
}

}  // namespace splashdown::apps
