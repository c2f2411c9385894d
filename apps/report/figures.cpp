#include "apps/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include "apps/record/frames/frames.hpp"
#include "apps/report/curves/acceleration.hpp"
#include "apps/report/curves/behind.hpp"
#include "apps/report/curves/filtered_curves.hpp"
#include "apps/report/curves/passes.hpp"
#include "apps/report/curves/section_figures.hpp"
#include "apps/report/curves/style.hpp"
#include "apps/report/words.hpp"
#include "apps/scene/channel_classes.hpp"
#include "apps/statistics/attitude.hpp"
#include "apps/statistics/summary.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/verdict.hpp"

namespace splashdown::apps {

namespace {

Values difference(const Values& a, const Values& b) {
  Values result(a);
  for (std::size_t i = 0; i < result.size() && i < b.size(); ++i) result[i] -= b[i];
  return result;
}

double first_of(const Values& values) { return values.empty() ? 0 : values.front(); }

/// Whether the body's acceleration has a peak in the class of its headline.
bool has_class(const RunData& run, const std::string& body) {
  const auto key = fmt::format("cfc{}", structures_class);
  return number_at(run.summary, {"bodies", body.c_str(), "peak_acceleration_g", key.c_str(), "value"}) > 0;
}

/// A table with fewer rows than steps does not show what the filter was given.
bool has_every_step(const RunData& run, const Table& rows) {
  return static_cast<double>(rows.rows()) >= number_at(run.summary, {"steps"});
}

struct BodyPlotter {
  const RunData& run;
  const Table& table;
  std::string body;
  std::string stem;
  int dimension;
  bool filters;  ///< headline numbers are filtered, and rows are steps
  Unit time;
  Values t;

  BodyPlotter(const RunData& of, const std::string& name, const Table& rows)
      : run(of),
        table(rows),
        body(name),
        stem("body_" + file_name_of(name)),
        dimension(of.dimension()),
        filters(has_class(of, name) && has_every_step(of, rows)),
        time(time_unit(of.end_time())),
        t(scaled(rows["time"], time.scale)) {}

  Figure empty(const std::string& kind, const std::string& y_label) const {
    Figure figure;
    figure.name = stem + "_" + kind;
    figure.x_label = "t / " + time.unit;
    figure.y_label = y_label;
    figure.over_time = true;
    return figure;
  }

  const nlohmann::ordered_json& json() const { return member(member(run.summary, "bodies"), body.c_str()); }
  char vertical() const { return dimension == 2 ? 'y' : 'z'; }

  /// Total, physical and repair part of one component.
  Figure load(char axis, const std::string& prefix, const std::string& base_unit, const std::string& what) const {
    const std::string column = prefix + axis;
    const Values &total = table[column], &repair = table[column + "_repair"];
    const Unit unit = si_unit(largest(total), base_unit);
    Figure figure = empty(column, what + " / (" + unit.unit + ")");
    const auto smooth = filters ? filtered_curves(table, {column}, structures_class) : std::nullopt;
    figure.curves = {{"total", t, scaled(total, unit.scale), smooth ? grey : ink, smooth ? 1.1 : 1.8},
                     {"physical", t, scaled(difference(total, repair), unit.scale), blue, 1.1},
                     {"repair", t, scaled(repair, unit.scale), red, 1.1}};
    if (smooth)
      figure.curves.push_back({fmt::format("CFC {}", structures_class), scaled(smooth->t, time.scale),
                               scaled(smooth->values[0], unit.scale), ink, 2.2});
    if (column == std::string("f") + vertical()) figure.between = theory_of(json(), time.scale, unit.scale);
    double impulse = 0, repair_impulse = 0, to_and_fro = 0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      const double dt = table["time"][i] - table["time"][i - 1];
      impulse += 0.5 * dt * (total[i] + total[i - 1]);
      to_and_fro += 0.5 * dt * (std::abs(total[i]) + std::abs(total[i - 1]));
      if (repair.size() == t.size()) repair_impulse += 0.5 * dt * (repair[i] + repair[i - 1]);
    }
    const auto share = share_of(repair_impulse, impulse, cancels_below * to_and_fro);
    const auto& marked = figure.curves[smooth ? figure.curves.size() - 1 : 0];
    const auto top =
        std::ranges::max_element(marked.y, {}, [](double v) { return std::isfinite(v) ? std::abs(v) : -1; });
    if (top != marked.y.end() && std::isfinite(*top)) {
      const double when = marked.x[static_cast<std::size_t>(top - marked.y.begin())];
      figure.marks = {
          {when, *top, fmt::format("{} {} at {} {}", digits(*top, 4), unit.unit, digits(when, 4), time.unit)}};
    }
    figure.caption = fmt::format(
        "{} of the water on the body, one value a recorded step{}: one component, while the peak load above is the "
        "resultant of all, at every step. The repair part is what re-meshing costs: {}.",
        what, smooth ? ", and filtered as the peaks above" : ", unfiltered",
        share ? "it makes up " + percent(*share) + " of the impulse"
              : std::string("of the little impulse that is left it is no meaningful share"));
    return figure;
  }

  /// Several components of one quantity.
  void add_components(std::vector<Figure>& figures, const std::string& kind, const std::string& y_label,
                      std::vector<Values> values, const std::vector<std::string>& labels,
                      const std::string& caption) const {
    Figure figure = empty(kind, y_label);
    for (const std::size_t k : present(values))
      figure.curves.push_back({labels[k], t, std::move(values[k]), series_colours[k], 1.6});
    if (figure.curves.empty()) return;
    figure.caption = caption;
    figures.push_back(std::move(figure));
  }

  /// Without jumps by whole turns [deg].
  Values angle(const std::string& name) const {
    Values values = table[name + "_deg"];
    for (std::size_t i = 1; i < values.size(); ++i) values[i] = continued(values[i], values[i - 1]);
    return values;
  }

  const Values& strongest_moment() const {
    const Values* strongest = &table["mz"];
    for (const char* column : {"mx", "my"})
      if (largest(table[column]) > largest(*strongest)) strongest = &table[column];
    return *strongest;
  }

  std::vector<Figure> figures() const {
    std::vector<Figure> figures;
    const std::string axes = dimension == 2 ? "xy" : "xyz";
    double top = 0;
    for (const char axis : axes) top = std::max(top, largest(table[std::string("f") + axis]));
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis)
      if (const double size = largest(table[std::string("f") + *axis]);
          size > 0.02 * top && size > 0)  // less is what symmetry leaves
        figures.push_back(load(*axis, "f", force_unit(dimension),
                               *axis == vertical() ? "Vertical load" : fmt::format("Load along {}", *axis)));
    std::vector<Values> v, x;
    std::vector<std::string> names_v, names_x, columns_a;
    for (const char axis : axes) {
      v.push_back(table[std::string("v") + axis]);
      x.push_back(scaled(table[std::string(1, axis)], 1, first_of(table[std::string(1, axis)])));
      names_v.push_back(std::string("v_") + axis);
      names_x.push_back(std::string(1, axis));
      columns_a.push_back(std::string("a") + axis);
    }
    add_components(figures, "velocity", "velocity / (m/s)", v, names_v, "Velocity of the centre of mass.");
    auto with_pulse = empty("acceleration", "");
    with_pulse.stretches = pulse_of_peaks(member(json(), "peak_acceleration_g"), time.scale);
    with_pulse.levels = levels_of(run.summary, body + ".peak_g");
    if (auto figure = acceleration_figure({table, columns_a, with_pulse, time.scale, filters, "the centre of mass"}))
      figures.push_back(std::move(*figure));
    add_components(figures, "displacement", "displacement / m", x, names_x,
                   "Displacement of the centre of mass since the start.");
    double turned = 0;
    std::vector<Values> angles;
    for (const char* name : attitude_names) {
      angles.push_back(angle(name));
      turned = std::max(turned, largest(scaled(angles.back(), 1, first_of(angles.back()))));
    }
    if (turned > 1e-6) {
      for (const char axis : dimension == 2 ? std::string("z") : axes)
        if (largest(table[std::string("m") + axis]) > 0.02 * largest(strongest_moment()))
          figures.push_back(load(axis, "m", moment_unit(dimension),
                                 dimension == 2 ? "Moment" : fmt::format("Moment about {}", axis)));
      add_components(figures, "attitude", "angle / deg", angles, {attitude_names.begin(), attitude_names.end()},
                     dimension == 2 ? "Pitch of the body, counter-clockwise positive."
                                    : "Attitude of the body: roll about its long axis, pitch nose up, heading "
                                      "counter-clockwise from above.");
    }
    add_components(figures, "wetted", dimension == 2 ? "wetted length / m" : "wetted area / m²", {table["wetted"]},
                   {"wetted"}, "Part of the body's surface that touches water.");
    add_components(figures, "submergence", "submergence / m", {table["submergence"]}, {"lowest point"},
                   "Depth of the hull's lowest point below the level of the water at the start; negative above it.");
    return figures;
  }
};

/// `empty`: with its axes alone.
Figure gain_figure(const RunData& run, const Values& t, const Figure& empty) {
  const double scale = number_at(run.summary, {"ledger", "energy_scale"});
  Figure relative = empty;
  relative.curves = {{"gain", t, scaled(run.fluid["energy_gain"], 100 / scale), ink, 1.8}};
  for (const auto& [limit, grade, colour] :
       {std::tuple{unphysical_above, Grade::unphysical, red}, {doubtful_above, Grade::doubtful, amber}})
    relative.curves.push_back({fmt::format("{:g} %: {}", 100 * limit, name_of(grade)),
                               {t.front(), t.back()},
                               {100 * limit, 100 * limit},
                               colour,
                               1.1});
  relative.caption = fmt::format(
      "The balance of the ledger over {}, the largest of what there was to give or to take. It falls by viscosity, "
      "impacts and breaking waves; what rises comes from nowhere, and nothing after it can be trusted above the red "
      "line.",
      digits_with_unit(scale, energy_unit(run.dimension())));
  return relative;
}

FigureGroup fluid_figures(const RunData& run) {
  FigureGroup group{"The numerics", {}};
  const Table& table = run.fluid;
  if (table.empty()) return group;
  const Unit time = time_unit(run.end_time());
  const Values t = scaled(table["time"], time.scale);
  const auto figure = [&](const std::string& name, const std::string& y_label) {
    Figure f;
    f.name = name;
    f.x_label = "t / " + time.unit;
    f.y_label = y_label;
    f.over_time = true;
    return f;
  };

  Figure volume = figure("volume", "change of volume / %");
  const double whole = first_of(table["volume"]) > 0 ? 100 / first_of(table["volume"]) : 0;
  Values change = scaled(table["volume"], whole, first_of(table["volume"]));
  const Values& spray = table["volume_spray"];
  for (std::size_t i = 0; i < change.size() && i < spray.size(); ++i) change[i] += spray[i] * whole;
  volume.curves = {{"total", t, change, ink, 1.8},
                   {"time steps", t, scaled(table["volume_time_integration"], whole), blue, 1.1},
                   {"created", t, scaled(table["volume_remesh_created"], whole), green, 1.1},
                   {"deleted", t, scaled(table["volume_remesh_deleted"], whole), red, 1.1},
                   {"returned", t, scaled(table["volume_returned"], whole), amber, 1.1}};
  volume.caption =
      "Where the mesh gains or loses water: by moving the nodes, or when the surface is recognised anew. What it lost "
      "comes back at its free surface. Drops count as water.";
  group.figures.push_back(std::move(volume));

  const Values kinetic = table["kinetic_energy"], potential = table["potential_energy"];
  const Values& work = table["work_on_walls"];
  Values balance(kinetic.size());
  for (std::size_t i = 0; i < balance.size(); ++i)
    balance[i] = kinetic[i] - kinetic[0] + potential[i] - potential[0] + (i < work.size() ? work[i] - work[0] : 0);
  const Unit energy = si_unit(std::max({largest(scaled(kinetic, 1, first_of(kinetic))),
                                        largest(scaled(potential, 1, first_of(potential))), largest(work)}),
                              energy_unit(run.dimension()));
  Figure ledger = figure("energy", "energy since the start / (" + energy.unit + ")");
  ledger.curves = {{"kinetic", t, scaled(kinetic, energy.scale, first_of(kinetic)), blue, 1.4},
                   {"potential", t, scaled(potential, energy.scale, first_of(potential)), green, 1.4},
                   {"work on walls", t, scaled(work, energy.scale), amber, 1.4},
                   {"repairs", t, scaled(table["energy_repair"], energy.scale), red, 1.1},
                   {"balance", t, scaled(balance, energy.scale), ink, 1.8}};
  ledger.caption =
      "The water's energy ledger. The balance, kinetic + potential + work done on walls, would stay at zero "
      "without numerical loss, viscosity and breaking waves.";
  group.figures.push_back(std::move(ledger));

  if (number_at(run.summary, {"ledger", "energy_scale"}) > 0 && !table["energy_gain"].empty())
    group.figures.push_back(gain_figure(run, t, figure("energy_gain", "energy gain / %")));

  Figure step = figure("step", "passes a step");
  step.counts = true;
  const Unit dt = si_unit(largest(table["dt"]), "s");
  const double dt_scale = largest(table["dt"]) < 1e-4 ? 1e6 : dt.scale;
  step.y2_label = "dt / " + (largest(table["dt"]) < 1e-4 ? std::string("µs") : dt.unit);
  step.curves = {{"passes", t, table["passes"], amber, 1.2, false, true},
                 {"dt", t, scaled(table["dt"], dt_scale), ink, 1.4, true}};
  step.caption = "Coupling passes of each step (left) and the step's size (right).";
  group.figures.push_back(std::move(step));

  Figure mesh = figure("mesh", "nodes, elements");
  mesh.zero_line = false;
  mesh.curves = {{"nodes", t, table["nodes"], ink, 1.6}, {"elements", t, table["elements"], blue, 1.6}};
  mesh.caption = "Size of the mesh: nodes come and go as the size field follows bodies and surface.";
  group.figures.push_back(std::move(mesh));
  return group;
}

FigureGroup surface_figures(const RunData& run) {
  FigureGroup group{"Pressure along the walls", {}};
  for (const auto& [wall, table] : run.surface_pressure) {
    // Up to six of the recorded instants, evenly chosen.
    Values instants = table["time"];
    instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
    const std::size_t count = std::min<std::size_t>(instants.size(), series_colours.size());
    const Unit unit = si_unit(largest(table["p"]), "Pa"), time = time_unit(run.end_time());
    Figure figure;
    figure.name = "surface_" + file_name_of(wall);
    figure.x_label = "s / m";
    figure.y_label = "pressure / " + unit.unit;
    for (std::size_t k = 0; k < count; ++k) {
      const double instant = instants[count == 1 ? 0 : k * (instants.size() - 1) / (count - 1)];
      Curve curve{fmt::format("{} {}", digits(instant * time.scale, 3), time.unit), {}, {}, series_colours[k], 1.4};
      for (std::size_t i = 0; i < table.rows(); ++i) {
        if (table["time"][i] != instant) continue;
        curve.x.push_back(table["s"][i]);
        curve.y.push_back(table["p"][i] * unit.scale);
      }
      curve.points = run.dimension() == 3;  // around a hull there are many points of one distance
      figure.curves.push_back(std::move(curve));
    }
    figure.caption = fmt::format("Pressure on <b>{}</b> over the distance {}from the keel.", html_escaped(wall),
                                 run.dimension() == 3 ? "" : "along its outline ");
    group.figures.push_back(std::move(figure));
  }
  return group;
}

/// The components of an instrument in one table, "ax" to "az"; nothing for other records and for components but the first.
std::optional<Table> instrument_table(const RunData& run, const std::string& probe) {
  const auto dot = probe.rfind('.');
  const auto kind = dot == std::string::npos ? run.record_kinds.end() : run.record_kinds.find(probe.substr(0, dot));
  if (kind == run.record_kinds.end() || kind->second != "acceleration") return {};
  Table table;
  for (const auto& [name, rows] : run.probes) {
    if (!name.starts_with(probe.substr(0, dot + 1))) continue;
    if (table.empty()) table = {{"time"}, {rows["time"]}};
    table.names.push_back(name.substr(dot + 1));
    table.columns.push_back(rows["value"]);
  }
  return table;
}

FigureGroup probe_figures(const RunData& run) {
  FigureGroup group{"Probes and gauges", {}};
  const Unit time = time_unit(run.end_time());
  std::set<std::string> instruments;
  for (const auto& [name, table] : run.probes) {
    Figure figure;
    figure.name = "probe_" + std::to_string(group.figures.size());
    figure.x_label = "t / " + time.unit;
    figure.over_time = true;
    if (const auto components = instrument_table(run, name)) {
      const auto instrument = name.substr(0, name.rfind('.'));
      if (!instruments.insert(instrument).second) continue;
      const bool filters = number_at(run.summary, {"equipment", instrument.c_str(), "cfc60", "value"}) > 0 &&
                           has_every_step(run, *components);
      const auto& peaks = member(member(run.summary, "equipment"), instrument.c_str());
      figure.stretches = pulse_of_peaks(peaks, time.scale);
      figure.levels = levels_of(run.summary, instrument + ".peak_g");
      const std::vector<std::string> columns(components->names.begin() + 1, components->names.end());
      if (auto drawn = acceleration_figure({*components, columns, figure, time.scale, filters, instrument}))
        group.figures.push_back(std::move(*drawn));
      continue;
    }
    figure.y_label = name + run.unit_of_probe(name);
    figure.levels = levels_of(run.summary, name + ".peak_pressure");
    figure.curves = {{"", scaled(table["time"], time.scale), table["value"], ink, 1.4}};
    figure.caption = fmt::format("Probe <b>{}</b>, SI units.", html_escaped(name));
    group.figures.push_back(std::move(figure));
  }
  return group;
}

}  // namespace

std::vector<FigureGroup> figures_of(const RunData& run) {
  std::vector<FigureGroup> groups;
  for (const auto& [name, table] : run.bodies)
    if (!table.empty()) groups.push_back({"Body " + name, BodyPlotter(run, name, table).figures()});
  groups.push_back(surface_figures(run));
  FigureGroup sections{"Section loads", {}};
  for (const auto& [name, table] : run.section_loads)
    std::ranges::move(section_figures(name, table, run.dimension(), run.end_time()),
                      std::back_inserter(sections.figures));
  groups.push_back(std::move(sections));
  groups.push_back(probe_figures(run));
  groups.push_back({"The coupling", pass_figures(run.passes, run.end_time())});
  groups.push_back(fluid_figures(run));
  std::erase_if(groups, [](const FigureGroup& group) { return group.figures.empty(); });
  return groups;
}

}  // namespace splashdown::apps
