// Runs of the stand-ins as recorders see them: whole, or killed and resumed.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "stand_ins.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps {

inline constexpr int steps = 60;
inline constexpr double dt = drop_end / steps;

/// `last`: the run ends with the last of these steps.
template <int d>
void record_steps(Recorder<d>& recorder, int from, int to, bool last) {
  std::conditional_t<d == 2, StandInDrop, StandInPress> stand_in;
  for (int n = from; n <= to; ++n) {
    RecordInput<d> input = stand_in.at(n * dt, dt);
    input.last = last && n == to;
    recorder.record(input);
    if (input.last) recorder.snapshot("end", input);
  }
}

template <int d>
std::string summary_of(const Recorder<d>& recorder) {
  Summary summary;
  summary.status = "done";
  summary.simulated_time = drop_end;
  summary.coupling = CouplingSummary{};
  recorder.summarise(summary);
  return to_json(summary);
}

/// A run killed seven steps after its checkpoint and resumed leaves the same bytes and the same statistics.
template <int d>
void expect_resumable(RecorderSettings<d> (*settings_in)(const std::filesystem::path&), int checkpoint_at,
                      const std::vector<std::string>& files) {
  ScratchFolder whole, broken;
  Recorder<d> undisturbed(settings_in(whole.path()));
  record_steps(undisturbed, 0, steps, true);
  undisturbed.finish();

  std::stringstream checkpoint;
  {
    Recorder<d> recorder(settings_in(broken.path()));
    record_steps(recorder, 0, checkpoint_at, false);
    recorder.save(checkpoint);
    record_steps(recorder, checkpoint_at + 1, checkpoint_at + 7, false);
  }
  std::ofstream(broken.path() / "bodies.csv", std::ios::app) << "0.1,wedge,0,0";  // a torn last row
  Recorder<d> recorder(settings_in(broken.path()));
  recorder.load(checkpoint.str());
  record_steps(recorder, checkpoint_at + 1, steps, true);
  recorder.finish();

  for (const auto& file : files) EXPECT_EQ(broken.text(file), whole.text(file)) << file;
  EXPECT_EQ(summary_of(recorder), summary_of(undisturbed));
}

}  // namespace splashdown::apps
