// Records of a fluid without nodes and mesh: pressure and velocity on a Cartesian grid that stays, a hull that moves through it, seen at
// samples along its outline.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/record/view.hpp"
#include "apps/report/data.hpp"
#include "apps/report/pictures/plane_picture.hpp"
#include "box_of_water.hpp"
#include "stand_ins.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::grid_fluid_test {
namespace {

constexpr int across = 16, down = 8, steps = 30;        // squares; steps of the record
constexpr double h = 0.125, end = 0.03, speed = 1;      // of a square [m], of the record [s], of the hull [m/s]
constexpr double half_length = 0.2, half_height = 0.1;  // of the hull [m]
constexpr double sample = 0.05;                         // between samples of the hull [m]
constexpr int hull_samples = static_cast<int>(4 * (half_length + half_height) / sample + 0.5);
constexpr double roundoff = 1e-12;  // of sums of a few dozen numbers

/// Weight of the water over what it is at rest.
double heaviness(double time) { return 1 + std::sin(std::numbers::pi * time / end); }
double pressure_of(const Vec<2>& x, double time) { return heaviness(time) * hydrostatic<2>(x); }

Surface<2> hull() {
  auto box = unit_box<2>();
  box.vertices.row(0) *= 2 * half_length;
  box.vertices.row(1) *= 2 * half_height;
  return box;
}

/// A grid over 2 m by 1 m with the water's level at its top. The hull is filled by the same fluid, as penalisation has it.
class GridFluid final : public FluidView<2> {
 public:
  explicit GridFluid(bool has_free_surface) {
    for (int j = 0; j <= down; ++j)
      for (int i = 0; i <= across; ++i) x_.emplace_back(i * h - 1, (j - down) * h);
    for (int j = 0; j < down; ++j)
      for (int i = 0; i < across; ++i) {
        cells_.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
        cells_.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    for (int i = 0; has_free_surface && i < across; ++i)
      boundary_.push_back({{corner(i + 1, down), corner(i, down)}, -1});
    grid_ = static_cast<int>(x_.size());
    for (int s = 0; s < hull_samples; ++s) boundary_.push_back({{grid_ + (s + 1) % hull_samples, grid_ + s}, 0});
    has_free_surface_ = has_free_surface;
    look_at(0);
    walls_ = {{"box", hull(), poses_[0]}};
  }

  void look_at(double time) {
    poses_[0] = Isometry<2>::Identity();
    poses_[0].translation().y() = -0.5 - speed * time;
    x_.resize(static_cast<std::size_t>(grid_));
    p_.clear();
    for (const auto& x : x_) p_.push_back(pressure_of(x, time));
    const auto outline = hull();
    for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
      const Vec<2> from = outline.vertices.col(outline.facets(0, f)), to = outline.vertices.col(outline.facets(1, f));
      const int pieces = static_cast<int>((to - from).norm() / sample + 0.5);
      for (int k = 0; k < pieces; ++k) x_.push_back(poses_[0] * Vec<2>(from + k * (to - from) / pieces));
    }
    for (auto s = p_.size(); s < x_.size(); ++s) p_.push_back(*pressure_at(x_[s]));
    ledger_.volume = ledger_.volume_initial = 2;
    ledger_.kinetic_energy = time;
    ledger_.work_on_walls = -time;  // all that the water has, hulls gave it
  }
  int grid_points() const { return grid_; }

  double density() const override { return 1000; }
  std::span<const WallSpec<2>> walls() const override { return walls_; }
  std::span<const Isometry<2>> wall_poses() const override { return poses_; }
  std::span<const WallLoad<2>> loads() const override { return {}; }
  std::span<const Vec<2>> points() const override { return x_; }
  std::span<const std::array<int, 3>> cells() const override { return cells_; }
  std::span<const Facet<2>> boundary() const override { return boundary_; }
  PointPlace place(std::size_t point) const override {
    if (static_cast<int>(point) >= grid_) return {.wall = 0};
    return {.on_free_surface = has_free_surface_ && static_cast<int>(point) >= corner(0, down)};
  }
  std::optional<double> drop_volume(std::size_t) const override { return std::nullopt; }
  std::span<const double> pressure() const override { return p_; }
  std::span<const double> repair_pressure() const override { return {}; }
  const Ledger& ledger() const override { return ledger_; }
  Vec<2> velocity_n(std::size_t point) const override { return {0.1 * x_[point].y(), 0}; }
  std::optional<double> pressure_at(const Vec<2>& point) const override {  // bilinear
    const double u = (point.x() + 1) / h, v = (point.y() + 1) / h;
    if (!(u >= 0 && v >= 0 && u <= across && v <= down)) return std::nullopt;
    const int i = std::min(static_cast<int>(u), across - 1), j = std::min(static_cast<int>(v), down - 1);
    const auto at = [&](int k, int l) { return p_[static_cast<std::size_t>(corner(i + k, j + l))]; };
    return (j + 1 - v) * ((i + 1 - u) * at(0, 0) + (u - i) * at(1, 0)) +
           (v - j) * ((i + 1 - u) * at(0, 1) + (u - i) * at(1, 1));
  }
  double potential(const Vec<2>& point) const override { return 9.81 * point.y(); }
  std::vector<Diagnostic> diagnostics() const override { return {{"circulation", 0.25}}; }
  Eigen::MatrixXd added_mass(std::span<const std::size_t>) const override { return Eigen::Matrix3d::Identity(); }

 private:
  static int corner(int i, int j) { return j * (across + 1) + i; }

  std::vector<WallSpec<2>> walls_;
  std::vector<Isometry<2>> poses_{Isometry<2>::Identity()};
  std::vector<Vec<2>> x_;  // corners of squares, then samples of the hull
  std::vector<double> p_;
  std::vector<std::array<int, 3>> cells_;
  std::vector<Facet<2>> boundary_;
  Ledger ledger_;
  int grid_ = 0;
  bool has_free_surface_ = false;
};

/// The fluid and its hull at the steps of a record.
class GridRun {
 public:
  explicit GridRun(bool has_free_surface = true) : fluid_(has_free_surface) {
    BodySpec<2> body;
    body.name = "box";
    body.surface = hull();
    body.mass = 50;
    bodies_.specs.push_back(body);
    bodies_.states.push_back({body.pose, body.velocity});
    input_.fluid = &fluid_;
    input_.bodies = &bodies_;
  }
  GridRun(const GridRun&) = delete;
  const GridFluid& fluid() const { return fluid_; }

  const RecordInput<2>& at(int step) {
    input_.time = step * end / steps;
    input_.dt = end / steps;
    fluid_.look_at(input_.time);
    bodies_.states[0].pose = fluid_.wall_poses()[0];
    input_.body_velocity_n = {Twist<2>(0, -speed, 0)};
    input_.body_acceleration_n = {Twist<2>::Zero()};
    WallLoad<2> load;
    load.physical(1) = heaviness(input_.time) * weight * 4 * half_length * half_height;
    load.wetted = 4 * (half_length + half_height);
    input_.body_load = {load};
    input_.passes = 1;
    input_.last = step == steps;
    return input_;
  }
  /// All steps; leaves what is written in the folder.
  Summary record(RecorderSettings<2> settings) {
    Recorder<2> recorder(std::move(settings));
    for (int n = 0; n <= steps; ++n) recorder.record(at(n));
    recorder.finish();
    Summary summary;
    recorder.summarise(summary);
    return summary;
  }

 private:
  GridFluid fluid_;
  DrawnBodies<2> bodies_;
  RecordInput<2> input_;
};

RecorderSettings<2> settings_in(const std::filesystem::path& directory) {
  RecorderSettings<2> settings;
  settings.directory = directory;
  settings.frames = 0.01;
  settings.pressure_probes = {{"deep", {0.3, -0.9}, ""}, {"bottom", {0.03, -half_height}, "box"}, {"air", {0, 1}, ""}};
  settings.gauges = {{"gauge", Eigen::Matrix<double, 1, 1>(0.4)}};
  const auto region = disc_region<2>({0, -half_height}, 0.1, {0, -1});
  settings.patches = {{"panel", "box", region, patch_area<2>(region, hull())}};
  settings.hull_maps = {{"box", hull(), Isometry<2>::Identity(), sample}};
  settings.surface_pressure = {{"box", {}, {end / 2}}};
  settings.added_mass = {{"box", end, {}}};
  return settings;
}

/// Height of the hull's bottom at the middle of the record, when the water is heaviest.
constexpr double lowest = -0.5 - speed * end / 2 - half_height;

TEST(GridFluid, frames_have_its_corners_its_triangles_and_samples_of_the_hull) {
  GridRun run;
  const auto frame = take_frame(run.at(3));
  const auto grid = static_cast<std::size_t>(run.fluid().grid_points());
  ASSERT_EQ(frame.x.size(), grid + hull_samples);
  EXPECT_EQ(frame.cells.size(), 2u * across * down);
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    const bool on_top = i < grid && frame.x[i].y() == 0;
    EXPECT_EQ(frame.kind[i], i >= grid ? NodeKind::wall : on_top ? NodeKind::free_surface : NodeKind::interior) << i;
    EXPECT_EQ(frame.wall[i], i >= grid ? 0 : -1) << i;
    EXPECT_EQ(frame.drop_diameter[i], 0) << i;
  }
  const auto& outline = frame.outlines.at(0);
  for (Eigen::Index v = 0; v < outline.surface.vertices.cols(); ++v) {
    const double p = pressure_of(outline.surface.vertices.col(v), 3 * end / steps);
    EXPECT_NEAR(outline.p[static_cast<std::size_t>(v)], p, roundoff * p);
  }
}

// What a reader of frames takes for drops are vertex cells: samples of a hull, in no cell either, are none.
TEST(GridFluid, pictures_show_the_grid_and_no_drops) {
  ScratchFolder folder;
  GridRun run;
  run.record(settings_in(folder.path()));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames/000003.vtu"));
  const auto picture = read_picture(folder.path() / "snapshots", "start");
  EXPECT_EQ(picture.nodes, static_cast<std::size_t>(run.fluid().grid_points() + hull_samples));
  EXPECT_EQ(picture.cells, 2u * across * down);
  EXPECT_TRUE(picture.drops.empty());
  EXPECT_EQ(picture.surface.size(), 2u * (across + down));
  EXPECT_EQ(picture.outlines.at(0).segments.size(), 4u);
}

TEST(GridFluid, probes_gauge_and_patch_read_its_linear_pressure_exactly) {
  ScratchFolder folder;
  GridRun run;
  run.record(settings_in(folder.path()));
  const auto probes = read_csv(folder.path() / "probes.csv", "probe");
  const auto of = [&](const std::string& name) -> const Table& {
    return std::ranges::find(probes, name, &NamedTables::value_type::first)->second;
  };
  const auto& times = of("deep")["time"];
  ASSERT_EQ(times.size(), steps + 1u);
  for (std::size_t n = 0; n < times.size(); ++n) {
    const double bottom = pressure_of({0, -0.5 - speed * times[n] - half_height}, times[n]);
    EXPECT_NEAR(of("deep")["value"][n], pressure_of({0.3, -0.9}, times[n]), 1e-9 * bottom);  // digits of the file
    EXPECT_NEAR(of("bottom")["value"][n], bottom, 1e-9 * bottom);
    EXPECT_NEAR(of("panel")["value"][n], bottom, 1e-9 * bottom);
    EXPECT_EQ(of("air")["value"][n], 0);
    EXPECT_EQ(of("gauge")["value"][n], 0);
  }
}

TEST(GridFluid, surface_pressure_has_a_row_for_each_sample_of_the_hull) {
  ScratchFolder folder;
  GridRun run;
  run.record(settings_in(folder.path()));
  const auto rows = read_csv(folder.path() / "surface_pressure.csv", "body").at(0).second;
  ASSERT_EQ(rows.rows(), static_cast<std::size_t>(hull_samples));
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    EXPECT_NEAR(rows["p"][i], pressure_of({rows["x"][i], rows["y"][i]}, end / 2), 1e-8 * weight);  // digits of the file
    if (i > 0) {
      EXPECT_NEAR(rows["s"][i] - rows["s"][i - 1], sample, 1e-9);
    }
    EXPECT_EQ(rows["p_repair"][i], 0);
  }
}

TEST(GridFluid, its_ledger_and_counts_are_told_as_they_are) {
  ScratchFolder folder;
  GridRun run;
  const auto summary = run.record(settings_in(folder.path()));
  const auto rows = read_csv(folder.path() / "fluid.csv").at(0).second;
  ASSERT_EQ(rows.rows(), steps + 1u);
  EXPECT_EQ(rows["nodes"].back(), run.fluid().grid_points() + hull_samples);
  EXPECT_EQ(rows["elements"].back(), 2 * across * down);
  EXPECT_NEAR(rows["kinetic_energy"].back(), end, 1e-9 * end);
  EXPECT_EQ(rows["circulation"].back(), 0.25);
  for (const char* column : {"volume_time_integration", "volume_remesh_created", "volume_spray", "energy_repair"})
    EXPECT_EQ(rows[column].back(), 0) << column;
  ASSERT_TRUE(summary.ledger);
  EXPECT_EQ(summary.ledger->volume_initial, 2);
  EXPECT_EQ(summary.ledger->volume_final, 2);
  EXPECT_NEAR(summary.ledger->energy_gain, 0, roundoff);
  EXPECT_NEAR(summary.fluid->max_speed, 0.1, roundoff);
}

TEST(GridFluid, evidence_counts_samples_of_the_hull_as_its_facets) {
  ScratchFolder folder;
  GridRun run;
  const auto summary = run.record(settings_in(folder.path()));
  const double peak = pressure_of({0, lowest}, end / 2);
  const auto& panel = summary.patches.at("panel");
  EXPECT_NEAR(panel.pressure.value, peak, roundoff * peak);
  EXPECT_NEAR(panel.evidence.pressed, 0.1 / sample, roundoff);
  EXPECT_NEAR(panel.evidence.elements, hull_samples / 2., roundoff);
  EXPECT_NEAR(summary.probes.at("bottom").pressure.value, peak, roundoff * peak);
  const auto& highest = summary.bodies.at("box").maximum_pressure;
  ASSERT_TRUE(highest);
  EXPECT_NEAR(highest->peak.value, peak, roundoff * peak);
  EXPECT_NEAR(highest->point[1], -half_height, roundoff);
}

// In a stream without end nothing but gauges and the water's level ask for a free surface.
TEST(GridFluid, without_a_free_surface_gauges_read_nothing_and_the_rest_stays) {
  ScratchFolder folder;
  GridRun run(false);
  EXPECT_TRUE(std::isnan(water_level(run.fluid())));
  const auto summary = run.record(settings_in(folder.path()));
  const auto probes = read_csv(folder.path() / "probes.csv", "probe");
  for (const double level : std::ranges::find(probes, "gauge", &NamedTables::value_type::first)->second["value"])
    EXPECT_TRUE(std::isnan(level));
  const double peak = pressure_of({0, lowest}, end / 2);
  EXPECT_NEAR(summary.patches.at("panel").pressure.value, peak, roundoff * peak);
  EXPECT_EQ(summary.dry_records, (std::vector<std::string>{"probe air", "gauge gauge"}));
}

}  // namespace
}  // namespace splashdown::apps::grid_fluid_test
