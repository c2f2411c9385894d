// The subcommands of `splashdown`. Each returns the program's exit code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

namespace exit_code {
inline constexpr int done = 0;
inline constexpr int bad_input = 2;      ///< command line or scene; nothing was run or written
inline constexpr int cannot_go_on = 3;   ///< the last good state is saved
inline constexpr int interrupted = 130;  ///< by a signal or a spent budget; a checkpoint is saved
}  // namespace exit_code

struct RunOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> out;
  std::optional<double> until;
  std::optional<double> budget;
  std::optional<int> threads;
  std::optional<double> accuracy;              ///< wanted, in per cent: chooses fluid.size.refine
  std::optional<double> seconds;               ///< wanted: the same
  std::optional<std::filesystem::path> price;  ///< folder of the price list to choose by
  bool resume = false;
  bool large = false;      ///< whatever memory it takes
  bool restart = false;    ///< begin anew, although the folder holds a run of this scene
  bool no_report = false;  ///< none is drawn at the end
  bool force = false;      ///< and although it holds one of another scene
  bool quiet = false;
};

struct StudyOptions {
  std::filesystem::path study;
  std::optional<std::filesystem::path> out;
  int jobs = 1;              ///< runs at a time
  std::string on = "local";  ///< "local" or "slurm"
  bool large = false;        ///< whatever memory the runs take
  bool collect = false;      ///< tables and chart of what is there, no runs
  bool quiet = false;
};

/// Three meshes have a band and four an order; the eighth is 5.7 times finer than the scene.
inline constexpr int fewest_rungs = 3, usual_rungs = 4, most_rungs = 8;

struct PriceOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> quantities;  ///< NAME=EXPRESSION [from TABLE] [where CONDITION]
  int rungs = usual_rungs;
  std::optional<double> budget;    ///< wall seconds for all runs
  std::optional<double> accuracy;  ///< that a mesh of the list is to have, in per cent
  bool open_water = false;         ///< what its tank does to the scene belongs to the band
  std::optional<int> threads;
  bool large = false;  ///< whatever memory the runs take
  bool quiet = false;
};

int run_command(const RunOptions& options);
/// With `accuracy` or `seconds`: chooses the mesh, runs it, says what came of it.
int aimed_run_command(const RunOptions& options);
int check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides);
int study_command(const StudyOptions& options);
int price_command(const PriceOptions& options);
int report_command(const std::filesystem::path& directory);

/// Where the price of a scene stands unless --out says otherwise.
std::filesystem::path price_directory(const std::filesystem::path& scene);

/// What an exception says, in the words of this program: those of the file system name path, reason and cure.
std::string trouble(const std::exception& error);

/// `error: ` and the text on the standard error stream; returns exit_code::bad_input.
int bad_input(const std::string& text);

}  // namespace splashdown::apps
