#include "apps/record/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/record/tables/rows.hpp"
#include "apps/record/view.hpp"
#include "apps/report/data.hpp"
#include "apps/statistics/verdict/grades.hpp"
#include "recorded_runs.hpp"

namespace splashdown::apps::recorder_test {
namespace {

RecorderSettings<2> settings_in(const std::filesystem::path& directory) {
  RecorderSettings<2> settings;
  settings.directory = directory;
  settings.frames = 0.005;
  settings.pressure_probes = {{"keel", {0.02, -0.09}, "wedge"}, {"air", {0.0, 0.4}, ""}};
  settings.gauges = {{"gauge", Eigen::Matrix<double, 1, 1>(0.4)}, {"outside", Eigen::Matrix<double, 1, 1>(9)}};
  settings.equipment = {{"seat", "wedge", {0.1, 0}}};
  settings.surface_pressure = {{"wedge", {}, {0.01, 0.02}}};
  settings.added_mass = {{"wedge", 0.004, {}}};
  settings.passes.emplace();
  settings.sections = {{.name = "frames", .body = "wedge", .stations = {{0.1, {}}}, .every = 0.004, .times = {}}};
  const auto hull = StandInDrop::hull();
  const auto region = box_region<2>({-0.05, -1}, {0.05, 1});
  settings.patches = {{"bottom", "wedge", region, patch_area<2>(region, hull)}};
  settings.hull_maps = {{"wedge", hull, Isometry<2>::Identity(), 0.01}};
  settings.centre_of_mass = {{"wedge", {0, 2 * wedge_height / 3}}};
  return settings;
}

class ResumedAt : public testing::TestWithParam<int> {};

TEST_P(ResumedAt, leaves_what_an_undisturbed_run_leaves) {
  expect_resumable<2>(settings_in, GetParam(),
                      {"bodies.csv", "fluid.csv", "probes.csv", "surface_pressure.csv", "added_mass.csv", "passes.csv",
                       "section_loads.csv", "frames.pvd", "hull_wedge.vtu", "frames/000003.vtu", "snapshots/start.vtu",
                       "snapshots/peak.vtu"});
}

INSTANTIATE_TEST_SUITE_P(Steps, ResumedAt, testing::Values(0, 10, 29, 30, 31, 50));

TEST(Recorder, a_summary_can_be_given_right_after_a_resume) {
  ScratchFolder folder;
  std::stringstream checkpoint;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, 20, false);
  recorder.save(checkpoint);
  Recorder<2> resumed(settings_in(folder.path()));
  resumed.load(checkpoint.str());
  EXPECT_EQ(summary_of(resumed), summary_of(recorder));
}

TEST(Recorder, a_missing_file_stops_a_resume) {
  ScratchFolder folder;
  std::stringstream checkpoint;
  {
    Recorder<2> recorder(settings_in(folder.path()));
    record_steps(recorder, 0, 5, false);
    recorder.save(checkpoint);
  }
  std::filesystem::remove(folder.path() / "fluid.csv");
  Recorder<2> resumed(settings_in(folder.path()));
  EXPECT_THROW(resumed.load(checkpoint.str()), std::runtime_error);
}

TEST(Recorder, a_new_run_clears_what_an_earlier_one_left_and_nothing_else) {
  ScratchFolder folder;
  {
    Recorder<2> recorder(settings_in(folder.path()));
    record_steps(recorder, 0, steps, true);
    recorder.finish();
  }
  std::ofstream(folder.path() / "frames" / "mine.txt") << "notes";
  std::ofstream(folder.path() / "mine.csv") << "notes";
  RecorderSettings<2> bare;
  bare.directory = folder.path();
  Recorder<2> recorder(bare);
  record_steps(recorder, 0, 3, true);
  for (const char* gone :
       {"probes.csv", "surface_pressure.csv", "added_mass.csv", "frames.pvd", "frames/000000.vtu", "hull_wedge.vtu"})
    EXPECT_FALSE(std::filesystem::exists(folder.path() / gone)) << gone;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames" / "mine.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "mine.csv"));
}

TEST(Recorder, writes_nothing_before_its_first_step) {
  ScratchFolder folder;
  { Recorder<2> recorder(settings_in(folder.path() / "run")); }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "run"));
}

TEST(Recorder, rows_follow_the_interval_and_the_last_step_has_one) {
  ScratchFolder folder;
  auto settings = settings_in(folder.path());
  settings.interval = 0.004;
  Recorder<2> recorder(settings);
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto bodies = read_csv(folder.path() / "bodies.csv", "body");
  ASSERT_EQ(bodies.size(), 1u);
  const std::vector<double> expected{0, 0.004, 0.008, 0.012, 0.016, 0.02, 0.024, 0.028, 0.03};
  const auto& times = bodies[0].second["time"];
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-12);
}

// Loads are averages over the kick, so that their sum times the kick is the change of momentum.
TEST(Recorder, impulse_is_the_sum_over_kicks_whatever_the_interval) {
  ScratchFolder folder;
  auto settings = settings_in(folder.path());
  settings.interval = 1;
  Recorder<2> recorder(settings);
  record_steps(recorder, 0, steps, true);
  StandInDrop drop;
  double impulse = 0;
  for (int n = 0; n <= steps; ++n) impulse += drop.at(n * dt, dt).body_load[0].total()(1) * (n == 0 ? 0.5 * dt : dt);
  Summary summary;
  recorder.summarise(summary);
  EXPECT_NEAR(summary.bodies.at("wedge").impulse[1], impulse, 1e-12 * impulse);
}

// The level of the tank's water is at y = 0: what appears there counts nothing.
TEST(Recorder, energy_gain_is_the_balance_of_the_ledger_over_what_the_body_brought) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto rows = read_csv(folder.path() / "fluid.csv").at(0).second;
  for (std::size_t i = 0; i < rows.rows(); ++i)
    EXPECT_NEAR(rows["energy_gain"][i],
                rows["kinetic_energy"][i] - rows["kinetic_energy"][0] + rows["potential_energy"][i] -
                    rows["potential_energy"][0] + rows["work_on_walls"][i],
                1e-9);
  Summary summary;
  recorder.summarise(summary);
  EXPECT_EQ(summary.ledger->energy_gain, 0);
  StandInDrop drop;
  double brought = 0;  // at the last dry step
  for (int n = 0; n <= steps; ++n) {
    const auto& input = drop.at(n * dt, dt);
    const double v = input.body_velocity_n[0](1);
    brought = std::max(brought, 0.5 * 241 * v * v);
    if (input.body_load[0].wetted > 0) break;
  }
  EXPECT_NEAR(summary.ledger->energy_scale, brought, 1e-9);
  const auto& ledger = *summary.ledger;
  EXPECT_NEAR(*ledger.volume_error_bodies,
              (ledger.volume_final - ledger.volume_initial) / (wedge_half_breadth * wedge_height), 1e-12);
}

TEST(Recorder, probes_have_a_defined_answer_everywhere) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto probes = read_csv(folder.path() / "probes.csv", "probe");
  ASSERT_EQ(probes.size(), 7u);
  const auto named = [&](const std::string& name) -> const Table& {
    return std::ranges::find(probes, name, &NamedTables::value_type::first)->second;
  };
  EXPECT_GT(named("keel")["value"].back(), 0);
  EXPECT_EQ(named("air")["value"].back(), 0);
  EXPECT_TRUE(std::isfinite(named("gauge")["value"].back()));
  EXPECT_TRUE(std::isnan(named("outside")["value"].back()));
  EXPECT_EQ(named("seat.ay")["value"].size(), steps + 1u);
}

TEST(Recorder, surface_pressure_is_written_at_the_listed_times_only) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  EXPECT_TRUE(folder.text("surface_pressure.csv").starts_with("time,body,x,y,s,p,x_body,y_body,p_repair\n"));
  auto times = read_csv(folder.path() / "surface_pressure.csv", "body").at(0).second["time"];
  times.erase(std::unique(times.begin(), times.end()), times.end());
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 0.01, 1e-12);
  EXPECT_NEAR(times[1], 0.02, 1e-12);
}

// A wall's point in the frame of its shape, whose origin is the keel, is where the world's point is behind the pose.
TEST(Recorder, frames_have_sizes_of_drops_and_motion_and_pressure_of_hulls) {
  StandInDrop drop;
  const auto& input = drop.at(0.5 * drop_end, dt);
  const auto frame = take_frame(input);
  ASSERT_EQ(frame.drop_diameter.size(), frame.x.size());
  for (std::size_t i = 0; i < frame.x.size(); ++i)
    EXPECT_NEAR(frame.drop_diameter[i], frame.kind[i] == NodeKind::drop ? 0.01 : 0, 1e-15);
  const auto& hull = frame.outlines[0];
  ASSERT_EQ(static_cast<Eigen::Index>(hull.v.size()), hull.surface.vertices.cols());
  for (const auto& v : hull.v) EXPECT_EQ(v, (Vec<2>(input.body_velocity_n[0].head<2>())));
  EXPECT_GT(*std::ranges::max_element(hull.p), 0) << "the keel is wet";
  EXPECT_EQ(*std::ranges::min_element(hull.p), 0) << "the top is dry";
}

TEST(Recorder, surface_pressure_has_its_points_in_the_frame_of_the_shape) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto table = read_csv(folder.path() / "surface_pressure.csv", "body").at(0).second;
  StandInDrop drop;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double keel = drop.at(std::round(table["time"][i] / dt) * dt, dt).bodies->state(0).pose.translation().y() -
                        2 * wedge_height / 3;
    EXPECT_NEAR(table["x_body"][i], table["x"][i], 1e-15);
    EXPECT_NEAR(table["y_body"][i], table["y"][i] - keel, 1e-15);
  }
}

TEST(Recorder, the_peak_of_a_patch_is_the_largest_of_its_rows_when_every_step_has_one) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto probes = read_csv(folder.path() / "probes.csv", "probe");
  const auto& rows = std::ranges::find(probes, "bottom", &NamedTables::value_type::first)->second;
  Summary summary;
  recorder.summarise(summary);
  const auto& patch = summary.patches.at("bottom");
  EXPECT_EQ(patch.pressure.value, std::ranges::max(rows["value"]));
  EXPECT_GT(patch.pressure.value, 0);
  const auto& highest = summary.bodies.at("wedge").maximum_pressure;
  ASSERT_TRUE(highest);
  EXPECT_GE(highest->peak.value, patch.pressure.value);
}

// Peaks of equipment are in g: a stiff point of a body that does not turn feels what the body feels.
TEST(Recorder, equipment_on_a_body_that_does_not_turn_has_the_bodys_pulse) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  Summary summary;
  recorder.summarise(summary);
  const auto& seat = summary.equipment.at("seat");
  const auto& body = summary.bodies.at("wedge").acceleration;
  EXPECT_EQ(seat.raw.value, body.raw.value);
  EXPECT_EQ(seat.cfc.at(60).value, body.cfc.at(60).value);
  EXPECT_EQ(seat.cfc.at(60).change, body.cfc.at(60).change);
}

// An instrument there is as well resolved as the body itself.
TEST(Recorder, equipment_on_a_body_that_does_not_turn_has_the_bodys_band) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  Summary summary;
  recorder.summarise(summary);
  grade_numbers(summary);
  const auto& seat = summary.equipment.at("seat").grades;
  const auto& body = summary.bodies.at("wedge").acceleration_grades;
  ASSERT_TRUE(body.raw);
  ASSERT_TRUE(seat.raw);
  EXPECT_EQ(seat.raw->band, body.raw->band);
  EXPECT_EQ(seat.raw->grade, body.raw->grade);
  ASSERT_EQ(seat.cfc.size(), body.cfc.size());
  for (const auto& [cfc, grade] : body.cfc) EXPECT_EQ(seat.cfc.at(cfc).band, grade.band);
}

TEST(Recorder, the_peak_of_a_probe_is_that_of_all_steps_whatever_rows_are_written) {
  ScratchFolder every, seldom;
  auto settings = settings_in(seldom.path());
  settings.interval = 0.01;
  Recorder<2> all(settings_in(every.path())), few(settings);
  record_steps(all, 0, steps, true);
  record_steps(few, 0, steps, true);
  const auto probes = read_csv(every.path() / "probes.csv", "probe");
  const auto& rows = std::ranges::find(probes, "keel", &NamedTables::value_type::first)->second;
  for (const auto* recorder : {&all, &few}) {
    Summary summary;
    recorder->summarise(summary);
    EXPECT_EQ(summary.probes.at("keel").pressure.value, std::ranges::max(rows["value"]));
    EXPECT_EQ(summary.probes.at("keel").body, "wedge");
    EXPECT_EQ(summary.probes.at("air").pressure.value, 0);
  }
}

TEST(Recorder, added_mass_is_written_when_asked_for_and_only_then) {
  ScratchFolder folder, without;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  EXPECT_TRUE(folder.text("added_mass.csv").starts_with("time,body,m_xx,m_xy,m_xr,m_yy,m_yr,m_rr\n"));
  const auto times = read_csv(folder.path() / "added_mass.csv", "body").at(0).second["time"];
  const std::vector<double> expected{0, 0.004, 0.008, 0.012, 0.016, 0.02, 0.024, 0.028};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-12);
  auto bare = settings_in(without.path());
  bare.added_mass.clear();
  Recorder<2> quiet(bare);
  record_steps(quiet, 0, steps, true);
  EXPECT_FALSE(std::filesystem::exists(without.path() / "added_mass.csv"));
}

// A body's own matrix M, seen from the world by a body that has turned: G = T M T^T, T = diag(R, 1) or diag(R, R).
template <int d>
void turned_matrix_reads_as_its_own() {
  constexpr int m = freedoms<d>;
  ScratchFolder folder;
  CsvFile file(folder.path() / "m.csv", added_mass_header(d));
  file.create();
  const Eigen::Matrix<double, m, m> half = Eigen::Matrix<double, m, m>::Random(), own = half * half.transpose();
  Isometry<d> pose = Isometry<d>::Identity();
  if constexpr (d == 2)
    pose.rotate(0.65);
  else
    pose.rotate(Eigen::AngleAxisd(0.65, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translate(Vec<d>::Constant(7));  // about the centre of mass: no matter where that is
  Eigen::Matrix<double, m, m> turn = Eigen::Matrix<double, m, m>::Zero();
  turn.template topLeftCorner<d, d>() = pose.linear();
  if constexpr (d == 2)
    turn(2, 2) = 1;
  else
    turn.template bottomRightCorner<d, d>() = pose.linear();
  write_added_mass_row<d>(file, 0, "body", turn * own * turn.transpose(), pose);
  file.sync();
  const auto table = read_csv(folder.path() / "m.csv").at(0).second;
  ASSERT_EQ(table.columns.size(), 2u + m * (m + 1) / 2);
  for (int i = 0, column = 2; i < m; ++i)
    for (int j = i; j < m; ++j, ++column)
      EXPECT_NEAR(table.columns[static_cast<std::size_t>(column)][0], own(i, j), 1e-14 * own.norm()) << i << j;
}

TEST(AddedMassRow, is_in_the_axes_of_a_body_that_has_turned) {
  turned_matrix_reads_as_its_own<2>();
  turned_matrix_reads_as_its_own<3>();
}

TEST(Recorder, an_effect_that_is_present_has_its_column) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, 1, true);
  const std::string text = folder.text("fluid.csv");
  EXPECT_TRUE(text.substr(0, text.find('\n')).ends_with(",gravity_energy"));
}

TEST(Recorder, a_scene_without_liquid_leaves_no_fluid_files) {
  ScratchFolder folder;
  Recorder<2> recorder(settings_in(folder.path()));
  StandInDrop drop;
  RecordInput<2> input = drop.at(0, dt);
  input.fluid = nullptr;
  recorder.record(input);
  recorder.finish();
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "bodies.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "fluid.csv"));
  Summary summary;
  recorder.summarise(summary);
  EXPECT_FALSE(summary.ledger);
}

TEST(Recorder, a_record_of_an_unknown_body_is_an_error_that_names_it) {
  ScratchFolder folder;
  auto settings = settings_in(folder.path());
  settings.pressure_probes[0].body = "boat";
  Recorder<2> recorder(settings);
  StandInDrop drop;
  try {
    recorder.record(drop.at(0, dt));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("boat"), std::string::npos);
  }
}

}  // namespace
}  // namespace splashdown::apps::recorder_test
