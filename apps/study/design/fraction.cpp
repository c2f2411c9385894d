#include "apps/study/design/fraction.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace splashdown::apps {
namespace {

std::pair<int, Factors> rank(Factors factors) { return {std::popcount(factors), factors}; }

}  // namespace

std::string product_text(Factors factors, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t a = 0; a < names.size(); ++a)
    if (factors >> a & 1) text += (text.empty() ? "" : " * ") + names[a];
  return text.empty() ? "1" : text;
}

Fraction::Fraction(std::vector<Factors> generators) {
  for (const Factors generator : generators) {
    const auto before = words_;
    words_.push_back(generator);
    for (const Factors word : before) words_.push_back(word ^ generator);
  }
}

int Fraction::resolution() const {
  if (words_.empty()) return 0;
  return std::popcount(*std::ranges::min_element(words_, {}, [](Factors word) { return std::popcount(word); }));
}

std::vector<Factors> Fraction::aliases(Factors effect, int most) const {
  std::vector<Factors> found;
  for (const Factors word : words_)
    if (const Factors other = effect ^ word; std::popcount(other) <= most) found.push_back(other);
  std::ranges::sort(found, {}, rank);
  return found;
}

Factors Fraction::representative(Factors effect) const {
  Factors best = effect;
  for (const Factors word : words_)
    if (rank(effect ^ word) < rank(best)) best = effect ^ word;
  return best;
}

}  // namespace splashdown::apps
