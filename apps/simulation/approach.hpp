// A bound on dt before contact, which the fluid's own criterion cannot see: it knows the nodes it has, not
// the hull that is about to meet them.
//
//   dt <= max(cfl h, gap/2) / (hull speed + speed of the water there)      for every hull that is dry, every facet of the free surface
//
// so that no hull enters by more than a share of its own elements in the step of first contact. Drops that fly by themselves do
// not count: they meet a hull when they have reached it.
#pragma once

#include "core/fluid_view.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::apps {

/// `cfl`: share of a hull's own elements. Infinity when all hulls are wet or far from water that waits, or nothing moves. Gaps are between bounding boxes, of the hull and of a facet: never overestimated.
template <int d>
double approach_dt(const FluidView<d>& fluid, const rigid::Bodies<d>& bodies, double cfl);

extern template double approach_dt<2>(const FluidView<2>&, const rigid::Bodies<2>&, double);
extern template double approach_dt<3>(const FluidView<3>&, const rigid::Bodies<3>&, double);

}  // namespace splashdown::apps
