#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/files/csv.hpp"
#include "apps/price/write.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {
namespace {

// Okabe and Ito (2008): told apart by everybody, also in print.
constexpr std::array curve_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
/// Of the first six, of the next six ...: point, size and dashes.
constexpr std::array curve_marks = {"pt 7 ps 0.4 dt 1", "pt 5 ps 0.5 dt 3", "pt 9 ps 0.6 dt 4"};
constexpr const char* ink = "#24313d";

struct Work {
  double seconds, percent;
};

std::string block(const std::string& name, const std::vector<Work>& points) {
  std::string text = name + " << EOD\n";
  for (const auto& point : points) text += fmt::format("{:.8g} {:.8g}\n", point.seconds, point.percent);
  return text + "EOD\n";
}

/// Accuracy of all quantities that count on the rungs that were made.
std::vector<Work> made(const Price& price) {
  std::vector<Work> points;
  for (const auto& rung : price.rungs)
    if (const auto worst = price.accuracy(rung.spec.refine); worst && rung.spec.role == Role::rung)
      points.push_back({rung.seconds, 100 * worst->first});
  return points;
}

std::vector<Work> beyond(const Price& price) {
  std::vector<Work> points;
  for (const double factor : {1., 1.2, 1.41, 1.7, 2., 2.4, 2.83, 3.4, farthest_extrapolation}) {
    const double refine = factor * price.finest();
    if (const auto worst = price.accuracy(refine)) points.push_back({*price.seconds(refine), 100 * worst->first});
  }
  return points;
}

/// Of the list, where several runs take the place of one.
std::vector<Work> means_of_runs(const Price& price) {
  std::vector<Work> points;
  for (const auto& row : price.rows)
    if (row.runs > 1 && row.seconds) points.push_back({*row.seconds, row.accuracy_percent});
  return points;
}

/// Those that no other one beats in both.
std::vector<Work> pareto(const std::vector<Work>& points) {
  std::vector<Work> best;
  for (const auto& point : points)
    if (std::ranges::none_of(
            points, [&](const Work& other) { return other.seconds < point.seconds && other.percent <= point.percent; }))
      best.push_back(point);
  return best;
}

std::string script_of(const Price& price) {
  std::string data, plots;
  const auto add = [&](const std::vector<Work>& points, const std::string& style) {
    if (points.empty()) return;
    const auto name = fmt::format("$d{}", std::ranges::count(data, '$'));
    data += block(name, points);
    plots += fmt::format("{}{} using 1:2 {}", plots.empty() ? "plot " : ", \\\n  ", name, style);
  };
  std::size_t curve = 0;
  for (const auto& quantity : price.quantities) {
    std::vector<Work> points;
    for (const auto& [rung, value] : quantity.rungs)
      if (const auto accuracy = quantity.accuracy(rung.spec.refine); accuracy && *accuracy > 0)
        points.push_back({rung.seconds, 100 * *accuracy});
    if (!quantity.what.counts) continue;
    add(points, fmt::format("with linespoints lw 1.2 {} lc rgb '{}' title {} noenhanced",
                            curve_marks[curve / curve_colours.size() % curve_marks.size()],
                            curve_colours[curve % curve_colours.size()], gnuplot_text(quantity.what.name)));
    ++curve;
  }
  const auto all = made(price);
  add(all, fmt::format("with lines lw 3 lc rgb '{}' title 'all of them'", ink));
  add(beyond(price), fmt::format("with lines lw 2 dt 2 lc rgb '{}' title 'extrapolated'", ink));
  add(means_of_runs(price),
      fmt::format("with linespoints lw 2 dt 3 pt 12 ps 1.2 lc rgb '{}' title 'means of runs'", ink));
  add(pareto(all), fmt::format("with points pt 6 ps 1.8 lw 2 lc rgb '{}' title 'Pareto set'", ink));
  if (plots.empty()) return {};
  return "set encoding utf8\n"
         "set terminal svg size 820,480 font 'Helvetica,14' enhanced rounded background rgb 'white'\n"
         "set output 'price.svg'\n"
         "set border 3 lw 0.8 lc rgb '#8796a5'\nset tics nomirror out scale 0.5 textcolor rgb '#51606e'\n"
         "set grid lw 0.6 lt 1 lc rgb '#dfe5ea'\nset logscale xy\nset format x '%g'\nset format y '%g'\n"
         "set xlabel 'wall time (s)'\nset ylabel 'band (% of the value)'\n"
         "set key outside right top samplen 2 font ',12'\n" +
         data + plots + "\nunset output\n";
}

}  // namespace

std::optional<std::string> draw_price(const Price& price, const std::filesystem::path& folder) {
  std::filesystem::remove(folder / "price.svg");  // that of other runs
  const auto script = script_of(price);
  if (script.empty()) return "no chart: too few meshes for a band";
  write_file_atomically(folder / "price.gnuplot", script);
  return draw_chart(folder, "price", "the same command");
}

}  // namespace splashdown::apps
