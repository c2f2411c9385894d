// Recorder and report in three dimensions.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/record/view.hpp"
#include "apps/report/data.hpp"
#include "apps/report/pictures/plane_picture.hpp"
#include "apps/report/report.hpp"
#include "recorded_runs.hpp"

namespace splashdown::apps::spatial_recorder_test {
namespace {

RecorderSettings<3> settings_in(const std::filesystem::path& directory) {
  RecorderSettings<3> settings;
  settings.directory = directory;
  settings.frames = 0.01;
  settings.gauges = {{"gauge", {0.7, -0.8}}, {"covered", {0.1, 0.1}}};
  settings.equipment = {{"tip", "box", {0.5, 0, 0}}};
  const auto hull = StandInPress::hull();
  const auto region = disc_region<3>({0.1, 0.05, -press_half_height}, 0.2, {0, 0, -1});
  settings.patches = {{"panel", "box", region, patch_area<3>(region, hull)}};
  Isometry<3> pose = Isometry<3>::Identity();
  settings.hull_maps = {{"box", hull, pose, 0.125}};
  settings.surface_pressure = {{"box", {}, {0.015}}};
  settings.added_mass = {{"box", 0.01, {}}};
  settings.centre_of_mass = {{"box", {0, 0, press_half_height}}};
  return settings;
}

TEST(SpatialRecorder, reads_patch_map_gauge_and_point_as_they_are) {
  ScratchFolder folder;
  Recorder<3> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto summary = nlohmann::json::parse(summary_of(recorder));
  const double peak = press_at(drop_end / 2);  // a step is there; the bottom is level, at z = 0
  EXPECT_NEAR(summary["patches"]["panel"]["peak_pressure"]["value"], peak, 1e-12 * peak);
  EXPECT_NEAR(summary["patches"]["panel"]["peak_pressure"]["time"], drop_end / 2, 1e-15);
  EXPECT_NEAR(summary["bodies"]["box"]["maximum_pressure"]["value"], peak, 1e-12 * peak);
  EXPECT_NEAR(summary["bodies"]["box"]["maximum_pressure"]["point"][2], 0, 1e-15) << "the shape's frame begins below";
  EXPECT_NEAR(summary["bodies"]["box"]["attitude_deg"]["heading"]["end"], 0, 0);
  EXPECT_FALSE(summary["bodies"]["box"]["capsized"]);

  const auto probes = read_csv(folder.path() / "probes.csv", "probe");
  const auto values = [&](const std::string& name) {
    return std::ranges::find(probes, name, &NamedTables::value_type::first)->second["value"];
  };
  EXPECT_EQ(values("gauge").back(), 0);
  EXPECT_TRUE(std::isnan(values("covered").back())) << "a hull is above";
  for (const double a : values("tip.ax")) EXPECT_NEAR(a, -100 * 0.5, 1e-12);  // w^2 r
}

TEST(SpatialRecorder, files_have_the_columns_of_three_dimensions) {
  ScratchFolder folder;
  Recorder<3> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  const auto pressure = read_csv(folder.path() / "surface_pressure.csv", "body").at(0).second;
  ASSERT_EQ(pressure.names, (std::vector<std::string>{"time", "body", "x", "y", "z", "s", "p", "x_body", "y_body",
                                                      "z_body", "p_repair"}));
  EXPECT_EQ(pressure.rows(), 25u);  // 5 x 5 nodes under the box
  for (std::size_t i = 0; i < pressure.rows(); ++i) {
    EXPECT_NEAR(pressure["z_body"][i], pressure["z"][i], 1e-15);
    EXPECT_NEAR(pressure["p"][i], press_at(0.015), 1e-9);
  }
  EXPECT_EQ(read_csv(folder.path() / "added_mass.csv", "body").at(0).second.names.size(), 2u + 21u);
}

TEST(SpatialRecorder, a_resumed_run_leaves_what_an_undisturbed_one_leaves) {
  const int beyond_the_peak = steps / 2 + 1;
  expect_resumable<3>(settings_in, beyond_the_peak,
                      {"bodies.csv", "fluid.csv", "probes.csv", "surface_pressure.csv", "added_mass.csv", "frames.pvd",
                       "hull_box.vtu", "frames/000002.vtu", "snapshots/peak.vtu"});
}

TEST(SpatialReport, shows_curves_slices_and_the_hull) {
  ScratchFolder folder;
  Recorder<3> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, steps, true);
  recorder.finish();
  folder.write("summary.json", summary_of(recorder));
  const ReportResult result = write_report(folder.path());
  if (!result.warnings.empty() && result.warnings[0].find("not installed") != std::string::npos)
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(result.warnings.empty()) << result.warnings[0];
  for (const char* picture : {"field_0.svg", "body_box_fz.svg", "body_box_acceleration.svg", "body_box_wetted.svg",
                              "hull_box_below.svg", "hull_box_side.svg", "hull_box_ahead.svg", "surface_box.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "report" / picture)) << picture;
  EXPECT_NE(folder.text("report.html").find("box from below"), std::string::npos);
}

// A whole scene that is turned about the vertical has the same slice.
TEST(SpatialPicture, a_slice_follows_the_heading_of_the_body) {
  ScratchFolder folder;
  StandInPress press;
  Frame<3> frame = take_frame(press.at(0, dt));
  const Eigen::AngleAxisd turn(0.645, Eigen::Vector3d::UnitZ());
  for (auto& x : frame.x) x = turn * x;
  for (auto& outline : frame.outlines) {
    outline.surface.vertices = turn.toRotationMatrix() * outline.surface.vertices;
    outline.forward = turn * outline.forward;
  }
  write_pieces(folder.path(), "turned", frame);
  write_pieces(folder.path(), "straight", take_frame(press.at(0, dt)));
  const auto turned = read_picture(folder.path(), "turned"), straight = read_picture(folder.path(), "straight");
  const auto area = [](const PlanePicture& picture) {
    double sum = 0;
    for (const auto& [a, b] : picture.outlines.at(0).segments) sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    return std::abs(sum);
  };
  EXPECT_NEAR(area(turned), area(straight), 1e-12);
  EXPECT_NEAR(area(straight), 4 * press_half_length * press_half_height, 1e-12);
}

// The slice at y = 0 through a block of 2 m by 1 m: its outline has the block's length, its triangles its area.
TEST(SpatialPicture, a_slice_has_the_outline_of_the_water) {
  ScratchFolder folder;
  Recorder<3> recorder(settings_in(folder.path()));
  record_steps(recorder, 0, 1, true);
  recorder.finish();
  const auto picture = read_picture(folder.path() / "snapshots", "start");
  double length = 0;
  for (const auto& [a, b] : picture.surface) length += std::hypot(b[0] - a[0], b[1] - a[1]);
  EXPECT_NEAR(length, 2 * (2 + 1), 1e-12);
  ASSERT_EQ(picture.outlines.size(), 1u);
  double silhouette = 0;
  const auto& outline = picture.outlines[0].segments;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [a, b] = outline[i];
    silhouette += std::hypot(b[0] - a[0], b[1] - a[1]);
    EXPECT_EQ(b, outline[(i + 1) % outline.size()][0]) << "a closed loop";
  }
  EXPECT_NEAR(silhouette, 4 * (press_half_length + press_half_height), 1e-12);
}

}  // namespace
}  // namespace splashdown::apps::spatial_recorder_test
