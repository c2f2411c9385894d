// What theory says of effects that no scene can switch on yet, or whose tables say nothing of themselves. Water at 20 C, air at
// sea level.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "apps/scene/outlook/advice.hpp"
#include "apps/scene/outlook/outlook.hpp"

namespace splashdown::apps {

/// A name, and what is said of it; called for scenes with a fluid only.
struct TheoryRow {
  std::string_view name;
  Advice (*advise)(const Outlook&);
};
/// In the order in which they are told.
std::span<const TheoryRow> theory_rows();
/// The row of this name; null: there is none.
const TheoryRow* theory_of(std::string_view name);
/// Those that no scene can switch on yet.
std::vector<const TheoryRow*> theory_of_what_is_missing();

Advice advise_waves(const Outlook& look);
Advice advise_wind(const Outlook& look);
Advice advise_skin_friction(const Outlook& look);
Advice advise_form_drag(const Outlook& look);
Advice advise_surface_tension(const Outlook& look);
Advice advise_compressibility(const Outlook& look);
Advice advise_trapped_air(const Outlook& look);
Advice advise_cavitation(const Outlook& look);
Advice advise_elasticity(const Outlook& look);
Advice advise_turbulence(const Outlook& look);

inline constexpr double water_viscosity = 1e-3;         ///< [Pa s]
inline constexpr double water_surface_tension = 0.073;  ///< [N/m]
inline constexpr double water_sound_speed = 1480;       ///< [m/s]
inline constexpr double air_density = 1.2;              ///< [kg/m^3]
inline constexpr double air_sound_speed = 340;          ///< [m/s]

/// rho U L / mu of the scene's scales.
double reynolds_number(const Outlook& look, double viscosity);
/// Of a laminar boundary layer on a flat plate, both ends of it (Blasius 1908).
double laminar_friction(double reynolds);
/// ITTC 1957, of turbulent ones on ships.
double turbulent_friction(double reynolds);
/// Half rho U^2.
double dynamic_pressure(double density, double speed);

}  // namespace splashdown::apps
