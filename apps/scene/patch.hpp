// A pressure patch of a scene as a piece of space.
#pragma once

#include "apps/scene/geometry.hpp"
#include "apps/scene/patch_region.hpp"

namespace splashdown::apps {

/// In the frame of `hull`, whose origin is the point `origin` of the shape's frame.
template <int d>
PatchRegion<d> patch_region(const PatchEntry& entry, const rigid::Surface<d>& hull, const rigid::Vec<d>& origin);

}  // namespace splashdown::apps
