// A bound on dt before contact, which the fluid's own criterion cannot see: it knows the nodes it has, not
// the hull that is about to meet them.
//
//   dt <= max(cfl h, gap/2) / (hull speed + liquid speed)      for every hull that is dry
//
// so that no hull enters by more than a share of its own elements in the step of first contact.
#pragma once

#include "fluid/fluid.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::apps {

/// Infinity when all hulls are wet or nothing moves. Gaps are between bounding boxes: never overestimated.
template <int d>
double approach_dt(const fluid::Fluid<d>& fluid, const rigid::Bodies<d>& bodies);

extern template double approach_dt<2>(const fluid::Fluid<2>&, const rigid::Bodies<2>&);
extern template double approach_dt<3>(const fluid::Fluid<3>&, const rigid::Bodies<3>&);

}  // namespace splashdown::apps
