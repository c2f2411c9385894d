// Fractions of two-level factorial designs: which effects cannot be told apart (Box and Hunter 1961).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splashdown::apps {

/// Axes of two values by their bits; the sign of a run in such a set is the product of the signs of its axes, first value -1, second +1.
using Factors = std::uint64_t;

/// "a * b * c" with names by bit; 1 for no factor.
std::string product_text(Factors factors, const std::vector<std::string>& names);

/// A fraction by its generators, each a set of factors whose sign is +1 in all runs.
class Fraction {
 public:
  explicit Fraction(std::vector<Factors> generators);

  /// All products of generators but the empty one: what is +1 in every run. Linearly dependent generators give 0 among them.
  const std::vector<Factors>& words() const { return words_; }
  /// Factors in the shortest word: III confuses single effects with pairs, IV pairs with pairs, V pairs with triples. 0: no fraction.
  int resolution() const;
  /// Effects of at most `most` factors that these runs do not tell from this one.
  std::vector<Factors> aliases(Factors effect, int most) const;
  /// The one that stands for this effect and its aliases: fewest factors, then lowest bits.
  Factors representative(Factors effect) const;

 private:
  std::vector<Factors> words_;
};

}  // namespace splashdown::apps
