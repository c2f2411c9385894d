#include "apps/report/look/theme.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdio>
#include <utility>

namespace splashdown::apps {
namespace {

struct ThemeColour {
  const char *variable, *light, *dark;
};

constexpr ThemeColour theme_colours[] = {
    // Page.
    {"--ink", "#17222d", "#e6edf3"},
    {"--soft", "#51606e", "#a3b3c1"},
    {"--line", "#e1e7ec", "#2c3a47"},
    {"--paper", "#ffffff", "#18222c"},
    {"--ground", "#f4f7f9", "#10171e"},
    {"--link", "#2470b0", "#6fb4ea"},
    {"--code", "#eef2f5", "#26333f"},
    {"--good", "#2b7d62", "#5cc9a2"},
    {"--fair", "#a56a00", "#e8b04b"},
    {"--bad", "#b8354a", "#f2828f"},
    {"--fair-ground", "#fff8e8", "#2a2416"},
    {"--fair-line", "#f0dfb4", "#4b3d1c"},
    {"--bad-ground", "#fdf0f1", "#2e1b20"},
    // Pictures; "-1": those of studies, prices and ablations (Okabe and Ito 2008).
    {"--c-ink", "#0f2f4f", "#d3e3f2"},
    {"--c-blue", "#2f7fc1", "#5aa9e6"},
    {"--c-red", "#d1495b", "#f0707f"},
    {"--c-green", "#3a9d7c", "#4fc3a0"},
    {"--c-amber", "#d98e04", "#f0ae3c"},
    {"--c-violet", "#7b5ea7", "#b196e0"},
    {"--c-grey", "#b9c3cc", "#66757f"},
    {"--c-axis", "#8796a5", "#6c7d8d"},
    {"--c-pulse", "#f7efd8", "#302a1b"},
    {"--c-theory", "#dbe9f4", "#203040"},
    {"--c-blue-1", "#0072b2", "#4aa3df"},
    {"--c-orange-1", "#d55e00", "#f08a4b"},
    {"--c-green-1", "#009e73", "#2fc79d"},
    // Of the page again, after the pictures whose colours they share.
    {"--heat", "#2f7fc1", "#2469a3"},
    {"--good-edge", "#3a9d7c", "#3a9d7c"},
    {"--fair-edge", "#d98e04", "#d98e04"},
    {"--bad-edge", "#d1495b", "#d1495b"},
};

/// Shades of pictures that stand for a colour that the page has anyway.
constexpr std::pair<std::string_view, std::string_view> aliases[] = {
    {"#24313d", "--ink"},  {"#000000", "--ink"}, {"#e3e8ed", "--line"},
    {"#dfe5ea", "--line"}, {"#fff", "--paper"},  {"#fdeef0", "--bad-ground"}};

/// The colour that begins at a place, "#rrggbb" or "rgb( 15,  47,  79)" as "#rrggbb", and where it ends; no text if none does.
struct Found {
  std::string colour;
  std::size_t end = 0;
};
Found colour_at(const std::string& text, std::size_t at) {
  if (text[at] == '#') {
    std::size_t end = at + 1;
    while (end < text.size() && std::isxdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    return {text.substr(at, end - at), end};
  }
  unsigned red = 0, green = 0, blue = 0;
  int length = 0;
  if (text.compare(at, 4, "rgb(") != 0 ||
      std::sscanf(text.c_str() + at, "rgb( %u , %u , %u )%n", &red, &green, &blue, &length) != 3 || length == 0)
    return {};
  return {fmt::format("#{:02x}{:02x}{:02x}", red, green, blue), at + static_cast<std::size_t>(length)};
}

std::string variables(const char* ThemeColour::*of) {
  std::string rules;
  for (const auto& colour : theme_colours) rules += fmt::format("{}:{};", colour.variable, colour.*of);
  return rules;
}

}  // namespace

std::string theme_style() {
  return fmt::format(
      ":root{{color-scheme:light dark;{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n"
      "@media print{{:root{{color-scheme:light}}}}\n",
      variables(&ThemeColour::light), variables(&ThemeColour::dark));
}

std::string_view colour_variable(std::string_view colour) {
  for (const auto& [shade, variable] : aliases)
    if (shade == colour) return variable;
  for (const auto& known : theme_colours)
    if (colour == known.light) return known.variable;
  return {};
}

std::string themed(const std::string& svg) {
  std::string result;
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return svg;
  const std::size_t inner = svg.find("<svg", begin + 1), inner_end = svg.find("</svg>", inner);
  std::size_t kept = 0;
  for (std::size_t at = svg.find_first_of("#r", begin); at != std::string::npos; at = svg.find_first_of("#r", at)) {
    if (inner_end != std::string::npos && at > inner && at < inner_end) {
      at = inner_end;
      continue;
    }
    const auto [colour, end] = colour_at(svg, at);
    const auto variable = colour.empty() ? std::string_view() : colour_variable(colour);
    if (variable.empty()) {
      ++at;
      continue;
    }
    result.append(svg, kept, at - kept).append(fmt::format("var({})", variable));
    kept = at = end;
  }
  return result.append(svg, kept);
}

}  // namespace splashdown::apps
