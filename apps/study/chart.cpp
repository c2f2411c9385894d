#include "apps/study/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/files/csv.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

// Okabe and Ito (2008): told apart by everybody, also in print.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#24313d"};
constexpr std::array markers = {7, 5, 9, 13, 11, 15, 6};

constexpr int panel_width = 330, panel_height = 250;                    // pixels
constexpr int left = 112, right = 20, top = 96, gap = 16, bottom = 66;  // around the panels
constexpr std::size_t longest_word = 24;                                // letters of an x axis of words
constexpr int pixels_a_letter = 5;
constexpr double band = 0.25;  // share of a panel's height for the runs that broke down

/// As gnuplot's point types 2, 1 and 3 look.
const std::map<Outcome::Status, const char*> signs = {
    {Outcome::Status::diverged, "×"}, {Outcome::Status::stalled, "+"}, {Outcome::Status::failed, "∗"}};

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

/// Position between 0 and 1 on an axis, and back.
struct Scale {
  Range range;
  bool log = false;
  double at(double share) const {
    return log ? range.low * std::pow(range.high / range.low, share) : range.low + share * (range.high - range.low);
  }
  double moved(double x, double share) const {
    return log ? x * std::pow(range.high / range.low, share) : x + share * (range.high - range.low);
  }
};

Scale widened(Range range, bool log, double below, double above) {
  if (range.empty()) range = {1, 1};
  if (log && range.low <= 0) range.low = range.high > 0 ? 1e-3 * range.high : 1;
  if (range.high <= range.low) log ? (range.low *= 0.5, range.high *= 2) : (range.low -= 0.5, range.high += 0.5);
  const Scale scale{range, log};
  return {{scale.at(-below), scale.at(1 + above)}, log};
}

/// 1, 2, 5, 10 ... within few decades, powers of ten within many.
std::string tics(const char* axis, const Scale& scale) {
  if (!scale.log) return fmt::format("set {0}tics autofreq\nset format {0} '%g'\n", axis);
  const double decades = std::log10(scale.range.high / scale.range.low);
  if (decades > 4) return fmt::format("set {0}tics autofreq\nset format {0} '10^{{%L}}'\n", axis);
  std::string list;
  for (int power = static_cast<int>(std::floor(std::log10(scale.range.low)));
       power <= static_cast<int>(std::ceil(std::log10(scale.range.high))); ++power)
    for (const double digit : {1., 2., 5.})
      if (const double value = digit * std::pow(10., power);
          (digit == 1 || decades <= 2.2) && value >= scale.range.low && value <= scale.range.high)
        list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", value);
  return fmt::format("set {0}tics ({1})\nset format {0} '%g'\n", axis, list);
}

/// At most so many letters, whole ones.
std::string shortened(const std::string& word) {
  if (word.size() <= longest_word) return word;
  std::size_t end = longest_word - 1;
  while (end > 0 && (static_cast<unsigned char>(word[end]) & 0xc0) == 0x80) --end;  // within a letter of UTF-8
  return word.substr(0, end) + "…";
}

class Chart {
 public:
  Chart(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes)
      : study_(study), chart_(*study.chart), runs_(runs), outcomes_(outcomes) {
    const auto& values = study.axes[chart_.x].values;
    if (of_words()) {
      x_ = {{0.5, static_cast<double>(values.size()) + 0.5}, false};
      return;
    }
    Range x;
    for (const auto& value : values) x.add(*value.number);
    x_ = widened(x, chart_.log_x, 0.08, 0.08);
  }

  int width() const { return left + right + static_cast<int>(columns()) * (panel_width + gap) - gap; }
  int height() const { return top + below() + static_cast<int>(chart_.y.size()) * (panel_height + gap) - gap; }

  /// Data blocks, then one panel after the other, then the key.
  std::string body() const {
    const auto across = [&](int id, const std::string& words, double y, int size) {
      return fmt::format(
          "set label {} {} at screen {:.4f}, screen {:.4f} center font ',{}' textcolor rgb '#24313d' "
          "noenhanced\n",
          id, gnuplot_text(words), (left + 0.5 * (width() - left - right)) / width(), y, size);
    };
    // Title and x label once for all panels.
    std::string text = "set multiplot\n";
    text += across(1, study_.title, 1 - 18. / height(), 17);
    text += across(3, study_.axes[chart_.x].label, 14. / height(), 14);
    for (std::size_t row = 0; row < chart_.y.size(); ++row)
      for (std::size_t column = 0; column < columns(); ++column) text += panel(row, column);
    return text + key() + "unset multiplot\n";
  }

 private:
  bool of_words() const { return !study_.axes[chart_.x].is_of_numbers(); }
  /// Room for the words of the x axis, which stand aslant.
  int below() const {
    if (!of_words()) return bottom;
    std::size_t longest = 0;
    for (const auto& value : study_.axes[chart_.x].values) longest = std::max(longest, value.text.size());
    return bottom + static_cast<int>(std::min<std::size_t>(longest, longest_word)) * pixels_a_letter;
  }
  /// Words of the x axis below their dots, or marks alone.
  std::string words(bool shown) const {
    std::string list;
    const auto& values = study_.axes[chart_.x].values;
    for (std::size_t i = 0; i < values.size(); ++i)
      list += fmt::format("{}{} {}", i ? ", " : "", gnuplot_text(shown ? shortened(values[i].text) : ""), i + 1);
    return "set xtics rotate by 40 right noenhanced (" + list + ")\n";
  }
  std::size_t columns() const { return chart_.panels ? study_.axes[*chart_.panels].values.size() : 1; }
  std::size_t series() const { return chart_.series ? study_.axes[*chart_.series].values.size() : 1; }

  bool belongs(const StudyRun& run, std::size_t column, std::size_t curve) const {
    return (!chart_.panels || run.value[*chart_.panels] == column) &&
           (!chart_.series || run.value[*chart_.series] == curve);
  }
  bool broke(std::size_t i) const {
    return outcomes_[i].finished() && outcomes_[i].status != Outcome::Status::converged;
  }

  /// One range for a row, so that its panels compare; with room for the band if any run needs it.
  Scale y_scale(std::size_t row) const {
    Range range;
    for (const auto& outcome : outcomes_)
      if (const auto found = outcome.numbers.find(chart_.y[row]); outcome.status == Outcome::Status::converged &&
                                                                  found != outcome.numbers.end() &&
                                                                  !(chart_.log_y && found->second <= 0))
        range.add(found->second);
    return widened(range, chart_.log_y, 0.08, 0.08 + (has_band() ? 1.16 * band / (1 - band) : 0));
  }
  bool has_band() const {
    for (std::size_t i = 0; i < runs_.size(); ++i)
      if (broke(i)) return true;
    return false;
  }

  /// "× diverged   + stalled", of what there is.
  std::string broken_words() const {
    std::string text;
    for (const auto& [status, sign] : signs)
      if (std::ranges::find(outcomes_, status, &Outcome::status) != outcomes_.end())
        text += fmt::format("  {} {}", sign, word(status));
    return text;
  }

  /// Neighbouring curves stand a little beside each other where they coincide.
  double x_of(std::size_t i, std::size_t curve) const {
    const auto place = runs_[i].value[chart_.x];
    if (of_words()) return double(place) + 1 + 0.7 * ((double(curve) + 0.5) / double(series()) - 0.5);
    const double x = *study_.axes[chart_.x].values[place].number;
    return x_.moved(x, 0.008 * (double(curve) - 0.5 * double(series() - 1)));
  }

  std::string panel(std::size_t row, std::size_t column) const {
    const double w = width(), h = height();
    const double x0 = left + double(column) * (panel_width + gap), y0 = top + double(row) * (panel_height + gap);
    const bool last_row = row + 1 == chart_.y.size();
    const Scale y = y_scale(row);
    std::string text = fmt::format(
        "\nset lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\nset "
        "bmargin at "
        "screen {:.4f}\n",
        x0 / w, (x0 + panel_width) / w, 1 - y0 / h, 1 - (y0 + panel_height) / h);
    text += fmt::format("set {} x\nset {} y\nset xrange [{:.8g}:{:.8g}]\nset yrange [{:.8g}:{:.8g}]\n",
                        x_.log ? "logscale" : "nologscale", y.log ? "logscale" : "nologscale", x_.range.low,
                        x_.range.high, y.range.low, y.range.high);
    text += (of_words() ? words(last_row) : tics("x", x_)) + tics("y", y);
    if (!last_row && !of_words()) text += "set format x ''\n";
    if (column > 0) text += "set format y ''\n";
    text += column == 0 ? fmt::format("set ylabel {} offset 0.5,0 textcolor rgb '#24313d' noenhanced\n",
                                      gnuplot_text(column_label(study_, chart_.y[row])))
                        : "unset ylabel\n";
    if (row == 0 && chart_.panels) {
      const auto& axis = study_.axes[*chart_.panels];
      text += fmt::format("set title {} offset 0,-0.6 textcolor rgb '#24313d' noenhanced\n",
                          gnuplot_text(axis.label + ": " + axis.values[column].text));
    } else {
      text += "unset title\n";
    }
    if (has_band())
      text += fmt::format(
          "set object 1 rectangle from graph 0,{:.3f} to graph 1,1 behind fillcolor rgb '#fbe6e1' fillstyle "
          "solid "
          "noborder\nset label 2 {} at graph 0.02,{:.3f} font ',11' textcolor rgb '#8c2d19' "
          "noenhanced\n",
          1 - band, gnuplot_text("no solution: " + broken_words()), 1 - 0.16 * band);
    return text + plots(row, column, y) + "unset label 1\nunset label 3\n";
  }

  /// Lines through the runs that ended, crosses for those that broke down.
  std::string plots(std::size_t row, std::size_t column, const Scale& y) const {
    std::string data, list;
    const auto add = [&](const std::string& points, const std::string& style) {
      if (points.empty()) return;
      const auto name = fmt::format("$d{}", blocks_++);
      data += name + " << EOD\n" + points + "EOD\n";
      list += (list.empty() ? "plot " : ", \\\n  ") + name + " using 1:2 " + style + " notitle";
    };
    for (std::size_t curve = 0; curve < series(); ++curve) {
      std::vector<std::pair<double, double>> points;
      std::map<Outcome::Status, std::string> crosses;
      // The band's upper third holds its label.
      const double height = 1 - band + 0.68 * band * (double(series() - 1 - curve) + 0.5) / double(series());
      for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (!belongs(runs_[i], column, curve)) continue;
        if (broke(i)) crosses[outcomes_[i].status] += fmt::format("{:.8g} {:.8g}\n", x_of(i, curve), y.at(height));
        const auto found = outcomes_[i].numbers.find(chart_.y[row]);
        if (outcomes_[i].status == Outcome::Status::converged && found != outcomes_[i].numbers.end() &&
            std::isfinite(found->second))
          points.emplace_back(x_of(i, curve), found->second);
      }
      std::ranges::sort(points);
      std::string text;
      for (const auto& [x, value] : points) text += fmt::format("{:.8g} {:.8g}\n", x, value);
      // A line through random values of several axes, or through words, would say that they are neighbours.
      const char* const form = study_.axes[chart_.x].sampled || of_words() ? "points" : "linespoints";
      add(text, fmt::format("with {} {}", form, style_of(curve)));
      for (const auto& [status, where] : crosses)
        add(where, fmt::format("with points pt {} ps 0.8 lw 2 lc rgb '{}'",
                               status == Outcome::Status::diverged  ? 2
                               : status == Outcome::Status::stalled ? 1
                                                                    : 3,
                               colours[curve % colours.size()]));
    }
    return data + (list.empty() ? "plot NaN notitle" : list) + "\n";
  }

  std::string style_of(std::size_t curve) const {
    return fmt::format("lw 2 pt {} ps 0.8 lc rgb '{}'", markers[curve % markers.size()],
                       colours[curve % colours.size()]);
  }

  /// Words speak for themselves, numbers need the name of what they are.
  static std::string series_name(const Axis& axis, const AxisValue& value) {
    return value.number ? axis.name + " = " + value.text : value.text;
  }

  /// One for all panels: an empty plot over the whole picture.
  std::string key() const {
    if (!chart_.series) return "";
    const auto& axis = study_.axes[*chart_.series];
    std::string text = fmt::format(
        "\nset lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\nset bmargin at screen "
        "0\n"
        "unset tics\nunset border\nunset xlabel\nunset ylabel\nunset title\nunset object\nunset label\nunset "
        "logscale\nset xrange [0:1]\nset yrange [0:1]\nset key at screen 0.5, screen {:.4f} center center "
        "horizontal "
        "samplen 2 font ',14' textcolor rgb '#24313d'\nplot ",
        1 - 45. / height());
    for (std::size_t i = 0; i < axis.values.size(); ++i)
      text += fmt::format("{}NaN with linespoints {} title {} noenhanced", i ? ", \\\n  " : "", style_of(i),
                          gnuplot_text(series_name(axis, axis.values[i])));
    return text + "\n";
  }

  const Study& study_;
  const StudyChart& chart_;
  const std::vector<StudyRun>& runs_;
  const std::vector<Outcome>& outcomes_;
  Scale x_;
  mutable int blocks_ = 0;
};

/// What both pictures share, and what gnuplot must forget between them.
constexpr const char* common =
    "reset\nset border 3 lw 0.8 lc rgb '#8796a5'\nset tics nomirror out scale 0.5 textcolor rgb '#51606e'\n"
    "set grid lw 0.6 lt 1 lc rgb '#dfe5ea'\n";

}  // namespace

std::string chart_script(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes) {
  const Chart chart(study, runs, outcomes);
  std::string text = "set encoding utf8\n";
  text += fmt::format("set terminal svg size {},{} font 'Helvetica,14' enhanced rounded background rgb 'white'\n",
                      chart.width(), chart.height());
  text += fmt::format("set output 'study.svg'\n{}{}", common, chart.body());
  // Twice the pixels, for screens that have them.
  text += fmt::format(
      "set terminal pngcairo size {},{} font 'Helvetica,14' fontscale 2 linewidth 2 pointscale 2 "
      "enhanced rounded background rgb 'white'\n",
      2 * chart.width(), 2 * chart.height());
  return text + fmt::format("set output 'study.png'\n{}{}unset output\n", common, chart.body());
}

std::optional<std::string> draw_chart(const Study& study, const std::vector<StudyRun>& runs,
                                      const std::vector<Outcome>& outcomes, const fs::path& folder) {
  write_file_atomically(folder / "study.gnuplot", chart_script(study, runs, outcomes));
  for (const char* picture : {"study.svg", "study.png"}) fs::remove(folder / picture);  // those of other runs
  return draw_chart(folder, "study", "--collect");
}

}  // namespace splashdown::apps
