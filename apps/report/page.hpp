// What the pages of runs and studies share: the look, the heading with its verdict, tiles, figures held in
// the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/words.hpp"

namespace splashdown::apps {

inline constexpr const char* no_gnuplot =
    "gnuplot is not installed, so there are no pictures. Install it with \"sudo apt install gnuplot-nox\" and "
    "run "
    "\"splashdown report\" again.";

/// One file without links to elsewhere. `content` is HTML.
std::string html_page(const std::string& title, const std::string& content);

/// Title, folder, verdict, then warnings (HTML).
std::string html_header(const std::string& title, const std::filesystem::path& directory, const Banner& banner,
                        const std::vector<std::string>& warnings);

std::string html_tile(const std::string& value, const std::string& rows,
                      const char* classes = "tile");  ///< rows: <span> elements
std::string html_tiles(const std::string& tiles);     ///< around them; nothing if there are none
std::string html_figure(const std::string& image, const std::string& caption);
/// One with small print: on narrow screens it moves sideways and stays readable.
std::string html_wide_figure(const std::string& image, const std::string& caption);
/// One whose picture a chart of the browser takes the place of (curves/charts.hpp); without scripts and in print it is there.
std::string html_chart(const std::string& name, const std::string& image, const std::string& caption);
const char* css_class(Mood mood);

/// Last part of the path, also of "." and "folder/".
std::string folder_name(const std::filesystem::path& directory);

/// An <svg> element made fit for a page with many: no prolog, ids of its own, the page's fonts.
std::string inline_svg(const std::string& svg, const std::string& name);

}  // namespace splashdown::apps
