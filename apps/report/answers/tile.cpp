#include "apps/report/answers/tile.hpp"

#include <fmt/format.h>

#include "apps/report/page.hpp"

namespace splashdown::apps {

void Lines::add(const std::string& text, const char* style) {
  if (text.empty()) return;
  html += fmt::format("<span{}>{}</span>", *style ? fmt::format(" class=\"{}\"", style) : "", text);
}

void Lines::add(const GradeWords& grade) {
  if (!grade.words.empty()) add(html_escaped(grade.words), css_class(grade.mood));
}

std::string tile(const std::string& value, const Lines& lines, bool wide) {
  return html_tile(value, lines.html, wide ? "tile wide" : "tile");
}

}  // namespace splashdown::apps
