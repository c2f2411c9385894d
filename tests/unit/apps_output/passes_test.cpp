// Residuals of passes: which rows there are, and what the report makes of them.
#include "apps/report/curves/passes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "recorded_runs.hpp"

namespace splashdown::apps::passes_test {
namespace {

RecorderSettings<2> with_passes(const std::filesystem::path& directory, double every) {
  RecorderSettings<2> settings;
  settings.directory = directory;
  settings.passes = PassesRecord{every, {}};
  return settings;
}

Table rows_in(const ScratchFolder& folder) { return read_csv(folder.path() / "passes.csv").at(0).second; }

TEST(Passes, refused_attempts_stand_before_the_step_that_follows_them) {
  ScratchFolder folder;
  Recorder<2> recorder(with_passes(folder.path(), 0));
  record_steps(recorder, 0, 1, false);
  recorder.refused({2 * dt, 2 * dt, {1e-2, 1e-1}});
  record_steps(recorder, 2, 2, false);
  recorder.refused({3 * dt, dt, {0.5}});
  recorder.finish();
  const auto rows = rows_in(folder);
  EXPECT_EQ(rows["step"], (std::vector<double>{0, 1, 2, 2, 2, 3}));
  EXPECT_EQ(rows["accepted"], (std::vector<double>{1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(rows["pass"], (std::vector<double>{1, 1, 1, 2, 1, 1}));
  EXPECT_EQ(rows["residual"], (std::vector<double>{1e-9, 1e-9, 1e-2, 1e-1, 1e-9, 0.5}));
}

// The attempts that end a run are made again when it is continued.
TEST(Passes, of_a_run_that_is_continued_are_there_once) {
  ScratchFolder folder;
  std::stringstream checkpoint;
  {
    Recorder<2> recorder(with_passes(folder.path(), 0));
    record_steps(recorder, 0, 4, false);
    recorder.refused({5 * dt, dt, {0.5, 0.7}});
    recorder.save(checkpoint);
    recorder.finish();
    EXPECT_EQ(rows_in(folder).rows(), 7u);
  }
  Recorder<2> recorder(with_passes(folder.path(), 0));
  recorder.load(checkpoint.str());
  recorder.refused({5 * dt, dt, {0.5, 0.7}});
  record_steps(recorder, 5, 5, false);
  recorder.finish();
  EXPECT_EQ(rows_in(folder).rows(), 8u);
}

TEST(Passes, follow_their_interval_and_are_absent_unless_asked_for) {
  ScratchFolder folder, without;
  Recorder<2> few(with_passes(folder.path(), 0.01)), none(RecorderSettings<2>{.directory = without.path(),
                                                                              .frames = {},
                                                                              .pressure_probes = {},
                                                                              .gauges = {},
                                                                              .signals = {},
                                                                              .equipment = {},
                                                                              .patches = {},
                                                                              .hull_maps = {},
                                                                              .surface_pressure = {},
                                                                              .added_mass = {},
                                                                              .passes = {},
                                                                              .sections = {},
                                                                              .velocity_lines = {},
                                                                              .centre_of_mass = {},
                                                                              .symmetric = {},
                                                                              .still_water_level = {}});
  few.refused({0, dt, {0.1}});
  record_steps(few, 0, 5, false);
  few.refused({6 * dt, dt, {0.1}});  // of a step that no row is due for
  record_steps(few, 6, steps, true);
  none.refused({0, dt, {0.1}});
  record_steps(none, 0, steps, true);
  EXPECT_EQ(rows_in(folder).rows(), 5u);
  EXPECT_FALSE(std::filesystem::exists(without.path() / "passes.csv"));
}

TEST(Passes, are_drawn_as_the_median_the_longest_and_what_was_refused) {
  Table passes{{"step", "time", "dt", "accepted", "pass", "residual"}, std::vector<std::vector<double>>(6)};
  const auto add = [&](double step, bool accepted, const std::vector<double>& residuals) {
    for (std::size_t k = 0; k < residuals.size(); ++k)
      for (std::size_t c = 0;
           const double value : {step, 0.1 * step, 0.1, accepted ? 1. : 0., static_cast<double>(k + 1), residuals[k]})
        passes.columns[c++].push_back(value);
  };
  add(0, true, {1e-3, 1e-9});
  add(1, true, {1e-2, 1e-4, 1e-6, 1e-8});
  add(2, false, {1e-1, 1});
  add(2, true, {1e-1, 1e-5, 1e-9});
  const auto figures = pass_figures(passes, 1);
  ASSERT_EQ(figures.size(), 2u);
  ASSERT_EQ(figures[0].curves.size(), 3u);
  EXPECT_TRUE(figures[0].log_y);
  EXPECT_EQ(figures[0].curves[0].y, (std::vector<double>{1e-1, 1e-5, 1e-9})) << "three passes are the median";
  EXPECT_EQ(figures[0].curves[1].y.size(), 4u);
  EXPECT_EQ(figures[0].curves[2].y, (std::vector<double>{1e-1, 1}));
  EXPECT_EQ(figures[0].between[0].low, (std::vector<double>{1e-3, 1e-9, 1e-9, 1e-8}));
  EXPECT_EQ(figures[0].between[0].high, (std::vector<double>{1e-1, 1e-4, 1e-6, 1e-8}));
  const auto range = axis_range(figures[0], false);
  EXPECT_DOUBLE_EQ(range.low, 1e-9);
  EXPECT_DOUBLE_EQ(range.high, 1);
  ASSERT_EQ(figures[1].curves[0].y.size(), 3u);
  EXPECT_NEAR(figures[1].curves[0].y[1], 1e-2, 1e-14);  // three passes take six digits off
}

TEST(Passes, of_steps_of_one_pass_are_no_picture) {
  const Table passes{{"step", "time", "dt", "accepted", "pass", "residual"}, {{0}, {0}, {1}, {1}, {1}, {1e-9}}};
  EXPECT_TRUE(pass_figures(passes, 1).empty());
  EXPECT_TRUE(pass_figures({}, 1).empty());
}

}  // namespace
}  // namespace splashdown::apps::passes_test
