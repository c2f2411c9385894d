#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/coupling_kinds.hpp"
#include "apps/scene/kinds/formulation_kinds.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

struct ReadRegionShape {
  Reader& reader;
  Rule place = place_rule(reader.context().dimension);
  Rule extent = positive("m", "Use e.g. 0.5.");

  void operator()(BoxRegion& box) const {
    reader.point("min", box.min, place, Need::required);
    reader.point("max", box.max, place, Need::required);
    if (reader.context().dimension == 2) wave(box);
  }
  void wave(BoxRegion& box) const {
    reader.number("surface_amplitude", box.surface_amplitude,
                  any("m", "Use e.g. 0.01; leave it out for a flat surface."));
    if (box.surface_amplitude == 0 && !reader.holds("surface_wavelength") && !reader.holds("surface_phase_deg")) return;
    reader.number("surface_wavelength", box.surface_wavelength,
                  positive("m", "Use e.g. twice the tank's length for the first sloshing mode."), Need::required);
    reader.number("surface_phase_deg", box.surface_phase_deg, any("deg", "Use degrees, e.g. 90."));
  }
  void operator()(CircleRegion& circle) const { round(circle); }
  void operator()(SphereRegion& sphere) const { round(sphere); }
  void operator()(EllipseRegion& ellipse) const {
    reader.point("centre", ellipse.centre, place, Need::required);
    reader.point("semi_axes", ellipse.semi_axes, positive("m", "Use e.g. [1.0, 0.5]."), Need::required);
  }
  void operator()(PolygonRegion& polygon) const { reader.points("points", polygon.points, place); }
  void operator()(SplineRegion& spline) const {
    read_spline(reader, spline.shape);
    reader.point("position", spline.position, place);
  }
  void operator()(RevolvedRegion& revolved) const {
    read_profile(reader, "profile", revolved.shape.profile);
    reader.point("position", revolved.position, place);
  }
  void operator()(UnionRegion& all) const;  // reads regions in turn

 private:
  template <class Round>
  void round(Round& region) const {
    reader.point("centre", region.centre, place, Need::required);
    reader.number("radius", region.radius, extent, Need::required);
  }
};

struct Centre {
  Point operator()(const BoxRegion& box) const { return 0.5 * (box.min + box.max); }
  Point operator()(const PolygonRegion&) const { return Point::Zero(); }
  Point operator()(const SplineRegion& spline) const { return spline.position; }
  Point operator()(const RevolvedRegion& revolved) const { return revolved.position; }
  Point operator()(const UnionRegion&) const { return Point::Zero(); }
  template <class Round>
  Point operator()(const Round& region) const {
    return region.centre;
  }
};

/// A shape that liquid may have, with its defaults.
struct RegionType {
  const char* name;
  bool in_plane, in_space;
  RegionShape shape;
  bool in(int dimension) const { return dimension == 2 ? in_plane : in_space; }
};
std::vector<RegionType> region_types() {
  return {{"box", true, true, BoxRegion{}},          {"circle", true, false, CircleRegion{}},
          {"ellipse", true, false, EllipseRegion{}}, {"polygon", true, false, PolygonRegion{}},
          {"sphere", false, true, SphereRegion{}},   {"revolved", false, true, RevolvedRegion{}},
          {"spline", true, true, SplineRegion{}},    {"union", true, true, UnionRegion{}}};
}

/// The key `shape` and those of the shape; false if there is none.
bool read_region_shape(Reader& reader, RegionShape& shape, bool in_union) {
  const int dimension = reader.context().dimension;
  std::string name = "box";
  Reader::Names names;
  for (const auto& type : region_types())
    if (type.in(dimension) && !(in_union && std::holds_alternative<UnionRegion>(type.shape)))
      names.emplace_back(type.name);
  if (!reader.choice("shape", name, names, Need::required)) return false;
  for (const auto& type : region_types())
    if (type.in(dimension) && type.name == name) shape = type.shape;
  std::visit(ReadRegionShape{reader}, shape);
  return true;
}

void ReadRegionShape::operator()(UnionRegion& all) const {
  reader.each_table("part", [&](Reader& part) {
    if (!read_region_shape(part, all.parts.emplace_back().shape, true)) part.skip_all();
  });
  if (all.parts.empty() && !reader.holds("part"))
    reader.context().problems.add_missing(reader.key("part"), "a union has parts",
                                          "Write [[fluid.region.part]] below it, each with a shape.");
  if (reader.context().dimension == 3 && !reader.context().problems.found_in(reader.path())) unite_in_space(all);
}

void read_region(Reader& reader, Region& region) {
  const int dimension = reader.context().dimension;
  if (!read_region_shape(reader, region.shape, false)) return reader.skip_all();
  reader.point(
      "velocity", region.velocity,
      any("m/s", "Use metres per second, one number for each axis, e.g. " + axis_example(dimension, -1) + "."));
  if (!reader.holds("velocity_gradient")) return reader.skip("velocity_gradient");
  reader.matrix(
      "velocity_gradient", region.velocity_gradient,
      any("1/s", dimension == 2 ? "Use a square list of lists with zero trace, e.g. [[-1.0, 0.0], [0.0, 1.0]]."
                                : "Use a square list of lists with zero trace, e.g. [[-1.0, 0.0, 0.0], "
                                  "[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]."));
  region.velocity_origin = std::visit(Centre{}, region.shape);
  reader.point("velocity_origin", region.velocity_origin, place_rule(dimension));
}

void read_sizes(Reader& reader, Sizes& size) {
  // Two decades either way: beyond them it is another scene, or a slip.
  size.refine = reader.divisor("refine", within(0.01, 100, "", "Use e.g. 2 for elements of half the size."), presets);
  const auto finer = [&](Rule rule) { return refined(std::move(rule), size.refine); };
  reader.number("surface", size.surface,
                finer(positive("m", "Leave it out to have sizes chosen, or use e.g. a fifth of the body's breadth.")));
  size.far = size.surface;
  reader.number("far", size.far, finer(positive("m", "Use fluid.size.surface or more.")));
  reader.number("growth", size.growth, share("Use 0.2: the element size's growth per unit distance."));
  reader.number("wetted_fraction", size.wetted_fraction,
                finer(within(0, 0.5, "",
                             "Use 0 (off), 0.004 to 0.01 in the plane or 0.03 in space: h over the wetted half length, "
                             "for starting impacts.")));
  reader.number("hollow", size.hollow,
                positive("", "Use e.g. 0.2, or leave it out: h over the radius of a jet's root."));
  if (size.hollow)
    reader.number("hollow_min", size.hollow_min, finer(positive("m", "Use e.g. a quarter of the hull's size.")),
                  Need::required);
  else
    reader.skip("hollow_min");
  reader.number("curvature", size.curvature,
                positive("", "Use 0.5, or 0.25 where flow around a tight bend matters: h over its radius."));
  reader.number("corner", size.corner,
                share("Use 1, or 0.25 where the pressure at a tip or a steep keel matters: h there over the hull's."));
}

}  // namespace

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

void read_fluid(Reader& reader, Fluid& fluid) {
  reader.number("density", fluid.density, positive("kg/m^3", "Use e.g. 1000 for water."), Need::required);
  for (const FormulationKind& kind : formulation_kinds()) {
    if (!kind.read) continue;
    if (kind.name == fluid.formulation) {
      Reader own = reader.table_or_defaults(kind.name);
      kind.read(own, fluid);
    } else {
      reader.refuse(kind.name, fmt::format("belongs to formulation = \"{}\"", kind.name),
                    "Ask for that formulation, or remove the table.");
    }
  }
  Reader size = reader.table_or_defaults("size");
  read_sizes(size, fluid.size);
  reader.each_table("region", [&](Reader& region) { read_region(region, fluid.regions.emplace_back()); });
  if (fluid.regions.empty() && !reader.holds("region"))
    reader.context().problems.add_missing(reader.key("region"), "a fluid needs liquid to begin with",
                                          "Write [[fluid.region]] with shape = \"box\", min and max.");
}

void read_coupling(Reader& reader, Coupling& coupling) {
  reader.choice("scheme", coupling.scheme, {"iterated", "staggered"});
  reader.choice("interface_term", coupling.interface_term, names_of(interface_kinds()));
  reader.choice("accelerator", coupling.accelerator, names_of(accelerator_kinds()));
  reader.number("relaxation", coupling.relaxation, share("Use 1 unless the coupling diverges."));
  reader.integer("depth", coupling.depth, within(1, 10000, "", "Use e.g. 50: passes that anderson remembers."));
  reader.integer("reuse", coupling.reuse, within(0, 100, "", "Use 0 to 8: past steps that iqn_ils learns from."));
  reader.number("tolerance", coupling.tolerance,
                within(1e-14, 0.1, "", "Use e.g. 1e-8: change of the bodies' velocities from pass to pass, relative."));
  reader.integer("max_passes", coupling.max_passes, within(1, 10000, "", "Use e.g. 50."));
}

}  // namespace splashdown::apps
