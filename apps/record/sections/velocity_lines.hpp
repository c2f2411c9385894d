// Velocity of a fluid along lines: profiles, as laser anemometers measure them.
#pragma once

#include <optional>
#include <vector>

#include "apps/files/csv.hpp"
#include "apps/record/settings.hpp"
#include "core/fluid_view.hpp"

namespace splashdown::apps {

inline constexpr const char* velocity_lines_header = "time,record,s,x,y,z,vx,vy,vz";

/// Velocity at t_n at each point [m/s], linear in the cell that holds it; nothing where no cell does. Cost: a pass over the cells, and
/// of those that the points' box meets, one over the points.
template <int d>
std::vector<std::optional<Vec<d>>> velocities_at(const FluidView<d>& fluid, const std::vector<Vec<d>>& points);

/// A row a point in the fluid; s: way from the line's beginning [m].
template <int d>
void write_rows(CsvFile& file, double time, const VelocityLineRecord<d>& line, const FluidView<d>& fluid);

}  // namespace splashdown::apps
