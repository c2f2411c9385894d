#include "apps/report/picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "apps/report/words.hpp"

namespace splashdown::apps {

namespace {

constexpr int plot_width = 760;                  // of a picture between its axes [pixels]
constexpr int raster_width = 570;                // of the pressures: gnuplot's time goes with their number
constexpr double faint_edges = 4, edges_of = 9;  // [pixels]: shorter mesh lines would hide the colours

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw std::runtime_error(path.string() + ": cannot write");
}

bool touches(const Segment& segment, const Box& view) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::max(segment[0][k], segment[1][k]) < view.low[k]) return false;
    if (std::min(segment[0][k], segment[1][k]) > view.high[k]) return false;
  }
  return true;
}

void append(fmt::memory_buffer& text, const std::vector<Segment>& segments, const Box& view, double shortest = 0,
            double longest = INFINITY) {
  for (const auto& [a, b] : segments) {
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!touches({a, b}, view) || length < shortest || length >= longest) continue;
    fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n{:.6g} {:.6g}\n\n", a[0], a[1], b[0], b[1]);
  }
  // A block must not be empty, or gnuplot's indices shift.
  text.append(std::string_view("NaN NaN\n\n\n"));
}

/// Blocks: short and long mesh lines, outline of the water, tanks, drops, then each body as one polygon.
void write_lines(const std::filesystem::path& path, const PlanePicture& picture, const Box& view) {
  fmt::memory_buffer text;
  const double pixel = view.width() / plot_width;
  append(text, picture.edges, view, faint_edges * pixel, edges_of * pixel);
  append(text, picture.edges, view, edges_of * pixel);
  append(text, picture.surface, view);
  std::vector<Segment> tanks;
  for (const auto& outline : picture.outlines)
    if (!outline.encloses_solid) tanks.insert(tanks.end(), outline.segments.begin(), outline.segments.end());
  append(text, tanks, view);
  for (const auto& drop : picture.drops) fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n", drop[0], drop[1]);
  text.append(std::string_view("NaN NaN\n\n\n"));
  for (const auto& outline : picture.outlines) {
    if (!outline.encloses_solid) continue;
    for (const auto& segment : outline.segments)
      fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n{:.6g} {:.6g}\n", segment[0][0], segment[0][1],
                     segment[1][0], segment[1][1]);
    text.append(std::string_view("NaN NaN\n\n\n"));
  }
  write_bytes(path, {text.data(), text.size()});
}

struct Range {
  double low = 0, high = 0;
};

/// Lowest and highest pressure in view, without the outermost thousandth.
Range pressure_range(const Raster& raster) {
  std::vector<float> values;
  for (const float v : raster.values)
    if (std::isfinite(v)) values.push_back(v);
  if (values.empty()) return {0, 1};
  const auto quantile = [&](double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return static_cast<double>(*at);
  };
  Range range{std::min(0.0, quantile(0.001)), quantile(0.999)};
  // Rounding below the hydrostatic zero is no suction worth a colour.
  if (range.low > -0.01 * range.high) range.low = 0;
  if (!(range.high > range.low)) range.high = range.low + 1;
  return range;
}

std::string plot_of(const std::string& name, const Raster& raster, const Box& view, const PlanePicture& picture,
                    const Range& range, const Unit& unit, const std::string& colour_label) {
  const double dx = view.width() / raster.width, dy = view.height() / raster.height;
  std::string plots = fmt::format(
      "plot '{0}.bin' binary array=({1},{2}) format='%float' dx={3:.9g} dy={4:.9g} origin=({5:.9g},{6:.9g}) "
      "using ($1*{7}) with image notitle",
      name, raster.width, raster.height, dx, dy, view.low[0] + 0.5 * dx, view.low[1] + 0.5 * dy, unit.scale);
  const std::string lines = fmt::format("'{}.lines' index", name);
  plots += fmt::format(", \\\n  {} 0 with lines lw 0.5 lc rgb '#e80f2f4f' notitle", lines);
  plots += fmt::format(", \\\n  {} 1 with lines lw 0.6 lc rgb '#c80f2f4f' notitle", lines);
  plots += fmt::format(", \\\n  {} 2 with lines lw 1.3 lc rgb '#0f2f4f' notitle", lines);
  plots += fmt::format(", \\\n  {} 3 with lines lw 2.5 lc rgb '#5f6b76' notitle", lines);
  if (!picture.drops.empty())
    plots += fmt::format(", \\\n  {} 4 with points pt 7 ps 0.35 lc rgb '#2f7fc1' notitle", lines);
  int block = 5;
  for (const auto& outline : picture.outlines) {
    if (!outline.encloses_solid) continue;
    plots += fmt::format(", \\\n  {} {} with filledcurves closed fc rgb '#d6d9dc' notitle", lines, block);
    plots += fmt::format(", \\\n  {} {} with lines lw 2 lc rgb '#39424a' notitle", lines, block);
    ++block;
  }
  return fmt::format(
             "set output '{}.png'\nset xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n"
             "set cbrange [{:.6g}:{:.6g}]\nset cblabel '{} / {}' offset 0.6,0 textcolor rgb "
             "'#51606e'\n",
             name, view.low[0], view.high[0], view.low[1], view.high[1], range.low * unit.scale,
             range.high * unit.scale, colour_label, unit.unit) +
         plots + "\n";
}

}  // namespace

FieldFigure figure_of(const std::filesystem::path& folder, const std::string& name, const PlanePicture& picture,
                      const Box& view, const std::string& colour_label) {
  const int height = std::max(1, static_cast<int>(std::lround(plot_width * view.height() / view.width())));
  const double canvas = height + 105.0;
  const std::string preamble = fmt::format(
      "set encoding utf8\nset terminal pngcairo size {},{} font 'Helvetica,19' noenhanced background "
      "'#ffffff'\n"
      "set lmargin screen 0.095\nset rmargin screen 0.855\nset tmargin screen {:.4g}\nset bmargin screen "
      "{:.4g}\n"
      "set border 15 lw 0.8 lc rgb '#8796a5'\nset tics out scale 0.4 nomirror textcolor rgb '#51606e'\n"
      "set xlabel 'both axes in m' textcolor rgb '#51606e' offset 0,0.3\nset key off\nset colorbox user origin "
      "0.872,{:.4g} size 0.022,{:.4g}\n"
      "set palette defined (0 '#dcecf5', 0.12 '#a9d3ea', 0.3 '#5fa8d8', 0.5 '#3272b4', 0.68 '#3f3f97', "
      "0.84 '#7a2a86', 1 '#c2185b')\nset format cb '%.4g'\n",
      1000, canvas, 1 - 20 / canvas, 85 / canvas, 85 / canvas, 1 - 105 / canvas);
  const Raster raster =
      rasterise(picture, view.low, view.high, raster_width, std::max(1, height * raster_width / plot_width));
  const Range range = pressure_range(raster);
  const Unit unit = si_unit(std::max(range.high, -range.low), "Pa");
  write_bytes(folder / (name + ".bin"),
              {reinterpret_cast<const char*>(raster.values.data()), raster.values.size() * sizeof(float)});
  write_lines(folder / (name + ".lines"), picture, view);
  FieldFigure figure{name, {}, {}, preamble + plot_of(name, raster, view, picture, range, unit, colour_label)};
  float top = -std::numeric_limits<float>::infinity();
  for (const float v : raster.values)
    if (std::isfinite(v)) top = std::max(top, v);
  if (std::isfinite(top)) figure.caption = fmt::format("highest pressure in view {}", with_unit(top, "Pa", 3));
  return figure;
}

}  // namespace splashdown::apps
