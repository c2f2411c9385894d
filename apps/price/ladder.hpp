// The runs of a price: one scene at several refinements, one after the other, each in a process of its own.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/price/quantities.hpp"
#include "apps/study/design/replicates.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

/// Runs within this share of a mesh's refinement are of its size.
inline constexpr double same_size = 0.035;

/// A tank that stands for open water is grown by this for one run: in the plane its influence falls to 4/9, in space to 8/27.
inline constexpr double tank_growth = 1.5;

enum class Role { rung, replicate, larger_tank };
/// "rung", "replicate", "larger tank"
std::string word_of(Role role);

struct RungSpec {
  double refine = 1;
  Role role = Role::rung;
};

struct Rung {
  RungSpec spec;
  std::string folder;  ///< name within that of the price
  double seconds = 0, steps = 0, node_steps = 0, memory_mb = 0;
  double setup_seconds = 0, output_seconds = 0;  ///< of these seconds
  std::vector<double> values;                    ///< of the quantities, in their order; nan: none
  std::vector<double> told = {};                 ///< errors that the run tells of them; nan, or empty: none
};

/// A run that is done.
Rung rung_in(const std::filesystem::path& folder, const RungSpec& spec, const std::vector<PriceQuantity>& quantities,
             std::vector<std::string>& notes);

/// A refinement with the digits that a run of it is given.
std::string digits_of(double refine);

/// 0.5, 0.71, 1, 1.41 ... times `scene`, three digits.
std::vector<double> rung_refines(int rungs, double scene);

/// The scene on that mesh; nothing: it does not allow it.
std::optional<Scene> scene_at(const std::filesystem::path& scene, std::vector<std::string> set, double refine);

/// Arguments of --set that give a scene this refinement, by the keys that refine its meshes.
std::vector<std::string> refined_by(const std::vector<std::string>& keys, double refine);
/// Those keys. Throws SceneError.
std::vector<std::string> refine_keys_of(const std::filesystem::path& scene, const std::vector<std::string>& set);

struct LadderOrder {
  std::filesystem::path scene, folder;
  std::vector<std::string> set;
  std::vector<std::string> refine_keys = {"fluid.size.refine"};
  std::vector<PriceQuantity> quantities;
  std::optional<int> threads;  ///< nothing: the program's choice
  std::optional<double> budget;
  bool large = false, quiet = false;
  int dimension = 2;
  std::vector<std::pair<double, double>> expected_nodes;  ///< by refine; empty: not known
  std::vector<std::string> larger_tank;  ///< --set arguments that grow the tank; empty: it is what it is
};

struct LadderEnd {
  bool interrupted = false;
  bool out_of_budget = false;
  std::vector<std::string> notes;  ///< runs that did not reach their end, each with its reason
};

class Ladder {
 public:
  /// Throws SceneError if the scene cannot be refined so.
  Ladder(LadderOrder order, const std::vector<RungSpec>& possible);

  /// Adds a run to those that are possible; false: the scene, or what is in its place, does not allow it.
  bool allow(const RungSpec& spec);

  const std::vector<Rung>& made() const { return made_; }
  const LadderEnd& end() const { return end_; }
  std::vector<StudyRun> runs() const { return runs_; }
  double seconds_left() const;

  /// Makes the run, or reads it if it is finished; false if the ladder has to end or its cost does not fit in the budget. It is
  /// stopped after `most` seconds, with a checkpoint, from which the next climb goes on.
  bool climb(const RungSpec& spec, double most = HUGE_VAL);
  /// Of its simulated time, what a run that was stopped has made.
  double part_made(const RungSpec& spec) const;
  /// Whether the run is finished already or is predicted to fit in the budget.
  bool affordable(const RungSpec& spec) const;
  std::optional<double> seconds_at(double refine) const;
  double spent() const;

 private:
  const StudyRun& run_of(const RungSpec& spec) const;
  bool make(const StudyRun& run, const RungSpec& spec, double most);
  std::optional<Rung> read(const StudyRun& run, const RungSpec& spec);
  void say(const std::string& text) const;

  LadderOrder order_;
  Study study_;
  std::vector<RungSpec> possible_;
  std::vector<StudyRun> runs_;
  std::vector<Rung> made_;
  LadderEnd end_;
  double started_ = 0;
};

/// The tank and the water in it grown sideways and downwards. Throws SceneError for a scene without a tank.
std::vector<std::string> larger_tank_of(const Scene& scene, const std::string& name);

/// Rungs from the coarsest on, and before the last one two replicates of the one before it, and that one in a larger tank, as
/// the budget allows. `replicates`: false where meshes tell their errors themselves.
void climb_all(Ladder& ladder, const std::vector<double>& refines, bool open_water, bool replicates = true);
/// All that `climb_all` may want.
std::vector<RungSpec> possible_rungs(const std::vector<double>& refines, bool open_water);

}  // namespace splashdown::apps
