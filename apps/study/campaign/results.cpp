#include "apps/study/campaign/results.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace splashdown::apps {
namespace {

bool is_factor(const Study& study, std::size_t a) {
  const auto& axis = study.axes[a];
  return axis.values.size() == 2 && axis.leader == a && !axis.sampled && !axis.replicates;
}

std::vector<std::size_t> factors_of(const Study& study) {
  std::vector<std::size_t> factors;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (is_factor(study, a)) factors.push_back(a);
  return factors;
}

bool has_chance(const Study& study) {
  return std::ranges::any_of(study.axes, [](const Axis& axis) { return axis.sampled || axis.replicates; });
}

/// The sets of axes whose values make groups: where there is chance, all axes beside it; each factor; those that the study names. Runs of an
/// envelope are chosen, so that its groups are those that it names alone.
std::vector<std::vector<std::size_t>> sets_of_axes(const Study& study) {
  constexpr std::size_t most_levels = 12;  // of a factor
  std::vector<std::size_t> fixed;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (!study.axes[a].sampled && !study.axes[a].replicates) fixed.push_back(a);
  std::vector<std::vector<std::size_t>> sets;
  if (has_chance(study) && !fixed.empty()) sets.push_back(fixed);
  for (const std::size_t a : fixed)
    if (study.axes[a].leader == a && study.axes[a].values.size() <= most_levels && !study.envelope) sets.push_back({a});
  sets.insert(sets.end(), study.groups.begin(), study.groups.end());
  std::vector<std::vector<std::size_t>> once;
  for (auto& set : sets)
    if (std::ranges::find(once, set) == once.end()) once.push_back(std::move(set));
  return once;
}

/// All runs, and those of each combination of values of each set of axes.
std::vector<Group> groups_of(const Study& study, const std::vector<StudyRun>& runs) {
  std::vector<Group> groups(1);
  for (std::size_t i = 0; i < runs.size(); ++i) groups[0].runs.push_back(i);
  const bool chance = has_chance(study);
  groups[0].by_chance =
      chance && std::ranges::all_of(study.axes, [](const Axis& axis) { return axis.sampled || axis.replicates; });
  const auto fixed = std::ranges::count_if(study.axes, [](const Axis& a) { return !a.sampled && !a.replicates; });
  for (const auto& set : sets_of_axes(study)) {
    std::map<std::vector<std::size_t>, std::size_t> places;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      std::vector<std::size_t> at;
      for (const std::size_t a : set) at.push_back(runs[i].value[a]);
      const auto [place, is_new] = places.try_emplace(at, groups.size());
      if (is_new) {
        auto& group = groups.emplace_back();
        group.by_chance = chance && static_cast<std::ptrdiff_t>(set.size()) == fixed;
        for (const std::size_t a : set)
          group.at.emplace_back(study.axes[a].name, study.axes[a].values[runs[i].value[a]].text);
      }
      groups[place->second].runs.push_back(i);
    }
  }
  return groups;
}

std::optional<double> number_of(const Outcome& outcome, const std::string& quantity) {
  const auto found = outcome.numbers.find(quantity);
  if (outcome.status != Outcome::Status::converged || found == outcome.numbers.end() || !std::isfinite(found->second))
    return {};
  return found->second;
}

std::vector<double> values_of(const Group& group, const std::string& quantity, const std::vector<Outcome>& outcomes) {
  std::vector<double> values;
  for (const std::size_t i : group.runs)
    if (const auto value = number_of(outcomes[i], quantity)) values.push_back(*value);
  return values;
}

/// Bands as they narrow with the number of runs.
std::vector<PartialMean> growth_of(const std::vector<double>& values) {
  std::vector<PartialMean> growth;
  const auto add = [&](std::size_t n) {
    const std::vector<double> first(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n));
    growth.push_back({.runs = n,
                      .mean = std::accumulate(first.begin(), first.end(), 0.) / static_cast<double>(n),
                      .band = mean_band(first)});
  };
  for (std::size_t n = 2; n < values.size(); n *= 2) add(n);
  if (values.size() > 1) add(values.size());
  return growth;
}

void add_statistics(Campaign& campaign, const Group& group, const std::string& quantity,
                    const std::vector<Outcome>& outcomes) {
  const auto values = values_of(group, quantity, outcomes);
  if (values.empty()) return;
  const auto finished = std::ranges::count_if(group.runs, [&](std::size_t i) { return outcomes[i].finished(); });
  campaign.statistics.push_back({.quantity = quantity,
                                 .group = &group,
                                 .without = static_cast<std::size_t>(finished) - values.size(),
                                 .found = statistics_of(values),
                                 .growth = group.by_chance ? growth_of(values) : std::vector<PartialMean>{}});
}

void add_probability(Campaign& campaign, const Group& group, const std::string& limit,
                     const std::vector<Outcome>& outcomes) {
  LimitProbability found{.limit = limit, .group = &group};
  for (const std::size_t i : group.runs) {
    if (!outcomes[i].finished()) continue;
    const auto answer = outcomes[i].limits.find(limit);
    const auto text =
        answer == outcomes[i].limits.end() || outcomes[i].status != Outcome::Status::converged ? "" : answer->second;
    ++(text == "yes" ? found.yes : text == "no" ? found.no : text.empty() ? found.without : found.open);
  }
  if (found.answered() > 0) campaign.probabilities.push_back(found);
}

void add_effects(Campaign& campaign, const Study& study, const std::vector<StudyRun>& runs,
                 const std::vector<Outcome>& outcomes) {
  const auto factors = factors_of(study);
  if (factors.size() < 2 || factors.size() > 60) return;
  std::vector<Factors> generators;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    campaign.factors.push_back(study.axes[factors[f]].name);
    Factors word = study.axes[factors[f]].product.empty() ? 0 : Factors{1} << f;
    for (const std::size_t of : study.axes[factors[f]].product)
      word ^= Factors{1} << (std::ranges::find(factors, of) - factors.begin());
    if (word != 0) generators.push_back(word);
  }
  campaign.fraction = Fraction(generators);
  for (const auto& quantity : study.quantities) {
    std::vector<FactorialRun> found;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto value = number_of(outcomes[i], quantity.name);
      if (!value) continue;
      FactorialRun run{.high = 0, .value = *value};
      for (std::size_t f = 0; f < factors.size(); ++f)
        if (runs[i].value[factors[f]] == 1) run.high |= Factors{1} << f;
      found.push_back(run);
    }
    auto effects = effects_of(found, factors.size(), campaign.fraction);
    if (!effects.empty()) campaign.effects.push_back({quantity.name, std::move(effects)});
  }
}

void add_indices(Campaign& campaign, const Study& study, const std::vector<StudyRun>& runs,
                 const std::vector<Outcome>& outcomes) {
  const auto first = std::ranges::find_if(study.axes, &Axis::sampled);
  if (!study.samples || study.samples->plan != Plan::saltelli || first == study.axes.end()) return;
  const auto leader = static_cast<std::size_t>(first - study.axes.begin());
  for (const auto& axis : study.axes)
    if (axis.sampled) campaign.random_axes.push_back(axis.name);
  for (const auto& quantity : study.quantities) {
    for (const auto& group : campaign.groups) {
      // Points of the plan in their order, once each: with other axes beside chance that is a group, without them it is all.
      std::vector<std::optional<double>> values(study.axes[leader].values.size());
      if (group.runs.size() != values.size()) continue;
      for (const std::size_t i : group.runs) values[runs[i].value[leader]] = number_of(outcomes[i], quantity.name);
      QuantityIndices found{.quantity = quantity.name, .group = &group, .rows = 0, .indices = {}};
      found.indices = sobol_indices(values, campaign.random_axes.size(), found.rows);
      if (!found.indices.empty()) campaign.indices.push_back(std::move(found));
    }
  }
}

CampaignEnvelope envelope_of(const Study& study, const std::vector<StudyRun>& runs,
                             const std::vector<Outcome>& outcomes) {
  const auto& asked = *study.envelope;
  const auto &x = study.axes[asked.x], &y = study.axes[asked.y];
  CampaignEnvelope envelope{.limit = asked.limit,
                            .x = x.name,
                            .y = y.name,
                            .x_values = {},
                            .y_values = {},
                            .level = asked.level,
                            .doubt = asked.doubt,
                            .cells = EnvelopePlane(study, runs, outcomes).cells()};
  for (const auto& value : x.values) envelope.x_values.push_back(*value.number);
  for (const auto& value : y.values) envelope.y_values.push_back(*value.number);
  return envelope;
}

}  // namespace

std::optional<Campaign> campaign_of(const Study& study, const std::vector<StudyRun>& runs,
                                    const std::vector<Outcome>& outcomes) {
  if (!has_chance(study) && factors_of(study).size() < 2 && !study.envelope && study.groups.empty()) return {};
  Campaign campaign;
  campaign.groups = groups_of(study, runs);
  const auto limits = limit_names(outcomes);
  for (const auto& group : campaign.groups) {
    for (const auto& quantity : study.quantities) add_statistics(campaign, group, quantity.name, outcomes);
    for (const auto& limit : limits) add_probability(campaign, group, limit, outcomes);
  }
  add_effects(campaign, study, runs, outcomes);
  add_indices(campaign, study, runs, outcomes);
  if (study.envelope) campaign.envelope = envelope_of(study, runs, outcomes);
  if (study.stop)
    if (const auto width = width_of(*study.stop, study, runs, outcomes))
      campaign.stop = {study.stop->of, study.stop->width, *width};
  return campaign;
}

std::optional<double> width_of(const StudyStop& stop, const Study& study, const std::vector<StudyRun>& runs,
                               const std::vector<Outcome>& outcomes) {
  Campaign campaign;
  campaign.groups.resize(1);
  for (std::size_t i = 0; i < runs.size(); ++i) campaign.groups[0].runs.push_back(i);
  const auto least = static_cast<std::size_t>(stop.least);
  if (std::ranges::find(study.quantities, stop.of, &StudyQuantity::name) == study.quantities.end()) {
    add_probability(campaign, campaign.groups[0], stop.of, outcomes);
    if (campaign.probabilities.empty() || campaign.probabilities[0].answered() < least) return {};
    const auto band = campaign.probabilities[0].band();
    return band.high - band.low;
  }
  const auto values = values_of(campaign.groups[0], stop.of, outcomes);
  const auto band = mean_band(values);
  return values.size() < least || !band ? std::nullopt : std::optional(band->high - band->low);
}

}  // namespace splashdown::apps
