#include "apps/scene/read/dimensions.hpp"

#include <algorithm>
#include <array>

#include "apps/scene/read/read.hpp"
#include "apps/scene/sketch.hpp"

namespace splashdown::apps {
namespace {

const Sketch& sketch_of(int dimension) {
  static const auto both = [] {
    std::array<Sketch, 2> sketches;
    for (const int d : {2, 3}) sketch_scene(sketches[static_cast<std::size_t>(d - 2)], d);
    return sketches;
  }();
  return both[static_cast<std::size_t>(dimension - 2)];
}

bool has_key(int dimension, const std::string& header, std::string_view key) {
  const auto* visits = sketch_of(dimension).find(header);
  return visits && std::ranges::any_of(*visits, [&](const auto& visit) { return visit.keys.contains(key); });
}

bool has_word(int dimension, const std::string& header, std::string_view key, std::string_view word) {
  const auto* visits = sketch_of(dimension).find(header);
  return visits && std::ranges::any_of(*visits, [&](const auto& visit) {
           const auto found = visit.keys.find(key);
           return found != visit.keys.end() && std::ranges::any_of(found->second.any_of, [&](const Wanted& wanted) {
                    return std::ranges::find(wanted.words, word) != wanted.words.end();
                  });
         });
}

std::string only_in(int dimension) {
  return dimension == 2 ? "in the plane only (dimension = 2)" : "in space only (dimension = 3)";
}

}  // namespace

std::string elsewhere(int dimension, const std::string& header, std::string_view key) {
  const int other = 5 - dimension;
  return has_key(other, header, key) && !has_key(dimension, header, key) ? only_in(other) : std::string();
}

std::string word_elsewhere(int dimension, const std::string& header, std::string_view key, std::string_view word) {
  const int other = 5 - dimension;
  return has_word(other, header, key, word) && !has_word(dimension, header, key, word) ? only_in(other) : std::string();
}

}  // namespace splashdown::apps
