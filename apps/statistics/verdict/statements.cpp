#include "apps/statistics/verdict/statements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "apps/statistics/verdict/missing.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/share.hpp"

namespace splashdown::apps {

namespace {

/// Above it the digits of a percentage say more than is known.
constexpr double most_said = 0.5;
constexpr double order_of_magnitude = 1;  // of the value
constexpr double a_hair = 1e-9;

struct Fraction {
  double most;
  const char* words;
};
constexpr std::array<Fraction, 3> fractions = {{{1. / 4, "a quarter"}, {1. / 3, "a third"}, {1. / 2, "half"}}};
constexpr double fractions_above = 0.2;

/// What no band says; empty: the band says it.
std::string ruling(const Summary& summary, const std::string& name, const Headline& headline) {
  const auto& number = *headline.grade;
  if (summary.status == "failed") return "the run could not go on";
  if (peak_is_to_come(summary, name)) return "it still rises when the run ends";
  if (headline.is_impulse) return "the load is an impulse: no mesh gives its peak a value";
  const auto of_water = summary.bodies.at(name).of_water;
  if (of_water != Grade::resolved && of_water == number.grade && grade_of_band(number.band) < of_water)
    return "the water's energy or volume is wrong";
  return {};
}

std::string bracket_of(const Summary& summary, const std::string& name, const Headline& headline) {
  const auto& number = *headline.grade;
  if (number.grade == Grade::resolved) return band_words(number.band);
  if (auto rule = ruling(summary, name, headline); !rule.empty()) return rule;
  return band_words(number.band) + (number.causes.empty() ? "" : ": " + number.causes.front());
}

std::string owner(const std::string& body, bool several) { return several ? body + ": " : ""; }

/// "left: " of a statement about a body; empty: of none.
std::string owner_in(const std::string& statement) {
  const auto colon = statement.find(": ");
  return colon < statement.find(" (") ? statement.substr(0, colon + 2) : "";
}

/// Where the brackets begin that a statement ends with; npos: none.
std::size_t brackets_at(const std::string& statement) {
  return statement.ends_with(")") ? statement.find(" (") : std::string::npos;
}

}  // namespace

std::string band_words(double band) {
  if (!std::isfinite(band)) return "has no band";
  if (band <= doubtful_band) return "within " + share_text(band);
  if (band <= fractions_above) return "may be off by " + share_text(band);
  for (const auto& [most, words] : fractions)
    if (band <= most * (1 + a_hair)) return fmt::format("may be off by {}", words);
  return band <= order_of_magnitude ? "may be off by half and more" : "tells no more than the order of magnitude";
}

std::string band_mark(double band, const std::string& sign) {
  if (!std::isfinite(band)) return "no band";
  if (band <= most_said) return sign + share_text(band);
  return band <= order_of_magnitude ? "off by half and more" : "order of magnitude";
}

std::string part_words(double share) {
  if (std::abs(share) <= most_said) return share_text(std::abs(share));
  return std::isfinite(share) ? "more than half" : "no telling how much";
}

std::string statement_of(const Summary& summary, const std::string& body, const Headline& headline, bool several) {
  return fmt::format("{}{} {} ({}{})", owner(body, several), headline.what, headline.value,
                     headline.filter.empty() ? "" : headline.filter + ", ", bracket_of(summary, body, headline));
}

std::string further_causes(const Summary& summary, const std::string& body, const Headline& headline, bool several) {
  const auto& causes = headline.grade->causes;
  if (causes.size() < 2 || !ruling(summary, body, headline).empty()) return {};
  return fmt::format("{}{} (also {})", owner(body, several), headline.what,
                     fmt::join(causes.begin() + 1, causes.end(), "; "));
}

std::vector<std::string> grouped(const std::vector<std::string>& statements) {
  std::vector<std::string> groups;
  std::string open, last;  // last: of whom it was
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const auto& statement = statements[i];
    const auto at = brackets_at(statement);
    const auto next = i + 1 < statements.size() ? brackets_at(statements[i + 1]) : std::string::npos;
    const bool shared = at != std::string::npos && next != std::string::npos &&
                        std::string_view(statement).substr(at) == std::string_view(statements[i + 1]).substr(next);
    const auto whose = owner_in(statement);
    auto text = shared ? statement.substr(0, at) : statement;
    if (!open.empty() && whose == last) text.erase(0, whose.size());
    open += (open.empty() ? "" : ", ") + text;
    last = whose;
    if (!shared) groups.push_back(std::exchange(open, {}));
  }
  return groups;
}

std::vector<std::string> advice_of(const Summary& summary) {
  std::vector<std::string> list;
  const auto& verdict = summary.verdict;
  // The next step is the cure of what is doubtful; what is unphysical comes before it.
  const bool interrupted = summary.status == "interrupted";
  if ((!summary.next && !interrupted) || verdict.grade == Grade::unphysical) list = verdict.advice;
  if (summary.next) list.push_back(text_of(*summary.next));
  if (interrupted) list.emplace_back("go on with --resume");
  if (!list.empty()) return list;
  for (const auto& [name, body] : summary.bodies)
    if (std::ranges::any_of(headlines(summary, name), &Headline::is_impulse))
      return {"read the impulse: no mesh gives the peak a value"};
  if (!verdict.doubted.empty()) return {"compare with a run of half the element size"};
  if (!summary.ledger) return {"nothing: there is no water"};
  const bool graded =
      std::ranges::any_of(summary.bodies, [](const auto& body) { return !body.second.verdict.about.empty(); });
  return {graded ? "nothing more: all that is graded is resolved"
                 : "no load is graded: compare with a run of half the element size before you quote a number"};
}

}  // namespace splashdown::apps
