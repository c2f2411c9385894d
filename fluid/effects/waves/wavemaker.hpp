// What a paddle that swings with a small stroke sends out, far away from it, on water of constant depth d:
//
//   piston                  H/S = 2 (cosh 2kd - 1)/(sinh 2kd + 2kd)
//   flap, hinge on the bed  H/S = 4 sinh kd (kd sinh kd - cosh kd + 1)/(kd (sinh 2kd + 2kd))
//
// H the height of the waves, S the stroke at the still level from end to end, k the wave number (Havelock 1929; Biesel and Suquet
// 1951; Dean and Dalrymple, Water Wave Mechanics, 1984, section 6.3).
#pragma once

namespace splashdown::fluid {

/// How a paddle moves.
enum class Paddle { piston, flap };

/// H/S for k d > 0; to roundoff also in deep water.
double height_over_stroke(Paddle paddle, double kd);

}  // namespace splashdown::fluid
