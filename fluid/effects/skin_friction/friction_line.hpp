// Friction of a flat plate by the speed and length of the flow over it.
#pragma once

namespace splashdown::fluid {

/// Which line gives C_F.
enum class FrictionLine {
  ittc1957,   ///< of ships: turbulent, with some form resistance in it
  flat_plate  ///< laminar from the leading edge, turbulent beyond Re = 5e5
};

/// C_F = F / (rho U^2 S / 2) of one side of a plate of length L in the direction of the flow, Re = U L / nu > 0:
///
///   ittc1957     0.075 / (log10 Re - 2)^2                        (8th ITTC, Madrid 1957); below Re = 1e4 on as Re^(-1/2)
///   flat_plate   1.32823 Re^(-1/2)                  Re < 5e5     (Blasius 1908)
///                0.074 Re^(-1/5) - 1742 / Re        Re < 1e7     (Prandtl 1927)
///                0.455 / (log10 Re)^2.58 - k / Re   above        (Schlichting 1932), k = 1742 with what makes it continuous
double friction_coefficient(FrictionLine line, double reynolds);

}  // namespace splashdown::fluid
