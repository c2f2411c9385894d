// A study: one scene, axes of values, and every combination of them as a run of its own. docs/study.md.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/rules/problems.hpp"
#include "apps/scene/scene.hpp"
#include "apps/study/design/shares.hpp"

namespace splashdown::apps {

class Sketch;

/// One value of an axis, or one of its named cases.
struct AxisValue {
  std::string text;              ///< in tables and folder names
  std::optional<double> number;  ///< what expressions and the chart see; absent for words
  std::vector<std::string> set;  ///< key.path=value, for --set
  Place place;                   ///< in the study file
};

struct Axis {
  std::string name;   ///< column; name in expressions
  std::string label;  ///< in the chart, with its unit
  std::vector<AxisValue> values;
  std::size_t leader = 0;   ///< the axis that it varies together with, itself if it varies alone
  bool sampled = false;     ///< its values are random
  bool replicates = false;  ///< its values are meshes of practically one size
  /// Axes of two values, the product of whose signs is this one's: it is not free. Empty: it is.
  std::vector<std::size_t> product;

  /// Whether its values have places on a line; words stand beside each other in their order.
  bool is_of_numbers() const;
  /// Index of the value with this text; nothing if there is none.
  std::optional<std::size_t> find(const std::string& text) const;
};

struct StudyQuantity {
  std::string name;   ///< column; later quantities may use it
  std::string label;  ///< in the chart
  std::string unit = "-";
  std::string table;                 ///< "file.csv" or "file.csv:key" in the run's folder; may be empty
  std::string where;                 ///< expression: rows of the table that count
  std::string quantity;              ///< expression
  std::optional<std::string> exact;  ///< expression that the error refers to
  /// Axis -> index of the value at which the reference run stands, the other axes being equal.
  std::map<std::size_t, std::size_t> reference;

  std::string scale;            ///< expression that a deviation is divided by; empty: the reference's magnitude
  Place place;                  ///< of `quantity` in the study file
  std::optional<double> limit;  ///< a run with a larger error has diverged, whatever its coupling thought

  bool has_error() const { return exact || !reference.empty(); }
  std::string error_name() const { return name + "_error"; }
};

/// Rows of panels, one a quantity; columns of panels, one a value of `panels`; in each a curve a value of
/// `series`, or dots of its colour over an axis of words. Axes by index.
struct StudyChart {
  std::size_t x = 0;
  std::optional<std::size_t> series, panels;
  std::vector<std::string> y;  ///< columns of study.csv
  bool log_x = true, log_y = true;
};

/// Random values for the axes that have a distribution.
struct Samples {
  Plan plan = Plan::latin_hypercube;
  int number = 0, seed = 1;
};

/// A question about each run: is the quantity above, or below, the value?
struct StudyLimit {
  std::string name;      ///< its column is limit.NAME
  std::string quantity;  ///< expression of what quantities may use but tables
  bool above = true;
  double value = 0;
  Place place;  ///< of `quantity` in the study file
};

/// No more runs are begun once this band is narrow enough.
struct StudyStop {
  std::string of;    ///< a quantity, for the mean of all runs, or a limit, for its probability
  double width = 0;  ///< of the band, in the quantity's unit
  int least = 10;    ///< runs with an answer before it is asked
};

/// In the plane of two axes of numbers, where a limit is passed: the next run is made where that is least known.
struct StudyEnvelope {
  std::string limit;  ///< of the study
  std::size_t x = 0, y = 0;
  int runs = 0;         ///< no more than these are made
  double level = 0.5;   ///< the line is where the probability of a yes is this
  double doubt = 0.05;  ///< of each cell's side of the line; with less no more runs are begun
};

/// A key of the scene that follows from axes and constants.
struct DerivedKey {
  std::string key, value;  ///< value: an expression
  Place place;
};

struct Study {
  std::filesystem::path file, scene;
  std::string title;
  std::vector<std::string> set;  ///< for all runs
  std::optional<double> budget;  ///< wall seconds after which a run has stalled
  std::optional<double> until;   ///< simulated time at which every run stops [s]
  Place until_place;
  bool large = false;              ///< runs may take whatever memory they need
  bool reports = true;             ///< each run draws a page of its own
  std::optional<int> threads = 1;  ///< of each run; nothing: what a run takes by itself
  std::optional<Samples> samples;
  std::vector<Axis> axes;
  std::vector<StudyQuantity> quantities;
  std::vector<StudyLimit> limits;                ///< beside those of the scene
  std::vector<std::vector<std::size_t>> groups;  ///< axes: statistics of each combination of their values
  std::vector<DerivedKey> derived;
  std::optional<StudyEnvelope> envelope;
  std::optional<StudyStop> stop;
  std::map<std::string, double> constants;
  std::optional<StudyChart> chart;
};

/// One combination. The last axis varies fastest.
struct StudyRun {
  std::string name;                ///< of its folder
  std::vector<std::size_t> value;  ///< of each axis, by index
  std::vector<std::string> set;    ///< all --set arguments; those of derived keys are the last
  std::string resolved;            ///< the scene with all values in force
  double stop = 0;                 ///< simulated time at which it is finished [s]
};

/// Throws SceneError with what is wrong with the study file itself.
Study read_study(const std::filesystem::path& file);
/// The same, collecting; what could not be read is left out.
Study read_study(const std::filesystem::path& file, Problems& problems);

/// What the reader of studies asks for.
void sketch_study(Sketch& sketch);

/// Of a study: each is a folder, and a scene that is read before any of them is made.
inline constexpr int most_runs = 10'000;

/// Names and --set arguments of all combinations, without reading a scene. Throws SceneError if they are too many.
std::vector<StudyRun> expand(const Study& study);

/// Reads the scene of each run into `resolved`. Throws SceneError; what a value of an axis did wrong is told
/// at its place in the study file.
void resolve(const Study& study, std::vector<StudyRun>& runs);

/// The names in quantities that no run of this scene will have: entries of summary.json, columns, bodies.
void check_quantities(const Study& study, const Scene& scene, Problems& problems);

struct StudyPlan {
  Study study;
  std::vector<StudyRun> runs;  ///< resolved
};
/// Throws SceneError with all mistakes at once: those of the file, of its values in the scene, and of its quantities.
StudyPlan plan_study(const std::filesystem::path& file);

/// Index of the run that serves as reference for `quantity` at `run`.
std::size_t reference_run(const Study& study, const StudyQuantity& quantity, const StudyRun& run);

}  // namespace splashdown::apps
