#include "apps/new/hull.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "apps/new/numbers.hpp"
#include "apps/new/units.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/echo.hpp"
#include "core/surface/repair.hpp"
#include "core/surface/surface_file.hpp"
#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::apps {
namespace {

/// Letters, digits, _ and -, as names of bodies are.
std::string name_of(const NewOptions& options, const std::string& otherwise) {
  std::string name = options.name.empty() ? otherwise : options.name;
  for (auto& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  const bool digits = std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  return name.empty() || digits || name == "tank" ? "hull_" + name : name;
}

Vec<3> axis_of(const std::string& option, const std::string& word) {
  const bool back = word.starts_with("-");
  const auto axis = std::string("xyz").find(word.substr(back ? 1 : 0));
  if (word.size() != (back ? 2u : 1u) || axis == std::string::npos)
    throw NewError(fmt::format("{} {}: must be x, y or z of the file, with a - for the other way", option, word));
  return (back ? -1 : 1) * Vec<3>::Unit(static_cast<Eigen::Index>(axis));
}

/// From the file's axes to nose along x, z up.
Eigen::Matrix3d turn_of(const NewOptions& options) {
  const Vec<3> nose = axis_of("--nose", options.nose), up = axis_of("--up", options.up);
  if (std::abs(nose.dot(up)) > 0.5)
    throw NewError(
        fmt::format("--nose {} --up {}: both are along one axis. Name two of x, y and z", options.nose, options.up));
  Eigen::Matrix3d turn;
  turn << nose.transpose(), up.cross(nose).transpose(), up.transpose();
  return turn;
}

void tell_axes(const NewOptions& options, const Vec<3>& size, std::vector<Assumption>& told) {
  told.push_back(
      {"axes", fmt::format("the nose is along {}, up is {} of the file ({:.3g} m long, {:.3g} m wide, {:.3g} m "
                           "high): --nose and --up say otherwise",
                           options.nose, options.up, size.x(), size.y(), size.z())});
  if (size.z() > 1.2 * std::max(size.x(), size.y()))  // more than a sphere's facets
    told.push_back(
        {"axes", "QUESTION: the hull is higher than it is long: is another axis of the file upward (--up y)?"});
  else if (size.y() > 1.5 * size.x())
    told.push_back({"axes", "QUESTION: the hull is wider than it is long: wings, or is the nose along y (--nose y)?"});
}

struct GivenSurface {
  Surface<3> surface;
  int parts = 1;
};

bool can_be_repaired(const std::string& file) {
  try {
    repaired_surface(file);
    return true;
  } catch (const SurfaceFileError&) {
    return false;
  }
}

void refuse_missing(const std::string& file) {
  if (!std::filesystem::exists(file)) throw NewError(file + ": there is no such file. Name an STL or OBJ file");
  if (std::filesystem::is_directory(file)) throw NewError(file + ": is a folder. Name an STL or OBJ file");
}

GivenSurface read_given(const NewOptions& options, NewHull& hull) {
  refuse_missing(options.hull);
  try {
    if (!options.repair) {
      auto file = read_surface_file(options.hull);
      return {std::move(file.surface), file.parts};
    }
    auto repaired = repaired_surface(options.hull);
    for (const auto& line : repaired.done) hull.told.push_back({"repair", line});
    if (repaired.done.empty())
      hull.told.push_back({"repair", "nothing was there to repair: the file is used as it is"});
    if (!repaired.done.empty()) hull.write = repaired.surface;
    return {std::move(repaired.surface), 1};
  } catch (const SurfaceFileError& error) {
    const bool offer = !options.repair && can_be_repaired(options.hull);
    throw NewError(fmt::format("{}: {}. {}{}", options.hull, error.what(), error.cure(),
                               offer ? " Or try --repair, which says what it does" : ""));
  }
}

NewHull hull_of_file(const NewOptions& options) {
  NewHull hull;
  hull.name = name_of(options, std::filesystem::path(options.hull).stem().string());
  auto given = read_given(options, hull);
  const auto turn = turn_of(options);
  if (!turn.isIdentity()) {
    given.surface.vertices = (turn * given.surface.vertices).eval();
    hull.write = given.surface;
  }
  rigid::MassProperties<3> uniform;
  try {
    uniform = rigid::mass_properties<3>(given.surface);
  } catch (const std::invalid_argument& error) {
    throw NewError(
        fmt::format("{}: {}. Give the hull a thickness, e.g. Blender: Solidify", options.hull, error.what()));
  }
  const Vec<3> extent = extents<3>(given.surface).sizes();
  auto unit = unit_of(options, extent.maxCoeff(), uniform.mass);
  std::ranges::move(unit.told, std::back_inserter(hull.told));
  SurfaceShape shape{.file = options.hull, .scale = unit.scale, .parts = given.parts, .read = {}};
  const rigid::Surface<3> scaled{unit.scale * given.surface.vertices, given.surface.facets};
  shape.read = std::make_shared<rigid::Shape<3>>(rigid::Shape<3>{scaled, rigid::mass_properties<3>(scaled)});
  tell_axes(options, unit.scale * extent, hull.told);
  hull.told.push_back(
      {"hull",
       fmt::format("closed, normals outward, {} facets{}, encloses {:.3g} m^3", scaled.facets.cols(),
                   given.parts > 1 ? fmt::format(" in {} parts", given.parts) : "", shape.read->at_unit_density.mass)});
  hull.toml = fmt::format("scale = {}", toml_text(unit.scale));
  hull.shape = std::move(shape);
  return hull;
}

double needed(const std::optional<double>& value, const std::string& shape, const char* option, const char* example) {
  if (!value) throw NewError(fmt::format("--shape {} needs {}. Use e.g. {} {}", shape, option, option, example));
  if (!(*value > 0) || !std::isfinite(*value)) throw NewError(fmt::format("{} {:g}: must be positive", option, *value));
  return *value;
}

struct NamedShape {
  const char* name;
  int dimension;
  Shape (*make)(const NewOptions&);
  std::string (*toml)(const Shape&);
};

double radius_of(const NewOptions& o) { return needed(o.radius, o.shape, "--radius", "0.25"); }
double deadrise_of(const NewOptions& o) { return needed(o.deadrise, o.shape, "--deadrise", "20"); }

Shape capsule(const NewOptions& o) {
  return CapsuleShape{.radius = radius_of(o), .length = needed(o.length, o.shape, "--length", "0.8")};
}
std::string capsule_text(const Shape& shape) {
  const auto& s = std::get<CapsuleShape>(shape);
  return fmt::format("radius = {}, length = {}", toml_text(s.radius), toml_text(s.length));
}
Shape box(const NewOptions& o) {
  if (o.size.empty())
    throw NewError(o.plane ? "--shape box needs --size. Use e.g. --size 0.5,0.2"
                           : "--shape box needs --size. Use e.g. --size 1.2,0.4,0.3");
  const auto size = numbers_of_list("--size", o.size, o.plane ? 2 : 3);
  if (std::ranges::any_of(size, [](double s) { return !(s > 0); }))
    throw NewError(fmt::format("--size {}: all lengths must be positive", o.size));
  if (o.plane) return RectangleShape{.width = size[0], .height = size[1]};
  return BoxShape{.size = {size[0], size[1], size[2]}};
}
std::string flat_box_text(const Shape& shape) {
  const auto& s = std::get<RectangleShape>(shape);
  return fmt::format("width = {}, height = {}", toml_text(s.width), toml_text(s.height));
}
std::string box_text(const Shape& shape) {
  const auto& s = std::get<BoxShape>(shape).size;
  return "size = " + toml_list(std::vector<double>{s.x(), s.y(), s.z()});
}

const std::vector<NamedShape>& named_shapes() {
  static const std::vector<NamedShape> shapes = {
      {"capsule", 3, capsule, capsule_text},
      {"sphere", 3, [](const NewOptions& o) -> Shape { return SphereShape{.radius = radius_of(o)}; },
       [](const Shape& s) { return "radius = " + toml_text(std::get<SphereShape>(s).radius); }},
      {"box", 3, box, box_text},
      {"cone", 3,
       [](const NewOptions& o) -> Shape { return ConeShape{.deadrise_deg = deadrise_of(o), .radius = radius_of(o)}; },
       [](const Shape& s) {
         const auto& cone = std::get<ConeShape>(s);
         return fmt::format("deadrise_deg = {}, radius = {}", toml_text(cone.deadrise_deg), toml_text(cone.radius));
       }},
      {"capsule", 2, capsule, capsule_text},
      {"circle", 2, [](const NewOptions& o) -> Shape { return CircleShape{.radius = radius_of(o)}; },
       [](const Shape& s) { return "radius = " + toml_text(std::get<CircleShape>(s).radius); }},
      {"box", 2, box, flat_box_text},
      {"wedge", 2,
       [](const NewOptions& o) -> Shape {
         return WedgeShape{.deadrise_deg = deadrise_of(o),
                           .breadth = needed(o.breadth, o.shape, "--breadth", "0.5"),
                           .height = o.height};
       },
       [](const Shape& s) {
         const auto& wedge = std::get<WedgeShape>(s);
         return fmt::format("deadrise_deg = {}, breadth = {}{}", toml_text(wedge.deadrise_deg),
                            toml_text(wedge.breadth), wedge.height ? ", height = " + toml_text(*wedge.height) : "");
       }}};
  return shapes;
}

NewHull hull_of_shape(const NewOptions& options) {
  std::string names;
  for (const auto& known : named_shapes()) {
    if (known.dimension != options.dimension()) continue;
    if (known.name != options.shape) {
      names += (names.empty() ? "" : ", ") + std::string(known.name);
      continue;
    }
    NewHull hull;
    hull.name = name_of(options, options.shape);
    hull.shape = known.make(options);
    hull.toml = known.toml(hull.shape);
    return hull;
  }
  throw NewError(fmt::format("--shape {}: must be one of {} {}", options.shape, names,
                             options.plane ? "in the plane" : "in space; --plane has wedge, circle, box, capsule"));
}

/// Options of the other way to name a hull.
void refuse_strangers(const NewOptions& o) {
  const bool file = !o.hull.empty();
  const struct {
    const char* option;
    bool given;
  } strangers[] = {
      {"--radius", file && o.radius},         {"--length", file && o.length},     {"--breadth", file && o.breadth},
      {"--height", file && o.height},         {"--deadrise", file && o.deadrise}, {"--size", file && !o.size.empty()},
      {"--units", !file && !o.units.empty()}, {"--scale", !file && o.scale},      {"--nose", !file && o.nose != "x"},
      {"--up", !file && o.up != "z"},         {"--repair", !file && o.repair}};
  for (const auto& [option, given] : strangers)
    if (given) throw NewError(fmt::format("{}: is for {}. Leave it out", option, file ? "shapes" : "hulls from files"));
}

}  // namespace

NewHull new_hull(const NewOptions& options) {
  if (options.hull.empty() == options.shape.empty())
    throw NewError(options.hull.empty() ? "there is no hull. Name an STL or OBJ file, or a shape, e.g. --shape capsule"
                                        : "a file and --shape: there is one hull. Leave one of them out");
  if (!options.hull.empty() && options.plane)
    throw NewError("--plane: files are hulls in space. Leave it out, or use --shape wedge");
  refuse_strangers(options);
  return options.hull.empty() ? hull_of_shape(options) : hull_of_file(options);
}

}  // namespace splashdown::apps
