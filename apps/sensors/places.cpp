#include "apps/sensors/places.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "apps/quantity/curves.hpp"
#include "apps/quantity/signals.hpp"

namespace splashdown::apps {
namespace {

struct ProbeSignal {
  std::vector<double> times, values;
};

/// Of probes.csv, by the name of the probe: rows time,probe,value.
std::map<std::string, ProbeSignal> probe_signals_of(const std::filesystem::path& folder) {
  const auto path = folder / "probes.csv";
  std::ifstream in(path);
  if (!in)
    throw std::runtime_error(
        fmt::format("{}: cannot be read. Give the folder of a run whose scene has points.", path.string()));
  std::map<std::string, ProbeSignal> all;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto one = line.find(','), two = line.rfind(',');
    if (one == std::string::npos || one == two) continue;
    auto& signal = all[line.substr(one + 1, two - one - 1)];
    signal.times.push_back(std::stod(line.substr(0, one)));
    signal.values.push_back(std::stod(line.substr(two + 1)));
  }
  return all;
}

std::string signal_kinds_of(const std::map<std::string, ProbeSignal>& probes) {
  std::set<std::string> kinds;
  for (const auto& [name, signal] : probes)
    if (const auto dot = name.rfind('.'); dot != std::string::npos) kinds.insert(name.substr(dot + 1));
  std::string text;
  for (const auto& kind : kinds) text += (text.empty() ? "" : ", ") + kind;
  return text.empty() ? "none" : text;
}

double inner_product_of(const std::vector<double>& times, const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> both(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) both[i] = a[i] * b[i];
  return quantity::integral(both, times);
}

}  // namespace

std::vector<SensorCandidate> read_candidates(const std::filesystem::path& reference, const std::filesystem::path& other,
                                             const std::string& kind) {
  const auto first = probe_signals_of(reference), second = probe_signals_of(other);
  std::vector<SensorCandidate> all;
  for (const auto& [name, signal] : first) {
    const auto found = second.find(name);
    if (!name.ends_with("." + kind) || found == second.end()) continue;
    // Times of the reference that both runs have.
    const double end = std::min(signal.times.back(), found->second.times.back());
    SensorCandidate candidate{name, {}, {}, {}};
    for (std::size_t i = 0; i < signal.times.size() && signal.times[i] <= end; ++i) {
      candidate.times.push_back(signal.times[i]);
      candidate.reference.push_back(signal.values[i]);
    }
    if (candidate.times.size() < 2 || found->second.times.size() < 2)
      throw std::runtime_error(fmt::format("{}: {} has too few rows in common. Let both runs have the same end.",
                                           (other / "probes.csv").string(), name));
    // States at rest may differ already: what counts is what comes.
    const auto from_first = [](std::vector<double>& values) {
      for (double first = values.front(); double& value : values) value -= first;
    };
    candidate.other = quantity::interpolated(found->second.times, found->second.values, candidate.times);
    from_first(candidate.reference);
    from_first(candidate.other);
    all.push_back(std::move(candidate));
  }
  if (all.empty())
    throw std::runtime_error(
        fmt::format("{}: both runs have no signals '{}' in common. Those of the first are of the kinds {}.",
                    (reference / "probes.csv").string(), kind, signal_kinds_of(first)));
  return all;
}

std::vector<SensorPlace> rank_places(const std::vector<SensorCandidate>& candidates, std::size_t count) {
  const auto n = static_cast<Eigen::Index>(candidates.size());
  std::vector<std::vector<double>> differences;
  double strongest = 0;
  for (const auto& candidate : candidates) {
    auto& difference = differences.emplace_back(candidate.other);
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= candidate.reference[i];
    strongest = std::max(strongest, inner_product_of(candidate.times, candidate.reference, candidate.reference));
  }
  if (!(strongest > 0)) throw std::runtime_error("the reference has no signal. Let it run longer.");
  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k <= i; ++k)
      gram(i, k) = gram(k, i) =
          inner_product_of(candidates[static_cast<std::size_t>(i)].times, differences[static_cast<std::size_t>(i)],
                           differences[static_cast<std::size_t>(k)]) /
          strongest;
  std::vector<SensorPlace> places;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    places.push_back({.name = candidates[i].name,
                      .distance = std::sqrt(gram(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i))),
                      .arrival_reference = quantity::arrival(candidates[i].reference, candidates[i].times),
                      .arrival_other = quantity::arrival(candidates[i].other, candidates[i].times)});
  constexpr double nothing = 1e-12;  // of the largest square: roundoff of sums of thousands
  const double least = nothing * gram.diagonal().maxCoeff();
  for (std::size_t rank = 1; rank <= std::min(count, places.size()); ++rank) {
    Eigen::Index best = 0;
    const double most = gram.diagonal().maxCoeff(&best);
    if (!(most > least)) break;
    places[static_cast<std::size_t>(best)].rank = rank;
    places[static_cast<std::size_t>(best)].new_share = std::sqrt(most);
    const Eigen::VectorXd along = gram.col(best);
    gram -= along * along.transpose() / most;
    gram(best, best) = 0;
  }
  return places;
}

}  // namespace splashdown::apps
