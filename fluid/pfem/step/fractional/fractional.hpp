// The fractional step: repair and pressure by the pressure matrix, and a fixed number of corrections of what it leaves.
#pragma once

#include "fluid/pfem/step/step.hpp"

namespace splashdown::fluid {

/// Two passes of the repair and `corrections` of the pressure, all on the one factor.
template <int d>
class Fractional final : public WaterStep<d> {
 public:
  using WaterStep<d>::WaterStep;

 private:
  using WaterStep<d>::water_, WaterStep<d>::equation_, WaterStep<d>::trial_;
  using WaterStep<d>::begin_repair, WaterStep<d>::flux_before, WaterStep<d>::answer_to, WaterStep<d>::take_repair;
  using WaterStep<d>::move_nodes, WaterStep<d>::what_is_left, WaterStep<d>::ask, WaterStep<d>::apply;

  Status repair() override;
  Status correct(std::span<const double> previous) override;
};

extern template class Fractional<2>;
extern template class Fractional<3>;

}  // namespace splashdown::fluid
