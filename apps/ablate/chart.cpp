#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/ablate/write.hpp"
#include "apps/files/csv.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {
namespace {

// Okabe and Ito (2008): told apart by everybody, also in print.
constexpr std::array bar_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array bar_markers = {7, 5, 9, 13, 11, 15};

/// Of changes from below what matters to many times the value: linear within it, logarithmic beyond.
double place_of(double change, double least) { return std::asinh(change / least); }

/// Those that count and have a value, as many as there are colours.
std::vector<std::size_t> drawn(const Ablation& ablation) {
  std::vector<std::size_t> list;
  for (std::size_t q = 0; q < ablation.quantities.size() && list.size() < bar_colours.size(); ++q)
    if (ablation.quantities[q].counts && std::isfinite(ablation.base[q])) list.push_back(q);
  return list;
}

std::string tics(double least, double most) {
  std::string list = "0 0";
  for (double percent = 0.1; percent < 1e5; percent *= 10) {
    const double place = place_of(percent / 100, least);
    if (percent / 100 < 0.3 * least || place > most) continue;
    list += fmt::format(", '+{0:g}' {1:.6g}, '-{0:g}' {2:.6g}", percent, place, -place);
  }
  return list;
}

std::string script_of(const AblationPlan& plan, const Ablation& ablation, double least) {
  const auto quantities = drawn(ablation);
  if (quantities.empty()) return {};
  const auto rows = plan.variants.size() - 1;
  std::string data, plots, names;
  double most = place_of(10 * least, least);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    std::string points;
    for (std::size_t v = 1; v <= rows; ++v) {
      const auto& change = ablation.variants[v].changes[quantities[k]];
      if (!std::isfinite(change.relative)) continue;
      const double band = change.band.value_or(0);
      const double y = static_cast<double>(rows - v) + 0.3 -
                       0.6 * (static_cast<double>(k) + 0.5) / static_cast<double>(quantities.size());
      const double low = place_of(change.relative - band, least), high = place_of(change.relative + band, least);
      points += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", place_of(change.relative, least), y, low, high);
      most = std::max({most, std::abs(low), std::abs(high)});
    }
    if (points.empty()) continue;
    data += fmt::format("$d{} << EOD\n{}EOD\n", k, points);
    plots += fmt::format("{}$d{} using 1:2:3:4 with xerrorbars lw 2 pt {} ps 0.9 lc rgb '{}' title {} noenhanced",
                         plots.empty() ? "plot " : ", \\\n  ", k, bar_markers[k], bar_colours[k],
                         gnuplot_text(ablation.quantities[quantities[k]].name));
  }
  if (plots.empty()) return {};
  for (std::size_t v = 1; v <= rows; ++v)
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", gnuplot_text(plan.variants[v].name), rows - v);
  const double edge = place_of(least, least);
  return fmt::format(
             "set encoding utf8\nset terminal svg size 860,{} font 'Helvetica,14' enhanced rounded background rgb "
             "'white'\nset output 'ablation.svg'\nset border 3 lw 0.8 lc rgb '#8796a5'\n"
             "set tics nomirror out scale 0.5 textcolor rgb '#51606e'\nset grid x lw 0.6 lt 1 lc rgb '#dfe5ea'\n"
             "set xrange [{:.4g}:{:.4g}]\nset yrange [-0.6:{}]\nset ytics ({}) noenhanced\nset xtics ({})\n"
             "set object 1 rectangle from {:.4g}, graph 0 to {:.4g}, graph 1 behind fillcolor rgb '#eef2f5' fillstyle "
             "solid noborder\nset xlabel 'change (%); shaded: does not matter'\n"
             "set key outside right top samplen 1 font ',12'\n",
             150 + 60 * rows, -1.05 * most, 1.05 * most, static_cast<double>(rows) - 0.4, names, tics(least, most),
             -edge, edge) +
         data + plots + "\nunset output\n";
}

}  // namespace

std::optional<std::string> draw_ablation(const AblationPlan& plan, const Ablation& ablation, double least,
                                         const std::filesystem::path& folder) {
  std::filesystem::remove(folder / "ablation.svg");  // that of other runs
  const auto script = script_of(plan, ablation, least);
  if (script.empty()) return "no chart: no number that counts has a value";
  write_file_atomically(folder / "ablation.gnuplot", script);
  return draw_chart(folder, "ablation", "the same command");
}

}  // namespace splashdown::apps
