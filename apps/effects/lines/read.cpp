#include "apps/effects/lines/lines.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

std::string of_depth(const std::string& unit, int dimension) {
  return dimension == 2 ? unit + " per m of depth" : unit;
}

void read_catenary(Reader& reader, LineEntry& line, int dimension) {
  auto& catenary = line.catenary.emplace();
  reader.number(
      "weight", catenary.weight,
      positive(of_depth("N/m", dimension), "Use the line's weight a metre under water, e.g. 200 for a chain."),
      Need::required);
  reader.choice("floor", catenary.floor, {"at_anchor", "none"});
  if (catenary.floor == "at_anchor")
    reader.number("friction", catenary.friction, within(0, 2, "", "Use e.g. 1 for a chain on sand, 0 for none."));
  else
    reader.refuse("friction", "only a floor rubs", "Remove it, or use floor = \"at_anchor\".");
}

void read_canopy(Reader& reader, LineEntry& line, int dimension) {
  auto& canopy = line.canopy.emplace();
  reader.point("position", canopy.position, any("m", "Use where the canopy is at t = 0, e.g. above the body."),
               Need::required);
  reader.number("mass", canopy.mass, positive(mass_unit(dimension), "Use the mass of cloth and rigging, e.g. 5."),
                Need::required);
  reader.number("drag_area", canopy.drag_area,
                positive(dimension == 2 ? "m" : "m^2", "Use drag coefficient times area, open, e.g. 20."),
                Need::required);
  reader.number("start", canopy.start, not_negative("s", "Use when it begins to open, e.g. 0."));
  reader.number("inflation", canopy.inflation, not_negative("s", "Use how long it opens, e.g. 0.5; 0 is at once."));
  reader.number("air_density", canopy.air_density, positive("kg/m^3", "Use e.g. 1.225, air at sea level."));
}

void read_release(Reader& reader, LineEntry& line, const Scene& scene) {
  auto& release = line.release;
  reader.number("time", release.time, not_negative("s", "Use the time at which the line lets go."));
  reader.number("load", release.load,
                positive(scene.dimension == 2 ? "N/m" : "N", "Use the tension at which the line breaks."));
  release.wets = read_body_name(reader, "wets", scene, Need::optional, "release");
  if (!reader.holds("time") && !reader.holds("load") && !reader.holds("wets"))
    reader.context().problems.add(reader.path(), "nothing is said that releases the line",
                                  "Add time, load or wets, or remove the table.");
}

/// What the far end is tied to.
void read_far_end(Reader& reader, LineEntry& line, const Scene& scene) {
  line.other = read_body_name(reader, "other", scene, Need::optional, "line");
  if (reader.holds("other"))
    reader.point("other_point", line.other_point, place_rule(scene.dimension));
  else
    reader.refuse("other_point", "there is no other body", "Name one as other, or use anchor.");
  reader.point("anchor", line.anchor, place_rule(scene.dimension));
  if (auto canopy = reader.table("canopy")) read_canopy(*canopy, line, scene.dimension);
  const int ends = reader.holds("other") + reader.holds("anchor") + reader.holds("canopy");
  if (ends == 1) return;
  const std::string rule = ends == 0 ? "the line's far end is tied to nothing" : "a line has two ends";
  reader.context().problems.add(reader.path(), rule, "Use exactly one of other, anchor and canopy.");
}

}  // namespace

void LinesKind::read(Reader& reader, Scene& scene) const {
  const int dimension = scene.dimension;
  LineEntry line;
  line.path = reader.path();
  read_name(reader, line.name, "riser");
  const auto body = read_body_name(reader, "body", scene, Need::required, "line");
  line.body = body.value_or(0);
  reader.point("point", line.point, place_rule(dimension));
  read_far_end(reader, line, scene);
  if (auto catenary = reader.table("catenary")) read_catenary(*catenary, line, dimension);
  reader.number("length", line.length, positive("m", "Use the length of the slack line."), Need::required);
  const std::string per_depth = dimension == 2 ? "N/m" : "N";
  reader.number("axial_stiffness", line.axial_stiffness, positive(per_depth, "Use EA, e.g. 1e6 for a rope."));
  if (line.catenary || reader.holds("catenary")) {
    reader.refuse("stiffness", "a catenary stretches by its axial_stiffness", "Use axial_stiffness = EA.");
    reader.refuse("damping", "a catenary is at rest in every step", "Remove it.");
  } else {
    reader.number("stiffness", line.stiffness,
                  positive(dimension == 2 ? "N/m^2" : "N/m", "Use tension over stretch, EA/length."));
    reader.number("damping", line.damping, not_negative(dimension == 2 ? "N s/m^2" : "N s/m", "Use e.g. 0."));
  }
  if (reader.holds("stiffness") == reader.holds("axial_stiffness") && !reader.holds("catenary"))
    reader.context().problems.add(reader.path(), "a line stretches, and one number says how much",
                                  "Use exactly one of stiffness and axial_stiffness = EA.");
  else if (reader.holds("catenary") && !reader.holds("axial_stiffness"))
    reader.context().problems.add_missing(reader.key("axial_stiffness"), "says how a catenary stretches, EA",
                                          "Use e.g. 1e8 for a chain.");
  if (auto release = reader.table("release")) read_release(*release, line, scene);
  if (body) scene.effects.table<Lines>().all.push_back(std::move(line));
}

}  // namespace splashdown::apps
