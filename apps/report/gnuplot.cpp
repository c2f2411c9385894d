#include "apps/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "apps/report/curves/reduction.hpp"
#include "apps/text/plain_text.hpp"

extern char** environ;

namespace splashdown::apps {

namespace {

// Grounds of pulses and of theories, lines of limits.
constexpr const char *pulse_ground = "#f7efd8", *theory_ground = "#dbe9f4", *level_colour = "#d1495b";
constexpr double level_in_view = 3;  // times the highest value: farther off, a limit would flatten the curves

constexpr std::size_t points_a_curve = 1200;  // twice the pixels of a figure's axis

void write_data(const std::filesystem::path& path, const Figure& figure) {
  fmt::memory_buffer text;
  for (const auto& curve : figure.curves) {
    auto x = curve.x, y = curve.y;
    thin(x, y, points_a_curve);
    for (std::size_t i = 0; i < x.size(); ++i) {
      // Seven digits are far below a pixel. An empty line breaks the curve where there is no value.
      if (std::isfinite(x[i]) && std::isfinite(y[i]))
        fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g}\n", x[i], y[i]);
      else
        text.push_back('\n');
    }
    text.append(std::string_view("\n\n"));
  }
  for (const auto& band : figure.between) {
    for (std::size_t i = 0; i < band.x.size(); ++i)
      fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g}\n", band.x[i], band.low[i], band.high[i]);
    text.append(std::string_view("\n\n"));
  }
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!out) throw std::runtime_error(path.string() + ": cannot write");
}

bool has_points(const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) return true;
  return false;
}

std::string plot_command(const Figure& figure) {
  std::string plots;
  const auto add = [&](const std::string& plot) { plots += (plots.empty() ? "" : ", \\\n  ") + plot; };
  for (std::size_t i = 0; i < figure.between.size(); ++i)
    add(fmt::format("'{}.dat' index {} using 1:2:3 with filledcurves lc rgb '{}' title {}", figure.name,
                    figure.curves.size() + i, theory_ground, gnuplot_text(figure.between[i].text)));
  bool any = false;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve& curve = figure.curves[i];
    if (!has_points(curve)) continue;
    any = true;
    add(fmt::format("'{}.dat' index {} using 1:2 {} with {} lw {} lc rgb '{}' {}", figure.name, i,
                    curve.right_axis ? "axes x1y2" : "",
                    curve.points  ? "points pt 7 ps 0.25"
                    : curve.steps ? "steps"
                                  : "lines",
                    curve.width, curve.colour,
                    curve.label.empty() ? std::string("notitle") : "title " + gnuplot_text(curve.label)));
  }
  return any ? plots : std::string();
}

std::string range_command(const Figure& figure, bool right_axis) {
  const auto [low, high] = axis_range(figure, right_axis);
  const std::string axis = right_axis ? "y2" : "y";
  const auto scale =
      right_axis ? std::string() : fmt::format("{} y\n", figure.log_y ? "set logscale" : "unset logscale");
  if (low > high) return scale + fmt::format("set {}range [*:*]\n", axis);
  return scale + fmt::format("set {}range [{:.7g}:{:.7g}]\n{}", axis, low, high,
                             figure.counts && !right_axis && high < 11 ? "set ytics 1\n" : "");
}

/// What is neither curve nor axis.
std::string decorations(const Figure& figure) {
  std::string script = "unset label\nunset arrow\nunset object\n";
  int number = 0;
  for (const auto& stretch : figure.stretches)
    script += fmt::format(
        "set object {} rectangle from {:.7g},graph 0 to {:.7g},graph 1 behind fc rgb '{}' fs solid noborder\n",
        ++number, stretch.from, stretch.to, pulse_ground);
  const auto range = axis_range(figure, false);
  for (const auto& level : figure.levels)
    if (level.y > range.low && level.y < range.high)
      script += fmt::format(
          "set arrow from graph 0,first {0:.7g} to graph 1,first {0:.7g} nohead dt 2 lw 1.4 lc rgb '{2}'\nset label "
          "{1} "
          "at "
          "graph 0.01,first {0:.7g} offset 0,0.5 textcolor rgb '{2}'\n",
          level.y, gnuplot_text(level.text), level_colour);
  if (figure.zero_line && !figure.log_y)
    script += "set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'\n";
  else
    script += "unset xzeroaxis\n";
  for (const auto& mark : figure.marks)
    script += fmt::format(
        "set label {} at {:.7g},{:.7g} point pt 7 ps 0.5 lc rgb '#24313d' offset 0.8,0.4 textcolor rgb "
        "'#24313d'\n",
        gnuplot_text(mark.text), mark.x, mark.y);
  return script;
}

struct Process {
  pid_t id = 0;
  int error = 0;
};

Process start(const std::filesystem::path& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const std::string log = script + ".log";
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  // -d: figures do not depend on the settings in anybody's home.
  std::string program = "gnuplot", defaults = "-d", file = script;
  char* arguments[] = {program.data(), defaults.data(), file.data(), nullptr};
  Process process;
  process.error = posix_spawnp(&process.id, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  return process;
}

GnuplotResult wait_for(const Process& process) {
  if (process.error == ENOENT) return GnuplotResult::missing;
  if (process.error != 0) return GnuplotResult::failed;
  int status = 0;
  while (waitpid(process.id, &status, 0) < 0)
    if (errno != EINTR) return GnuplotResult::failed;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? GnuplotResult::drawn : GnuplotResult::failed;
}

}  // namespace

// A curve that is one value throughout would leave the axis without a range.
AxisRange axis_range(const Figure& figure, bool right_axis) {
  AxisRange range{INFINITY, -INFINITY};
  const auto look = [&](double y) {
    if (std::isfinite(y) && (y > 0 || !figure.log_y || right_axis))
      range = {std::min(range.low, y), std::max(range.high, y)};
  };
  for (const auto& curve : figure.curves)
    if (curve.right_axis == right_axis)
      for (const double y : curve.y) look(y);
  if (range.low > range.high) return range;
  if (figure.log_y && !right_axis) {
    const double low = std::floor(std::log10(range.low)), high = std::ceil(std::log10(range.high));
    return {std::pow(10, high > low ? low : low - 1), std::pow(10, high)};
  }
  if (!right_axis)
    for (const auto& band : figure.between)
      for (const auto* side : {&band.low, &band.high})
        for (const double y : *side) look(y);
  const double highest = range.high;
  for (const auto& level : figure.levels)
    if (!right_axis && level.y < level_in_view * highest) look(level.y);
  const auto [low, high] = range;
  double margin = 0.07 * (high - low);
  if (margin <= 1e-12 * std::max(std::abs(low), std::abs(high))) margin = low == 0 ? 1 : 0.1 * std::abs(low);
  if (figure.counts && !right_axis) return {0, high + 0.1 * high};
  const double room_for_marks = figure.marks.empty() ? 0 : margin;
  return {low - margin, high + margin + room_for_marks};
}

std::optional<std::string> draw_chart(const std::filesystem::path& folder, const std::string& name,
                                      const std::string& again) {
  const auto script = name + ".gnuplot", log = script + ".log";
  switch (run_gnuplot(folder, {script}).front()) {
    case GnuplotResult::drawn:
      std::filesystem::remove(folder / log);
      return {};
    case GnuplotResult::missing:
      return "no chart: gnuplot is missing. Install gnuplot-nox; " + again + " draws it";
    case GnuplotResult::failed:
      break;
  }
  return "no chart: see " + (folder / log).string();
}

std::string gnuplot_text(const std::string& text) {
  std::string quoted(1, '\'');
  for (const char c : one_line(text)) quoted.append(c == '\'' ? 2 : 1, c);
  return quoted + '\'';
}

std::string script_of(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
  std::string script =
      "set encoding utf8\n"
      "set terminal svg size 640,340 dynamic font 'Helvetica,15' noenhanced rounded\n"
      "set border 3 lw 0.8 lc rgb '#8796a5'\n"
      "set tics nomirror out scale 0.5 textcolor rgb '#51606e'\n"
      "set grid lw 0.6 lt 1 lc rgb '#e3e8ed'\n"
      "set key top right horizontal textcolor rgb '#24313d' samplen 1.6 outside center above\n"
      "set style line 1 lc rgb '#8796a5'\n";
  for (const auto& figure : figures) {
    const std::string plots = plot_command(figure);
    if (plots.empty()) continue;
    write_data(folder / (figure.name + ".dat"), figure);
    script += fmt::format(
        "\nset output '{}.svg'\nset xlabel {} textcolor rgb '#51606e'\nset ylabel {} textcolor rgb "
        "'#51606e'\n",
        figure.name, gnuplot_text(figure.x_label), gnuplot_text(figure.y_label));
    script += "set ytics autofreq\n" + range_command(figure, false);
    const bool right = std::ranges::any_of(figure.curves, &Curve::right_axis);
    if (right)
      script += fmt::format("set border 11\nset y2tics\nset y2label {} textcolor rgb '#51606e'\n",
                            gnuplot_text(figure.y2_label)) +
                range_command(figure, true);
    else
      script += "set border 3\nunset y2tics\nunset y2label\n";
    script += decorations(figure);
    script += "plot " + plots + "\n";
  }
  return script;
}

std::vector<GnuplotResult> run_gnuplot(const std::filesystem::path& folder, const std::vector<std::string>& scripts) {
  const std::size_t at_a_time = std::max(1u, std::thread::hardware_concurrency());
  std::vector<Process> processes;
  std::vector<GnuplotResult> results;
  for (const auto& script : scripts) {
    if (processes.size() >= results.size() + at_a_time) results.push_back(wait_for(processes[results.size()]));
    processes.push_back(start(folder, script));
  }
  while (results.size() < processes.size()) results.push_back(wait_for(processes[results.size()]));
  return results;
}

}  // namespace splashdown::apps
