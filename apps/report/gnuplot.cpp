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

#include "apps/text/plain_text.hpp"

extern char** environ;

namespace splashdown::apps {

namespace {

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
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve& curve = figure.curves[i];
    if (!has_points(curve)) continue;
    if (!plots.empty()) plots += ", \\\n  ";
    plots += fmt::format("'{}.dat' index {} using 1:2 {} with {} lw {} lc rgb '{}' {}", figure.name, i,
                         curve.right_axis ? "axes x1y2" : "",
                         curve.points  ? "points pt 7 ps 0.25"
                         : curve.steps ? "steps"
                                       : "lines",
                         curve.width, curve.colour,
                         curve.label.empty() ? std::string("notitle") : "title " + gnuplot_text(curve.label));
  }
  return plots;
}

/// A curve that is one value throughout would leave the axis without a range.
std::string range_command(const Figure& figure, bool right_axis) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& curve : figure.curves) {
    if (curve.right_axis != right_axis) continue;
    for (const double y : curve.y)
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
  }
  const std::string axis = right_axis ? "y2" : "y";
  if (low > high) return fmt::format("set {}range [*:*]\n", axis);
  double margin = 0.07 * (high - low);
  if (margin <= 1e-12 * std::max(std::abs(low), std::abs(high))) margin = low == 0 ? 1 : 0.1 * std::abs(low);
  if (figure.counts && !right_axis)
    return fmt::format("set yrange [0:{:.7g}]\n{}", high + 0.1 * high, high < 10 ? "set ytics 1\n" : "");
  const double room_for_marks = figure.marks.empty() ? 0 : margin;
  return fmt::format("set {}range [{:.7g}:{:.7g}]\n", axis, low - margin, high + margin + room_for_marks);
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

void thin(std::vector<double>& x, std::vector<double>& y, std::size_t limit) {
  if (x.size() <= limit || limit < 4) return;
  // Lowest and highest point of each of limit/2 groups, in their order.
  const std::size_t groups = limit / 2;
  std::vector<double> thin_x, thin_y;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t begin = g * x.size() / groups, end = (g + 1) * x.size() / groups;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (y[i] < y[low] || std::isnan(y[low])) low = i;
      if (y[i] > y[high] || std::isnan(y[high])) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (i == std::max(low, high) && low == high && !thin_x.empty() && thin_x.back() == x[i]) continue;
      thin_x.push_back(x[i]);
      thin_y.push_back(y[i]);
    }
  }
  if (thin_x.back() != x.back()) {
    thin_x.push_back(x.back());
    thin_y.push_back(y.back());
  }
  x = std::move(thin_x);
  y = std::move(thin_y);
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
    script += "unset label\nunset arrow\n";
    if (figure.zero_line)
      script += "set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'\n";
    else
      script += "unset xzeroaxis\n";
    for (const auto& mark : figure.marks)
      script += fmt::format(
          "set label {} at {:.7g},{:.7g} point pt 7 ps 0.5 lc rgb '#24313d' offset 0.8,0.4 textcolor rgb "
          "'#24313d'\n",
          gnuplot_text(mark.text), mark.x, mark.y);
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
