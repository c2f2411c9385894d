// A question is a function of a scene and of what is known about it; the tables of this folder hold them.
//
// What is plausible follows from physics: what water, bodies, gravity and hulls are like, and what the parts of a scene say about
// each other (docs/guide.md, "What check asks about"). A value that nothing else in the scene speaks against is not asked about.
#pragma once

#include <string>
#include <vector>

#include "apps/check/cost.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {

using Questions = std::vector<std::string>;

/// A body of the scene as questions need it: world frame, at t = 0.
template <int d>
struct PreparedBody {
  const Body* body;
  rigid::Surface<d> hull;
  Extents<d> box;
  rigid::MassProperties<d> uniform;  ///< of its shape at unit density; `mass` is the volume [m^2, m^3]
  double wet = 0;                    ///< share of the volume below still water
};

template <int d>
struct PreparedScene {
  const Scene& scene;
  const Cost& cost;
  std::optional<double> level;  ///< of still water [m]
  double pull = 0;              ///< downward component of gravity [m/s^2]
  std::vector<PreparedBody<d>> bodies;
};

/// Adds what it asks, or nothing.
template <int d>
using Question = void (*)(const PreparedScene<d>&, Questions&);

template <int d>
PreparedScene<d> prepared_scene(const Scene& scene, const Cost& cost);

// The tables, by what they are about.
template <int d>
void ask_about_bodies(const PreparedScene<d>& prepared, Questions& list);
template <int d>
void ask_about_liquid(const PreparedScene<d>& prepared, Questions& list);
template <int d>
void ask_about_places(const PreparedScene<d>& prepared, Questions& list);
template <int d>
void ask_about_times(const PreparedScene<d>& prepared, Questions& list);

}  // namespace splashdown::apps
