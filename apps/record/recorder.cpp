#include "apps/record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/files/bounded_archive.hpp"
#include "apps/files/csv.hpp"
#include "apps/files/run_files.hpp"
#include "apps/record/frames/frames.hpp"
#include "apps/record/hulls.hpp"
#include "apps/record/points.hpp"
#include "apps/record/probes.hpp"
#include "apps/record/schedule.hpp"
#include "apps/record/sections/section_loads.hpp"
#include "apps/record/sections/velocity_lines.hpp"
#include "apps/record/tables/energy.hpp"
#include "apps/record/tables/evidence.hpp"
#include "apps/record/tables/rows.hpp"
#include "apps/record/view.hpp"
#include "apps/statistics/statistics.hpp"
#include "apps/statistics/stress_statistics.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {

namespace {

template <class Record>
Schedule schedule_of(const Record& record) {
  if (record.every) return Schedule(*record.every);
  auto times = record.times;
  std::ranges::sort(times);
  return Schedule(std::move(times));
}

}  // namespace

template <int d>
struct Recorder<d>::State {
  RecorderSettings<d> settings;
  std::map<std::string, CsvFile> files;  ///< by file name; opened when the first row is due
  bool started = false;
  double previous_dt = 0;
  double still_water_level = std::numeric_limits<double>::quiet_NaN();
  Schedule rows, frames_due;
  std::vector<Schedule> surface_due, added_mass_due;
  std::optional<PassRows> passes;
  std::vector<Schedule> sections_due, lines_due;
  std::vector<SectionExtremes> sections;
  FrameSeries frames;
  RunStatistics run;
  double max_speed_peak = 0;
  long remeshings = -1, remeshings_missed = -1;  ///< of the fluid's mesh; -1: not counted
  EnergyStatistics energy;
  std::vector<BodyStatistics<d>> bodies;
  std::vector<PulseStatistics> equipment;
  HullReadings<d> hulls;
  PointReadings points;
  std::map<std::string, StressStatistics> stresses;  // of bodies that deform
  std::vector<GoalSummary> goals;                    // once the run has ended
  double peak_force = 0;
  std::vector<char> met_water;  ///< probes, then gauges, at any row
  std::vector<std::string> body_names;
  Ledger ledger;
  double speed = 0;
  bool has_fluid = false;
  // Not part of the checkpoint.
  std::optional<Frame<d>> peak;  ///< state at the largest load, until it is written
  std::map<std::size_t, SurfaceRuler<d>> rulers;
  std::vector<HullExtent> extents;           ///< of the bodies, once known
  std::vector<double> submergence;           ///< of the bodies at this step [m]
  std::vector<Deformation<d>> deformations;  ///< at this step, of the bodies that deform

  explicit State(RecorderSettings<d> s)
      : settings(std::move(s)),
        rows(settings.interval),
        frames_due(settings.frames.value_or(0)),
        frames(settings.directory),
        equipment(settings.equipment.size()),
        hulls(settings),
        points(settings.pressure_probes.size()),
        met_water(settings.pressure_probes.size() + settings.gauges.size(), 0) {
    for (const auto& record : settings.surface_pressure) surface_due.push_back(schedule_of(record));
    for (const auto& record : settings.added_mass) added_mass_due.push_back(schedule_of(record));
    for (const auto& record : settings.sections) sections_due.push_back(schedule_of(record));
    for (const auto& record : settings.velocity_lines) lines_due.push_back(schedule_of(record));
    sections.resize(settings.sections.size());
    if (settings.passes) passes.emplace(schedule_of(*settings.passes));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(started, previous_dt, still_water_level, rows, frames_due, surface_due, added_mass_due, frames, run,
            max_speed_peak, remeshings, remeshings_missed, energy, bodies, equipment, hulls, points, peak_force,
            met_water, body_names, speed, has_fluid, sections_due, sections, lines_due, stresses, goals,
            cereal::binary_data(&ledger, sizeof ledger));
    if (passes) archive(*passes);
  }

  CsvFile& file(const std::string& name, const std::string& header) {
    const auto [place, is_new] = files.try_emplace(name, settings.directory / name, header);
    if (is_new) place->second.create();
    return place->second;
  }

  /// Whether what was loaded belongs to records like these.
  bool fits_settings() const {
    return lines_due.size() == settings.velocity_lines.size() && sections_due.size() == settings.sections.size() &&
           sections.size() == settings.sections.size() && body_names.size() == bodies.size() &&
           surface_due.size() == settings.surface_pressure.size() &&
           added_mass_due.size() == settings.added_mass.size() && equipment.size() == settings.equipment.size() &&
           met_water.size() == settings.pressure_probes.size() + settings.gauges.size() && hulls.fits_settings() &&
           points.fits(settings.pressure_probes.size());
  }

  void start(const RecordInput<d>& input);
  void add_statistics(const RecordInput<d>& input);
  void write_rows(const RecordInput<d>& input);
  void write_forces(const RecordInput<d>& input);
  void write_deformations(const RecordInput<d>& input);
  void write_probes(const RecordInput<d>& input);
  void write_surface_pressure(const RecordInput<d>& input, std::size_t record);
  void write_added_mass(const RecordInput<d>& input, const std::string& body);
  Vec<d> equipment_acceleration(const RecordInput<d>& input, std::size_t i) const;
  double probe_pressure(const RecordInput<d>& input, const PressureProbe<d>& probe) const;
  void write_peak();
  void count_meshes(const FluidView<d>& fluid);
};

template <int d>
void Recorder<d>::State::start(const RecordInput<d>& input) {
  std::filesystem::create_directories(settings.directory);
  clear_earlier_run(settings.directory);
  if (settings.still_water_level)
    still_water_level = *settings.still_water_level;
  else if (input.fluid)
    still_water_level = water_level(*input.fluid);
  if (input.bodies) bodies.resize(input.bodies->size());
  if (input.fluid) energy.begin(water_at_start(input));
  started = true;
}

template <int d>
Vec<d> Recorder<d>::State::equipment_acceleration(const RecordInput<d>& input, std::size_t i) const {
  const auto& point = settings.equipment[i];
  const std::size_t body = body_index(*input.bodies, point.body);
  const Vec<d> arm = input.bodies->state(body).pose.linear() * point.point;
  return rigid_acceleration<d>(arm, input.body_velocity_n[body], input.body_acceleration_n[body]);
}

template <int d>
void Recorder<d>::State::add_statistics(const RecordInput<d>& input) {
  const double before = run.steps == 0 ? 0 : 0.5 * previous_dt;
  const Kick kick{input.time, input.time - before, input.time + 0.5 * input.dt};
  run.add_step(input.passes);
  if (input.fluid) {
    run.add_mesh(input.fluid->points().size(), input.fluid->cells().size());
    ledger = input.fluid->ledger();
    speed = input.fluid->max_speed();
    max_speed_peak = std::max(max_speed_peak, speed);
    energy.add(input.time, ledger, body_energies(input));
  }
  has_fluid = input.fluid != nullptr;
  bool new_peak = false;
  body_names.clear();
  submergence.clear();
  deformations.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& spec = input.bodies->spec(b);
    const auto& pose = input.bodies->state(b).pose;
    if (extents.size() <= b) extents.push_back(extent_of<d>(spec.surface));
    submergence.push_back(still_water_level - (pose * spec.surface.vertices).row(d - 1).minCoeff());
    body_names.push_back(spec.name);
    bodies[b].add(kick, {input.body_velocity_n[b], input.body_acceleration_n[b], input.body_load[b], submergence[b],
                         pose.linear(), extents[b], spec.becomes_free(), spec.mass, wetted_facets(input, b),
                         symmetric_axes(settings, spec.name)});
    new_peak = new_peak || bodies[b].peak_force() > peak_force;
    peak_force = std::max(peak_force, bodies[b].peak_force());
  }
  if (input.solids)
    for (std::size_t b = 0; b < input.solids->size(); ++b)
      stresses[input.solids->spec(b).name].add(input.time, deformations.emplace_back(input.solids->deformation(b)));
  if (input.solids && !input.fluid) {
    std::size_t nodes = 0, cells = 0;
    for (const auto& deformation : deformations) nodes += deformation.nodes, cells += deformation.cells;
    run.add_mesh(nodes, cells);
  }
  for (std::size_t i = 0; i < equipment.size(); ++i) {
    const auto acceleration = equipment_acceleration(input, i);
    equipment[i].add(kick, {acceleration.data(), static_cast<std::size_t>(d)});
  }
  if (input.fluid) {
    hulls.read(*input.fluid, kick);
    std::vector<double> pressures;
    for (const auto& probe : settings.pressure_probes) pressures.push_back(probe_pressure(input, probe));
    points.read(kick, std::move(pressures));
  }
  if (new_peak) peak = take_frame(input);
  previous_dt = input.dt;
}

template <int d>
void Recorder<d>::State::write_rows(const RecordInput<d>& input) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    write_row(file("bodies.csv", bodies_header),
              BodyRow<d>{input.time, input.bodies->spec(b).name, input.bodies->state(b).pose, input.body_velocity_n[b],
                         input.body_acceleration_n[b], input.body_load[b], submergence[b]});
  if (input.bodies) write_forces(input);
  if (input.solids) write_deformations(input);
  if (input.fluid) {
    const auto& fluid = *input.fluid;
    std::vector<std::string> names;
    std::vector<double> values;
    for (const auto& [name, value] : fluid.diagnostics()) names.push_back(name), values.push_back(value);
    write_row(file("fluid.csv", fluid_header(names)),
              FluidRow{input.time, input.dt, fluid.points().size(), fluid.cells().size(), fluid.ledger(), input.passes,
                       input.residual, input.wall_seconds, speed, energy.gain(), std::move(values)});
  }
  write_probes(input);
}

template <int d>
void Recorder<d>::State::write_forces(const RecordInput<d>& input) {
  const std::vector<Diagnostic> forces = input.bodies->diagnostics();
  if (forces.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, value] : forces) names.push_back(name);
  auto& csv = file("forces.csv", forces_header(names));
  csv << input.time;
  for (const auto& [name, value] : forces) csv << value;
  csv.end_row();
}

template <int d>
void Recorder<d>::State::write_deformations(const RecordInput<d>& input) {
  for (std::size_t b = 0; b < input.solids->size(); ++b)
    write_row(file("elastic.csv", elastic_header),
              ElasticRow<d>{input.time, input.solids->spec(b).name, deformations[b]});
}

template <int d>
double Recorder<d>::State::probe_pressure(const RecordInput<d>& input, const PressureProbe<d>& probe) const {
  Vec<d> point = probe.point;
  if (!probe.body.empty()) point = input.bodies->state(body_index(*input.bodies, probe.body)).pose * point;
  const auto& fluid = *input.fluid;
  if (const auto p = fluid.pressure_at(point)) return *p;
  return wall_pressure<d>(fluid.points(), fluid.boundary(), fluid.pressure(), point).value_or(0);
}

template <int d>
void Recorder<d>::State::write_probes(const RecordInput<d>& input) {
  const auto put = [&](const std::string& name, double value) {
    auto& probes = file("probes.csv", probes_header);
    probes << input.time << name << value;
    probes.end_row();
  };
  if (input.fluid) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < settings.pressure_probes.size(); ++i) {
      const double pressure = points.pressures()[i];
      met_water[k++] |= pressure != 0;
      put(settings.pressure_probes[i].name, pressure);
    }
    for (const auto& gauge : settings.gauges) {
      const auto elevation = surface_elevation<d>(input.fluid->points(), input.fluid->boundary(), gauge.at);
      met_water[k++] |= elevation.has_value();
      put(gauge.name, elevation.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    for (const auto& [name, value] : settings.signals) put(name, value(input.time));
    for (std::size_t i = 0; i < settings.patches.size(); ++i) put(settings.patches[i].name, hulls.pressures()[i]);
  }
  if (input.solids)
    for (const auto& [name, value] : input.solids->signals()) put(name, value);
  for (std::size_t i = 0; i < equipment.size(); ++i) {
    const auto acceleration = equipment_acceleration(input, i);
    for (int k = 0; k < d; ++k) put(settings.equipment[i].name + ".a" + "xyz"[k], acceleration(k));
  }
}

template <int d>
void Recorder<d>::State::write_surface_pressure(const RecordInput<d>& input, std::size_t record) {
  const auto& name = settings.surface_pressure[record].wall;
  const int wall = wall_called(*input.fluid, name);
  const auto w = static_cast<std::size_t>(wall);
  const auto& spec = input.fluid->walls()[w];
  const auto at_rest = points_at_rest(*input.fluid, wall);
  // Body k is wall k; what deforms is a body.
  const Isometry<d> to_body = at_rest.empty() ? Isometry<d>::Identity() : input.bodies->spec(w).pose.inverse();
  const Vec<d> origin = centre_of_mass(settings, name);
  const auto& ruler = rulers.try_emplace(w, spec.surface, spec.pose).first->second;
  auto& csv = file("surface_pressure.csv", surface_pressure_header(d));
  for (const auto& point : surface_pressure<d>(wall_facets(*input.fluid, wall), input.fluid->pressure(),
                                               input.fluid->repair_pressure(), ruler, at_rest)) {
    const Vec<d> on_hull = (at_rest.empty() ? point.on_wall : Vec<d>(to_body * point.on_wall)) + origin;
    csv << input.time << name;
    for (int k = 0; k < d; ++k) csv << point.x(k);
    csv << point.s << point.p;
    for (int k = 0; k < d; ++k) csv << on_hull(k);
    csv << point.p_repair;
    csv.end_row();
  }
}

template <int d>
void Recorder<d>::State::write_added_mass(const RecordInput<d>& input, const std::string& body) {
  const std::size_t wall = body_index(*input.bodies, body);  // body k is wall k
  write_added_mass_row<d>(file("added_mass.csv", added_mass_header(d)), input.time, body,
                          input.fluid->added_mass({&wall, 1}), input.fluid->wall_poses()[wall]);
}

template <int d>
void Recorder<d>::State::write_peak() {
  if (!peak) return;
  write_pieces(settings.directory / "snapshots", "peak", *peak);
  peak.reset();
}

template <int d>
void Recorder<d>::State::count_meshes(const FluidView<d>& fluid) {
  for (const auto& [name, value] : fluid.diagnostics()) {
    if (name == "remeshings") remeshings = std::lround(value);
    if (name == "remeshings_missed") remeshings_missed = std::lround(value);
  }
}

template <int d>
Recorder<d>::Recorder(RecorderSettings<d> settings) : s_(std::make_unique<State>(std::move(settings))) {}

template <int d>
Recorder<d>::~Recorder() = default;

template <int d>
void Recorder<d>::record(const RecordInput<d>& input) {
  State& s = *s_;
  const bool first = !s.started;
  if (first) s.start(input);
  s.add_statistics(input);
  if (first) write_pieces(s.settings.directory / "snapshots", "start", take_frame(input));

  if (input.last) {
    s.goals.clear();
    const auto add = [&](const std::vector<GoalValue>& goals) {
      for (const auto& [name, value, error, unit] : goals) s.goals.push_back({name, value, error, unit});
    };
    if (input.fluid) add(input.fluid->goals());
    if (input.fluid) s.count_meshes(*input.fluid);
    if (input.solids) add(input.solids->goals());
  }
  // Each schedule is asked at each step, so that a last row does not shift the ones after a resume.
  if (s.rows.due(input.time) || input.last) s.write_rows(input);
  for (std::size_t r = 0; input.fluid && r < s.surface_due.size(); ++r)
    if (s.surface_due[r].due(input.time)) s.write_surface_pressure(input, r);
  for (std::size_t r = 0; input.fluid && r < s.added_mass_due.size(); ++r)
    if (s.added_mass_due[r].due(input.time)) s.write_added_mass(input, s.settings.added_mass[r].body);
  for (std::size_t r = 0; input.fluid && r < s.sections.size(); ++r) {
    const auto& record = s.settings.sections[r];
    const auto loads = section_loads<d>(record, input);
    s.sections[r].offer(input.time, loads);
    if (s.sections_due[r].due(input.time))
      write_rows(s.file("section_loads.csv", section_loads_header), input.time, record.name, loads);
  }
  for (std::size_t r = 0; input.fluid && r < s.lines_due.size(); ++r)
    if (s.lines_due[r].due(input.time))
      write_rows(s.file("velocity_lines.csv", velocity_lines_header), input.time, s.settings.velocity_lines[r],
                 *input.fluid);
  if (s.passes && s.passes->due(input.time))
    s.passes->accepted(s.file("passes.csv", passes_header), static_cast<std::size_t>(s.run.steps) - 1,
                       {input.time, input.dt, input.pass_residuals});
  if (s.settings.frames && (s.frames_due.due(input.time) || input.last)) try {
      s.frames.add(take_frame(input));
    } catch (const std::exception&) {
      if (files_in_place()) throw;  // else the next step says so, before anything of it is counted
    }
  for (auto& [name, file] : s.files) file.write();
}

template <int d>
void Recorder<d>::refused(RefusedAttempt attempt) {
  if (s_->passes) s_->passes->refused(std::move(attempt));
}

template <int d>
void Recorder<d>::snapshot(const std::string& name, const RecordInput<d>& input) {
  write_pieces(s_->settings.directory / "snapshots", file_name_of(name), take_frame(input));
}

template <int d>
std::size_t Recorder<d>::bodies() const {
  return s_->bodies.size();
}

template <int d>
void Recorder<d>::check_files() const {
  for (const auto& [name, file] : s_->files) file.check_in_place();
}

template <int d>
bool Recorder<d>::files_in_place() const {
  try {
    check_files();
    return true;
  } catch (const FilesLost&) {
    return false;
  }
}

template <int d>
void Recorder<d>::copy_tables(const std::filesystem::path& folder) {
  for (auto& [name, file] : s_->files) file.copy_to(folder / name);
  s_->peak.reset();  // there is no place for pictures
}

template <int d>
void Recorder<d>::finish() {
  s_->write_peak();
  if (s_->started) s_->hulls.write();
  if (s_->started && s_->passes && s_->passes->waits())
    s_->passes->given_up(s_->file("passes.csv", passes_header), static_cast<std::size_t>(s_->run.steps));
  for (auto& [name, file] : s_->files) file.sync();
}

/// Probes, gauges and patches that met no water.
template <int d>
void add_dry_records(const RecorderSettings<d>& settings, const std::vector<char>& met_water, Summary& summary) {
  std::size_t k = 0;
  const auto add = [&](const char* kind, const std::string& name, bool wet) {
    ++summary.wettable_records;
    if (!wet) summary.dry_records.push_back(fmt::format("{} {}", kind, name));
  };
  for (const auto& probe : settings.pressure_probes) add("probe", probe.name, met_water[k++] != 0);
  for (const auto& gauge : settings.gauges) add("gauge", gauge.name, met_water[k++] != 0);
  for (const auto& patch : settings.patches)
    add("patch", patch.name, summary.patches.at(patch.name).pressure.value > 0);
}

template <int d>
void Recorder<d>::summarise(Summary& summary) const {
  const State& s = *s_;
  summary.dimension = d;
  if (s.has_fluid || !s.stresses.empty()) {
    summary.nodes = s.run.nodes;
    summary.elements = s.run.elements;
  }
  summary.goals = s.goals;
  if (s.has_fluid) {
    s.energy.summarise(summary.ledger.emplace(summary_of(s.ledger)));
    summary.fluid = FluidSummary{s.speed, s.max_speed_peak, {}, {}};
    if (s.remeshings >= 0) summary.fluid->remeshings = s.remeshings;
    if (s.remeshings_missed >= 0) summary.fluid->remeshings_missed = s.remeshings_missed;
  }
  if (summary.coupling && s.run.steps > 0) {
    summary.coupling->passes_mean = static_cast<double>(s.run.passes_sum) / static_cast<double>(s.run.steps);
    summary.coupling->passes_max = s.run.passes_max;
  }
  for (std::size_t b = 0; b < s.body_names.size(); ++b) summary.bodies[s.body_names[b]] = s.bodies[b].summary();
  const auto statistics_of = [&](const std::string& body) -> const BodyStatistics<d>* {
    const auto found = std::ranges::find(s.body_names, body);
    return found == s.body_names.end() ? nullptr : &s.bodies[static_cast<std::size_t>(found - s.body_names.begin())];
  };
  for (std::size_t i = 0; i < s.equipment.size(); ++i) {
    const auto& point = s.settings.equipment[i];
    auto& equipment = summary.equipment[point.name] = {s.equipment[i].summary(standard_gravity), point.body, {}};
    if (const auto* body = statistics_of(point.body); body && body->moves_freely())
      equipment.grades = evidence_of(body->evidence(), equipment, s.equipment[i]);
  }
  for (std::size_t r = 0; r < s.sections.size(); ++r) {
    const auto& record = s.settings.sections[r];
    summary.sections[record.name] = {record.body, std::string(1, "xyz"[record.axis]), s.sections[r].shear(),
                                     s.sections[r].hogging(), s.sections[r].sagging()};
  }
  s.hulls.summarise(summary);
  if (s.has_fluid) add_dry_records(s.settings, s.met_water, summary);
  if (s.has_fluid)
    for (std::size_t i = 0; i < s.settings.pressure_probes.size(); ++i)
      summary.probes[s.settings.pressure_probes[i].name] = {
          s.points.peak(i), s.settings.pressure_probes[i].body, {}, {}};
  const auto steps_of = [&](const std::string& body) -> const EvidenceStatistics* {
    const auto* statistics = statistics_of(body);
    return statistics ? &statistics->evidence() : nullptr;
  };
  for (const auto& [name, stress] : s.stresses) {
    auto& told = summary.bodies[name].stress.emplace(stress.summary());
    const double solid = told.evidence.stress;
    if (const auto* steps = s.has_fluid ? steps_of(name) : nullptr) told.evidence = steps->at_pressure(told.peak.time);
    told.evidence.stress = solid;
  }
  add_pressure_evidence<d>(summary, s.settings, {s.hulls, s.points}, steps_of);
}

template <int d>
void Recorder<d>::save(std::ostream& out) {
  s_->write_peak();
  std::map<std::string, std::uint64_t> lengths;
  for (auto& [name, file] : s_->files) lengths[name] = file.sync();
  cereal::BinaryOutputArchive archive(out);
  archive(lengths, *s_);
}

template <int d>
void Recorder<d>::load(const std::string& bytes) {
  std::map<std::string, std::uint64_t> lengths;
  BoundedInputArchive archive(bytes);
  s_->files.clear();
  archive(lengths, *s_);
  if (!archive.rest().empty() || !s_->fits_settings())
    throw std::runtime_error("holds records of other bodies or points than the scene");
  // All of them before the first is cut back.
  for (const auto& [name, length] : lengths) {
    if (!is_table(name)) throw std::runtime_error("names a table that is none");
    const auto file = s_->settings.directory / name;
    const auto present = std::filesystem::is_regular_file(file) ? std::filesystem::file_size(file) : 0;
    if (present < length)
      throw std::runtime_error(fmt::format("needs {} bytes of {}, which has {}", length, file.string(), present));
  }
  for (const auto& [name, length] : lengths)
    s_->files.try_emplace(name, s_->settings.directory / name, "").first->second.reopen(length);
  if (s_->settings.frames) s_->frames.write_index();
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace splashdown::apps
