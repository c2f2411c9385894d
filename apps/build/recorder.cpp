#include "apps/build/build.hpp"
#include "apps/build/symmetry.hpp"
#include "apps/scene/patch.hpp"

namespace splashdown::apps {
namespace {

/// From the shape's frame to the body's, whose origin is the centre of mass.
template <int d>
rigid::Vec<d> in_body(const Body& body, const Point& point) {
  return vec<d>(point) - mass_properties<d>(body).centre;
}

template <int d>
struct AddRecord {
  const Scene& scene;
  RecorderSettings<d>& settings;

  void operator()(const PressureEntry& entry) const {
    if (entry.body) {
      const auto& body = scene.bodies[*entry.body];
      settings.pressure_probes.push_back({entry.name, in_body<d>(body, entry.point), body.name});
    } else {
      settings.pressure_probes.push_back({entry.name, vec<d>(entry.point), {}});
    }
  }
  void operator()(const SurfacePressureEntry& entry) const {
    settings.surface_pressure.push_back({entry.wall, entry.interval, entry.times});
  }
  void operator()(const ElevationEntry& entry) const {
    settings.gauges.push_back({entry.name, Eigen::Vector2d(entry.x, entry.y).head<d - 1>()});
  }
  void operator()(const AccelerationEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    settings.equipment.push_back({entry.name, body.name, in_body<d>(body, entry.point)});
  }
  void operator()(const AddedMassEntry& entry) const {
    settings.added_mass.push_back({scene.bodies[entry.body].name, entry.interval, entry.times});
  }
  void operator()(const PatchEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    const auto hull = body_spec<d>(body).surface;
    const auto region = patch_region<d>(entry, hull, mass_properties<d>(body).centre);
    settings.patches.push_back({entry.name, body.name, region, patch_area<d>(region, hull)});
  }
  void operator()(const MaximumPressureEntry& entry) const {
    const auto spec = body_spec<d>(scene.bodies[entry.body]);
    settings.hull_maps.push_back({spec.name, {spec.surface.vertices, spec.surface.facets}, spec.pose, entry.size});
  }
};

}  // namespace

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
  return settings;
}

template RecorderSettings<2> recorder_settings<2>(const Scene&, const std::filesystem::path&);
template RecorderSettings<3> recorder_settings<3>(const Scene&, const std::filesystem::path&);

}  // namespace splashdown::apps
