// What the runs of a study came to: study.csv and study.json.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/study.hpp"

namespace splashdown::apps {

/// How a run ended. Its files say so; the study keeps no record of its own.
struct Outcome {
  enum class Status {
    waiting,      ///< not begun, or begun anew since its scene has changed
    interrupted,  ///< begun and neither finished nor failed; continues from its checkpoint
    converged,    ///< reached its end
    diverged,     ///< stopped: the coupling's residual grew
    stalled,      ///< stopped: the coupling did not converge within its passes, or the budget is spent
    failed        ///< stopped for another reason
  };
  Status status = Status::waiting;
  std::string cause;    ///< why it stopped; empty otherwise
  std::string verdict;  ///< what the run's numbers are worth: a grade of its summary; empty: not known
  /// By column: passes_mean, wall_seconds ... and the study's quantities with their errors; absent: no value.
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> limits;  ///< answers to those of scene and study, by name

  bool finished() const { return status != Status::waiting && status != Status::interrupted; }
};

const char* word(Outcome::Status status);

/// "12 converged: 3 resolved, 9 unresolved; 2 diverged"
std::string counts_text(const std::vector<Outcome>& outcomes);

/// Columns that every study has beside its axes and quantities, and those of them that are numbers.
std::vector<std::string> outcome_columns();
std::vector<std::string> number_columns();

/// Names of the limits that any run has answered.
std::vector<std::string> limit_names(const std::vector<Outcome>& outcomes);

/// What a column says, in words, with its unit.
std::string column_label(const Study& study, const std::string& column);

/// Reads a run's folder. A run counts only if it was made with the very scene that the study asks for now.
Outcome outcome_of(const Study& study, const StudyRun& run, const std::filesystem::path& folder);

/// Of all runs, from their folders within that of the study.
std::vector<Outcome> outcomes_in(const Study& study, const std::vector<StudyRun>& runs,
                                 const std::filesystem::path& folder);

/// Whether the folder was begun with the run's scene, so that --resume may continue in it.
bool begun_with(const StudyRun& run, const std::filesystem::path& folder);

/// Evaluates the quantities of all finished runs, then the errors. What has no value is told once a quantity.
std::vector<std::string> measure(const Study& study, const std::vector<StudyRun>& runs,
                                 const std::filesystem::path& folder, std::vector<Outcome>& outcomes);

/// The same for one run that has just ended, but for errors that need another run; what has no value is left out.
void measure_run(const Study& study, const StudyRun& run, const std::filesystem::path& folder, Outcome& outcome);

/// study.csv, study.json and the tables of a campaign, each whole or not at all.
void write_tables(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                  const std::filesystem::path& folder);

}  // namespace splashdown::apps
