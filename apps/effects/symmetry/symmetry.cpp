#include "apps/effects/symmetry/symmetry.hpp"

#include <fmt/format.h>

#include "apps/scene/mirror.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/pfem/spec.hpp"
#include "rigid/forces/half.hpp"
#include "rigid/joint.hpp"

namespace splashdown::apps {
namespace {

std::string plane_of(const Mirror& mirror) { return fmt::format("{} = {:g} m", "xy"[mirror.axis], mirror.at); }

/// Half of each body and of what acts on it: the other half does the same beyond the plane.
template <int d>
void halve(const Mirror& mirror, const BodyParts<d>& parts) {
  const Twist<d> kept = mirror.kept<d>();
  for (auto& spec : parts.specs) {
    spec.mass *= 0.5;
    spec.inertia *= 0.5;
    for (int i = 0; i < freedoms<d>; ++i) {
      spec.free[static_cast<std::size_t>(i)] = spec.free[static_cast<std::size_t>(i)] && kept[i] != 0;
      spec.velocity[i] *= kept[i];
    }
  }
  for (auto& force : parts.forces) force = std::make_unique<rigid::HalfForce<d>>(std::move(force));
  for (auto& joint : parts.joints)
    if (joint.spring) joint.spring->stiffness *= 0.5, joint.spring->damping *= 0.5;
}

/// Axes of a rotation that maps the mirror's axis onto itself but for roundoff: exactly.
template <int d>
void straighten(const Mirror& mirror, rigid::Isometry<d>& pose) {
  const rigid::Vec<d> across = pose.linear().row(mirror.axis).transpose();
  Eigen::Index k = 0;
  across.cwiseAbs().maxCoeff(&k);
  const double sign = across[k] < 0 ? -1 : 1, roundoff = 1e-12;
  if ((across - sign * rigid::Vec<d>::Unit(k)).norm() > roundoff) return;
  pose.linear().row(mirror.axis).setZero();
  pose.linear().col(k).setZero();
  pose.linear()(mirror.axis, k) = sign;
}

}  // namespace

std::optional<Mirror> mirror_of_whole(const Scene& scene) {
  if (!scene.fluid || !scene.tank) return {};
  for (int axis = 0; axis < scene.dimension - 1; ++axis) {
    const Mirror mirror{axis, 0.5 * (scene.tank->min[axis] + scene.tank->max[axis])};
    if ((scene.dimension == 2 ? asymmetries<2>(scene, mirror) : asymmetries<3>(scene, mirror)).empty()) return mirror;
  }
  return {};
}

void SymmetryKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Symmetry>();
  if (scene.dimension == 2) table.normal = "x";
  reader.choice("normal", table.normal,
                scene.dimension == 2 ? std::vector<std::string>{"x"} : std::vector<std::string>{"x", "y"});
  reader.number("at", table.at, any("m", "Use the middle of the tank."));
}

std::optional<Mirror> SymmetryKind::mirror(const Scene& scene) const {
  const auto* table = scene.effects.find<Symmetry>();
  return table ? std::optional(table->mirror()) : std::nullopt;
}

void SymmetryKind::check(const Scene& scene, Problems& problems) const {
  const auto mirror = this->mirror(scene);
  if (!mirror || problems.found_in("symmetry") || problems.found_in("tank")) return;
  if (!scene.fluid || !scene.tank)
    return problems.add("symmetry", "needs a [fluid] in a [tank]: its plane is a side of the tank that is simulated",
                        "Add what is missing, or remove the table.");
  const auto found = scene.dimension == 2 ? asymmetries<2>(scene, *mirror) : asymmetries<3>(scene, *mirror);
  for (const auto& [key, rule, cure] : found)
    if (!problems.found_in(key)) problems.add(key, rule, cure);
  const auto kept = scene.dimension == 2 ? Eigen::VectorXd(mirror->kept<2>()) : Eigen::VectorXd(mirror->kept<3>());
  const auto names = freedom_names(scene.dimension);
  for (const auto& body : scene.bodies) {
    const std::string key = "body." + body.name + ".free";
    if (body.motion != Motion::free || !problems.noted(key)) continue;  // all that the plane leaves
    for (std::size_t i = 0; i < names.size(); ++i)
      if (kept[static_cast<Eigen::Index>(i)] == 0 && std::ranges::find(body.free, names[i]) != body.free.end())
        problems.add(key, fmt::format("[symmetry] about {} lets nothing move in '{}'", plane_of(*mirror), names[i]),
                     "Take it out of the list, or remove [symmetry].");
  }
}

std::optional<EffectNote> SymmetryKind::note(const Scene& scene, const Scales&) const {
  if (!scene.fluid || !scene.tank) return {};
  if (const auto mirror = this->mirror(scene))
    return EffectNote{"symmetry", true,
                      fmt::format("about {}: half of the nodes; loads, masses and energies are those of the whole",
                                  plane_of(*mirror))};
  const auto mirror = mirror_of_whole(scene);
  return EffectNote{
      "symmetry", false,
      mirror ? fmt::format("the scene is its own mirror image about {}: [symmetry] halves the nodes", plane_of(*mirror))
             : "the scene is not its own mirror image"};
}

void SymmetryKind::prepare(const Scene& scene, const BodyParts<2>& parts) const {
  if (const auto mirror = this->mirror(scene)) halve<2>(*mirror, parts);
}
void SymmetryKind::prepare(const Scene& scene, const BodyParts<3>& parts) const {
  if (const auto mirror = this->mirror(scene)) halve<3>(*mirror, parts);
}

// Hulls reach across the plane, so that they are closed there without a side that could be wetted.
template <int d>
void SymmetryKind::prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const {
  const auto mirror = this->mirror(scene);
  Tank half = *scene.tank;
  half.min[mirror->axis] = mirror->at;
  for (std::size_t w = 0; w < spec.walls.size(); ++w) {
    auto& wall = spec.walls[w];
    wall.mirror = mirror;
    if (w < scene.bodies.size()) {
      straighten<d>(*mirror, wall.pose);
      wall.surface = symmetrised<d>(in_frame<d>(*mirror, wall.pose), wall.surface);
    } else {
      wall.surface = tank_outline<d>(half);
    }
  }
}

template void SymmetryKind::prepare_in<2>(const Scene&, fluid::FluidSpec<2>&) const;
template void SymmetryKind::prepare_in<3>(const Scene&, fluid::FluidSpec<3>&) const;

}  // namespace splashdown::apps
