#include "apps/study/read_runs.hpp"

#include <algorithm>

#include "apps/scene/kinds/named.hpp"

namespace splashdown::apps {
namespace {

/// Axes of numbers that vary by themselves and are not random: those that a plane may have.
std::vector<std::string> axes_of_planes(const Study& study) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (const auto& axis = study.axes[a]; !axis.sampled && !axis.replicates && axis.leader == a &&
                                          axis.product.empty() && axis.is_of_numbers() && axis.values.size() > 1)
      names.push_back(axis.name);
  return names;
}

}  // namespace

void read_samples(Reader& reader, Samples& samples) {
  const bool given = reader.holds("number");
  reader.integer("number", samples.number, within(1, most_runs, "", "Use e.g. 20: combinations that are drawn."));
  if (!given)
    reader.context().problems.add_missing(reader.key("number"), "how many combinations are drawn", "Use e.g. 20.");
  reader.integer("seed", samples.seed, within(0, 1e9, "", "Use a whole number; another one draws other values."));
  struct NamedPlan {
    std::string_view name;
    Plan plan;
  };
  static constexpr NamedPlan plans[] = {{"latin_hypercube", Plan::latin_hypercube},
                                        {"sobol", Plan::sobol},
                                        {"random", Plan::random},
                                        {"saltelli", Plan::saltelli}};
  std::string plan(plans[0].name);
  if (reader.choice("plan", plan, names_of(plans))) samples.plan = named(plans, plan).plan;
}

void read_stop(Reader& reader, Study& study) {
  auto& stop = study.stop.emplace();
  std::vector<std::string> valid;
  for (const auto& quantity : study.quantities) valid.push_back(quantity.name);
  for (const auto& limit : study.limits) valid.push_back(limit.name);
  if (valid.empty())
    reader.text("of", stop.of, "Name a quantity or a limit of this study.", Need::required);
  else
    reader.reference("of", stop.of, valid, Need::required);
  const bool given = reader.holds("width");
  reader.number("width", stop.width, positive("", "Use how wide the band of 95 % may be at most."));
  if (!given)
    reader.context().problems.add_missing(reader.key("width"), "how narrow its band has to be", "Use e.g. 0.05.");
  reader.integer("least", stop.least, within(2, most_runs, "", "Use how many runs it takes at least, e.g. 20."));
  if (std::ranges::any_of(study.axes, [](const Axis& axis) { return !axis.sampled && !axis.replicates; }))
    reader.context().problems.add(reader.path(), "stops a study between values that are not random",
                                  "Use random axes and replicates alone, or remove [stop].");
}

void read_envelope(Reader& reader, Study& study) {
  auto& envelope = study.envelope.emplace();
  Problems& problems = reader.context().problems;
  const auto plane = axes_of_planes(study);
  std::vector<std::string> limits;
  for (const auto& limit : study.limits) limits.push_back(limit.name);
  const auto name = [&](const char* key, std::string& target, const std::vector<std::string>& valid, const char* what) {
    if (!valid.empty()) return reader.reference(key, target, valid, Need::required);
    reader.text(key, target, what, Need::required);
    if (reader.holds(key)) problems.add(reader.key(key), "there is none that it could name", what);
    return false;
  };
  name("limit", envelope.limit, limits, "Name a [[limit]] of this study.");
  const auto axis = [&](const char* key, std::size_t& target) {
    std::string word;
    if (!name(key, word, plane, "Name an axis with two or more values that are numbers.")) return;
    target = static_cast<std::size_t>(std::ranges::find(study.axes, word, &Axis::name) - study.axes.begin());
  };
  axis("x", envelope.x);
  axis("y", envelope.y);
  if (envelope.x == envelope.y && !problems.found_in(reader.path()) && reader.holds("y"))
    problems.add(reader.key("y"), "is the axis of x too", "Name two axes.");
  const bool given = reader.holds("runs");
  reader.integer("runs", envelope.runs, within(1, most_runs, "", "Use how many runs may be made, e.g. 60."));
  if (!given) problems.add_missing(reader.key("runs"), "how many runs are made at most", "Use e.g. 60.");
  reader.number("level", envelope.level, within(0.01, 0.99, "", "Use the probability at the line, e.g. 0.5."));
  reader.number("doubt", envelope.doubt, within(0.001, 0.4, "", "Use how doubtful a cell's side may stay, e.g. 0.05."));
}

}  // namespace splashdown::apps
