// What a scene is about to do, by closed formulas, without a run: for advice on effects, not for results.
//
// The load of an impact is that of von Karman (1929): (m + M_a) V keeps its momentum, and M_a is what the water adds to a flat plate
// (Lamb 1932, articles 71 and 102) as wide as the hull is at the water line,
//   F = V_0^2 M_a' / (1 + M_a/m)^3,   M_a' = dM_a/d(depth).
// In the plane the water line is taken to be a quarter higher than still water, with which wedges of 30 degrees have the load of
// boundary elements (Zhao and Faltinsen 1993); in space it is not raised, with which cones of 30 degrees have it.
#pragma once

#include <optional>

#include "apps/scene/scales.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// The first meeting with the water of the body that is fastest there.
struct Entry {
  std::size_t body = 0;
  double time = 0;                 ///< of the first contact [s]
  double speed = 0;                ///< downward, there [m/s]
  double start_speed = 0;          ///< downward, at t = 0 [m/s]
  double height = 0;               ///< that it falls before [m]
  std::optional<double> deadrise;  ///< beside the lowest point [rad]; absent: round
  double peak_load = 0;            ///< [N, N/m]; infinite: a flat bottom, whose load is an impulse
  double peak_depth = 0;           ///< of penetration at the peak [m]
  double contact_speed = 0;        ///< of the water line along the hull there, at the speed of entry [m/s]
  double wetted = 0;               ///< breadth, area of the wetted hull seen from above there [m, m^2]

  double peak_time() const { return peak_depth / speed; }  ///< after the contact [s]
  bool flat() const;                                       ///< below 1 degree: an impulse
};

/// Of the body that enters, else of the first one.
struct Mover {
  std::size_t body = 0;
  double length = 0, breadth = 0, height = 0;  ///< extents: largest, horizontal (mean in space), vertical [m]
  double plan = 0;                             ///< breadth, area seen from above [m, m^2]
  double mass = 0;                             ///< [kg, kg/m]; infinite: its motion is prescribed
  double added = 0;                            ///< mass of water on a flat plate of its plan [kg, kg/m]
  double forward = 0;                          ///< speed along the water [m/s]
  double way = 0;                              ///< that it makes in the water until the end [m]
  double climb = 0;                            ///< how far up that ends; negative: down [m]
  double facing = 0;                           ///< what of it is seen along that way [m, m^2]
  double time_in_water = 0;                    ///< [s]
  bool moves = false;                          ///< free or prescribed
};

struct Outlook {
  const Scene& scene;
  Scales scales;
  double pull = 0;             ///< downward component of gravity [m/s^2]
  std::optional<Mover> mover;  ///< absent: no bodies
  std::optional<Entry> entry;  ///< absent: nothing enters water from above within the run
  double wave_length = 0;      ///< of the waves that it makes or is given [m]
  double tank_length = 0;      ///< 0: no tank
  double depth = 0;            ///< of water in the tank [m]

  int dimension() const { return scene.dimension; }
  bool starts_at_rest() const;  ///< nothing moves at t = 0
  bool has_load() const;        ///< there is a finite load of an impact to compare with
};

template <int d>
Outlook outlook(const Scene& scene);

}  // namespace splashdown::apps
