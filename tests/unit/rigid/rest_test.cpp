// Bodies at rest on still water with all that holds them, against energy minimised by brute force.
#include "rigid/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/rest_reference.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::rest_test {
namespace {

using std::numbers::pi;

const StillWater water{.density = 1000, .gravity = 9.81, .level = 0};

BodySpec<2> hull_of(const std::vector<Vec<2>>& outline, double mass, const Vec<2>& place, double turn = 0) {
  const auto shape = polygon(outline);
  auto spec = of_shape<2>(shape, place, mass);
  spec.pose.linear() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  return spec;
}

std::vector<Vec<2>> block(double width, double height) {
  return {{-width / 2, -height / 2}, {width / 2, -height / 2}, {width / 2, height / 2}, {-width / 2, height / 2}};
}

JointSpec tie(JointType type, std::size_t body, Vec<2> point, Vec<2> axis = {0, 1}) {
  JointSpec joint;
  joint.type = type;
  joint.body = body;
  joint.point << point, 0;
  if (type == JointType::slider) joint.axis << axis.normalized(), 0;
  return joint;
}

/// Something that still water may do to a hull, one to three coordinates.
struct Drawn {
  Mechanism<2> mechanism;
  std::vector<double> steps;
  std::function<double(const std::vector<double>&)> energy;
  std::function<Isometry<2>(const std::vector<double>&)> pose;
  double size = 0;
  std::string what;
};

std::vector<Vec<2>> drawn_outline(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double width = std::pow(10, unit(random) - 0.5), height = width * (0.25 + unit(random));
  const int kind = static_cast<int>(4 * unit(random));
  if (kind == 0) return block(width, height);
  std::vector<Vec<2>> points;
  const int corners = kind == 1 ? 64 : 5;  // round; a convex polygon
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + (kind == 1 ? 0 : 0.3 * unit(random))) / corners;
    points.emplace_back(width / 2 * std::cos(angle), (kind == 1 ? width : height) / 2 * std::sin(angle));
  }
  return points;
}

/// A closed hull in one of the ways in which scenes hold one.
Drawn drawn(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  auto outline = drawn_outline(random);
  while (seed % 5 == 1 && outline.size() == 64) outline = drawn_outline(random);  // a round one may turn as it likes
  const auto shape = polygon(outline);
  const double area = shape.at_unit_density.mass, mass = water.density * area * (0.1 + 0.8 * unit(random));
  reference::Hull hull{outline, {}, {}, mass};
  for (auto& x : hull.outline) x -= shape.at_unit_density.centre;
  const double size = 2 * std::sqrt(area);
  const Vec<2> place(0, size * (0.4 * unit(random) - 0.2));
  const double turn = pi * (2 * unit(random) - 1);
  Drawn of;
  of.size = size;
  of.mechanism.bodies = {hull_of(outline, mass, place, turn)};
  auto& spec = of.mechanism.bodies[0];
  const Vec<2> point = place + size * Vec<2>(unit(random) - 0.5, unit(random) - 0.5);
  const double stiffness = unit(random) < 0.5 ? 0 : mass * water.gravity * size * unit(random),
               rest = unit(random) - 0.5;
  const auto energy_at = [=](const Isometry<2>& pose) {
    return reference::energy(hull, pose.translation(), std::atan2(pose(1, 0), pose(0, 0)), water.density);
  };
  const auto posed = [](const Vec<2>& x, double angle) {
    Isometry<2> pose = Isometry<2>::Identity();
    pose.translate(x).rotate(angle);
    return pose;
  };
  const double fine = 0.002;
  switch (seed % 5) {
    case 0:
      of.what = "heaves only";
      spec.free = {false, true, false};
      of.steps = {fine * size};
      of.pose = [=](const std::vector<double>& q) { return posed(place + Vec<2>(0, q[0]), turn); };
      break;
    case 1:
      of.what = "turns only";
      spec.free = {false, false, true};
      of.steps = {fine};
      of.pose = [=](const std::vector<double>& q) { return posed(place, turn + q[0]); };
      break;
    case 2: {
      of.what = "hinge";
      auto joint = tie(JointType::hinge, 0, point);
      if (stiffness > 0) joint.spring = Spring{stiffness, 0, rest};
      if (unit(random) < 0.5) joint.stops = {-0.5 * unit(random), 0.5 * unit(random)};
      of.mechanism.joints = {joint};
      of.steps = {fine};
      of.pose = [=](const std::vector<double>& q) {
        return posed(point + Eigen::Rotation2Dd(q[0]) * (place - point), turn + q[0]);
      };
      of.energy = [=](const std::vector<double>& q) {
        if (q[0] < joint.stops[0] || q[0] > joint.stops[1]) return 1e30;
        return energy_at(of.pose(q)) + 0.5 * stiffness * (q[0] - rest) * (q[0] - rest) / water.gravity;
      };
      return of;
    }
    case 3: {
      of.what = "slider";
      const Vec<2> axis = Eigen::Rotation2Dd(0.8 * (unit(random) - 0.5)) * Vec<2>(0, 1);
      auto joint = tie(JointType::slider, 0, place, axis);
      if (stiffness > 0) joint.spring = Spring{stiffness / size / size, 0, rest * size};
      of.mechanism.joints = {joint};
      of.steps = {fine * size};
      of.pose = [=](const std::vector<double>& q) { return posed(place + q[0] * axis, turn); };
      of.energy = [=](const std::vector<double>& q) {
        const double stretch = q[0] - rest * size;
        return energy_at(of.pose(q)) + 0.5 * stiffness / size / size * stretch * stretch / water.gravity;
      };
      return of;
    }
    default: {
      of.what = "stands on the floor if it must";
      const double floor = -size * (0.1 + 0.4 * unit(random));
      spec.pose.translation().y() = size - floor;
      spec.free = {false, true, false};
      of.mechanism.contacts = ContactSpec<2>{.planes = {{Vec<2>(0, floor), Vec<2>(0, 1)}}};
      of.steps = {fine * size};
      const double top = spec.pose.translation().y();
      of.pose = [=](const std::vector<double>& q) { return posed(Vec<2>(0, top + q[0]), turn); };
      of.energy = [=](const std::vector<double>& q) {
        for (const auto& x : reference::moved(hull.outline, Vec<2>(0, top + q[0]), turn))
          if (x.y() < floor) return 1e30;
        return energy_at(of.pose(q));
      };
      return of;
    }
  }
  of.energy = [=](const std::vector<double>& q) { return energy_at(of.pose(q)); };
  return of;
}

/// How far hull points of both are apart, over the size.
double difference(const Drawn& of, const Isometry<2>& a, const Isometry<2>& b) {
  const auto& x = of.mechanism.bodies[0].surface.vertices;
  return ((a.linear() * x).colwise() + a.translation() - ((b.linear() * x).colwise() + b.translation()))
             .colwise()
             .norm()
             .maxCoeff() /
         of.size;
}

double worst_of(unsigned first, unsigned count) {
  double worst = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const auto of = drawn(seed);
    const auto rest = at_rest<2>(of.mechanism, water);
    const auto q = reference::bottom(of.energy, std::vector<double>(of.steps.size(), 0), of.steps);
    EXPECT_TRUE(rest.found) << seed;
    const double apart = difference(of, rest.bodies[0].pose, of.pose(q));
    EXPECT_LT(apart, 0.005) << "seed " << seed << ", " << of.what << ", q " << q[0] << ", energy "
                            << rest.energy / water.gravity << " against " << of.energy(q);
    worst = std::max(worst, apart);
  }
  return worst;
}

/// One that floats freely, closed or a trough, its weight off the middle; coordinate: its heel.
Drawn drawn_afloat(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const bool open = seed % 2 == 1;
  auto closed = open ? block(1 + unit(random), 0.4 + 0.6 * unit(random)) : drawn_outline(random);
  auto outline = closed;
  reference::Hull hull;
  if (open) {
    const double b = closed[1].x(), h = closed[2].y(), t = 0.05 + 0.1 * unit(random);
    outline = {{-b, -h}, {b, -h}, {b, h}, {b - t, h}, {b - t, t - h}, {t - b, t - h}, {t - b, h}, {-b, h}};
    hull.rims = {{b - t, h}, {t - b, h}};
  }
  const double area = polygon(closed).at_unit_density.mass, size = 2 * std::sqrt(area);
  const Vec<2> centre = (open ? Vec<2>(0, -0.1 * size) : polygon(closed).at_unit_density.centre) +
                        size * (open ? 0.02 : 0.1) * Vec<2>(unit(random) - 0.5, unit(random) - 0.5);
  hull.mass = water.density * area * (open ? 0.2 + 0.3 * unit(random) : 0.1 + 0.8 * unit(random));
  for (auto* points : {&outline, &closed, &hull.rims})
    for (auto& x : *points) x -= centre;
  hull.outline = outline;
  hull.closed = closed;
  Drawn of;
  of.what = open ? "trough" : "closed";
  of.size = size;
  BodySpec<2> spec = free_body<2>(hull.mass, Inertia<2>(1));
  spec.surface = polygon(outline).surface;
  spec.pose.translate(Vec<2>(0, 2 * size)).rotate((open ? 0.2 : pi) * (2 * unit(random) - 1));
  of.mechanism.bodies = {spec};
  of.steps = {0.002};
  const double turn = angle(spec.pose), volume = hull.mass / water.density;
  of.pose = [=](const std::vector<double>& q) {
    double low = -3 * size, high = 3 * size;
    for (int i = 0; i < 60; ++i) {
      const double y = 0.5 * (low + high);
      (reference::below(reference::moved(open ? closed : outline, Vec<2>(0, y), turn + q[0]), 0).area > volume ? low
                                                                                                               : high) =
          y;
    }
    Isometry<2> pose = Isometry<2>::Identity();
    pose.translate(Vec<2>(0, low)).rotate(turn + q[0]);
    return pose;
  };
  of.energy = [=](const std::vector<double>& q) {
    const auto pose = of.pose(q);
    return reference::energy(hull, pose.translation(), turn + q[0], water.density);
  };
  return of;
}

double worst_afloat(unsigned first, unsigned count) {
  double worst = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const auto of = drawn_afloat(seed);
    const auto& spec = of.mechanism.bodies[0];
    const auto q = reference::bottom(of.energy, {0}, of.steps);
    const auto floats = floating_stable<2>(spec.surface, spec.pose, spec.mass, water.density, water.level);
    if (!floats) {
      ADD_FAILURE() << seed << " sinks, " << of.what;
      continue;
    }
    const double apart = difference(of, floats->pose, of.pose(q));
    EXPECT_LT(apart, 0.005) << "seed " << seed << ", " << of.what << ", q " << q[0];
    worst = std::max(worst, apart);
  }
  return worst;
}

}  // namespace

TEST(AtRest, floating_bodies_are_where_their_energy_is_least) { worst_afloat(0, 20); }

TEST(AtRestNightly, floating_bodies_are_where_their_energy_is_least) {
  std::printf("worst of 300 afloat: %.2g of the hull's size\n", worst_afloat(1000, 300));
}

TEST(AtRest, held_bodies_are_where_their_energy_is_least) { EXPECT_LT(worst_of(0, 40), 0.005); }

// ctest -L nightly
TEST(AtRestNightly, held_bodies_are_where_their_energy_is_least) {
  const double worst = worst_of(1000, 300);
  RecordProperty("worst", std::to_string(worst));
  std::printf("worst of 300: %.2g of the hull's size\n", worst);
}

TEST(AtRest, box_that_may_only_heave_does_not_roll) {
  auto box = hull_of(block(1, 1), 500, {0, 0.3});
  box.free = {false, true, false};
  const auto rest = at_rest<2>({{box}}, water);
  EXPECT_NEAR(angle(rest.bodies[0].pose), 0, 1e-12);
  EXPECT_NEAR(rest.bodies[0].draft, 0.5, 1e-9);
}

TEST(AtRest, free_box_turns_as_hydrostatics_say) {
  const auto box = hull_of(block(1, 1), 500, {0, 0});
  const auto rest = at_rest<2>({{box}}, water);
  EXPECT_NEAR(std::abs(angle(rest.bodies[0].pose)), pi / 4, 1e-6);
  EXPECT_NEAR(rest.energy, at_rest<2>({{hull_of(block(1, 1), 500, {0, 0}, pi / 4)}}, water).energy, 1e-6);
}

// Buoyancy and weight turn about the hinge: a flap that is lighter than water stands up.
TEST(AtRest, flap_rises_about_its_hinge) {
  const auto flap = hull_of(block(2, 11), 5769, {0, -3.5}, 0.3);
  const Vec<2> hinge = Vec<2>(0, -3.5) + Eigen::Rotation2Dd(0.3) * Vec<2>(0, -5.5);
  Mechanism<2> mechanism{{flap}, {tie(JointType::hinge, 0, hinge)}};
  const auto rest = at_rest<2>(mechanism, {.density = 1020, .gravity = 9.81, .level = 0});
  EXPECT_NEAR(angle(rest.bodies[0].pose), 0, 1e-8);
  EXPECT_NEAR((rest.bodies[0].pose.translation() - hinge - Vec<2>(0, 5.5)).norm(), 0, 1e-8);
}

TEST(AtRest, weight_lies_on_the_floor_and_what_it_carries_on_it) {
  auto heavy = hull_of(block(2, 1), 5000, {0, 3});
  auto second = hull_of(block(1, 0.5), 1000, {0, 5});
  Mechanism<2> mechanism{{heavy, second}};
  mechanism.contacts = ContactSpec<2>{.planes = {{Vec<2>(0, -2), Vec<2>(0, 1)}}};
  const auto rest = at_rest<2>(mechanism, water);
  EXPECT_NEAR(rest.bodies[0].pose.translation().y(), -1.5, 1e-6);
  EXPECT_NEAR(rest.bodies[1].pose.translation().y(), -0.75, 1e-6);
  EXPECT_TRUE(rest.bodies[0].touches && rest.bodies[1].touches);
  EXPECT_FALSE(rest.bodies[0].sinks);
}

TEST(AtRest, what_is_too_heavy_sinks_and_pulls_what_is_tied_to_it) {
  Mechanism<2> mechanism{{hull_of(block(1, 1), 3000, {0, 0}), hull_of(block(1, 1), 500, {2, 0})}};
  auto joint = tie(JointType::hinge, 0, {1, 0});
  joint.other = 1;
  mechanism.joints = {joint};
  EXPECT_TRUE(at_rest<2>(mechanism, water).bodies[0].sinks);
  mechanism.bodies[0] = hull_of(block(1, 1), 300, {0, 0});
  EXPECT_FALSE(at_rest<2>(mechanism, water).bodies[0].sinks);
}

// Two boxes and a hinge, coordinates: height of the hinge and both angles.
TEST(AtRest, raft_of_two_is_where_its_energy_is_least) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::array<reference::Hull, 2> hulls;
    Mechanism<2> mechanism;
    for (int i = 0; i < 2; ++i) {
      const auto outline = block(2, 0.6);
      const double mass = 1200 * (0.2 + 0.6 * unit(random));
      hulls[static_cast<std::size_t>(i)] = {outline, {}, {}, mass};
      mechanism.bodies.push_back(hull_of(outline, mass, {i == 0 ? -1.1 : 1.1, 0.1}));
    }
    auto joint = tie(JointType::hinge, 0, {0, 0.1});
    joint.other = 1;
    const double stiffness = 2000 * unit(random);
    joint.spring = Spring{stiffness, 0, 0.2};
    mechanism.joints = {joint};
    const auto energy = [&](const std::vector<double>& q) {
      double sum = 0.5 * stiffness / water.gravity * std::pow(q[1] - q[2] - 0.2, 2);
      for (const int i : {0, 1}) {
        const Vec<2> arm(i == 0 ? -1.1 : 1.1, 0);
        const double turn = q[static_cast<std::size_t>(i) + 1];
        sum += reference::energy(hulls[static_cast<std::size_t>(i)],
                                 Vec<2>(0, 0.1 + q[0]) + Eigen::Rotation2Dd(turn) * arm, turn, water.density);
      }
      return sum;
    };
    const auto q = reference::bottom(energy, {0, 0, 0}, {0.02, 0.01, 0.01});
    const auto rest = at_rest<2>(mechanism, water);
    EXPECT_NEAR(angle(rest.bodies[0].pose), q[1], 0.003) << seed;
    EXPECT_NEAR(angle(rest.bodies[1].pose), q[2], 0.003) << seed;
    EXPECT_LE(rest.energy / water.gravity, energy(q) + 1e-3) << seed;
  }
}

TEST(AtRest, in_space_it_is_that_of_hydrostatics) {
  const auto shape = box({2, 1, 0.3});
  auto spec = of_shape<3>(shape, {0, 0, 0.5}, 300);
  spec.pose.linear() = Eigen::AngleAxisd(0.3, Vec<3>(1, 0.4, 0.2).normalized()).toRotationMatrix();
  const auto free = at_rest<3>({{spec}}, water);
  EXPECT_NEAR(free.bodies[0].pose.linear()(2, 2), 1, 1e-8);
  EXPECT_NEAR(free.bodies[0].draft, 0.15, 1e-8);
  spec.free = {false, false, true, false, false, false};
  const auto held = at_rest<3>({{spec}}, water);
  EXPECT_NEAR((held.bodies[0].pose.linear() - spec.pose.linear()).norm(), 0, 1e-12);
  EXPECT_NEAR(held.bodies[0].submerged.volume, 0.3, 1e-8);
}

}  // namespace splashdown::rigid::rest_test
