// How a run ended: what only the step loop knows and the summary reports.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace splashdown::apps {

/// An effect of the catalogue: at work in this scene, or absent, and why it matters or does not.
struct EffectNote {
  std::string name;    ///< "gravity", "viscosity" ...
  bool active = false;
  std::string reason;  ///< one line with the number that decides, e.g. "Re = 3.1e6: boundary layer 0.2 mm"
};

struct RunOutcome {
  enum class Status { done, interrupted, failed };
  Status status = Status::done;
  std::string cause;                         ///< why it was interrupted or failed; empty when done
  double time = 0;                           ///< simulated [s]
  long steps = 0;                            ///< committed since t = 0, resumed parts included
  double wall_seconds = 0;                   ///< since t = 0, resumed parts included
  std::map<std::string, int> rejected;       ///< refused steps by cause
  std::vector<std::pair<std::string, double>> phases;  ///< seconds a phase; they sum to wall_seconds
  std::vector<EffectNote> effects;
  std::string scheme, interface_term;        ///< empty when nothing is coupled
};

}  // namespace splashdown::apps
