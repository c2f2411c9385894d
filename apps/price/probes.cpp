#include "apps/price/probes.hpp"

#include <algorithm>

namespace splashdown::apps {
namespace {

// Shares of the time asked for. Where a run's time grows with the square of refine, three probes for three tenths of the time end
// 1.9 times coarser than the mesh that takes the rest. A quarter for a single one is the price of knowing how time grows at
// all, or of a mesh that uses the time up.
constexpr double first_probe_share = 0.05, all_share = 0.3, single_share = 0.25;
constexpr double least_used = 0.9;  // less is worth another probe
/// From the last probe to the mesh that is chosen: 2^(2/2) = `farthest_run`.
constexpr int farthest_step = 2;

}  // namespace

int first_probe(double asked, ProbeRange range, int usual, const SecondsOf& guessed) {
  int k = std::clamp(usual, range.coarsest, range.finest);
  while (k > range.coarsest && guessed(k) > first_probe_share * asked) --k;
  return k;
}

std::optional<int> next_probe(double asked, ProbeRange range, const ProbesMade& made, const SecondsOf& predicted) {
  const int next = made.finest + 1;
  if (next > range.finest) return {};
  if (made.spent + predicted(next) <= all_share * asked) return next;
  if (made.count == 1 && predicted(next) <= single_share * asked) return next;
  // No mesh in reach takes the time: one that may be chosen in reach of the next has to be paid for, too.
  const bool out_of_reach = made.spent + predicted(made.finest + farthest_step) < least_used * asked;
  if (out_of_reach && made.spent + 2 * predicted(next) <= asked) return next;
  return {};
}

}  // namespace splashdown::apps
