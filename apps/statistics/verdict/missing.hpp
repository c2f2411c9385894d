// What a scene asks for and its run has not.
//
//   a body that moves never met the water, and no joint ties it to one that did      unresolved: there is no load to judge
//   the load on a free body still rises when the run ends                           unresolved: its peak comes later
//   the same of a body that moves as prescribed, or is held                          told: the load is that of this instant
//   a body that is held, one that others may carry, a record: never met the water   told, and unresolved if nothing else did
//   the run was interrupted, or ends before a path does                              told
//   a free body dived by more than its length, or swung afloat for long, and no form drag took part   told
//   a new mesh around bodies was wanted and could not be had                        told
//
// Told: a sentence among the reasons that leaves the grade as it is. In a scene without water nothing of this is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

struct Missing {
  Grade grade = Grade::resolved;
  std::string reason;
  std::string body;           ///< that it concerns alone; empty: the run
  std::string doubt, advice;  ///< in plain words; empty: nothing is doubted, told by others
};

std::vector<Missing> missing(const Summary& summary);

/// Whether the peak of a body's load is still to come.
bool peak_is_to_come(const Summary& summary, const std::string& body);

/// When the run should end for what is missing to happen [s]: the guessed contact and half as long again, or as long again after contact as
/// it was until now. Nothing: nothing is missing, or no time brings it.
std::optional<double> end_to_ask_for(const Summary& summary);

}  // namespace splashdown::apps
