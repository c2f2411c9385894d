// Reads what random axes of a study are drawn from, and draws them. For read_axes.cpp alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/scene/read/reader.hpp"
#include "apps/study/design/distribution.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

/// What a random axis is drawn from, until all of them are read and can be drawn together.
struct RandomAxis {
  std::size_t axis = 0;
  Distribution distribution = {};
  /// Numbers of the distribution that depend on random axes before this one: expressions.
  std::vector<std::pair<Distribution::Part, std::string>> conditions = {};
  std::string key = {};
  double scale = 1;
  Place place = {};
  std::vector<double> weights = {};  ///< of cases; empty: values of a key
};

/// A key and its value for --set; none of a key that is missing, which is told already.
std::vector<std::string> set_text(const std::string& key, const std::string& value);

/// A range with its spacing, or a distribution of its own.
void read_random(Reader& reader, const Study& study, RandomAxis& random, const std::string& spacing);

/// Gives random axes their values. `root` is told where a distribution is none for what was drawn before it.
void draw_random(Reader& root, Study& study, const std::vector<RandomAxis>& randoms);

}  // namespace splashdown::apps
