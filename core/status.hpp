// Numerical trouble is reported, not thrown: the step is refused and the caller decides.
#pragma once

#include <string>

namespace splashdown {

/// Why a step may be refused. `cause` is empty when all is well.
struct Status {
  std::string cause;  ///< what went wrong, for the user; empty: nothing
  /// Whether the step may go on.
  bool ok() const { return cause.empty(); }
};

}  // namespace splashdown
