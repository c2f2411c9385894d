#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "apps/scene/geometry.hpp"
#include "apps/scene/read/parts.hpp"
#include "core/surface/surface_file.hpp"

namespace splashdown::apps {
namespace {

struct ReadShape {
  Reader& reader;
  Rule place = place_rule(reader.context().dimension);
  Rule extent = positive("m", "Use e.g. 0.5.");

  void deadrise(double& target, const std::string& cure) const {
    Rule rule = within(0, 89, "deg", cure);
    rule.low_open = true;
    reader.number("deadrise_deg", target, rule, Need::required);
  }
  void operator()(PolygonShape& polygon) const { reader.points("points", polygon.points, place); }
  void operator()(WedgeShape& wedge) const {
    deadrise(wedge.deadrise_deg, "Use e.g. 30; a flat bottom is a box.");
    reader.number("breadth", wedge.breadth, extent, Need::required);
    reader.number("height", wedge.height, positive("m", "Use at least breadth/2 tan(deadrise), or leave it out."));
  }
  void operator()(RectangleShape& box) const {
    reader.number("width", box.width, extent, Need::required);
    reader.number("height", box.height, extent, Need::required);
  }
  void operator()(CircleShape& circle) const { reader.number("radius", circle.radius, extent, Need::required); }
  void operator()(EllipseShape& ellipse) const {
    reader.point("semi_axes", ellipse.semi_axes, positive("m", "Use e.g. [1.0, 0.5]."), Need::required);
  }
  void operator()(CapsuleShape& capsule) const {
    reader.number("radius", capsule.radius, extent, Need::required);
    reader.number("length", capsule.length,
                  positive("m", "Use the straight part's length; without one it is a circle or a sphere."),
                  Need::required);
  }
  void operator()(BoxShape& box) const {
    reader.point("size", box.size, positive("m", "Use the lengths along x, y and z, e.g. [1.0, 0.5, 0.3]."),
                 Need::required);
  }
  void operator()(SphereShape& sphere) const { reader.number("radius", sphere.radius, extent, Need::required); }
  void operator()(ConeShape& cone) const {
    deadrise(cone.deadrise_deg, "Use e.g. 30; the angle between the horizontal and the side.");
    reader.number("radius", cone.radius, extent, Need::required);
  }
  void operator()(RevolvedShape& revolved) const { read_profile(reader, "profile", revolved.profile); }
  void operator()(SplineShape& spline) const { read_spline(reader, spline); }
  void operator()(SurfaceShape& surface) const {
    reader.file("file", surface.file, "Name an .stl or .obj file; relative names begin at the folder of the scene.");
    reader.number("scale", surface.scale,
                  positive("", "Use metres per unit of the file: 0.001 if it is in millimetres."));
    auto& problems = reader.context().problems;
    if (problems.found_in(reader.path())) return;
    try {
      const auto file = read_surface_file(surface.file);
      const rigid::Surface<3> hull{surface.scale * file.surface.vertices, file.surface.facets};
      const double longest = extents<3>(hull).sizes().maxCoeff(), farthest = hull.vertices.cwiseAbs().maxCoeff();
      if (!(longest >= smallest_length && farthest <= largest_length))
        return problems.add(reader.key("file"),
                            fmt::format("is {:g} m long and reaches {:g} m from its origin at scale = {:g}; hulls have "
                                        "{:g} to {:g} m",
                                        longest, farthest, surface.scale, smallest_length, largest_length),
                            "Use metres per unit of the file as scale: 0.001 if it is in millimetres.");
      surface.parts = file.parts;
      surface.read = std::make_shared<rigid::Shape<3>>(rigid::Shape<3>{hull, rigid::mass_properties<3>(hull)});
    } catch (const SurfaceFileError& error) {
      problems.add(reader.key("file"), error.what(), error.cure());
    }
  }
};

/// The shapes of each dimension by their names.
struct ShapeType {
  int dimension;
  const char* name;
  Shape shape;
};

const std::vector<ShapeType>& shape_types() {
  static const std::vector<ShapeType> types = {
      {2, "polygon", PolygonShape{}}, {2, "wedge", WedgeShape{}},     {2, "box", RectangleShape{}},
      {2, "circle", CircleShape{}},   {2, "ellipse", EllipseShape{}}, {2, "capsule", CapsuleShape{}},
      {2, "spline", SplineShape{}},   {3, "sphere", SphereShape{}},   {3, "box", BoxShape{}},
      {3, "cone", ConeShape{}},       {3, "capsule", CapsuleShape{}}, {3, "revolved", RevolvedShape{}},
      {3, "spline", SplineShape{}},   {3, "surface", SurfaceShape{}}};
  return types;
}

void read_shape(Reader& reader, Shape& shape) {
  Reader::Names names;
  for (const auto& type : shape_types())
    if (type.dimension == reader.context().dimension) names.emplace_back(type.name);
  std::string name = names.front();
  if (!reader.choice("type", name, names, Need::required)) return reader.skip_all();
  for (const auto& type : shape_types())
    if (type.dimension == reader.context().dimension && type.name == name) shape = type.shape;
  std::visit(ReadShape{reader}, shape);
}

void read_mass(Reader& reader, Body& body) {
  const int dimension = reader.context().dimension;
  const std::string fix = "Use motion = \"fixed\" or \"prescribed\" for a body that the fluid does not move.";
  reader.number("mass", body.mass, not_negative(mass_unit(dimension), fix));
  reader.number("density", body.density, not_negative("kg/m^3", fix));
  body.without_mass = body.mass == 0. || body.density == 0.;
  reader.point("centre_of_mass", body.centre_of_mass, place_rule(dimension));
  reader.inertia("inertia", body.inertia,
                 positive(inertia_unit(dimension), "Leave it out for that of uniform density."));
}

bool is_good_name(const std::string& name) {
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return name != "tank" && !std::all_of(name.begin(), name.end(), digit) &&  // digits alone: an index in --set
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

Motion read_motion(Reader& reader) {
  std::string motion = "free";
  reader.choice("motion", motion, {"free", "fixed", "prescribed"});
  return motion == "fixed" ? Motion::fixed : motion == "prescribed" ? Motion::prescribed : Motion::free;
}

/// A row of a path: time, position, angles.
Waypoint waypoint(const std::vector<double>& row, std::size_t dimension) {
  Waypoint point;
  point.time = row[0];
  for (std::size_t i = 0; i < dimension; ++i) point.position[static_cast<Eigen::Index>(i)] = row[i + 1];
  if (dimension == 2)
    point.attitude.pitch_deg = row[3];
  else
    point.attitude = {.heading_deg = row[4], .pitch_deg = row[5], .roll_deg = row[6]};
  return point;
}

void read_path(Reader& reader, Body& body) {
  std::vector<std::vector<double>> rows;
  const auto d = static_cast<std::size_t>(reader.context().dimension);
  const std::string cure =
      d == 2 ? "Use rows of time, position and angle: [[0, 0, 1, 0], [0.5, 0, 0.8, 0]]."
             : "Use rows of time, x, y, z, heading, pitch, roll: [[0, 0, 0, 1, 0, 0, 0], [0.5, 0, 0, 0.8, 0, 0, 0]].";
  reader.rows("path", rows, 1 + d + d * (d - 1) / 2, any("s, m, deg", cure));
  for (const auto& row : rows) body.path.push_back(waypoint(row, d));
}

/// About what `position` and the angles say; points of it until the end of the run become the body's path.
void read_oscillation(Reader& reader, Body& body, double end) {
  auto& swing = body.oscillation.emplace();
  swing.centre = body.position;
  swing.attitude = body.attitude;
  reader.number("frequency", swing.frequency, positive("Hz", "Use e.g. 0.5."), Need::required);
  reader.point("amplitude", swing.amplitude,
               any("m", "Use e.g. " + axis_example(reader.context().dimension, 0.1) + "."));
  const Rule angle = within(-360, 360, "deg", "Use degrees.");
  reader.number("phase_deg", swing.phase_deg, angle);
  reader.number("pitch_deg", swing.pitch_deg, angle);
  reader.number("pitch_phase_deg", swing.pitch_phase_deg, angle);
  constexpr double points_a_period = 24, most = 1e5;
  const double count = std::min(most, std::ceil(end * swing.frequency * points_a_period));
  for (double k = 0; swing.frequency > 0 && k <= count; ++k)
    body.path.push_back(swing.at(k / (points_a_period * swing.frequency)));
  if (body.path.empty()) return;
  body.position = body.path.front().position;
  body.attitude = body.path.front().attitude;
}

/// When a prescribed body is let go.
void read_release(Reader& reader, Release& release) {
  std::string at = "contact";
  if (!reader.choice("at", at, {"time", "contact", "load"}, Need::required)) return reader.skip_all();
  release.at_contact = at == "contact";
  if (at == "time")
    reader.number("time", release.time.emplace(1), positive("s", "Use the time at which it is let go, e.g. 0.5."),
                  Need::required);
  else
    reader.refuse("time", "only a release with at = \"time\" has one", "Remove it, or change at.");
  if (at == "load")
    reader.number("load", release.load.emplace(1),
                  positive(reader.context().dimension == 2 ? "N/m" : "N", "Use the water's load that frees it."),
                  Need::required);
  else
    reader.refuse("load", "only a release with at = \"load\" has one", "Remove it, or change at.");
}

/// The keys of an attitude; two dimensions know the pitch alone.
struct Angle {
  const char* name;
  double Attitude::*value;
};
std::vector<Angle> angles(int dimension) {
  if (dimension == 2) return {{"pitch_deg", &Attitude::pitch_deg}};
  return {
      {"heading_deg", &Attitude::heading_deg}, {"pitch_deg", &Attitude::pitch_deg}, {"roll_deg", &Attitude::roll_deg}};
}

}  // namespace

void read_body(Reader& reader, Body& body, const Scene& scene) {
  const int dimension = scene.dimension;
  read_name(reader, body.name, "hull");
  body.motion = read_motion(reader);
  read_mass(reader, body);
  body.free = freedom_names(dimension);
  if (body.motion == Motion::prescribed) {
    if (auto release = reader.table("release")) read_release(*release, body.release.emplace());
  } else {
    reader.refuse("release", "only a body with motion = \"prescribed\" is let go", "Remove it, or change the motion.");
  }
  if (body.becomes_free())
    reader.choices("free", body.free, freedom_names(dimension));
  else
    reader.refuse("free", "only a body with motion = \"free\" or a release has freedoms", "Remove it.");

  if (body.motion == Motion::prescribed)
    read_path(reader, body);
  else
    reader.refuse("path", "only a body with motion = \"prescribed\" follows a path",
                  "Remove it, or change the motion.");
  const bool follows_path = !body.path.empty();
  const std::string on_path = "the path already says it", drop = "Remove it, or the path.";
  if (follows_path) {
    reader.refuse("position", on_path, drop);
    for (const auto& angle : angles(dimension)) reader.refuse(angle.name, on_path, drop);
    body.position = body.path.front().position;
    body.attitude = body.path.front().attitude;
  } else {
    reader.point("position", body.position, place_rule(dimension));
    for (const auto& angle : angles(dimension))
      reader.number(angle.name, body.attitude.*angle.value,
                    within(-360, 360, "deg", dimension == 2 ? "Use degrees, counter-clockwise." : "Use degrees."));
  }
  if (body.motion == Motion::prescribed && !follows_path) {
    auto swing = reader.holds("oscillation") ? reader.table("oscillation") : std::nullopt;
    swing ? read_oscillation(*swing, body, scene.time.end) : reader.skip("oscillation");
  } else {
    reader.refuse("oscillation", "only a body with motion = \"prescribed\" and without a path has one",
                  "Remove it, or the path, or change the motion.");
  }
  if (body.oscillation) {
    reader.refuse("velocity", "the oscillation already says it", "Remove it, or the oscillation.");
    reader.refuse("spin_deg", "the oscillation already says it", "Remove it, or the oscillation.");
  } else if (follows_path || body.motion == Motion::fixed) {
    const auto rule = follows_path ? on_path : "a fixed body does not move";
    reader.refuse("velocity", rule, follows_path ? drop : "Remove it, or change the motion.");
    reader.refuse("spin_deg", rule, follows_path ? drop : "Remove it, or change the motion.");
  } else {
    reader.point("velocity", body.velocity, any("m/s", "Use metres per second, one number for each axis."));
    reader.rotation("spin_deg", body.spin_deg,
                    any("deg/s", dimension == 2 ? "Use degrees per second, counter-clockwise."
                                                : "Use degrees per second about x, y and z."));
  }
  if (scene.fluid) {
    body.size = scene.fluid->size.surface;
    reader.number("size", body.size,
                  refined(positive("m", "Use e.g. a fiftieth of the body's breadth."), scene.fluid->size.refine));
  } else if (scene.ale) {
    body.size = scene.ale->hull;
    reader.number("size", body.size,
                  refined(positive("m", "Use e.g. a twentieth of the body's breadth."), scene.ale->refine));
  } else {
    reader.skip("size");
  }
  if (auto shape = reader.table("shape", Need::required)) read_shape(*shape, body.shape);
}

void read_name(Reader& reader, std::string& name, const std::string& example) {
  const std::string cure = "Use letters, digits, _ and -, e.g. " + example + ".";
  reader.text("name", name, cure, Need::required);
  const auto key = reader.key("name");
  auto& problems = reader.context().problems;
  if (!problems.found_in(key) && !is_good_name(name))
    problems.add(key, "must be made of letters, digits, _ and -, not of digits alone, and not be 'tank'", cure);
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
  reader.reference(key, name, names, need);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace splashdown::apps
