// Keys and words that scenes of the other dimension have: found in what its reader asks for (sketch.hpp), so that none is listed twice.
#pragma once

#include <string>
#include <string_view>

namespace splashdown::apps {

/// "in the plane only (dimension = 2)" of a key that scenes of the other dimension have in tables of this header, and scenes of
/// this dimension never; nothing of other keys.
std::string elsewhere(int dimension, const std::string& header, std::string_view key);

/// The same of a word that the key may be there alone.
std::string word_elsewhere(int dimension, const std::string& header, std::string_view key, std::string_view word);

}  // namespace splashdown::apps
