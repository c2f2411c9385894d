#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "apps/scene/patch.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

template <int d>
class RecordChecker {
 public:
  RecordChecker(const Scene& scene, Problems& problems) : scene_(scene), problems_(problems) {}

  void check(const RecordEntry& entry, const std::string& label) {
    label_ = label;
    std::visit(*this, entry);
  }

  void operator()(const PressureEntry& entry) {
    needs_fluid();
    unique(entry.name);
    if (problems_.found_in(label_)) return;
    const rigid::Vec<d> point = vec<d>(entry.point);
    if (!entry.body) return inside_tank(point, ".point");
    const auto& body = scene_.bodies[*entry.body];
    inside_tank(shape_pose<d>(body) * point, ".point");
    try {
      const Solid<d> hull(shape_of<d>(body.shape).surface);
      const double extent = hull.extents().diagonal().norm(), depth = -hull.signed_distance(point);
      // A sensor flush with the hull, up to the digits people write.
      if (depth > 1e-3 * extent)
        problems_.add(label_ + ".point",
                      fmt::format("lies {:g} m inside the body '{}', where there is never water", depth, body.name),
                      "Put it on the hull (coordinates of the shape's frame).");
    } catch (const std::invalid_argument&) {  // the body's own check has reported it
    }
  }
  void operator()(const SurfacePressureEntry& entry) {
    needs_fluid();
    within_run(entry.times);
  }
  void operator()(const ElevationEntry& entry) {
    needs_fluid();
    unique(entry.name);
    if (!scene_.tank || problems_.found_in(label_)) return;
    rigid::Vec<d> point = extents<d>(*scene_.tank).center();
    point.template head<d - 1>() = Eigen::Vector2d(entry.x, entry.y).head<d - 1>();
    inside_tank(point, ".x");
  }
  void operator()(const PatchEntry& entry) {
    needs_fluid();
    unique(entry.name);
    if (problems_.found_in(label_)) return;
    if (entry.min && !((*entry.max - *entry.min).template head<d>().minCoeff() > 0))
      return problems_.add(label_ + ".max", "must be greater than min in every axis",
                           "min is the lower corner of the box, max the upper one.");
    const auto& body = scene_.bodies[entry.body];
    try {
      const auto hull = shape_of<d>(body.shape).surface;
      if (patch_area<d>(patch_region<d>(entry, hull, rigid::Vec<d>::Zero()), hull) > 0) return;
      problems_.add(label_ + (entry.centre ? ".centre" : ".min"),
                    fmt::format("the patch holds no part of the hull of '{}'", body.name),
                    fmt::format("Coordinates are those of the shape's frame, in which the hull fills {} m.",
                                text<d>(extents<d>(hull))));
    } catch (const std::invalid_argument&) {  // the body's own check has reported it
    }
  }
  void operator()(const MaximumPressureEntry& entry) {
    needs_fluid();
    if (!problems_.found_in(label_) && !maximum_pressure_of_.insert(entry.body).second)
      problems_.add(label_ + ".body", "has a maximum_pressure record already", "Remove one of them.");
  }
  void operator()(const AccelerationEntry& entry) { unique(entry.name); }
  void operator()(const AddedMassEntry& entry) {
    needs_fluid();
    within_run(entry.times);
    if (!problems_.found_in(label_) && !added_mass_of_.insert(entry.body).second)
      problems_.add(label_ + ".body", "has an added_mass record already", "Remove one of them.");
  }
  void operator()(const PassesEntry& entry) {
    within_run(entry.times);
    if (!scene_.coupling)
      problems_.add(label_ + ".kind", "needs a body that moves freely in a [fluid]: nothing else takes passes",
                    "Remove the record.");
    else if (std::exchange(has_passes_, true))
      problems_.add(label_ + ".kind", "is there already", "Remove one of them.");
  }
  void operator()(const SectionEntry& entry) {
    needs_fluid();
    unique(entry.name);
    within_run(entry.times);
    if (problems_.found_in(label_)) return;
    double heavy = 0;
    for (const auto& part : entry.parts) heavy += part.mass;
    const auto& body = scene_.bodies[entry.body];
    try {
      if (const double mass = mass_properties<d>(body).mass; heavy > mass * (1 + 1e-9))
        problems_.add(label_ + ".mass", fmt::format("{:g} kg, more than the {:g} kg of '{}'", heavy, mass, body.name),
                      "Its heavy parts are part of its mass.");
    } catch (const std::invalid_argument&) {  // the body's own check has reported it
    }
  }

  void operator()(const VelocityLineEntry& entry) {
    needs_fluid();
    unique(entry.name);
    within_run(entry.times);
    if (problems_.found_in(label_)) return;
    inside_tank(vec<d>(entry.from), ".from");
    inside_tank(vec<d>(entry.to), ".to");
  }

 private:
  void needs_fluid() {
    if (!scene_.has_fluid() && !problems_.found_in("fluid.formulation"))
      problems_.add(label_ + ".kind", "needs a [fluid]", "Add one or remove the record.");
  }
  void unique(const std::string& name) {
    if (!name.empty() && !names_.insert(name).second)
      problems_.add(label_ + ".name", "is taken by another record", "Give every record its own name.");
  }
  void within_run(const std::vector<double>& times) {
    if (std::ranges::any_of(times, [&](double time) { return time > scene_.time.end; }))
      problems_.add(label_ + ".times", fmt::format("must not exceed time.end = {:g} s", scene_.time.end),
                    "Remove the later ones.");
  }
  void inside_tank(const rigid::Vec<d>& point, const std::string& key) {
    if (!scene_.tank) return;
    const Extents<d> box = extents<d>(*scene_.tank);
    if (box.isEmpty() || box.exteriorDistance(point) <= 1e-9 * box.diagonal().norm()) return;
    problems_.add(label_ + key, fmt::format("{} m lies outside the tank {} m", text<d>(point), text<d>(box)),
                  "Move it inside.");
  }

  const Scene& scene_;
  Problems& problems_;
  std::string label_;
  std::set<std::string> names_;
  std::set<std::size_t> added_mass_of_, maximum_pressure_of_;
  bool has_passes_ = false;
};

}  // namespace

template <int d>
void check_records(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  RecordChecker<d> checker(scene, problems);
  for (std::size_t i = 0; i < scene.records.size(); ++i) checker.check(scene.records[i], labels.records[i]);
}

template void check_records<2>(const Scene&, const SceneLabels&, Problems&);
template void check_records<3>(const Scene&, const SceneLabels&, Problems&);

}  // namespace splashdown::apps
