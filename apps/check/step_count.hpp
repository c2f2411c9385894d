// How many steps a run takes, before it is made.
#pragma once

#include <vector>

#include "apps/scene/outlook/motion_guess.hpp"

namespace splashdown::apps {

/// The smallest elements limit steps by the speed of bodies and water, those that a contact line runs over by its own speed along the
/// hull. A hull that is nearly flat on the water wets its length in a blink. Needs a fluid of particle finite elements. `bodies`: the guesses
/// of all (`guessed_bodies`).
template <int d>
double predicted_steps(const Scene& scene, const std::vector<GuessedBody<d>>& bodies);

}  // namespace splashdown::apps
