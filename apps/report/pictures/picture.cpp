#include "apps/report/pictures/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "apps/report/pictures/png.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {

namespace {

// Of a figure [pixels]: its width, the picture between the axes, room around it.
constexpr int figure_width = 1000, plot_width = 760, left = 95, above = 20, below = 85;
constexpr double faint_edges = 4, edges_of = 9;  // [pixels]: shorter mesh lines would hide the colours
constexpr std::size_t most_edges = 20000;        // of a picture: browsers scroll a page of several at ease

/// From pale to dark by lightness alone, so that it reads in print and with any eyes.
constexpr ColourStop stops[] = {{0, 0xdc, 0xec, 0xf5},   {0.12, 0xa9, 0xd3, 0xea}, {0.3, 0x5f, 0xa8, 0xd8},
                                {0.5, 0x32, 0x72, 0xb4}, {0.68, 0x3f, 0x3f, 0x97}, {0.84, 0x7a, 0x2a, 0x86},
                                {1, 0xc2, 0x18, 0x5b}};

/// The stops for gnuplot.
std::string palette_command() {
  std::string entries;
  for (const auto& [at, red, green, blue] : stops)
    entries += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", entries.empty() ? "" : ", ", at, red, green, blue);
  return "set palette defined (" + entries + ")\n";
}

/// The stops in equal parts; the last entry, where there is no water, is clear.
std::array<Colour, 256> palette() {
  std::array<Colour, 256> colours{};
  const std::size_t last = colours.size() - 2;
  for (std::size_t i = 0; i <= last; ++i) {
    const double at = static_cast<double>(i) / static_cast<double>(last);
    std::size_t k = 1;
    while (k + 1 < std::size(stops) && stops[k].at < at) ++k;
    const auto &a = stops[k - 1], &b = stops[k];
    const double f = (at - a.at) / (b.at - a.at);
    const auto mix = [&](std::uint8_t from, std::uint8_t to) {
      return static_cast<std::uint8_t>(std::lround(from + f * (to - from)));
    };
    colours[i] = {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue), 255};
  }
  return colours;
}

// Of so many pixels one counts for the range of colours; no divisor of `plot_width`, so that they lie in all columns.
constexpr std::size_t pixels_of_range = 7;

struct Range {
  double low = 0, high = 0;    ///< of the colours
  double least = 0, most = 0;  ///< in view; what lies beyond the colours has the outermost one, and the key says so
};

/// A hundredth of the scale is no colour of its own.
constexpr double worth_a_mark = 0.01;

/// Colours that end below this share of the highest value would show no difference between what is high: few pixels are.
constexpr double worth_the_colours = 0.1;

/// Lowest and highest pressure in view, without the outermost thousandth.
Range pressure_range(const Raster& raster, const ColourScale& scale) {
  std::vector<float> values;
  for (std::size_t i = 0; i < raster.values.size(); i += pixels_of_range)
    if (std::isfinite(raster.values[i])) values.push_back(raster.values[i]);
  if (values.empty()) return {0, 1, 0, 1};
  const auto quantile = [&](double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return static_cast<double>(*at);
  };
  Range range{std::min(0.0, quantile(0.001)), quantile(0.999)};
  range.least = INFINITY, range.most = -INFINITY;
  for (const double value : raster.values)
    if (std::isfinite(value)) range.least = std::min(range.least, value), range.most = std::max(range.most, value);
  range.high = std::max({range.high, worth_the_colours * range.most, scale.least});
  if (scale.from_zero) range.low = 0;
  // Rounding below the hydrostatic zero is no suction worth a colour.
  if (range.low > -0.01 * range.high) range.low = 0;
  if (!(range.high > range.low)) range.high = range.low + 1;
  const double little = worth_a_mark * (range.high - range.low);  // the scale then ends where the values do
  if (range.most <= range.high + little) range.high = std::max(range.high, range.most);
  if (range.least >= range.low - little) range.least = range.low;
  return range;
}

std::string colours_of(const Raster& raster, const Range& range) {
  static const auto colours = palette();
  const std::size_t clear = colours.size() - 1;
  const auto most = static_cast<float>(clear - 1);
  const auto low = static_cast<float>(range.low), scale = static_cast<float>(most / (range.high - range.low));
  std::vector<std::uint8_t> pixels(raster.values.size());
  auto* pixel = pixels.data();
  const auto width = static_cast<std::size_t>(raster.width);
  for (std::size_t row = raster.values.size() / width; row-- > 0;)
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const float colour = std::clamp((raster.values[i] - low) * scale, 0.F, most);  // of no number: no number
      *pixel++ = static_cast<std::uint8_t>(colour >= 0 ? static_cast<int>(colour + 0.5F) : static_cast<int>(clear));
    }
  return png_of(pixels, raster.width, colours);
}

/// Lines and areas of a picture in pixels, y down.
class Drawing {
 public:
  Drawing(const Box& view, int height) : view_(view), height_(height) {}

  double pixels(const Segment& s) const {
    return plot_width / view_.width() * std::hypot(s[1][0] - s[0][0], s[1][1] - s[0][1]);
  }
  bool shows(const Segment& segment) const {
    for (std::size_t k = 0; k < 2; ++k) {
      if (std::max(segment[0][k], segment[1][k]) < view_.low[k]) return false;
      if (std::min(segment[0][k], segment[1][k]) > view_.high[k]) return false;
    }
    return true;
  }
  void lines(const std::vector<Segment>& segments, double shortest, double longest, const char* style) {
    std::string path;
    for (const auto& s : segments)
      if (shows(s) && pixels(s) >= shortest && pixels(s) < longest) path += "M" + at(s[0]) + "L" + at(s[1]);
    add(path, std::string("fill=\"none\" ") + style);
  }
  void area(const std::vector<Segment>& outline, const char* style) {
    std::string path;
    for (const auto& s : outline) path += (path.empty() ? "M" : "L") + at(s[0]) + "L" + at(s[1]);
    add(path.empty() ? path : path + "Z", style);
  }
  void dots(const std::vector<PlanePoint>& points) {
    for (const auto& x : points)
      if (shows({x, x}))
        content += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"#2f7fc1\"/>\n", across(x), down(x));
  }
  std::string content;

 private:
  double across(const PlanePoint& x) const { return plot_width * (x[0] - view_.low[0]) / view_.width(); }
  double down(const PlanePoint& x) const { return height_ * (view_.high[1] - x[1]) / view_.height(); }
  std::string at(const PlanePoint& x) const { return fmt::format("{:.1f} {:.1f}", across(x), down(x)); }
  void add(const std::string& path, const std::string& style) {
    if (!path.empty()) content += fmt::format("<path {} d=\"{}\"/>\n", style, path);
  }

  Box view_;
  int height_;
};

/// Mesh lines shorter than this [pixels] are left out.
double shortest_edge(const Drawing& drawing, const std::vector<Segment>& edges) {
  std::vector<double> lengths;
  for (const auto& edge : edges)
    if (drawing.shows(edge) && drawing.pixels(edge) >= faint_edges) lengths.push_back(drawing.pixels(edge));
  if (lengths.size() <= most_edges) return faint_edges;
  const auto at = lengths.end() - static_cast<std::ptrdiff_t>(most_edges);
  std::ranges::nth_element(lengths, at);
  return *at;
}

std::string content_of(const PlanePicture& picture, const Box& view, const Raster& raster, const Range& range) {
  Drawing drawing(view, raster.height);
  drawing.content = fmt::format(
      "<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" stroke-linejoin=\"round\">\n<image width=\"{}\" height=\"{}\" "
      "xlink:href=\"data:image/png;base64,{}\"/>\n",
      left, above, plot_width, raster.height, plot_width, raster.height, base64(colours_of(raster, range)));
  const double shortest = shortest_edge(drawing, picture.edges), longer = std::max(edges_of, shortest);
  drawing.lines(picture.edges, shortest, longer, "stroke=\"#0f2f4f\" stroke-opacity=\".09\" stroke-width=\".7\"");
  drawing.lines(picture.edges, longer, INFINITY, "stroke=\"#0f2f4f\" stroke-opacity=\".22\" stroke-width=\".8\"");
  drawing.lines(picture.surface, 0, INFINITY, "stroke=\"#0f2f4f\" stroke-width=\"1.5\"");
  for (const auto& outline : picture.outlines)
    if (!outline.encloses_solid)
      drawing.lines(outline.segments, 0, INFINITY, "stroke=\"#5f6b76\" stroke-width=\"2.8\"");
  drawing.dots(picture.drops);
  for (const auto& outline : picture.outlines)
    if (outline.encloses_solid)
      drawing.area(outline.segments, "fill=\"#d6d9dc\" stroke=\"#39424a\" stroke-width=\"2.2\"");
  return drawing.content + "</svg>\n";
}

/// Axes and colours' key. gnuplot shows the key beside a plot only, if it is of nothing.
std::string axes_script(const std::string& name, const Box& view, int height, const Range& range, const Unit& unit,
                        const std::string& colour_label) {
  const double canvas = above + height + below;
  const auto share = [&](double pixels) { return pixels / canvas; };
  return fmt::format(
             "reset\nset encoding utf8\nset terminal svg size {},{} dynamic font 'Helvetica,19' noenhanced\n"
             "set lmargin screen {}\nset rmargin screen {}\nset tmargin screen {:.6g}\nset bmargin screen {:.6g}\n",
             figure_width, canvas, left / static_cast<double>(figure_width),
             (left + plot_width) / static_cast<double>(figure_width), 1 - share(above), share(below)) +
         fmt::format(
             "set border 15 lw 0.8 lc rgb '#8796a5'\nset tics out scale 0.4 nomirror textcolor rgb '#51606e'\n"
             "set xlabel 'both axes in m' textcolor rgb '#51606e' offset 0,0.3\nset key off\n"
             "set colorbox user origin 0.872,{:.6g} size 0.022,{:.6g}\nset format cb '%.4g'\n",
             share(below), share(height)) +
         palette_command() +
         fmt::format(
             "set output '{}.svg'\nset xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n"
             "set cbrange [{:.6g}:{:.6g}]\nset cblabel '{} / {}' offset 0.6,0 textcolor rgb '#51606e'\n"
             "plot NaN with lines lc palette notitle\n",
             name, view.low[0], view.high[0], view.low[1], view.high[1], range.low * unit.scale,
             range.high * unit.scale, colour_label, unit.unit);
}

}  // namespace

std::span<const ColourStop> pressure_colours() { return stops; }

FieldFigure figure_of(const std::string& name, const PlanePicture& picture, const Box& view, const ColourScale& scale) {
  const int height = std::max(1, static_cast<int>(std::lround(plot_width * view.height() / view.width())));
  const Raster raster = rasterise(picture, view.low, view.high, plot_width, height);
  const Range range = pressure_range(raster, scale);
  const Unit unit = si_unit(std::max(range.high, -range.low), "Pa");
  FieldFigure figure;
  figure.name = name;
  figure.script = axes_script(name, view, height, range, unit, scale.label);
  figure.content = content_of(picture, view, raster, range);
  const bool any = std::ranges::any_of(raster.values, [](float v) { return std::isfinite(v); });
  if (any && range.most > worth_a_mark * range.high)
    figure.caption = fmt::format("highest pressure in view {}", digits_with_unit(range.most, "Pa", 3));
  if (any && range.most > range.high)
    figure.caption += fmt::format(", beyond the colours, which end at {}", digits_with_unit(range.high, "Pa", 3));
  if (any && range.least < range.low - worth_a_mark * (range.high - range.low))
    figure.caption += (figure.caption.empty() ? "" : "; ") +
                      fmt::format("lowest {}, below the colours", digits_with_unit(range.least, "Pa", 3));
  return figure;
}

std::string with_content(const std::string& axes, const FieldFigure& figure) {
  constexpr std::string_view before = "<g id=\"gnuplot_canvas\">";
  const auto at = axes.find(before);
  if (at == std::string::npos) throw std::runtime_error(figure.name + ".svg: is not what gnuplot writes");
  const auto ground = fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  return axes.substr(0, at) + ground + figure.content + axes.substr(at);
}

}  // namespace splashdown::apps
