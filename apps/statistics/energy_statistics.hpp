// Whether the water holds more energy than it can have. Survives a resume.
//
//   gain(t) = (K + P)(t) - (K + P)(0) + W(t) - E(t)
//
// K, P: kinetic and potential energy of the water at t_n, drops included. W: work of the water on walls, negative when
// walls gave energy. E: work on the water of effects that book it, such as waves that are kept alive. Viscosity, absorbers and impacts lower the gain; only numerics raise it. P counts from the level
// at rest: rho phi_rest (V - V(0)) is taken off, for water that appears there is an error of volume and brings no energy.
//
// The largest gain is compared with what there was to give or to take, the largest of
//
//   work     max |W|: what walls and bodies gave or took
//   effects  max |E|: what effects gave or took
//   arrival  sum over free bodies of the kinetic energy with which they first touch the water
//   hulls    sum over free bodies that touched it of rho V (phi_top - phi_bottom)/2, V the hull's volume: what it takes
//            to press them under (a box exactly). The scale of bodies that float, whatever little they bring
//   water    K(0) + P(0) - min P: what the water brought or let go, as a jet and a breaking dam do
//   rest     1e-6 rho V_w (phi_top - phi_bottom)/2 of all water at the start: its energy if it moved at a thousandth of
//            sqrt(g H). Slower water is at rest; this is far above what rounding leaves of the sums
//
// phi: potential of gravity. Without it hulls and rest are 0.
#pragma once

#include <string>
#include <vector>

#include "apps/statistics/statistics_archive.hpp"
#include "core/fluid_view.hpp"

namespace splashdown::apps {

/// What the water is at the start.
struct WaterAtStart {
  double level_energy = 0;  ///< rho phi of the level at rest [J/m^3]
  double depth_energy = 0;  ///< rho V_w (phi_top - phi_bottom) [J, J/m]
  double hull_volume = 0;   ///< of the bodies that move, of all if none does; 0 without bodies [m^2, m^3]
};

/// Of a body at t_n.
struct BodyEnergy {
  bool free = false;     ///< the water moves it
  bool wet = false;      ///< touches water
  double kinetic = 0;    ///< [J, J/m]
  double immersion = 0;  ///< rho V (phi_top - phi_bottom)/2 [J, J/m]
};

class EnergyStatistics {
 public:
  void begin(const WaterAtStart& water) { water_ = water; }
  void add(double time, const Ledger& ledger, const std::vector<BodyEnergy>& bodies);
  double gain() const { return now_; }  ///< at the last step that was added [J, J/m]
  /// Fills what is about energy and about volumes of hulls.
  void summarise(LedgerSummary& summary) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(water_.level_energy, water_.depth_energy, water_.hull_volume, begun_, first_kinetic_, first_potential_,
            lowest_potential_, lowest_kinetic_, most_work_, most_work_of_effects_, now_, loss_, gain_, rise_,
            dry_kinetic_, touched_, arrival_, hulls_);
  }

 private:
  void add_body(std::size_t b, const BodyEnergy& body);

  WaterAtStart water_;
  bool begun_ = false;
  double first_kinetic_ = 0, first_potential_ = 0, lowest_potential_ = 0, lowest_kinetic_ = 0, most_work_ = 0,
         most_work_of_effects_ = 0;
  double now_ = 0;
  Peak loss_, gain_;                 ///< largest so far
  double rise_ = -1;                 ///< when the loss was largest before the gain was
  std::vector<double> dry_kinetic_;  ///< of bodies, at the step before
  std::vector<char> touched_;        ///< bodies that the water has met
  double arrival_ = 0, hulls_ = 0;
};

}  // namespace splashdown::apps
