// One run of a world: what the step loop calls, with the recorder, the checkpoints and the clock.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/record/recorder.hpp"
#include "apps/run/loop.hpp"
#include "apps/run/progress.hpp"
#include "apps/scene/scene.hpp"
#include "apps/simulation/checkpoint.hpp"
#include "apps/simulation/simulation_of.hpp"

namespace splashdown::apps {

struct RunPlan {
  std::filesystem::path directory;
  std::string resolved;          ///< the scene with all values in force
  double stop = 0;               ///< [s]
  std::optional<double> budget;  ///< wall seconds
  std::chrono::steady_clock::time_point started;
  double processor_started = 0;  ///< what the process had spent on processors by then
};

template <int d>
class Run final : private LoopHost {
 public:
  Run(const Scene& scene, World<d> world, RecorderSettings<d> settings, RunPlan plan, Progress& progress);

  /// Continues where a checkpoint was taken. Throws std::runtime_error for one that is not of this world; another may be
  /// tried then.
  void resume(const Checkpoint& from);
  /// Steps to the stop time, then finishes the recorder's files.
  LoopEnd go();

  /// Tables and state beside the folder that was lost, or among the temporary files: where; nothing if no disk takes them.
  /// Frames and pictures are not among them.
  std::optional<std::filesystem::path> rescue();

  double time() const { return simulation_.stepper().time(); }
  const LoopState& loop() const { return loop_; }
  Summary summary(const LoopEnd& end) const;
  /// Half-step velocities of the bodies at the end, one a body [m/s].
  std::vector<rigid::Twist<d>> velocities() const { return last_input_.body_velocity_n; }

 private:
  using Clock = std::chrono::steady_clock;

  double dt_bound() const override { return simulation_.dt_bound(); }
  void record(const StepMade& step) override;
  std::optional<Obstacle> obstacle() override { return simulation_.obstacle(); }
  void refused(double time, double dt, const coupling::StepReport& why) override;
  void released(double time, const std::string& cause) override;
  bool checkpoint_due() override;
  void checkpoint() override;
  Checkpoint present();
  std::optional<std::string> interruption() override;

  double wall_seconds() const;
  double own_processor_seconds() const;
  std::map<std::string, double> phases() const;

  const Scene& scene_;
  SimulationOf<d> simulation_;
  Recorder<d> recorder_;
  RunPlan plan_;
  Progress& progress_;
  LoopState loop_;
  RecordInput<d> last_input_;
  double wall_before_ = 0, processor_before_ = 0;  // spent by the runs that this one continues
  std::map<std::string, double> phases_before_, phases_at_start_;
  double setup_seconds_ = 0, output_seconds_ = 0;
  std::optional<Clock::time_point> last_checkpoint_;
  std::optional<double> refused_at_;  // time of the last refusal that was told
};

extern template class Run<2>;
extern template class Run<3>;

}  // namespace splashdown::apps
