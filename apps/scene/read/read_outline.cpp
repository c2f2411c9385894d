// Outlines and profiles by points: what shapes of bodies and regions of liquid have in common.
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {

void read_profile(Reader& reader, std::string_view key, std::vector<std::array<double, 2>>& profile) {
  std::vector<std::vector<double>> rows;
  reader.rows(key, rows, 2, any("m", "Use points [r, z], e.g. [[0, 0], [0.5, 0.2], [0.5, 1]]."), Need::required);
  for (const auto& row : rows) profile.push_back({row[0], row[1]});
}

void read_spline(Reader& reader, SplineShape& spline) {
  const bool plane = reader.context().dimension == 2;
  if (plane) {
    reader.points("points", spline.points, place_rule(2));
  } else {
    std::vector<std::array<double, 2>> profile;
    read_profile(reader, "points", profile);
    for (const auto& [r, z] : profile) spline.points.emplace_back(r, z, 0);
  }
  reader.integer("degree", spline.degree, within(1, 5, "", "Use 3; 1 is straight between the points."));
  if (plane) {
    std::string ends = "clamped";
    reader.choice("ends", ends, {"clamped", "periodic"});
    spline.closed = ends == "periodic";
  } else {
    reader.refuse("ends", "a profile begins and ends in its first and last point", "Remove it.");
  }
  if (reader.holds("tolerance"))
    reader.number("tolerance", spline.tolerance, positive("m", "Leave it out for 5e-5 of the extent."));
  else
    reader.skip("tolerance");
}

}  // namespace splashdown::apps
