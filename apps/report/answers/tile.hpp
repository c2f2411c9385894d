// A tile of the card of answers: a number in large print, and what is said of it.
#pragma once

#include <string>

#include "apps/report/words.hpp"

namespace splashdown::apps {

/// What a tile says of its number, a row each.
struct Lines {
  std::string html;
  void add(const std::string& text, const char* style = "");
  void add(const GradeWords& grade);
};

/// A wide one takes two columns where there are several.
std::string tile(const std::string& value, const Lines& lines, bool wide = false);

}  // namespace splashdown::apps
