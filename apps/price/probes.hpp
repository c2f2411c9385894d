// Which coarse runs tell what mesh takes a given time: as fine ones as three tenths of it pay for.
//
// Meshes that may be probed are the scene's own times powers of sqrt(2), so that a later call with another time finds runs that it
// can use. The first is guessed to take a twentieth of the time; the others follow one after the other. The mesh that is chosen is
// no more than twice as fine as the last: where that leaves time unused, more are made, as long as one and the run that it allows
// fit.
#pragma once

#include <functional>
#include <optional>

namespace splashdown::apps {

/// Numbers of the coarsest and the finest mesh that may be probed.
struct ProbeRange {
  int coarsest = 0, finest = 0;
};

/// Of meshes, by their number.
using SecondsOf = std::function<double(int)>;

/// The finest, up to `usual`, that is guessed to take a twentieth of the time, or the coarsest of all.
int first_probe(double asked, ProbeRange range, int usual, const SecondsOf& guessed);

struct ProbesMade {
  int count = 0;
  int finest = 0;    ///< its number
  double spent = 0;  ///< seconds
};

/// Nothing: there are enough.
std::optional<int> next_probe(double asked, ProbeRange range, const ProbesMade& made, const SecondsOf& predicted);

}  // namespace splashdown::apps
