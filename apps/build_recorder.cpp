#include "apps/build.hpp"
#include "apps/scene_geometry.hpp"

namespace splashdown::apps {
namespace {

/// From the shape's frame to the body's, whose origin is the centre of mass.
rigid::Vec<2> in_body(const Body& body, const Point& point) {
  return planar(point) - mass_properties(body).centre;
}

struct AddRecord {
  const Scene& scene;
  RecorderSettings<2>& settings;

  void operator()(const PressureEntry& entry) const {
    if (entry.body) {
      const auto& body = scene.bodies[*entry.body];
      settings.pressure_probes.push_back({entry.name, in_body(body, entry.point), body.name});
    } else {
      settings.pressure_probes.push_back({entry.name, planar(entry.point), {}});
    }
  }
  void operator()(const SurfacePressureEntry& entry) const {
    settings.surface_pressure.push_back({entry.wall, entry.interval, entry.times});
  }
  void operator()(const ElevationEntry& entry) const {
    settings.gauges.push_back({entry.name, Eigen::Matrix<double, 1, 1>(entry.x)});
  }
  void operator()(const AccelerationEntry& entry) const {
    const auto& body = scene.bodies[entry.body];
    settings.equipment.push_back({entry.name, body.name, in_body(body, entry.point)});
  }
  void operator()(const AddedMassEntry& entry) const {
    settings.added_mass.push_back({scene.bodies[entry.body].name, entry.interval, entry.times});
  }
};

}  // namespace

RecorderSettings<2> recorder_settings(const Scene& scene, const std::filesystem::path& directory) {
  RecorderSettings<2> settings;
  settings.directory = directory;
  settings.interval = scene.output.interval;
  settings.frames = scene.output.frames;
  for (const auto& record : scene.records) std::visit(AddRecord{scene, settings}, record);
  return settings;
}

}  // namespace splashdown::apps
