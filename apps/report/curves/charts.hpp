// Curves of a page that can be read off: drawn in the browser by dygraphs, with zoom and one cursor for all.
//
// What is packed is what the eye can see: the lowest and the highest point of each of 1500 pieces of a curve, less what lies on the
// straight line between others to 1/5000 of the axis. It is one zlib stream in base64, which the browser unpacks (Compression Streams).
// Without scripts, and in print, the pictures of the same figures stand there.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

/// What a page needs to draw its curves in the browser.
struct Charts {
  std::string html;             ///< data and scripts, once for a page; empty: none
  std::set<std::string> drawn;  ///< names of the figures that are in it
  std::vector<std::string> warnings;
};

/// `seconds`: of the unit of figures over time. `later`: other scripts of the page draw more (event 'splashdown:draw', charts.js), so that
/// what draws is there even without a figure.
Charts charts_of(const std::vector<Figure>& figures, double seconds, bool later = false);

/// JSON: {"seconds", "charts": [{"name", "x", "y", "y2", "time", "log", "range", "range2", "curves": [{"label", "colour", "width", "x", "y"}],
/// "marks", "stretches", "levels", "between"}]}; colours are CSS variables where the page has one.
std::string charts_json(const std::vector<Figure>& figures, double seconds);

}  // namespace splashdown::apps
