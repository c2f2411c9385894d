// How the plain values of summaries go into checkpoints.
#pragma once

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

template <class Archive>
void serialize(Archive& archive, Peak& peak) {
  archive(peak.value, peak.time);
}

template <class Archive>
void serialize(Archive& archive, GoalSummary& goal) {
  archive(goal.name, goal.value, goal.error, goal.unit);
}

template <class Archive>
void serialize(Archive& archive, RangeCount& count) {
  archive(count.initial, count.max, count.final);
}

}  // namespace splashdown::apps
