#include "apps/effects/lines/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/geometry.hpp"
#include "apps/scene/read/reader.hpp"
#include "rigid/lines/line.hpp"

namespace splashdown::apps {
namespace {

template <int d>
Point placed(const Body& body, const Point& point) {
  Point place = Point::Zero();
  place.head<d>() = shape_pose<d>(body) * vec<d>(point);
  return place;
}

Point placed_in(const Scene& scene, std::size_t body, const Point& point) {
  return scene.dimension == 2 ? placed<2>(scene.bodies[body], point) : placed<3>(scene.bodies[body], point);
}

/// From corner to corner of the tank and all that the scene puts somewhere: no line between two of these places is longer when taut.
template <int d>
double widest(const Scene& scene, const LineEntry& line) {
  const LineEnds ends = ends_at_start(scene, line);
  Extents<d> box = extents<d>(*scene.tank);
  box.extend(vec<d>(ends.from)).extend(vec<d>(ends.to));
  for (const auto& body : scene.bodies) box.extend(extents<d>(outline<d>(body)));
  return box.diagonal().norm();
}

double widest(const Scene& scene, const LineEntry& line) {
  return scene.dimension == 2 ? widest<2>(scene, line) : widest<3>(scene, line);
}

double height(const Scene& scene, const Point& point) { return point[scene.dimension - 1]; }

/// The end of a catenary at t = 0.
rigid::CatenaryEnd catenary_at_start(const Scene& scene, const LineEntry& line) {
  const LineEnds ends = ends_at_start(scene, line);
  const Point offset = ends.from - ends.to;
  const double up = height(scene, offset);
  const rigid::CatenarySpec spec{line.length, *line.axial_stiffness, line.catenary->weight,
                                 line.catenary->floor == "at_anchor", line.catenary->friction};
  return rigid::catenary_end(spec, {offset.head(scene.dimension - 1).norm(), up});
}

void check_line(const Scene& scene, const LineEntry& line, Problems& problems) {
  const auto wrong = [&](const std::string& key, const std::string& rule, const std::string& cure) {
    problems.add(line.path + key, rule, cure);
  };
  const auto moves = [&](std::size_t body) { return scene.bodies[body].becomes_free(); };
  if (line.other == line.body) wrong(".other", "a body cannot be tied to itself", "Name another body, or use anchor.");
  if (!moves(line.body) && !(line.other && moves(*line.other)))
    wrong(".body",
          fmt::format("the line moves nothing: '{}' is not free, nor is what it is tied to",
                      scene.bodies[line.body].name),
          "Remove the line, or free a body.");
  if (line.catenary && !line.anchor)
    wrong(".catenary", "a catenary ends at an anchor", "Use anchor, or remove [line.catenary].");
  if (line.release.wets && !scene.fluid)
    wrong(".release.wets", "there is no water that could wet it", "Add [fluid], or release at a time or load.");
  if (line.canopy && scene.time.end < line.canopy->start)
    wrong(".canopy.start", fmt::format("must not lie behind time.end = {:g} s", scene.time.end), "Use e.g. 0.");
  if (problems.found_in("tank") || problems.found_in("body") || problems.found_in(line.path)) return;
  // Without a tank bodies may go anywhere; so may a parachute.
  const double room = scene.tank && !line.canopy ? widest(scene, line) : std::numeric_limits<double>::infinity();
  if (line.length > room)
    wrong(".length",
          fmt::format("must not exceed {:.4g} m, the diagonal of the box around tank, bodies and the line's ends: it "
                      "could never be taut",
                      room),
          fmt::format("Use e.g. {:.4g}, the distance of its ends at t = 0.", ends_at_start(scene, line).apart()));
  if (!line.catenary || line.catenary->floor != "at_anchor") return;
  const LineEnds ends = ends_at_start(scene, line);
  if (height(scene, ends.from) < height(scene, ends.to))
    wrong(".anchor", "must not lie above the place where the line is tied, or the floor that it stands on does",
          "Move the anchor down, or use floor = \"none\".");
}

/// Tension at t = 0, without damping [N, N/m].
double tension_at_start(const Scene& scene, const LineEntry& line) {
  if (line.catenary) return catenary_at_start(scene, line).force.norm();
  return std::max(0., stiffness_of(line) * (ends_at_start(scene, line).apart() - line.length));
}

template <int d>
rigid::LineEnd<d> end_on(const Scene& scene, std::size_t body, const Point& point) {
  return {body, vec<d>(point) - mass_properties<d>(scene.bodies[body]).centre};
}

template <int d>
rigid::LineSpec<d> spec_of(const Scene& scene, const LineEntry& line) {
  rigid::LineSpec<d> spec;
  spec.name = line.name;
  spec.from = end_on<d>(scene, line.body, line.point);
  if (line.other) spec.to = end_on<d>(scene, *line.other, line.other_point);
  if (line.anchor) spec.to.point = vec<d>(*line.anchor);
  spec.length = line.length;
  spec.release = {line.release.time, line.release.load, line.release.wets};
  if (line.catenary) {
    spec.catenary = rigid::CatenarySpec{line.length, *line.axial_stiffness, line.catenary->weight,
                                        line.catenary->floor == "at_anchor", line.catenary->friction};
    return spec;
  }
  spec.spring = {stiffness_of(line), line.damping};
  if (!line.canopy) return spec;
  const CanopyEntry& entry = *line.canopy;
  spec.to.point = vec<d>(entry.position);
  auto& canopy = spec.canopy.emplace();
  canopy.mass = entry.mass;
  canopy.drag_area = entry.drag_area;
  canopy.start = entry.start;
  canopy.inflation = entry.inflation;
  canopy.air_density = entry.air_density;
  if (scene.gravity) canopy.gravity = vec<d>(scene.gravity->acceleration);
  canopy.water_level = still_water_level<d>(scene);
  return spec;
}

}  // namespace

double stiffness_of(const LineEntry& line) {
  return line.stiffness ? *line.stiffness : line.axial_stiffness.value_or(0) / line.length;
}

LineEnds ends_at_start(const Scene& scene, const LineEntry& line) {
  LineEnds ends{placed_in(scene, line.body, line.point), Point::Zero()};
  if (line.other) ends.to = placed_in(scene, *line.other, line.other_point);
  if (line.anchor) ends.to = *line.anchor;
  if (line.canopy) ends.to = line.canopy->position;
  return ends;
}

void LinesKind::check(const Scene& scene, Problems& problems) const {
  const auto* lines = scene.effects.find<Lines>();
  if (!lines) return;
  for (std::size_t i = 0; i < lines->all.size(); ++i) {
    const LineEntry& line = lines->all[i];
    const bool taken = std::any_of(lines->all.begin(), lines->all.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const LineEntry& other) { return other.name == line.name; });
    if (taken) problems.add(line.path + ".name", "another line has this name", "Give each line a name of its own.");
    check_line(scene, line, problems);
  }
}

void LinesKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const Scene& scene = asked.scene;
  constexpr double long_stretch = 0.2;  // ropes of polyester break at 12 %, of nylon at 20 to 30 %
  const auto* lines = scene.effects.find<Lines>();
  if (!lines) return;
  for (const LineEntry& line : lines->all) {
    const LineEnds ends = ends_at_start(scene, line);
    const double stretch = ends.apart() / line.length - 1;
    if (stretch > long_stretch)
      questions.push_back(
          fmt::format("{}.length = {:g} m: its ends are {:.4g} m apart at t = 0, it is stretched by {:.3g} % and pulls "
                      "with {:.3g} {}: "
                      "did you mean {:.4g} m?",
                      line.path, line.length, ends.apart(), 100 * stretch, tension_at_start(scene, line),
                      scene.dimension == 2 ? "N/m" : "N", ends.apart()));
    if (!line.anchor || !scene.tank) continue;
    const int n = scene.dimension;
    const Point anchor = *line.anchor;
    const bool beside = (anchor.array() < scene.tank->min.array()).head(n - 1).any() ||
                        (anchor.array() > scene.tank->max.array()).head(n - 1).any();
    if (beside)
      questions.push_back(
          fmt::format("{}.anchor lies outside the tank: the line passes through its wall. Is it meant to "
                      "be fixed that far away?",
                      line.path));
    const double floor = height(scene, scene.tank->min);
    if (line.catenary && line.catenary->floor == "at_anchor" &&
        std::abs(height(scene, anchor) - floor) > 1e-3 * (line.length))
      questions.push_back(
          fmt::format("{}.anchor stands on a floor at {:g} m, the tank's is at {:g} m: did you mean {:g} m?", line.path,
                      height(scene, anchor), floor, floor));
  }
}

std::optional<EffectNote> LinesKind::note(const Scene& scene, const Scales& /*scales*/) const {
  const auto* lines = scene.effects.find<Lines>();
  if (!lines) return {};
  std::string text;
  for (const LineEntry& line : lines->all) {
    const double tension = tension_at_start(scene, line);
    text += fmt::format("{}{}: ", text.empty() ? "" : "; ", line.name);
    text += tension > 0 ? fmt::format("pulls with {:.3g} {} at t = 0", tension, scene.dimension == 2 ? "N/m" : "N")
                        : fmt::format("slack by {:.3g} m at t = 0", line.length - ends_at_start(scene, line).apart());
    if (line.catenary) {
      const auto end = catenary_at_start(scene, line);
      if (end.on_floor > 0) text += fmt::format(", {:.3g} m of it on the floor", end.on_floor);
    } else if (const auto mass = scene.bodies[line.body].mass) {
      text += fmt::format(", sqrt(m/k) = {:.3g} s", std::sqrt(*mass / stiffness_of(line)));
    }
    if (line.canopy && scene.gravity && scene.bodies[line.body].mass) {
      const double weight = (*scene.bodies[line.body].mass + line.canopy->mass) * scene.gravity->acceleration.norm();
      text += fmt::format(", lets down at {:.3g} m/s",
                          std::sqrt(2 * weight / (line.canopy->air_density * line.canopy->drag_area)));
    }
  }
  return EffectNote{"line", true, text};
}

template <int d>
void LinesKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  for (const LineEntry& line : scene.effects.find<Lines>()->all)
    parts.forces.push_back(std::make_unique<rigid::Line<d>>(spec_of<d>(scene, line)));
}

template void LinesKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void LinesKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
