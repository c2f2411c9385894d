#include "apps/report/curves/acceleration.hpp"

#include <fmt/format.h>

#include "apps/report/curves/filtered_curves.hpp"
#include "apps/report/curves/style.hpp"
#include "apps/report/words.hpp"
#include "apps/scene/channel_classes.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

std::optional<Figure> acceleration_figure(const AccelerationCurves& what) {
  constexpr double to_g = 1 / standard_gravity;
  std::vector<Values> raw;
  for (const auto& column : what.columns) raw.push_back(scaled(what.rows[column], to_g));
  const auto kept = present(raw);
  if (kept.empty()) return {};
  const auto label = [&](std::size_t k) { return "a_" + what.columns[k].substr(1); };
  const auto t = scaled(what.rows["time"], what.time_scale);
  const auto smooth = what.filters ? filtered_curves(what.rows, what.columns, structures_class) : std::nullopt;
  Figure figure = what.empty;
  figure.y_label = "acceleration / g";
  for (const std::size_t k : kept)
    figure.curves.push_back(smooth ? Curve{k == kept[0] ? "raw" : "", t, raw[k], grey, 1.1}
                                   : Curve{label(k), t, raw[k], series_colours[k % series_colours.size()], 1.6});
  if (smooth)
    for (const std::size_t k : kept)
      figure.curves.push_back({fmt::format("{}, CFC {}", label(k), structures_class),
                               scaled(smooth->t, what.time_scale), scaled(smooth->values[k], to_g),
                               series_colours[k % series_colours.size()], 2.2});
  figure.caption = fmt::format("Acceleration of <b>{}</b> in multiples of 9.80665 m/s², {}.", html_escaped(what.of),
                               smooth ? "filtered as the peak above; grey: unfiltered" : "unfiltered");
  return figure;
}

}  // namespace splashdown::apps
