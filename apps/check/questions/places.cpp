// Points of records and joints, and what touches.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/build/build.hpp"
#include "apps/check/questions/prepared_scene.hpp"
#include "apps/check/ties.hpp"
#include "apps/check/words.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"

namespace splashdown::apps {
namespace {

/// Points on masts and booms lie outside the hull, but hardly by more than its length.
constexpr double far_from_hull = 1;
/// An instrument is in the hull or on it: what stands out of it is a tenth of its length.
constexpr double beside_hull = 0.1;

template <int d>
struct AskAboutRecord {
  const PreparedScene<d>& prepared;
  Questions& list;

  void point(const std::string& what, const Body& body, const Point& point, double outside) const {
    const auto box = extents<d>(shape_of<d>(body.shape).surface);
    const double length = box.sizes().maxCoeff(), away = box.exteriorDistance(vec<d>(point));
    if (away <= outside * length) return;
    const rigid::Vec<d> in_mm = vec<d>(point) / 1000;
    list.push_back(
        fmt::format("record {}: point = {} m lies {:.3g} m outside the hull of '{}', which spans {} m in its own "
                    "frame: did you mean {}?",
                    what, text<d>(vec<d>(point)), away, body.name, text<d>(box),
                    box.contains(in_mm) ? text<d>(in_mm) + " m" : "a point of the hull"));
  }
  void operator()(const AccelerationEntry& entry) const {
    point(entry.name, prepared.scene.bodies[entry.body], entry.point, beside_hull);
  }
  void operator()(const PressureEntry& entry) const {
    if (entry.body) point(entry.name, prepared.scene.bodies[*entry.body], entry.point, far_from_hull);
  }
  void operator()(const PatchEntry& entry) const {
    if (!entry.radius) return;
    const auto& body = prepared.scene.bodies[entry.body];
    const double length = extents<d>(shape_of<d>(body.shape).surface).sizes().maxCoeff();
    if (2 * *entry.radius > length)
      list.push_back(
          fmt::format("record {}: radius = {:g} m: a disc larger than the hull of '{}', {:.3g} m: did you mean {:g} m?",
                      entry.name, *entry.radius, body.name, length, *entry.radius / 1000));
    else if (*entry.radius < body.size / 10)
      list.push_back(fmt::format(
          "record {}: radius = {:g} m: a tenth of an element of '{}' ({:g} m) or less: did you mean {:g} m?",
          entry.name, *entry.radius, body.name, body.size, *entry.radius * 1000));
  }
  void operator()(const MaximumPressureEntry& entry) const {
    const auto& body = prepared.scene.bodies[entry.body];
    const double length = extents<d>(shape_of<d>(body.shape).surface).sizes().maxCoeff();
    if (entry.size > length / 4 || entry.size < body.size / 50)
      list.push_back(
          fmt::format("record maximum_pressure of '{}': size = {:g} m: points {} on a hull of {:.3g} m: did you mean "
                      "{:g} m?",
                      body.name, entry.size, entry.size > length / 4 ? "too far apart" : "far nearer than elements",
                      length, body.size));
  }
  void operator()(const SurfacePressureEntry& entry) const { instants("surface_pressure", entry.interval); }
  void operator()(const AddedMassEntry& entry) const { instants("added_mass", entry.interval); }
  void operator()(const SectionEntry& entry) const {
    instants("section_loads", entry.interval);
    const auto& body = prepared.scene.bodies[entry.body];
    if (const auto mass = spread_mass<d>(body, entry); lowest_density<d>(mass) < -1e-6 * std::abs(mass.mean))
      list.push_back(
          fmt::format("record {}: no mass that fills the hull of '{}' evenly or ever more to one side has its centre "
                      "of mass where it is; "
                      "section loads then hold for a mass that is negative somewhere. Say where the heavy parts are: "
                      "[[record.mass]]",
                      entry.name, body.name));
  }
  void operator()(const PassesEntry& entry) const { instants("passes", entry.interval); }
  void operator()(const VelocityLineEntry& entry) const { instants("velocity_line", entry.interval); }
  void operator()(const ElevationEntry&) const {}

 private:
  void instants(const char* what, const std::optional<double>& interval) const {
    if (interval && *interval > prepared.scene.time.end)
      list.push_back(fmt::format("record {}: interval = {:g} s, and the run ends at {:g} s: did you mean {:g} s?", what,
                                 *interval, prepared.scene.time.end, *interval / 1000));
  }
};

template <int d>
void about_records(const PreparedScene<d>& prepared, Questions& list) {
  for (const auto& record : prepared.scene.records) std::visit(AskAboutRecord<d>{prepared, list}, record);
}

template <int d>
void about_joints(const PreparedScene<d>& prepared, Questions& list) {
  const double far = 5, whole_turn = 360;
  for (std::size_t j = 0; j < prepared.scene.joints.size(); ++j) {
    const auto& joint = prepared.scene.joints[j];
    const auto& of = prepared.bodies[joint.body];
    const double length = of.box.sizes().maxCoeff(), away = of.box.exteriorDistance(vec<d>(joint.point));
    if (kind_of(joint).turns && away > far * length)
      list.push_back(
          fmt::format("joint[{}].point = {} m lies {:.3g} m from '{}', {} times its length: did you mean a point of it "
                      "in the world's frame, which spans {} m?",
                      j, text<d>(vec<d>(joint.point)), away, of.body->name, rough(away / length), text<d>(of.box)));
    const bool turns = kind_of(joint).turns;
    for (const double limit : joint.limits)
      if (std::abs(limit) > (turns ? whole_turn : 10 * far * length))
        list.push_back(fmt::format("joint[{}].limits{} = {:g}: {}: did you mean {:g}?", j, turns ? "_deg" : "", limit,
                                   turns ? "more than a turn" : "many lengths of the body", limit / 1000));
  }
  for (auto& question : ties_questions<d>(prepared.scene)) list.push_back(std::move(question));
}

/// A spring that gives way by many lengths under the weight does nothing, one by less than a hundred-thousandth is a weld.
template <int d>
void about_springs(const PreparedScene<d>& prepared, Questions& list) {
  const double softest = 100, stiffest = 1e-5;
  for (std::size_t j = 0; j < prepared.scene.joints.size(); ++j) {
    const auto& joint = prepared.scene.joints[j];
    const auto& body = prepared.scene.bodies[joint.body];
    if (joint.stiffness <= 0 || body.motion != Motion::free || prepared.pull <= 0) continue;
    const double mass = mass_properties<d>(body).mass, length = prepared.bodies[joint.body].box.sizes().maxCoeff();
    const double lever = kind_of(joint).turns ? length : 1;
    const double yields = mass * prepared.pull * lever / joint.stiffness / (kind_of(joint).turns ? 1 : length);
    if (mass == 0 || (yields <= softest && yields >= stiffest)) continue;
    list.push_back(
        fmt::format("joint[{}].stiffness = {:g}: under the weight of '{}' it yields by {:.2g} {}: did you mean {:g}?",
                    j, joint.stiffness, body.name, yields, kind_of(joint).turns ? "rad" : "times its length",
                    yields > softest ? joint.stiffness * 1000 : joint.stiffness / 1000));
  }
}

template <int d>
void about_contact(const PreparedScene<d>& prepared, Questions& list) {
  const double least = 0.01;
  if (!prepared.scene.contact) return;
  const auto ask = [&](const char* key, double value) {
    if (value > 0 && value < least)
      list.push_back(
          fmt::format("contact.{} = {:g}: as good as none: did you mean {:g}, or 0?", key, value, value * 1000));
  };
  ask("friction", prepared.scene.contact->friction);
  ask("restitution", prepared.scene.contact->restitution);
}

/// Beside all liquid, and nothing below but the floor.
template <int d>
void about_water_below(const PreparedScene<d>& prepared, Questions& list) {
  if (!prepared.scene.fluid) return;
  for (const auto& of : prepared.bodies) {
    if (of.body->motion == Motion::fixed || of.body->deforms) continue;  // clamps may hold it
    const bool above = std::ranges::any_of(prepared.scene.fluid->regions, [&](const Region& region) {
      const auto box = extents<d>(outline<d>(region));
      bool meets = true;
      for (int k = 0; k < d - 1; ++k)
        meets = meets && of.box.min()[k] <= box.max()[k] && of.box.max()[k] >= box.min()[k];
      return meets;
    });
    if (!above)
      list.push_back(
          fmt::format("body.{} is beside all liquid: nothing is above or below it but the tank: did you mean another "
                      "position than {} m?",
                      of.body->name, text<d>(vec<d>(of.body->position))));
  }
}

template <int d>
constexpr Question<d> questions_of_places[] = {about_records<d>, about_joints<d>, about_springs<d>, about_contact<d>,
                                               about_water_below<d>};

}  // namespace

template <int d>
void ask_about_places(const PreparedScene<d>& prepared, Questions& list) {
  for (const auto question : questions_of_places<d>) question(prepared, list);
}

template void ask_about_places<2>(const PreparedScene<2>&, Questions&);
template void ask_about_places<3>(const PreparedScene<3>&, Questions&);

}  // namespace splashdown::apps
