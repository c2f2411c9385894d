#include "apps/price/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"
#include "apps/scene/numbers.hpp"

namespace splashdown::apps {
namespace {

constexpr const char* quantity_cure =
    "Use e.g. --quantity \"peak=max(smooth(fy, time, 5e-4)) from bodies.csv:wedge\" or "
    "\"passes=summary.coupling.passes_mean\".";

/// Across half of a patch: with fewer its mean is the pressure of one node or two, which need not converge.
constexpr double least_patch_elements = 2;

class Defaults {
 public:
  explicit Defaults(const Scene& scene) : scene_(scene), numbers_(numbers_of(scene)) {}

  std::vector<PriceQuantity> all() && {
    for (const auto& body : scene_.bodies) add_body(body);
    for (const auto& record : scene_.records) std::visit([this](const auto& entry) { add(entry); }, record);
    add_goals();
    return std::move(quantities_);
  }

 private:
  /// A number of the run by its name.
  void entry(const std::string& name, bool counts = true) {
    const auto number = std::ranges::find(numbers_, name, &NamedNumber::name);
    quantities_.push_back(
        {.name = name, .unit = number->unit, .counts = counts, .path = number->paths.front(), .measured = {}});
  }
  void expression(const std::string& name, const std::string& unit, const std::string& table, const std::string& text,
                  bool counts = true) {
    PriceQuantity quantity{.name = name, .unit = unit, .counts = counts, .path = {}, .measured = {}};
    quantity.measured.name = name;
    quantity.measured.table = table;
    quantity.measured.quantity = text;
    quantities_.push_back(std::move(quantity));
  }

  /// A scene that says what it is made for is priced by that.
  void add_goals() {
    const std::string of = "goals.";
    if (std::ranges::none_of(numbers_, [&](const NamedNumber& number) { return number.name.starts_with(of); })) return;
    for (auto& quantity : quantities_) quantity.counts = false;
    for (const auto& number : numbers_) {
      if (!number.name.starts_with(of)) continue;
      entry(number.name);
      quantities_.back().told = number.name + ".error";
    }
  }

  void add_body(const Body& body) {
    if (scene_.vortex || scene_.ale) add_in_stream(body);
    if (!scene_.fluid) return;
    const std::string of = "bodies." + body.name + ".", up = scene_.dimension == 2 ? "y" : "z";
    // CFC 60, of structures as a whole (SAE J211-1), is the headline, and there on all rungs; CFC 180 on those with short steps.
    if (body.becomes_free()) {
      entry(body.name + ".peak_g_cfc60");
      entry(body.name + ".peak_g_cfc180", false);
      entry(body.name + ".peak_g_raw", false);
    }
    entry(body.name + ".peak_force_cfc60", !body.becomes_free());
    entry(body.name + ".peak_force_raw", false);
    entry(body.name + ".impulse");
    if (!body.becomes_free()) return;
    expression(body.name + ".velocity_change", "m/s", "bodies.csv:" + body.name,
               fmt::format("last(v{0}) - first(v{0})", up));
    entry(body.name + ".greatest_submergence");
    // Over the second half of the time for which its speed has stayed below 2 % of sqrt(g L): in the first it still swings by
    // some per cent of its draft. There is none where it does not settle.
    if (scene_.gravity) {
      expression(body.name + ".rest_submergence", "m", "bodies.csv:" + body.name, "mean(submergence, time)");
      quantities_.back().measured.where =
          fmt::format("time >= 0.5*(summary.{}settled_time + summary.simulated_time)", of);
    }
  }
  /// There is no impact but that of a start, whose force depends on the step.
  void add_in_stream(const Body& body) {
    const auto table = "bodies.csv:" + body.name;
    if (body.becomes_free()) {
      expression(body.name + ".way", "m", table, "sqrt((last(x) - first(x))^2 + (last(y) - first(y))^2)");
      expression(body.name + ".last_speed", "m/s", table, "sqrt(last(vx)^2 + last(vy)^2)");
    } else {
      expression(body.name + ".mean_force", "N/m", table, "sqrt(mean(fx, time)^2 + mean(fy, time)^2)");
      expression(body.name + ".rms_force", "N/m", table, "sqrt(rms(fx)^2 + rms(fy)^2)");
      for (auto k = quantities_.size() - 2; k < quantities_.size(); ++k)
        quantities_[k].measured.where = "time > 0.02*summary.simulated_time";
    }
  }
  void add(const PatchEntry& patch) {
    entry(patch.name + ".peak_pressure");
    quantities_.back().resolution = "patches." + patch.name + ".grades.peak_pressure.evidence.patch_elements";
    quantities_.back().least_resolution = least_patch_elements;
  }
  void add(const AccelerationEntry& point) {
    entry(point.name + ".peak_g_cfc60");
    entry(point.name + ".peak_g_raw", false);
  }
  void add(const PressureEntry& probe) {
    expression(probe.name + ".peak_pressure", "Pa", "probes.csv:" + probe.name, "max(value)", false);
  }
  void add(const MaximumPressureEntry& map) {
    const auto& name = scene_.bodies[map.body].name;
    entry(name + ".maximum_pressure", false);
  }
  template <class Other>
  void add(const Other&) {}  // curves and matrices: no single number is the one that is meant

  const Scene& scene_;
  std::vector<NamedNumber> numbers_;
  std::vector<PriceQuantity> quantities_;
};

/// The text from `word` on, taken off.
std::string taken(std::string& text, const std::string& word) {
  const auto found = text.rfind(" " + word + " ");
  if (found == std::string::npos) return {};
  auto rest = text.substr(found + word.size() + 2);
  text.erase(found);
  return rest;
}

}  // namespace

std::vector<PriceQuantity> default_quantities(const Scene& scene) { return Defaults(scene).all(); }

PriceQuantity parsed_quantity(const std::string& argument) {
  const auto refuse = [&](const std::string& what) {
    return SceneError({fmt::format("--quantity {}: {}. {}", argument, what, quantity_cure)});
  };
  const auto equals = argument.find('=');
  PriceQuantity quantity{.name = argument.substr(0, std::min(equals, argument.size())),
                         .counts = true,
                         .asked = true,
                         .path = {},
                         .measured = {}};
  const bool plain = std::ranges::all_of(quantity.name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (equals == std::string::npos || equals == 0 || !plain)
    throw refuse("must read NAME=EXPRESSION, the name made of letters, digits and _");
  auto& measured = quantity.measured;
  std::string text = argument.substr(equals + 1);
  measured.name = quantity.name;
  measured.where = taken(text, "where");
  measured.table = taken(text, "from");
  measured.quantity = text;
  measured.place = {"--quantity " + argument, 0};
  try {
    quantity::check_syntax(measured.quantity);
    if (!measured.where.empty()) quantity::check_syntax(measured.where);
  } catch (const std::runtime_error& error) {
    throw refuse(error.what());
  }
  return quantity;
}

void check_price_quantities(const std::vector<PriceQuantity>& quantities, const Scene& scene) {
  Problems problems("");
  Study study;
  std::set<std::string> names;
  for (const auto& quantity : quantities) {
    if (!names.insert(quantity.name).second && quantity.asked)
      throw SceneError({fmt::format("--quantity {}=...: there is one of this name. Use another name.", quantity.name)});
    if (quantity.asked) study.quantities.push_back(quantity.measured);
  }
  check_quantities(study, scene, problems);
  problems.throw_if_any();
}

double node_steps_in(const std::filesystem::path& folder) {
  const auto summary = quantity::read_summary(folder);
  const double steps = summary.value("steps", 0.);
  if (!std::filesystem::exists(folder / "fluid.csv")) {  // bodies that deform keep their meshes
    const auto nodes = quantity::find_entry(summary, "nodes.max");
    return nodes ? nodes->numbers.front() * steps : 0;
  }
  const auto table = quantity::read_table(folder, "fluid.csv");
  const auto* nodes = table.find("nodes");
  if (nodes == nullptr || nodes->empty()) return 0;
  double sum = 0;
  for (const double n : *nodes) sum += n;
  return sum / static_cast<double>(nodes->size()) * steps;
}

double told_error_in(const std::filesystem::path& folder, const PriceQuantity& quantity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (quantity.told.empty()) return none;
  const auto entry = quantity::find_entry(quantity::read_summary(folder), quantity.told);
  return entry ? entry->numbers.front() : none;
}

double value_in(const std::filesystem::path& folder, const PriceQuantity& quantity, std::string& why) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto summary = quantity::read_summary(folder);
  const auto& measured = quantity.measured;
  quantity::Table table;
  const quantity::Lookup names = [&](const std::string& name) {
    if (const auto path = quantity::after("summary", name)) return quantity::find_entry(summary, *path);
    return quantity::find_column(table, name);
  };
  if (!quantity.resolution.empty()) {
    const auto found = quantity::find_entry(summary, quantity.resolution);
    if (found && !(found->numbers.front() >= quantity.least_resolution)) {
      why = fmt::format("summary.{} is below {:g}", quantity.resolution, quantity.least_resolution);
      return none;
    }
  }
  try {
    if (!quantity.path.empty()) {
      if (const auto entry = quantity::find_entry(summary, quantity.path)) return entry->numbers.front();
      why = "summary." + quantity.path + " has no value in this run";
      return none;
    }
    if (!measured.table.empty()) table = quantity::read_table(folder, measured.table);
    if (!measured.where.empty()) table = quantity::rows_where(table, measured.where, names);
    return quantity::evaluate_number(measured.quantity, names);
  } catch (const std::runtime_error& error) {
    why = error.what();
    return none;
  }
}

}  // namespace splashdown::apps
