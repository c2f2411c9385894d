#include "apps/scene/kinds/joint_kinds.hpp"
#include "apps/scene/kinds/named.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

/// How far a hinge or slider may move, and what draws it back.
void read_play(Reader& reader, Joint& joint, int dimension) {
  const bool hinge = kind_of(joint).turns, plane = dimension == 2;
  const std::string unit = hinge ? "deg" : "m";
  reader.numbers(hinge ? "limits_deg" : "limits", joint.limits,
                 any(unit, std::string("Use how far it may go back and forth from its place at t = 0, e.g. ") +
                               (hinge ? "[-30.0, 45.0]." : "[-0.1, 0.3].")));
  reader.number("stiffness", joint.stiffness,
                not_negative(hinge ? (plane ? "N/rad" : "N m/rad") : (plane ? "N/m^2" : "N/m"), "Use e.g. 500."));
  reader.number(
      "damping", joint.damping,
      not_negative(hinge ? (plane ? "N s/rad" : "N m s/rad") : (plane ? "N s/m^2" : "N s/m"), "Use e.g. 10."));
  reader.number(hinge ? "rest_deg" : "rest", joint.rest,
                any(unit, "Use where the spring is relaxed, from the place at t = 0, e.g. 0."));
}

}  // namespace

std::optional<Joint> read_joint(Reader& reader, const Scene& scene) {
  Joint joint;
  if (!reader.choice("type", joint.type, names_of(joint_kinds()), Need::required)) {
    reader.skip_all();
    return {};
  }
  const auto body = read_body_name(reader, "body", scene, Need::required, "joint");
  joint.body = body.value_or(0);
  joint.other = read_body_name(reader, "other", scene, Need::optional, "joint");
  const auto& kind = kind_of(joint);
  if (kind.turns)
    reader.point("point", joint.point,
                 any("m", "Use the place of the hinge at t = 0, e.g. " + axis_example(scene.dimension, 0.5) + "."),
                 Need::required);
  const bool turns_in_space = kind.turns && scene.dimension == 3;
  if (kind.slides || turns_in_space) {
    joint.axis = Point::Zero();
    const std::string what = kind.slides ? "direction of the motion" : "axis that it turns about";
    reader.point("axis", joint.axis, any("", "Use the " + what + ", e.g. " + axis_example(scene.dimension, 1) + "."),
                 Need::required);
  }
  if (kind.moves()) read_play(reader, joint, scene.dimension);
  return body ? std::optional(joint) : std::nullopt;
}

void read_contact(Reader& reader, Contact& contact) {
  reader.number("friction", contact.friction,
                within(0, 2, "", "Use e.g. 0.3: friction over normal force; wet rubber on concrete has 0.5."));
  reader.number("restitution", contact.restitution,
                within(0, 1, "", "Use e.g. 0.5: speed of leaving over speed of approach; 0 is no rebound."));
}

}  // namespace splashdown::apps
