// Decides at each accepted step what is due and writes it: csv rows, frames, running statistics.
//
// record() is called between attempt and commit, when everything at t_n is known. Intervals are met by the
// first step at or after each multiple of the interval; the step size is never changed for output.
// Statistics (peaks, impulses) see every step, whatever the intervals are.
//
// save() flushes the files to disk and stores their lengths; load() cuts them back to these lengths, so that
// a run which was killed at any moment continues to the same bytes as one that never stopped.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "apps/record/passes.hpp"
#include "apps/record/settings.hpp"
#include "apps/statistics/summary.hpp"
#include "core/bodies_view.hpp"
#include "core/fluid_view.hpp"
#include "core/solids_view.hpp"

namespace splashdown::apps {

/// A scene's state at t_n. Vectors have one entry a body, in the order of `bodies`.
template <int d>
struct RecordInput {
  const FluidView<d>* fluid = nullptr;        ///< null: a scene without liquid
  const BodiesView<d>* bodies = nullptr;      ///< null: a scene without bodies
  const SolidsView<d>* solids = nullptr;      ///< those of them that deform; null: all are rigid
  std::vector<Twist<d>> body_velocity_n;      ///< mean of the half-step velocities around t_n
  std::vector<Twist<d>> body_acceleration_n;  ///< their difference over the kick
  std::vector<WallLoad<d>> body_load;         ///< about the centre of mass; zero where dry
  double time = 0;                            ///< t_n [s]
  double dt = 0;                              ///< of the step that starts at t_n [s]
  int passes = 0;                             ///< coupling passes of this step
  double residual = 0;                        ///< of the coupling, relative [-]
  std::vector<double> pass_residuals = {};    ///< the same after each pass [-]
  double wall_seconds = 0;                    ///< spent since the start of the run
  bool last = false;                          ///< rows and a frame are due whatever the intervals say
};

template <int d>
class Recorder {
 public:
  /// Writes nothing yet. The first record() of a run that was not load()ed clears what an earlier run left.
  explicit Recorder(RecorderSettings<d> settings);
  ~Recorder();

  void record(const RecordInput<d>& input);
  /// An attempt at the step that record() is called for next, if any is accepted.
  void refused(RefusedAttempt attempt);
  /// A picture of the state besides the frames: snapshots/NAME.vtu and NAME_WALL.vtu.
  void snapshot(const std::string& name, const RecordInput<d>& input);
  /// Writes what is held back (the snapshot of the peak load) and flushes everything to disk.
  void finish();

  /// Fills `dimension`, `nodes`, `elements`, passes, `ledger`, `bodies`, `equipment`; leaves the rest alone.
  void summarise(Summary& summary) const;

  /// That it has statistics of.
  std::size_t bodies() const;

  /// Throws FilesLost if a table that is being written has been removed or replaced.
  void check_files() const;
  bool files_in_place() const;
  /// The tables as they are, wherever their files went. A picture that is held back is given up.
  void copy_tables(const std::filesystem::path& folder);

  void save(std::ostream& out);
  /// Throws std::runtime_error, and changes no file, for what is not of these records.
  void load(const std::string& bytes);

 private:
  struct State;
  std::unique_ptr<State> s_;
};

extern template class Recorder<2>;
extern template class Recorder<3>;

}  // namespace splashdown::apps
