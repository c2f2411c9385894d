// Numbers of few digits, for people to read and to write.
#pragma once

namespace splashdown::apps {

/// To the next number of so many digits upward, away from 0.
double rounded_up(double value, int digits = 2);
/// To the nearest.
double rounded(double value, int digits);

}  // namespace splashdown::apps
