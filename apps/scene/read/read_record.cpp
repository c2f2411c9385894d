#include "apps/scene/kinds/named.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

/// When rows of a file of its own are due: an interval or a list, each step without both.
template <class Entry>
void read_instants(Reader& reader, Entry& entry) {
  reader.number("interval", entry.interval, not_negative("s", "Use e.g. 0.001, or 0 for every step."));
  reader.times("times", entry.times, not_negative("s", "Use e.g. [0.005, 0.010]."));
  if (entry.interval && !entry.times.empty())
    reader.context().problems.add(reader.key("times"), "interval and times exclude each other", "Remove one of them.");
  if (!entry.interval && entry.times.empty()) entry.interval = 0;
}

void read_surface_pressure(Reader& reader, Scene& scene) {
  SurfacePressureEntry entry;
  auto walls = body_names(scene);
  if (scene.tank) walls.push_back("tank");
  reader.reference("wall", entry.wall, walls, Need::required);
  read_instants(reader, entry);
  scene.records.emplace_back(std::move(entry));
}

void read_patch(Reader& reader, Scene& scene) {
  PatchEntry entry;
  read_name(reader, entry.name, "keel");
  entry.body = read_body_name(reader, "body", scene, Need::required, "record").value_or(0);
  reader.point("centre", entry.centre, place_rule(reader.context().dimension));
  reader.number("radius", entry.radius, positive("m", "Use that of the sensor or panel."));
  reader.point("min", entry.min, place_rule(reader.context().dimension));
  reader.point("max", entry.max, place_rule(reader.context().dimension));
  const bool any_of_disc = reader.holds("centre") || reader.holds("radius");
  const bool any_of_box = reader.holds("min") || reader.holds("max");
  const bool whole = any_of_disc ? reader.holds("centre") && reader.holds("radius") && !any_of_box
                                 : reader.holds("min") && reader.holds("max");
  if (!whole)
    reader.context().problems.add(reader.key("centre"), "a patch is a disc (centre and radius) or a box (min and max)",
                                  "Give one of these pairs, in the frame of the body's shape.");
  scene.records.emplace_back(std::move(entry));
}

void read_maximum_pressure(Reader& reader, Scene& scene) {
  MaximumPressureEntry entry;
  const auto body = read_body_name(reader, "body", scene, Need::required, "record");
  entry.body = body.value_or(0);
  if (body) entry.size = scene.bodies[*body].size;
  reader.number("size", entry.size, positive("m", "Use the distance of the points, e.g. the body's size."));
  scene.records.emplace_back(std::move(entry));
}

void read_pressure(Reader& reader, Scene& scene) {
  PressureEntry entry;
  read_name(reader, entry.name, "keel");
  entry.body = read_body_name(reader, "body", scene, Need::optional, "record");
  reader.point("point", entry.point, place_rule(reader.context().dimension), Need::required);
  scene.records.emplace_back(std::move(entry));
}

void read_elevation(Reader& reader, Scene& scene) {
  ElevationEntry entry;
  read_name(reader, entry.name, "keel");
  const Rule place = any("m", "Use the gauge's horizontal place.");
  reader.number("x", entry.x, place, Need::required);
  if (reader.context().dimension == 3) reader.number("y", entry.y, place, Need::required);
  scene.records.emplace_back(std::move(entry));
}

void read_acceleration(Reader& reader, Scene& scene) {
  AccelerationEntry entry;
  read_name(reader, entry.name, "keel");
  entry.body = read_body_name(reader, "body", scene, Need::required, "record").value_or(0);
  reader.point("point", entry.point, place_rule(reader.context().dimension), Need::required);
  scene.records.emplace_back(std::move(entry));
}

void read_added_mass(Reader& reader, Scene& scene) {
  AddedMassEntry entry;
  entry.body = read_body_name(reader, "body", scene, Need::required, "record").value_or(0);
  read_instants(reader, entry);
  scene.records.emplace_back(std::move(entry));
}

void read_passes(Reader& reader, Scene& scene) {
  PassesEntry entry;
  read_instants(reader, entry);
  scene.records.emplace_back(std::move(entry));
}

void read_section_loads(Reader& reader, Scene& scene) {
  SectionEntry entry;
  read_name(reader, entry.name, "hull");
  entry.body = read_body_name(reader, "body", scene, Need::required, "record").value_or(0);
  const int dimension = reader.context().dimension;
  std::string axis = "x";
  reader.choice("axis", axis, dimension == 2 ? Reader::Names{"x", "y"} : Reader::Names{"x", "y", "z"});
  entry.axis = axis[0] - 'x';
  reader.numbers("stations", entry.stations, any("m", "Use places along the axis, in the frame of the body's shape."));
  if (entry.stations.empty())
    reader.integer("sections", entry.sections, within(1, 1000, "", "Use e.g. 20: so many equal parts of the hull."));
  reader.each_table("mass", [&](Reader& part) {
    auto& [mass, point] = entry.parts.emplace_back();
    part.number("mass", mass, positive(dimension == 2 ? "kg/m" : "kg", "Use that of the heavy part."), Need::required);
    part.point("point", point, place_rule(dimension), Need::required);
  });
  read_instants(reader, entry);
  scene.records.emplace_back(std::move(entry));
}

void read_velocity_line(Reader& reader, Scene& scene) {
  VelocityLineEntry entry;
  read_name(reader, entry.name, "wake");
  reader.point("from", entry.from, place_rule(reader.context().dimension), Need::required);
  reader.point("to", entry.to, place_rule(reader.context().dimension), Need::required);
  reader.integer("points", entry.points, within(2, 100'000, "", "Use e.g. 50, both ends included."));
  if (entry.from == entry.to && reader.holds("from") && reader.holds("to"))
    reader.context().problems.add(reader.key("to"), "is where the line begins", "Use two places.");
  read_instants(reader, entry);
  scene.records.emplace_back(std::move(entry));
}

/// A kind of record and who reads its keys.
struct RecordKind {
  std::string_view name;
  void (*read)(Reader& reader, Scene& scene);
};
constexpr RecordKind record_kinds[] = {{"pressure", read_pressure},
                                       {"pressure_patch", read_patch},
                                       {"maximum_pressure", read_maximum_pressure},
                                       {"surface_pressure", read_surface_pressure},
                                       {"surface_elevation", read_elevation},
                                       {"acceleration", read_acceleration},
                                       {"added_mass", read_added_mass},
                                       {"passes", read_passes},
                                       {"section_loads", read_section_loads},
                                       {"velocity_line", read_velocity_line}};

}  // namespace

void read_record(Reader& reader, Scene& scene) {
  std::string name;
  if (!reader.choice("kind", name, names_of(record_kinds), Need::required)) return reader.skip_all();
  named(record_kinds, name).read(reader, scene);
}

}  // namespace splashdown::apps
