// check.toml: the runs of an example and what has to come out of them. docs/validation.md describes it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::validation {

/// When a run is made: with every test run, or only with the nightly one.
enum class Label { ci, nightly };

struct RunSpec {
  std::string name;
  std::string scene = "scene.toml";
  std::vector<std::string> arguments;  ///< further ones of `splashdown run`: --set, --until ...
  int exit_code = 0;                   ///< the one that is right
  Label label = Label::ci;
};

/// What a measured number is held against. Without a bound it is reported only.
struct Bound {
  std::optional<std::string> expected;  ///< expression
  double tolerance = 0;                 ///< relative to |expected|, or absolute
  bool absolute = false;
  std::optional<double> at_most, at_least;

  bool judges() const { return expected || at_most || at_least; }
};

struct CheckSpec {
  std::string name;  ///< later quantities may use it
  std::string run;
  std::string table;      ///< "file.csv" or "file.csv:key" in the run's folder; may be empty
  std::string where;      ///< expression: rows of the table that count
  std::string reference;  ///< "file.csv" or "file.csv:key" in the example's folder, seen as ref.*
  std::string quantity;   ///< expression
  Bound bound;
  std::string unit;
  std::string why;
  Label label = Label::ci;  ///< nightly also if its run is
};

struct Example {
  std::filesystem::path folder;
  std::string title;
  std::map<std::string, double> constants;
  std::vector<RunSpec> runs;
  std::vector<CheckSpec> checks;

  const RunSpec& run(const std::string& name) const;
};

/// Reads `folder`/check.toml. Throws std::runtime_error that names file, line and key for whatever it does
/// not know: a misspelt tolerance must not pass for a missing one.
Example read_example(const std::filesystem::path& folder);

}  // namespace splashdown::validation
