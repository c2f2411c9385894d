// Which coarse runs tell what mesh takes a given time: as fine ones as three tenths of it pay for.
//
// Meshes that may be probed are the scene's own times powers of sqrt(2), so that a later call with another time finds runs that it
// can use. The first is guessed to take a twentieth of the time; the others follow one after the other, and at a longer stride to
// the last one where those between would leave no room for it. The mesh that is chosen is no more than twice as fine as the last.
//
// Guesses may be wrong by an order of magnitude, so probes are stopped at a third of the time, all together. One that was stopped
// tells by how much the guess is off, at least, and goes on as the run where there is no other and the rest of the time seems to do. With none that reached its end, and where even the coarsest is guessed to take
// more than a third, there are no probes: the run itself is made on the mesh that the guess, so corrected, allows.
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

/// Probes take this share of the time at most, together.
inline constexpr double most_share = 1. / 3;

struct PlannedProbe {
  int mesh = 0;
  double expected = 0;  ///< seconds, what is left of one that was begun
  double most = 0;      ///< seconds after which it is stopped
  bool is_run = false;  ///< no probe: what was asked for, by the guess alone
};

/// The probes of a given time, one after the other.
class ProbePlan {
 public:
  struct Guess {
    ProbeRange range;
    int usual = 0;      ///< the finest to begin with
    SecondsOf seconds;  ///< before any run is made
  };
  /// `asked`: seconds, of which at most `most_share` go to probes.
  ProbePlan(double asked, Guess guess) : asked_(asked), guess_(std::move(guess)) {}

  /// Nothing: a mesh can be chosen by those made. `predicted` is asked only where there is one.
  std::optional<PlannedProbe> next(const ProbesMade& made, const SecondsOf& predicted);
  /// The probe that was planned last was stopped after these seconds, with this share of its simulated time.
  void stopped(double seconds, double share);
  /// It could not go on to its end: the next is finer.
  void failed();

 private:
  PlannedProbe first(double room, double left) const;
  PlannedProbe run_by_guess(double left) const;

  double asked_;
  Guess guess_;
  double off_ = 1;  ///< seconds of a probe over its guess, at least
  PlannedProbe last_;
  std::optional<int> stopped_;
  double done_ = 0;  ///< seconds of the one that was stopped
};

}  // namespace splashdown::apps
