// What of a scene is not its own mirror image: the tank, the liquid, each body, what ties and records them, other effects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/effects/symmetry/symmetry.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;

constexpr double facets = 1e-3;    // of a body: round hulls are as symmetric as their facets
constexpr double elements = 0.15;  // of the hull's own: water does not feel less

template <int d>
class Judge {
 public:
  Judge(const Scene& scene, const Mirror& mirror)
      : scene_(scene),
        mirror_(mirror),
        axis_("xyz"[mirror.axis]),
        plane_(fmt::format("{} = {:g} m", axis_, mirror.at)) {}

  std::vector<Asymmetric> found() {
    tank();
    for (std::size_t i = 0; i < scene_.fluid->regions.size(); ++i)
      region(scene_.fluid->regions[i], fmt::format("fluid.region[{}]", i));
    for (const auto& body : scene_.bodies) try {
        this->body(body, "body." + body.name);
      } catch (const std::invalid_argument&) {  // a shape that is none: its own check has reported it
      }
    for (std::size_t i = 0; i < scene_.joints.size(); ++i) joint(scene_.joints[i], fmt::format("joint[{}]", i));
    for (std::size_t i = 0; i < scene_.records.size(); ++i)
      if (std::holds_alternative<AddedMassEntry>(scene_.records[i]))
        add(fmt::format("record[{}].kind", i), "motions across the plane have no added mass in half of the water",
            "Remove the record, or [symmetry].");
    effects();
    return std::move(found_);
  }

 private:
  void add(const std::string& key, const std::string& rule, const std::string& cure) {
    found_.push_back({key, "[symmetry] about " + plane_ + ": " + rule, cure});
  }

  void tank() {
    const double min = scene_.tank->min[mirror_.axis], max = scene_.tank->max[mirror_.axis];
    if (std::abs(0.5 * (min + max) - mirror_.at) <= written_digits * (max - min)) return;
    const double half = std::max(max - mirror_.at, mirror_.at - min);
    add("tank.min",
        fmt::format("the tank reaches from {:g} to {:g} m along {} and is not its own mirror image", min, max, axis_),
        fmt::format("Use {:g} and {:g} m, or symmetry.at = {:g}.", mirror_.at - half, mirror_.at + half,
                    0.5 * (min + max)));
  }

  void region(const Region& region, const std::string& key) {
    Surface<d> boundary;
    try {
      boundary = outline<d>(region);
    } catch (const std::invalid_argument&) {  // its own rule speaks of it
      return;
    }
    const double length = extents<d>(boundary).diagonal().norm();
    if (const auto off = asymmetry_of<d>(mirror_, boundary); off.distance > written_digits * length)
      add(key,
          fmt::format("the mirror image of its point {} m is {:.3g} m off its boundary", text<d>(off.at), off.distance),
          "Make the liquid symmetric, or remove [symmetry].");
    // v(x') = v(x)', a prime for the image.
    Eigen::Matrix3d gradient = region.velocity_gradient, image = gradient;
    image.row(mirror_.axis) *= -1, image.col(mirror_.axis) *= -1;
    const Point there = mirror_.at * Point::Unit(mirror_.axis) +
                        region.velocity_origin.cwiseProduct(Point::Ones() - Point::Unit(mirror_.axis));
    const double across = (region.velocity + gradient * (there - region.velocity_origin))[mirror_.axis];
    if (!(gradient - image).isZero(0))
      add(key + ".velocity_gradient", "the water's velocity is not its own mirror image",
          fmt::format("Leave out the entries that join {} with another axis, or remove [symmetry].", axis_));
    else if (std::abs(across) > written_digits * region.velocity.norm())
      add(key + ".velocity", fmt::format("the water flows across the plane at {:g} m/s", across),
          fmt::format("Use 0 along {}, or remove [symmetry].", axis_));
  }

  void body(const Body& body, const std::string& key) {
    const auto hull = outline<d>(body);
    const double length = extents<d>(hull).sizes().maxCoeff();
    const double slack = std::max(facets * length, elements * body.size);
    if (const auto off = asymmetry_of<d>(mirror_, hull); off.distance > slack) {
      const double middle = extents<d>(hull).center()[mirror_.axis] - mirror_.at;
      auto moved = hull;
      moved.vertices.row(mirror_.axis).array() -= middle;
      const bool is_aside = asymmetry_of<d>(mirror_, moved).distance <= slack;
      return add(
          key + ".shape",
          fmt::format("the mirror image of its vertex at {} m is {:.3g} m off the hull", text<d>(off.at), off.distance),
          is_aside
              ? fmt::format("The hull's middle lies {:g} m off the plane: move the body, or remove [symmetry].", middle)
              : "Turn the body or mend its shape, or remove [symmetry].");
    }
    volume(body, key, length);
    weight(body, key, length);
    motion(body, key, length);
  }

  // A hull that is off by many small facets has as much of it on either side; one that is bent has not.
  void volume(const Body& body, const std::string& key, double length) {
    Body alone = body;
    alone.centre_of_mass.reset();
    const double off = mirror_.distance<d>(shape_pose<d>(alone) * mass_properties<d>(alone).centre);
    if (std::abs(off) > facets * length)
      add(key + ".shape", fmt::format("the centroid of the hull lies {:.3g} m off the plane", off),
          "Turn the body or mend its shape, or remove [symmetry].");
  }

  void weight(const Body& body, const std::string& key, double length) {
    const auto properties = mass_properties<d>(body);
    const Vec<d> centre = shape_pose<d>(body) * properties.centre;
    if (const double off = mirror_.distance<d>(centre); std::abs(off) > facets * length)
      add(key + ".centre_of_mass", fmt::format("the centre of mass lies {:g} m off the plane", off),
          "Put it into the plane, or remove [symmetry].");
    if constexpr (d == 3) {
      const Eigen::Matrix3d turn = rotation<3>(body.attitude), inertia = turn * properties.inertia * turn.transpose();
      double product = 0;
      for (int k = 0; k < 3; ++k)
        if (k != mirror_.axis) product = std::max(product, std::abs(inertia(mirror_.axis, k)));
      if (product > facets * inertia.trace())
        add(key + ".inertia", fmt::format("a product of inertia across the plane is {:g} kg m^2", product),
            fmt::format("Set those with {} to 0, or remove [symmetry].", axis_));
    }
  }

  void motion(const Body& body, const std::string& key, double length) {
    if (const double across = body.velocity[mirror_.axis]; across != 0)
      add(key + ".velocity", fmt::format("the body moves across the plane at {:g} m/s", across),
          fmt::format("Use 0 along {}, or remove [symmetry].", axis_));
    for (int axis = 0; axis < 3; ++axis)
      if (body.spin_deg[axis] != 0 && (d == 2 || axis != mirror_.axis)) {
        add(key + ".spin_deg",
            fmt::format("the body turns at {:g} deg/s, which its mirror image does the other way round",
                        body.spin_deg[axis]),
            d == 2
                ? "Use 0, or remove [symmetry]."
                : fmt::format("Only a turn about {} is symmetric: use 0 for the others, or remove [symmetry].", axis_));
        break;
      }
    const auto at_start = in_frame<d>(mirror_, shape_pose<d>(body));
    for (const auto& point : body.path) {
      const auto there = in_frame<d>(mirror_, shape_pose<d>(point.position, point.attitude));
      if ((there.normal - at_start.normal).norm() <= written_digits &&
          std::abs(there.offset - at_start.offset) <= written_digits * length)
        continue;
      return add(key + ".path", fmt::format("at t = {:g} s it has left the plane", point.time),
                 "Move and turn the body along the plane alone, or remove [symmetry].");
    }
  }

  void joint(const Joint& joint, const std::string& key) {
    const auto& kind = kind_of(joint);
    const double across = std::abs(joint.axis.normalized()[mirror_.axis]);
    if (kind.turns && d == 2)
      add(key + ".type", "it turns, which its mirror image does the other way round",
          "Use \"weld\", or remove [symmetry].");
    else if (kind.turns && std::abs(across - 1) > written_digits)
      add(key + ".axis", "it turns about an axis that does not stand on the plane",
          fmt::format("Turn the axis to {}, or remove [symmetry].", axis_));
    if (kind.slides && across > written_digits)
      add(key + ".axis", "it moves across the plane", "Turn the axis into the plane, or remove [symmetry].");
  }

  void effects() {
    for (const auto* kind : effect_kinds()) {
      if (!kind->present(scene_)) continue;
      const auto why = kind->asymmetry(scene_, mirror_);
      if (!why) continue;
      const std::string name(kind->name());
      add(kind->place() == TablePlace::fluid ? "fluid." + name : name, fmt::format("[{}] {}", name, *why),
          "Change it, or remove [symmetry].");
    }
  }

  const Scene& scene_;
  const Mirror& mirror_;
  char axis_;
  std::string plane_;
  std::vector<Asymmetric> found_;
};

}  // namespace

template <int d>
std::vector<Asymmetric> asymmetries(const Scene& scene, const Mirror& mirror) {
  return Judge<d>(scene, mirror).found();
}

template std::vector<Asymmetric> asymmetries<2>(const Scene&, const Mirror&);
template std::vector<Asymmetric> asymmetries<3>(const Scene&, const Mirror&);

}  // namespace splashdown::apps
