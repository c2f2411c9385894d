#include "apps/effects/form_drag/shape_classes.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::apps {
namespace {

struct DragOf {
  // Plane: cylinders across the flow.
  ShapeDrag operator()(const PolygonShape&) const { return {2.0, false}; }  // plates and prisms: 1.98, 2.05
  ShapeDrag operator()(const WedgeShape&) const { return {1.55, false}; }   // of 60 degrees, edge ahead
  ShapeDrag operator()(const RectangleShape&) const { return {2.05, false}; }
  ShapeDrag operator()(const CircleShape&) const { return {1.2, true}; }  // subcritical
  ShapeDrag operator()(const EllipseShape&) const { return {1.2, true}; }
  ShapeDrag operator()(const CapsuleShape&) const {
    return {1.2, true};
  }  // space: a cylinder across the flow, subcritical
  ShapeDrag operator()(const SplineShape&) const { return {1.2, true}; }  // smooth: an ellipse
  // Space.
  ShapeDrag operator()(const BoxShape&) const { return {1.05, false}; }    // a cube, face ahead; plates 1.17
  ShapeDrag operator()(const SphereShape&) const { return {0.47, true}; }  // subcritical
  ShapeDrag operator()(
      const ConeShape& cone) const {  // apex ahead: a disc's 1.17 when flat, 0.5 with a half angle of 30 degrees
    const double flat = 1.17, steep = 0.5;
    return {flat - (flat - steep) * std::min(1.0, cone.deadrise_deg / 60), false};
  }
  ShapeDrag operator()(const RevolvedShape&) const { return {0.8, false}; }  // between a hemisphere's 0.4 and a disc
  ShapeDrag operator()(const SurfaceShape&) const { return {1.0, false}; }   // blunt
};

}  // namespace

ShapeDrag shape_drag(const Shape& shape) { return std::visit(DragOf{}, shape); }

}  // namespace splashdown::apps
