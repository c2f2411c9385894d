// Figures by gnuplot: data and script files in a folder, one subprocess for all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

struct Curve {
  std::string label;  ///< empty: not in the key
  std::vector<double> x, y;
  std::string colour;  ///< #rrggbb
  double width = 1.6;
  bool right_axis = false;
  bool steps = false;                   ///< constant until the next point
  bool points = false;                  ///< dots, not joined
  std::vector<std::string> links = {};  ///< where a click on a point leads; empty: nowhere
};

/// A labelled point, e.g. a peak.
struct Mark {
  double x, y;
  std::string text;
};

/// A piece of the x axis that is shaded, e.g. a pulse.
struct Stretch {
  double from, to;
  std::string text;
};

/// A value that is drawn right across, e.g. a limit.
struct Level {
  double y;
  std::string text;
};

/// What lies between two curves, behind all others, e.g. what theories say.
struct Between {
  std::string text;
  std::vector<double> x, low, high;
};

struct Figure {
  std::string name;  ///< of its files
  std::string x_label, y_label, y2_label;
  std::vector<Curve> curves;
  std::vector<Mark> marks;
  std::vector<Stretch> stretches;
  std::vector<Level> levels;
  std::vector<Between> between;
  bool over_time = false;  ///< x is the run's time, in the unit of all such figures of the run
  bool zero_line = true;
  bool counts = false;  ///< the left axis counts something: from zero, whole numbers
  bool log_y = false;   ///< the left axis is logarithmic, in whole decades; what is not positive is left out
  std::string caption;  ///< HTML below the figure
};

/// The left or the right axis: from its lowest value to its highest with a margin; reversed if there is none.
struct AxisRange {
  double low, high;
};
AxisRange axis_range(const Figure& figure, bool right_axis);

/// Writes NAME.dat for each figure; the commands that draw NAME.svg.
std::string script_of(const std::filesystem::path& folder, const std::vector<Figure>& figures);

enum class GnuplotResult { drawn, missing, failed };
/// Runs gnuplot on each script (file names in `folder`) with the folder as working directory, output to
/// SCRIPT.log; as many at a time as there are cores.
std::vector<GnuplotResult> run_gnuplot(const std::filesystem::path& folder, const std::vector<std::string>& scripts);

/// Runs the script NAME.gnuplot in `folder`: why there is no chart; nothing: it is drawn. `again`: what draws it once gnuplot is there,
/// as in "the same command".
std::optional<std::string> draw_chart(const std::filesystem::path& folder, const std::string& name,
                                      const std::string& again);

/// A gnuplot string with its quotes: single ones, between which gnuplot expands nothing. (Between double quotes it runs
/// what stands in backquotes.) Markup is off wherever such a text is shown.
std::string gnuplot_text(const std::string& text);

}  // namespace splashdown::apps
