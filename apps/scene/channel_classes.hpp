// Channel frequency classes of SAE J211-1 (2014) that peaks are told in; the filters are in apps/statistics/filters.hpp.
#pragma once

namespace splashdown::apps {

inline constexpr int channel_frequency_classes[] = {60, 180, 600, 1000};
/// Loads on structures as a whole. Peaks of this class have a value however long the steps are, with what that costs in their band
/// (grades.hpp); higher ones have none from records that J211 does not allow.
inline constexpr int structures_class = 60;

}  // namespace splashdown::apps
