// The fractional step: repair and pressure by the pressure matrix, and a fixed number of corrections of what it leaves.
#pragma once

#include "fluid/pfem/step/step.hpp"

namespace splashdown::fluid {

/// Two passes of the repair and `corrections` of the pressure, all on the one factor.
template <int d>
class Fractional final : public Step<d> {
 public:
  using Step<d>::Step;

 private:
  using Step<d>::water_, Step<d>::equation_, Step<d>::trial_;
  using Step<d>::begin_repair, Step<d>::flux_before, Step<d>::answer_to, Step<d>::take_repair;
  using Step<d>::move_nodes, Step<d>::what_is_left, Step<d>::ask, Step<d>::apply;

  Status repair() override;
  Status correct(std::span<const double> previous) override;
};

extern template class Fractional<2>;
extern template class Fractional<3>;

}  // namespace splashdown::fluid
