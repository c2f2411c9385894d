#include <algorithm>
#include <cctype>

#include "apps/scene_parts.hpp"

namespace splashdown::apps {
namespace {

const Rule coordinate = any("m", "Use metres, one number for each axis, e.g. [0.0, 1.0].");

struct ReadShape {
  Reader& reader;
  Rule extent = positive("m", "Use e.g. 0.5.");

  void operator()(PolygonShape& polygon) const { reader.points("points", polygon.points, coordinate); }
  void operator()(WedgeShape& wedge) const {
    Rule deadrise = within(0, 89, "deg", "Use e.g. 30; a flat bottom is a box.");
    deadrise.low_open = true;
    reader.number("deadrise_deg", wedge.deadrise_deg, deadrise, Need::required);
    reader.number("breadth", wedge.breadth, extent, Need::required);
    reader.number("height", wedge.height,
                  positive("m", "Use at least breadth/2 tan(deadrise), or leave it out."));
  }
  void operator()(BoxShape& box) const {
    reader.number("width", box.width, extent, Need::required);
    reader.number("height", box.height, extent, Need::required);
  }
  void operator()(CircleShape& circle) const {
    reader.number("radius", circle.radius, extent, Need::required);
  }
  void operator()(EllipseShape& ellipse) const {
    reader.point("semi_axes", ellipse.semi_axes, positive("m", "Use e.g. [1.0, 0.5]."), Need::required);
  }
  void operator()(CapsuleShape& capsule) const {
    reader.number("radius", capsule.radius, extent, Need::required);
    reader.number("length", capsule.length,
                  positive("m", "Use the straight part's length; without one it is a circle."),
                  Need::required);
  }
};

Shape shape_called(const std::string& type) {
  if (type == "wedge") return WedgeShape{};
  if (type == "box") return BoxShape{};
  if (type == "circle") return CircleShape{};
  if (type == "ellipse") return EllipseShape{};
  if (type == "capsule") return CapsuleShape{};
  return PolygonShape{};
}

void read_shape(Reader& reader, Shape& shape) {
  std::string type = "polygon";
  if (!reader.choice("type", type, {"polygon", "wedge", "box", "circle", "ellipse", "capsule"},
                     Need::required))
    return reader.skip_all();
  shape = shape_called(type);
  std::visit(ReadShape{reader}, shape);
}

void read_mass(Reader& reader, Body& body) {
  const std::string fix = "Use motion = \"fixed\" or \"prescribed\" for a body that the fluid does not move.";
  reader.number("mass", body.mass, not_negative("kg/m", fix));
  reader.number("density", body.density, not_negative("kg/m^3", fix));
  reader.point("centre_of_mass", body.centre_of_mass, coordinate);
  reader.number("inertia", body.inertia, positive("kg m", "Leave it out for that of uniform density."));
}

bool is_good_name(const std::string& name) {
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return name != "tank" &&
         !std::all_of(name.begin(), name.end(), digit) &&  // digits alone: an index in --set
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

void read_name(Reader& reader, std::string& name) {
  const std::string cure = "Use letters, digits, _ and -, e.g. hull.";
  reader.text("name", name, cure, Need::required);
  const auto key = reader.key("name");
  auto& problems = reader.context().problems;
  if (!problems.found_in(key) && !is_good_name(name))
    problems.add(key, "must be made of letters, digits, _ and -, not of digits alone, and not be 'tank'",
                 cure);
}

Motion read_motion(Reader& reader) {
  std::string motion = "free";
  reader.choice("motion", motion, {"free", "fixed", "prescribed"});
  return motion == "fixed" ? Motion::fixed : motion == "prescribed" ? Motion::prescribed : Motion::free;
}

/// A key that the body's kind of motion has no use for would mislead: it is refused, not ignored.
void refuse(Reader& reader, std::string_view name, const std::string& rule, const std::string& cure) {
  const bool given = reader.holds(name);
  reader.skip(name);
  if (!given) return;
  reader.context().problems.note(reader.key(name), reader.place(name), {});
  reader.context().problems.add(reader.key(name), rule, cure);
}

void read_path(Reader& reader, Body& body) {
  std::vector<std::vector<double>> rows;
  const auto d = static_cast<std::size_t>(reader.context().dimension);
  reader.rows("path", rows, d + 2,
              any("s, m, deg", "Use rows of time, position and angle: [[0, 0, 1, 0], [0.5, 0, 0.8, 0]]."));
  for (const auto& row : rows) {
    Waypoint point;
    point.time = row[0];
    for (std::size_t i = 0; i < d; ++i) point.position[static_cast<Eigen::Index>(i)] = row[i + 1];
    point.pitch_deg = row.back();
    body.path.push_back(point);
  }
}

}  // namespace

void read_body(Reader& reader, Body& body, const Scene& scene) {
  read_name(reader, body.name);
  body.motion = read_motion(reader);
  read_mass(reader, body);
  if (body.motion == Motion::free)
    reader.choices("free", body.free, {"x", "y", "rotation"});
  else
    refuse(reader, "free", "only a body with motion = \"free\" has freedoms", "Remove it.");

  if (body.motion == Motion::prescribed)
    read_path(reader, body);
  else
    refuse(reader, "path", "only a body with motion = \"prescribed\" follows a path",
           "Remove it, or change the motion.");
  const bool follows_path = !body.path.empty();
  const std::string on_path = "the path already says it", drop = "Remove it, or the path.";
  if (follows_path) {
    refuse(reader, "position", on_path, drop);
    refuse(reader, "pitch_deg", on_path, drop);
    body.position = body.path.front().position;
    body.pitch_deg = body.path.front().pitch_deg;
  } else {
    reader.point("position", body.position, coordinate);
    reader.number("pitch_deg", body.pitch_deg, within(-360, 360, "deg", "Use degrees, counter-clockwise."));
  }
  if (follows_path || body.motion == Motion::fixed) {
    const auto rule = follows_path ? on_path : "a fixed body does not move";
    refuse(reader, "velocity", rule, follows_path ? drop : "Remove it, or change the motion.");
    refuse(reader, "spin_deg", rule, follows_path ? drop : "Remove it, or change the motion.");
  } else {
    reader.point("velocity", body.velocity, any("m/s", "Use metres per second, one number for each axis."));
    reader.number("spin_deg", body.spin_deg, any("deg/s", "Use degrees per second, counter-clockwise."));
  }
  if (scene.fluid) {
    body.size = scene.fluid->size.surface;
    reader.number("size", body.size, positive("m", "Use e.g. a fiftieth of the body's breadth."));
  } else {
    reader.skip("size");
  }
  if (auto shape = reader.table("shape", Need::required)) read_shape(*shape, body.shape);
}

std::vector<std::string> body_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name);
  return names;
}

std::optional<std::size_t> read_body_name(Reader& reader, std::string_view key, const Scene& scene, Need need,
                                          const std::string& what) {
  const auto names = body_names(scene);
  if (need == Need::optional && !reader.holds(key)) {
    reader.skip(key);
    return {};
  }
  std::string name;
  if (reader.context().problems.found_in("body")) {  // first things first: the names may be wrong
    reader.text(key, name, "Use the name of a body.", need);
    return {};
  }
  if (names.empty()) {
    reader.text(key, name, "Use the name of a body.", need);
    reader.context().problems.add(reader.key(key), "the scene has no bodies",
                                  "Add [[body]] or remove the " + what + ".");
    return {};
  }
  reader.choice(key, name, names, need);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace splashdown::apps
