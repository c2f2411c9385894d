// What stands behind a run's curves: pulses, limits, what theories say of a load.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/report/gnuplot.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

/// The pulse whose numbers the report shows, from its begin to its end, of the peaks of an acceleration in summary.json.
std::vector<Stretch> pulse_of_peaks(const nlohmann::ordered_json& peaks, double time_scale);

/// Limits on a number of the run, "seat.peak_g", in whatever class.
std::vector<Level> levels_of(const nlohmann::ordered_json& summary, const std::string& number, double scale = 1);

/// The load of an impact between von Karman's and Wagner's theory, of a body in summary.json.
std::vector<Between> theory_of(const nlohmann::ordered_json& body, double time_scale, double force_scale);

}  // namespace splashdown::apps
