// What a study with random axes, replicates or two-level factors says as a whole: statistics, probabilities, effects.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/campaign/effects.hpp"
#include "apps/study/campaign/envelope.hpp"
#include "apps/study/campaign/sample.hpp"
#include "apps/study/campaign/sobol_indices.hpp"
#include "apps/study/study.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {

/// Runs with one value of each of some axes that are neither random nor of replicates.
struct Group {
  std::vector<std::pair<std::string, std::string>> at;  ///< axis and value; empty: all runs of the study
  std::vector<std::size_t> runs;
  bool by_chance = false;  ///< nothing else tells its runs apart
};

/// The mean of a group's first runs.
struct PartialMean {
  std::size_t runs = 0;
  double mean = 0;
  std::optional<Band> band;
};

struct QuantityStatistics {
  std::string quantity;
  const Group* group = nullptr;
  std::size_t without = 0;  ///< runs that ended without a number: broken down, most of them
  SampleStatistics found;
  std::vector<PartialMean> growth;  ///< of the first 2, 4, 8, ... runs and of all, where they differ by chance alone
};

/// How often a limit's question is answered with yes. What the band of a single run leaves open counts as no in `least`, as yes in `most`.
struct LimitProbability {
  std::string limit;
  const Group* group = nullptr;
  std::size_t yes = 0, no = 0, open = 0, without = 0;
  std::size_t answered() const { return yes + no + open; }
  Probability least() const { return {yes, answered()}; }
  Probability most() const { return {yes + open, answered()}; }
  /// Of the answers only: 95 % (Wilson), from the lower end of `least` to the upper one of `most`.
  Band band() const { return {least().wilson().low, most().wilson().high}; }
  /// The same, at least 95 % (Clopper and Pearson).
  Band wide_band() const { return {least().clopper_pearson().low, most().clopper_pearson().high}; }
};

struct QuantityEffects {
  std::string quantity;
  std::vector<Effect> effects;
};

struct QuantityIndices {
  std::string quantity;
  const Group* group = nullptr;
  std::size_t rows = 0;
  std::vector<SobolIndex> indices;  ///< by random axis
};

/// What [envelope] asks for.
struct CampaignEnvelope {
  std::string limit, x, y;  ///< axes by name
  std::vector<double> x_values, y_values;
  double level = 0.5;
  double doubt = 0.05;              ///< that a cell may have
  std::vector<EnvelopeCell> cells;  ///< by x, then by y
};

/// The band that [stop] is about.
struct CampaignStop {
  std::string of;
  double asked = 0, width = 0;  ///< in its unit
  bool is_reached() const { return width <= asked; }
};

struct Campaign {
  std::vector<Group> groups;  ///< not empty
  std::vector<QuantityStatistics> statistics;
  std::vector<LimitProbability> probabilities;
  std::vector<std::string> factors;  ///< axes of two values
  Fraction fraction{{}};             ///< of their combinations
  std::vector<QuantityEffects> effects;
  std::vector<std::string> random_axes;
  std::vector<QuantityIndices> indices;
  std::optional<CampaignEnvelope> envelope;
  std::optional<CampaignStop> stop;  ///< absent: not asked for, or too few runs yet

  Campaign() = default;
  Campaign(Campaign&&) = default;  // groups are pointed at
  Campaign& operator=(Campaign&&) = default;
};

/// Nothing for a study that is a mere grid of values: it has neither chance nor factors nor an envelope.
std::optional<Campaign> campaign_of(const Study& study, const std::vector<StudyRun>& runs,
                                    const std::vector<Outcome>& outcomes);

/// For study.json.
nlohmann::ordered_json json_of(const Campaign& campaign);

/// statistics.csv, convergence.csv, probabilities.csv, effects.csv, sobol_indices.csv, envelope.csv: those that have rows. Others of earlier
/// calls are removed.
void write_campaign(const Campaign& campaign, const std::filesystem::path& folder);

/// For the console: a line a limit, and the design.
std::string campaign_text(const Campaign& campaign, const Study& study);

/// Width of the band that `stop` is about: of a mean, or of a probability; nothing: too few runs.
std::optional<double> width_of(const StudyStop& stop, const Study& study, const std::vector<StudyRun>& runs,
                               const std::vector<Outcome>& outcomes);

}  // namespace splashdown::apps
