#include "apps/price/means/replicates.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::apps {
namespace {

bool is_in(const std::vector<double>& refines, double refine) {
  return std::ranges::any_of(refines, [&](double other) { return digits_of(other) == digits_of(refine); });
}

/// Seconds of all finer meshes up to the one of which a single run is expected to have the accuracy.
double single_seconds(const Price& price, const BandWanted& wanted, const std::vector<double>& finer) {
  const auto refine = wanted.by_mean ? std::nullopt : price.refine_for(wanted.accuracy);
  if (!refine || finer.empty() || *refine > finer.back()) return HUGE_VAL;
  double seconds = 0;
  for (const double next : finer) {
    seconds += *price.seconds(next);
    if (next >= *refine) break;
  }
  return seconds;
}

class Climb {
 public:
  Climb(Ladder& ladder, const BandWanted& wanted)
      : ladder_(ladder), wanted_(wanted), finer_(wanted.finer), replicates_(ladder) {}

  void go() {
    for (auto price = wanted_.price(); !price.rungs.empty() && !is_reached(price); price = wanted_.price())
      if (!step(price)) return;
  }

 private:
  bool is_reached(const Price& price) const {
    return wanted_.by_mean ? price.is_reached_by_mean(wanted_.accuracy) : price.is_reached(wanted_.accuracy);
  }

  /// False: there is nothing left to make, or no time for it.
  bool step(const Price& price) {
    std::erase_if(finer_, [&](double refine) { return refine <= price.finest(); });
    LadderState state{.sizes = price.sizes(),
                      .finer = {},
                      .single_seconds = single_seconds(price, wanted_, finer_),
                      .seconds_since_finer = since_finer_};
    if (!finer_.empty()) state.finer = {1 / finer_.front(), *price.seconds(finer_.front()), 0};
    const auto next = next_runs(state, price.expected_of_mean(), wanted_.accuracy);
    if (!next) return false;
    if (next->size < state.sizes.size()) return add(price, state.sizes[next->size], next->runs);
    const double refine = finer_.front();
    finer_.erase(finer_.begin());  // made or not, it is not tried again
    since_finer_ = 0;
    return ladder_.climb({refine, Role::rung});
  }

  bool add(const Price& price, const SizeOfMesh& size, int runs) {
    for (int k = 0; k < runs; ++k) {
      if (!replicates_.add(1 / size.h, price.rungs)) return k > 0;
      since_finer_ += size.seconds;
    }
    return true;
  }

  Ladder& ladder_;
  const BandWanted& wanted_;
  std::vector<double> finer_;
  Replicates replicates_;
  double since_finer_ = 0;
};

}  // namespace

bool Replicates::add(double refine, const std::vector<Rung>& made) {
  for (int k = 0; k + 1 < most_of_size; ++k) {
    const RungSpec spec{replicate_refine(refine, k), Role::replicate};
    const bool there = std::ranges::any_of(made, [&](const Rung& rung) {
      return rung.spec.role != Role::larger_tank && digits_of(rung.spec.refine) == digits_of(spec.refine);
    });
    if (there || is_in(tried_, spec.refine)) continue;
    tried_.push_back(spec.refine);
    if (!ladder_.allow(spec)) continue;
    const auto before = ladder_.made().size();
    if (!ladder_.climb(spec)) return false;
    if (ladder_.made().size() > before) return true;
  }
  return false;
}

void climb_to(Ladder& ladder, const BandWanted& wanted) { Climb(ladder, wanted).go(); }

}  // namespace splashdown::apps
