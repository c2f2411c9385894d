#include <algorithm>

#include "apps/build/build.hpp"
#include "apps/build/symmetry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/patch.hpp"

namespace splashdown::apps {
namespace {

/// From the shape's frame to the body's, whose origin is the centre of mass.
template <int d>
rigid::Vec<d> in_body(const Body& body, const rigid::Vec<d>& point) {
  return point - mass_properties<d>(body).centre;
}

template <int d>
std::optional<ShapeMirror<d>> mirror_in(const Scene& scene, const Body& body) {
  const auto mirror = mirror_of(scene);
  return mirror ? std::optional(in_frame<d>(*mirror, shape_pose<d>(body))) : std::nullopt;
}

/// A point of a body, or its mirror image, whichever is simulated; shape's frame.
template <int d>
rigid::Vec<d> simulated(const Scene& scene, const Body& body, const Point& point) {
  const auto mirror = mirror_in<d>(scene, body);
  return mirror ? mirror->kept(vec<d>(point)) : vec<d>(point);
}
/// The same of one that stays in place.
template <int d>
rigid::Vec<d> simulated(const Scene& scene, const Point& point) {
  const auto mirror = mirror_of(scene);
  return mirror && point[mirror->axis] < mirror->at ? mirror->image<d>(vec<d>(point)) : vec<d>(point);
}

/// What a patch, or its mirror image, has before the plane, whichever is more; body frame.
template <int d>
PatchRegion<d> simulated(const PatchRegion<d>& region, const ShapeMirror<d>& mirror, const rigid::Vec<d>& origin,
                         const rigid::Surface<d>& hull) {
  const auto& m = mirror.normal;
  const double place = mirror.offset - m.dot(origin);
  auto image = region;
  for (auto& side : image.sides) {
    side.offset -= 2 * place * m.dot(side.normal);
    side.normal -= 2 * m.dot(side.normal) * m;
  }
  if (image.facing) *image.facing -= 2 * m.dot(*image.facing) * m;
  const auto before = [&](PatchRegion<d> cut) {
    cut.sides.push_back({-m, -place});
    return cut;
  };
  const auto own = before(region), other = before(image);
  return patch_area<d>(other, hull) > (1 + 1e-9) * patch_area<d>(own, hull) ? other : own;
}

template <int d>
struct AddRecord {
  const Scene& scene;
  RecorderSettings<d>& settings;

  void operator()(const PressureEntry& entry) const {
    if (entry.body) {
      const auto& body = scene.bodies[*entry.body];
      settings.pressure_probes.push_back(
          {entry.name, in_body<d>(body, simulated<d>(scene, body, entry.point)), body.name});
    } else {
      settings.pressure_probes.push_back({entry.name, simulated<d>(scene, entry.point), {}});
    }
  }
  void operator()(const SurfacePressureEntry& entry) const {
    settings.surface_pressure.push_back({entry.wall, entry.interval, entry.times});
  }
  void operator()(const ElevationEntry& entry) const {
    Point at = Point::Zero();
    at.head<d - 1>() = Eigen::Vector2d(entry.x, entry.y).head<d - 1>();
    settings.gauges.push_back({entry.name, simulated<d>(scene, at).template head<d - 1>()});
  }
  void operator()(const AccelerationEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    settings.equipment.push_back({entry.name, body.name, in_body<d>(body, vec<d>(entry.point))});
  }
  void operator()(const AddedMassEntry& entry) const {
    settings.added_mass.push_back({scene.bodies[entry.body].name, entry.interval, entry.times});
  }
  void operator()(const SectionEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    const auto spec = body_spec<d>(body);
    const rigid::Vec<d> axis = rigid::Vec<d>::Unit(entry.axis);
    SectionRecord<d> record;
    record.name = entry.name;
    record.body = body.name;
    record.axis = entry.axis;
    record.centre = axis.dot(mass_properties<d>(body).centre);
    record.every = entry.interval;
    record.times = entry.times;
    if (scene.gravity) record.gravity = vec<d>(scene.gravity->acceleration);
    std::vector<double> places;
    for (const double station : entry.stations) places.push_back(station - record.centre);
    std::ranges::sort(places);
    if (places.empty()) {
      const auto along = spec.surface.vertices.row(entry.axis);
      const double low = along.minCoeff(), step = (along.maxCoeff() - low) / entry.sections;
      for (int k = 0; k <= entry.sections; ++k) places.push_back(low + k * step);
    }
    const auto mass = spread_mass<d>(body, entry);
    for (const double place : places) record.stations.push_back({place, mass_ahead<d>(mass, axis, place)});
    settings.sections.push_back(std::move(record));
  }
  void operator()(const VelocityLineEntry& entry) const {
    VelocityLineRecord<d> record{
        .name = entry.name, .points = {}, .every = entry.interval, .times = entry.times, .mirror = mirror_of(scene)};
    const rigid::Vec<d> from = vec<d>(entry.from), way = vec<d>(entry.to) - from;
    for (int k = 0; k < entry.points; ++k) record.points.emplace_back(from + way * (double(k) / (entry.points - 1)));
    settings.velocity_lines.push_back(std::move(record));
  }
  void operator()(const PassesEntry& entry) const { settings.passes = PassesRecord{entry.interval, entry.times}; }
  void operator()(const PatchEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    const auto spec = body_spec<d>(body);
    const auto& hull = spec.surface;
    const rigid::Vec<d> origin = mass_properties<d>(body).centre;
    auto region = patch_region<d>(entry, hull, origin);
    if (const auto mirror = mirror_in<d>(scene, body)) region = simulated(region, *mirror, origin, hull);
    settings.patches.push_back({entry.name, body.name, region, patch_area<d>(region, hull), spec.pose});
  }
  void operator()(const MaximumPressureEntry& entry) const {
    const auto spec = body_spec<d>(scene.bodies[entry.body]);
    auto surface = spec.surface;
    if (const auto mirror = mirror_of(scene)) surface = kept_part<d>(in_frame<d>(*mirror, spec.pose), surface);
    settings.hull_maps.push_back({spec.name, {surface.vertices, surface.facets}, spec.pose, entry.size});
  }
};

}  // namespace

template <int d>
MassDistribution<d> spread_mass(const Body& body, const SectionEntry& entry) {
  const auto properties = mass_properties<d>(body);
  std::vector<PointMass<d>> points;
  for (const auto& part : entry.parts) points.push_back({part.mass, vec<d>(part.point) - properties.centre});
  return distributed<d>(body_spec<d>(body).surface, properties.mass, std::move(points));
}

template <int d>
RecorderSettings<d> recorder_settings(const Scene& scene, const std::filesystem::path& directory) {
  RecorderSettings<d> settings;
  settings.directory = directory;
  settings.interval = scene.output.interval;
  settings.frames = scene.output.frames;
  for (const auto& body : scene.bodies) {
    settings.centre_of_mass[body.name] = mass_properties<d>(body).centre;
    settings.symmetric[body.name] = symmetric_axes<d>(scene, body);
  }
  for (const auto& record : scene.records) std::visit(AddRecord<d>{scene, settings}, record);
  for (const auto* kind : effect_kinds()) {
    if (!kind->present(scene)) continue;
    for (auto& [name, value] : kind->signals(scene)) settings.signals.push_back({name, value});
  }
  return settings;
}

template MassDistribution<2> spread_mass<2>(const Body&, const SectionEntry&);
template MassDistribution<3> spread_mass<3>(const Body&, const SectionEntry&);
template RecorderSettings<2> recorder_settings<2>(const Scene&, const std::filesystem::path&);
template RecorderSettings<3> recorder_settings<3>(const Scene&, const std::filesystem::path&);

}  // namespace splashdown::apps
