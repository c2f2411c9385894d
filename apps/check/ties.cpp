#include "apps/check/ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"
#include "rigid/ties.hpp"

namespace splashdown::apps {
namespace {

using Texts = std::vector<std::string>;

template <int d>
std::vector<rigid::BodySpec<d>> specs_of(const Scene& scene) {
  std::vector<rigid::BodySpec<d>> specs;
  for (const auto& body : scene.bodies) specs.push_back(body_spec<d>(body));
  return specs;
}

template <int d>
rigid::Ties ties_of(const Scene& scene) {
  return rigid::examine_ties<d>(specs_of<d>(scene), joint_specs(scene));
}

/// "joint[1] (slider of 'float' to the world)"
std::string named(const Scene& scene, std::size_t index) {
  const auto& joint = scene.joints[index];
  return fmt::format("joint[{}] ({} of '{}' to {})", index, joint.type, scene.bodies[joint.body].name,
                     joint.other ? "'" + scene.bodies[*joint.other].name + "'" : "the world");
}

std::string named(const Scene& scene, const std::vector<std::size_t>& joints) {
  Texts names;
  for (const std::size_t j : joints) names.push_back(named(scene, j));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

bool plays(const Joint& joint) { return joint.stiffness > 0 || joint.damping > 0 || !joint.limits.empty(); }

bool all_welds(const Scene& scene, const std::vector<std::size_t>& joints) {
  return std::ranges::all_of(joints, [&](std::size_t j) { return !kind_of(scene.joints[j]).moves(); });
}

/// When the first body on a path sets out [s]; infinite if none does.
double first_departure(const Scene& scene) {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& body : scene.bodies)
    for (std::size_t i = 1; i < body.path.size(); ++i) {
      const auto &from = body.path[i - 1], &to = body.path[i];
      const bool moves = from.position != to.position || from.attitude.heading_deg != to.attitude.heading_deg ||
                         from.attitude.pitch_deg != to.attitude.pitch_deg ||
                         from.attitude.roll_deg != to.attitude.roll_deg;
      if (moves) {
        first = std::min(first, from.time);
        break;
      }
    }
  return first;
}

/// With the velocities of paths on which something moves: until then all is where it is at t = 0.
Scene at_departure(const Scene& scene) {
  Scene later = scene;
  const auto is_on_its_way = [](const Body& body) {
    return body.motion == Motion::prescribed && body.path.empty() &&
           !(body.velocity.isZero(0) && body.spin_deg.isZero(0));
  };
  if (std::ranges::any_of(scene.bodies, is_on_its_way)) return later;
  const double time = first_departure(scene);
  for (auto& body : later.bodies)
    while (body.path.size() > 2 && body.path[1].time <= time) body.path.erase(body.path.begin());
  return later;
}

}  // namespace

template <int d>
Texts ties_notes(const Scene& scene) {
  Texts notes;
  if (scene.joints.empty()) return notes;
  for (const std::size_t j : ties_of<d>(scene).repeated)
    if (!plays(scene.joints[j]))
      notes.push_back(fmt::format("{} holds nothing that other joints or body.{}.free do not hold already: harmless",
                                  named(scene, j), scene.bodies[scene.joints[j].body].name));
  return notes;
}

template <int d>
Texts ties_questions(const Scene& scene) {
  Texts list;
  if (scene.joints.empty()) return list;
  const auto ties = ties_of<d>(scene);
  for (const auto& held : ties.held) {
    if (all_welds(scene, held.joints)) continue;
    const auto& body = scene.bodies[held.body];
    const bool alone = held.joints.size() == 1;
    const std::string with_free =
        body.free.size() < freedom_names(d).size() ? fmt::format(", with body.{}.free,", body.name) : "";
    list.push_back(
        fmt::format("body.{} cannot move: {}{} {} it no motion: did you mean {}?", body.name, named(scene, held.joints),
                    with_free, alone ? "leaves" : "together leave",
                    alone ? "another axis, or motion = \"fixed\"" : "one of them only, or motion = \"fixed\""));
  }
  for (const std::size_t b : ties.jolted)
    if (std::ranges::none_of(ties.held, [&](const auto& held) { return held.body == b; }))
      list.push_back(
          fmt::format("body.{0}.velocity and spin_deg are no motion that its joints leave: the first step changes them "
                      "by a jolt: did "
                      "you mean the velocity of its centre of mass that goes with its spin?",
                      scene.bodies[b].name));
    else
      list.push_back(
          fmt::format("body.{}.velocity: its joints stop it at once: did you mean to hold it?", scene.bodies[b].name));
  return list;
}

template <int d>
void refuse_contradicting_ties(const SceneFile& file) {
  const auto& scene = file.scene;
  if (scene.joints.empty()) return;
  const auto joints = ties_of<d>(at_departure(scene)).contradicting;
  if (joints.empty()) return;
  auto problems = file.places;
  problems.add(
      fmt::format("joint[{}]", joints.back()),
      joints.size() == 1
          ? fmt::format("{} asks for a motion that the prescribed motions or held freedoms of its bodies exclude",
                        named(scene, joints.front()))
          : fmt::format("{} ask for motions that exclude each other, with what is prescribed or held",
                        named(scene, joints)),
      "Remove one of them, free a body, or mend a path.");
  problems.throw_if_any();
}

template Texts ties_notes<2>(const Scene&);
template Texts ties_notes<3>(const Scene&);
template Texts ties_questions<2>(const Scene&);
template Texts ties_questions<3>(const Scene&);
template void refuse_contradicting_ties<2>(const SceneFile&);
template void refuse_contradicting_ties<3>(const SceneFile&);

}  // namespace splashdown::apps
