#include "apps/price/probes.hpp"

#include <algorithm>

namespace splashdown::apps {
namespace {

// Shares of the time asked for. Where a run's time grows with the square of refine, three probes for three tenths of the time end
// 1.9 times coarser than the mesh that takes the rest. A quarter for a single one is the price of knowing how time grows at
// all, or of a mesh that uses the time up.
constexpr double first_probe_share = 0.05, all_share = 0.3, single_share = 0.25;
/// To the last probe, where those between would leave no room for it: twice as fine. On it hangs what may be chosen, and what it takes
/// is not known farther.
constexpr int longest_stride = 2;
/// Of what is left, for a run that nothing but the guess speaks for.
constexpr double sure_share = 0.7;
/// What a start says of a whole run: less says nothing.
constexpr double least_part = 0.01;

}  // namespace

int first_probe(double asked, ProbeRange range, int usual, const SecondsOf& guessed) {
  int k = std::clamp(usual, range.coarsest, range.finest);
  while (k > range.coarsest && guessed(k) > first_probe_share * asked) --k;
  return k;
}

std::optional<int> next_probe(double asked, ProbeRange range, const ProbesMade& made, const SecondsOf& predicted) {
  const int next = made.finest + 1;
  if (next > range.finest) return {};
  const auto fits = [&](double seconds) { return made.spent + seconds <= all_share * asked; };
  int last = std::min(made.finest + longest_stride, range.finest);
  while (last > made.finest && !fits(predicted(last))) --last;
  if (last > made.finest) return last == next || fits(predicted(next) + predicted(last)) ? next : last;
  if (made.count == 1 && predicted(next) <= single_share * asked && made.spent + predicted(next) <= most_share * asked)
    return next;
  return {};
}

std::optional<PlannedProbe> ProbePlan::next(const ProbesMade& made, const SecondsOf& predicted) {
  if (last_.is_run || (stopped_ && made.count > 0) || guess_.range.coarsest > guess_.range.finest) return {};
  if (made.spent >= asked_) return {};
  const double room = most_share * asked_ - made.spent;
  if (made.count == 0) return last_ = first(room, asked_ - made.spent);
  const auto mesh = next_probe(asked_, guess_.range, made, predicted);
  if (!mesh) return {};
  return last_ = {.mesh = *mesh, .expected = predicted(*mesh), .most = room};
}

PlannedProbe ProbePlan::first(double room, double left) const {
  if (stopped_) return run_by_guess(left);
  const int k = first_probe(asked_, guess_.range, guess_.usual, guess_.seconds);
  if (guess_.seconds(k) > room) return run_by_guess(left);
  return {.mesh = k, .expected = guess_.seconds(k), .most = room};
}

PlannedProbe ProbePlan::run_by_guess(double left) const {
  const auto expected = [&](int k) { return off_ * guess_.seconds(k) - (stopped_ == k ? done_ : 0); };
  int k = stopped_.value_or(guess_.range.coarsest);
  while (k > guess_.range.coarsest && expected(k) > sure_share * left) --k;
  return {.mesh = k, .expected = expected(k), .most = left, .is_run = true};
}

void ProbePlan::stopped(double seconds, double share) {
  stopped_ = last_.mesh;
  done_ = seconds;
  off_ = std::max(1., seconds / std::max(share, least_part) / guess_.seconds(last_.mesh));
}

void ProbePlan::failed() {
  guess_.range.coarsest = last_.mesh + 1;
  guess_.usual = std::max(guess_.usual, guess_.range.coarsest);
}

}  // namespace splashdown::apps
