// Where sensors tell two states of a structure apart. Each candidate place has a signal s(t) in the reference and r(t) in another
// state, both less their first values, on the times of the reference. With D = r - s and <D, E> = int D E dt
//
//   distance    sqrt(<D, D>/max <s, s>): against the strongest signal of the reference, so that noise where nothing comes is
//               small
//   new         the same of what is left of D when its part along those of the places before it is taken away (Gram-Schmidt)
//
// Places are chosen one by one, the one with most that is new first: a Cholesky factorisation with pivots.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

/// A signal at a place in both states.
struct SensorCandidate {
  std::string name;
  std::vector<double> times, reference, other;  ///< [s], and the signal's unit
};

/// How a place tells the states apart.
struct SensorPlace {
  std::string name;
  double distance = 0;                              ///< [-]
  double arrival_reference = 0, arrival_other = 0;  ///< quantity::arrival [s]
  std::size_t rank = 0;                             ///< from 1 on; 0: not chosen
  double new_share = 0;                             ///< `new` of one that is chosen [-]
};

/// Signals of the kind, e.g. "uy", of all probes.csv rows NAME.KIND that both folders have. Throws std::runtime_error with file and
/// cure: none, or of other times.
std::vector<SensorCandidate> read_candidates(const std::filesystem::path& reference, const std::filesystem::path& other,
                                             const std::string& kind);

/// All places in the order of the candidates, the best `count` of them ranked; fewer where nothing new is left.
std::vector<SensorPlace> rank_places(const std::vector<SensorCandidate>& candidates, std::size_t count);

}  // namespace splashdown::apps
