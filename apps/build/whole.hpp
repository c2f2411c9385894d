// A simulation of one half of a symmetric scene, told as the whole.
//
// Twice: masses, inertias, loads along the plane, wetted measures, volumes, energies, powers, work. Zero: what a load has across
// the plane. As they are: points, cells and boundary, which hold the half before the plane, and pressures.
#pragma once

#include <memory>

#include "apps/record/recorder.hpp"

namespace splashdown::apps {

template <int d>
class Whole {
 public:
  /// Keeps the references; `bodies` may be null.
  Whole(const Mirror& mirror, const FluidView<d>& fluid, const BodiesView<d>* bodies);
  ~Whole();
  /// The same step with what is told of the whole. Its views live as long as this object.
  RecordInput<d> tell(RecordInput<d> half) const;

 private:
  class Fluid;
  class Bodies;
  Mirror mirror_;
  std::unique_ptr<Fluid> fluid_;
  std::unique_ptr<Bodies> bodies_;
};

extern template class Whole<2>;
extern template class Whole<3>;

}  // namespace splashdown::apps
