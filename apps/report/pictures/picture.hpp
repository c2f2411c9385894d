// A plane picture as a figure: colours by pressure, the mesh, the surface, the bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "apps/report/pictures/field.hpp"
#include "apps/report/pictures/plane_picture.hpp"

namespace splashdown::apps {

/// A piece of the plane [m].
struct Box {
  PlanePoint low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  void add(const PlanePoint& x) {
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  }
  bool valid() const { return low[0] <= high[0]; }
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// A colour of the pressure at a share of the largest; those between two stops are mixed.
struct ColourStop {
  double at;
  std::uint8_t red, green, blue;
};
std::span<const ColourStop> pressure_colours();

/// What the colours of a figure mean.
struct ColourScale {
  std::string label = "pressure";
  bool from_zero =
      false;         ///< what is below has the colour of zero; otherwise from the lowest value, if that is below zero
  double least = 0;  ///< they end no lower [Pa]
};

/// The figure; its caption ends with the highest pressure.
FieldFigure figure_of(const std::string& name, const PlanePicture& picture, const Box& view,
                      const ColourScale& scale = {});

/// The axes that gnuplot drew, with the picture between them.
std::string with_content(const std::string& axes, const FieldFigure& figure);

}  // namespace splashdown::apps
