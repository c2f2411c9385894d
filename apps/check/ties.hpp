// What joints do together: repeat each other, contradict each other, hold a body fast. Found by rank (rigid/ties.hpp).
#pragma once

#include <string>
#include <vector>

#include "apps/scene/read/read.hpp"

namespace splashdown::apps {

/// Joints that repeat others, a line each: harmless. None for joints with stops or a spring, which do more.
template <int d>
std::vector<std::string> ties_notes(const Scene& scene);

/// Bodies that joints hold fast though nobody asked for that (welds do), and velocities that joints do not leave.
template <int d>
std::vector<std::string> ties_questions(const Scene& scene);

/// Throws SceneError if no motion satisfies all joints together.
template <int d>
void refuse_contradicting_ties(const SceneFile& file);

}  // namespace splashdown::apps
