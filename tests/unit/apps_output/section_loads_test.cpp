// Loads between the parts of a body: equilibrium of a box in closed form, and what acts on one part acts back on the other.
#include "apps/record/sections/section_loads.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "box_of_water.hpp"
#include "stand_ins.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::section_loads_test {
namespace {

constexpr double round_off =
    1e-12 * 10 * weight;  // of a few hundred facets with forces of the box's weight, ten metres deep

/// A unit box deep in water at rest, anywhere.
template <int d>
struct SunkenBox {
  DrawnFluid<d> fluid;
  DrawnBodies<d> bodies;
  RecordInput<d> input;
  Isometry<d> pose = Isometry<d>::Identity();

  explicit SunkenBox(double turn) {
    pose.translation()(d - 1) = -3;
    pose.translation()(0) = 0.3;
    if constexpr (d == 2)
      pose.rotate(turn);
    else
      pose.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, 3).normalized()));
    const auto box = box_of_water<d>(pose);
    fluid.made = {{"box", box.hull, pose}};
    fluid.poses = {pose};
    fluid.x = box.x;
    fluid.v.assign(box.x.size(), Vec<d>::Zero());
    fluid.places.assign(box.x.size(), {});
    fluid.p = box.p;
    fluid.facets = box.boundary;
    BodySpec<d> body;
    body.name = "box";
    body.surface = box.hull;
    body.mass = weight / 9.81;  // as heavy as the water it displaces
    body.pose = pose;
    bodies.specs = {body};
    bodies.states = {{pose, body.velocity}};
    input.fluid = &fluid;
    input.bodies = &bodies;
    input.body_velocity_n = input.body_acceleration_n = {Twist<d>::Zero()};
    WallLoad<d> load;
    load.physical(d - 1) = weight;
    input.body_load = {load};
  }

  SectionRecord<d> record(int axis, const std::vector<PointMass<d>>& points = {}) const {
    const auto& body = bodies.specs[0];
    const auto mass = distributed<d>(body.surface, body.mass, points);
    SectionRecord<d> record;
    record.name = "frames";
    record.body = "box";
    record.axis = axis;
    record.gravity(d - 1) = -9.81;
    for (int k = -10; k <= 10; ++k)
      record.stations.push_back({0.05 * k, mass_ahead<d>(mass, Vec<d>::Unit(axis), 0.05 * k)});
    return record;
  }
};

Eigen::Vector3d deep(const Vec<2>& v) { return {v.x(), v.y(), 0}; }
Eigen::Vector3d deep(const Vec<3>& v) { return v; }

// Where each slice weighs what it displaces, a section carries what the water would press on it: -p along the axis at its centre, and
// the moment of a pressure that grows across it. The second moment of its unit side is 1/12.
template <int d>
void box_of_water_bends_as_water_does() {
  for (const double turn : {0.0, 0.4, 2.5})
    for (int axis = 0; axis < d; ++axis) {
      const SunkenBox<d> box(turn);
      const Vec<d> up = box.pose.linear().transpose() * Vec<d>::Unit(d - 1), along = Vec<d>::Unit(axis);
      for (const auto& load : section_loads<d>(box.record(axis), box.input)) {
        if (std::abs(load.station) > 0.499) {
          EXPECT_LE(load.force.norm() + load.moment.norm(), round_off);
          continue;
        }
        const double p = hydrostatic<d>(Vec<d>(box.pose * Vec<d>(load.station * along)));
        EXPECT_LE((load.force + p * deep(along)).norm(), round_off) << load.station;
        const Vec<d> grows = -weight / 12 * (up - up(axis) * along);  // integral of p r over the section
        EXPECT_LE((load.moment + deep(grows).cross(deep(along))).norm(), round_off) << load.station;
      }
    }
}
TEST(SectionLoads, of_a_box_that_weighs_as_water_are_those_of_the_water) {
  box_of_water_bends_as_water_does<2>();
  box_of_water_bends_as_water_does<3>();
}

// Two masses m at +-a, the rest filled evenly: b - w = 2 m g a metre, less m g at each mass.
template <int d>
void box_with_two_masses_hogs_as_its_weight_says() {
  const SunkenBox<d> box(0);
  const double m = 150, a = 0.33, g = 9.81;
  const auto loads = section_loads<d>(box.record(0, {{m, a * Vec<d>::UnitX()}, {m, -a * Vec<d>::UnitX()}}), box.input);
  for (const auto& load : loads) {
    const double rest = 0.5 - load.station;
    double shear = 2 * m * g * rest, lifts_the_bow = m * g * rest * rest;
    for (const double at : {a, -a})
      if (at > load.station) shear -= m * g, lifts_the_bow -= m * g * (at - load.station);
    // Water presses on the end with a load that grows downwards: it squeezes the keel, the same at each section.
    const double of_pressure = load.station < -0.499 || load.station > 0.499 ? 0 : weight / 12;
    EXPECT_NEAR(load.shear, shear, round_off) << load.station;
    EXPECT_NEAR(load.bending, -lifts_the_bow + of_pressure, round_off) << load.station;
  }
}
TEST(SectionLoads, of_a_box_at_rest_are_buoyancy_less_weight_summed_from_its_end) {
  box_with_two_masses_hogs_as_its_weight_says<2>();
  box_with_two_masses_hogs_as_its_weight_says<3>();
}

// Any pressures, any spin: with the accelerations that they give the box, nothing is left behind its last section.
template <int d>
void loads_end_at_zero_with_any_motion() {
  std::mt19937 random(55);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int draw = 0; draw < 20; ++draw) {
    SunkenBox<d> box(3 * any(random));
    for (double& p : box.fluid.p) p *= 1 + 0.5 * any(random);
    auto& velocity = box.input.body_velocity_n[0];
    for (int k = 0; k < freedoms<d>; ++k) velocity(k) = 3 * any(random);
    // More than pressure: friction and the like.
    auto& load = box.input.body_load[0];
    for (int k = 0; k < freedoms<d>; ++k)
      load.physical(k) = weight * any(random), load.repair(k) = weight * any(random);
    const double mass = box.bodies.specs[0].mass;
    auto& acceleration = box.input.body_acceleration_n[0];
    acceleration = load.total() / mass;
    acceleration(d - 1) -= 9.81;
    // A cube is a ball to Euler's equations: inertia m/6, no gyroscopic moment.
    acceleration.template tail<freedoms<d> - d>() *= 6;
    for (int axis = 0; axis < d; ++axis) {
      const auto loads = section_loads<d>(box.record(axis), box.input);
      EXPECT_LE(loads.back().force.norm(), round_off);
      EXPECT_LE(loads.back().moment.norm(), round_off);
      EXPECT_LE(loads.front().force.norm(), 10 * round_off);
      EXPECT_LE(loads.front().moment.norm(), 10 * round_off);
    }
  }
}
TEST(SectionLoads, act_on_one_part_as_they_act_back_on_the_other) {
  loads_end_at_zero_with_any_motion<2>();
  loads_end_at_zero_with_any_motion<3>();
}

// A body that is held has its holder's force behind the last section.
TEST(SectionLoads, behind_a_body_are_minus_what_else_acts_on_it) {
  SunkenBox<3> box(0);
  box.bodies.specs[0].mass *= 2;
  const auto load = section_loads<3>(box.record(0), box.input).front();
  EXPECT_NEAR(load.shear, weight - 2 * weight, round_off);
}

TEST(SectionMass, fills_the_hull_so_that_mass_and_centre_are_the_bodys) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.4, 0.4);
  for (int draw = 0; draw < 20; ++draw) {
    auto hull = unit_box<3>();
    for (Eigen::Index v = 0; v < 8; ++v)
      for (int k = 0; k < 3; ++k) hull.vertices(k, v) += 0.3 * any(random);
    const PointMass<3> heavy{20, {any(random), any(random), any(random)}};
    const auto body = distributed<3>(hull, 70, {heavy});
    const auto whole = mass_ahead<3>(body, Vec<3>::UnitY(), -5), none = mass_ahead<3>(body, Vec<3>::UnitY(), 5);
    EXPECT_NEAR(whole.mass, 70, 1e-12 * 70);
    EXPECT_LE(whole.first.norm(), 1e-12 * 70);
    EXPECT_EQ(none.mass, 0);
    const Vec<3> tilted = Vec<3>(1, 2, -1).normalized();
    const auto front = mass_ahead<3>(body, tilted, 0.1), back = mass_ahead<3>(body, Vec<3>(-tilted), -0.1);
    EXPECT_NEAR(front.mass + back.mass, 70, 1e-11 * 70);
    EXPECT_LE((front.second + back.second - whole.second).norm(), 1e-11 * whole.second.norm());
  }
  EXPECT_NEAR(lowest_density<3>(distributed<3>(unit_box<3>(), 5, {})), 5, 1e-12);
  EXPECT_LT(lowest_density<3>(distributed<3>(unit_box<3>(), 5, {{2, {0.5, 0, 0}}})), 0);
}

TEST(SectionLoads, are_written_in_the_frame_of_the_shape_and_their_largest_are_kept) {
  ScratchFolder folder;
  SunkenBox<2> box(0);
  RecorderSettings<2> settings;
  settings.directory = folder.path();
  auto record = box.record(0, {{100, {0.3, 0}}, {100, {-0.3, 0}}});
  record.centre = 2;
  record.every = 0;
  settings.sections = {record};
  Recorder<2> recorder(settings);
  recorder.record(box.input);
  EXPECT_TRUE(folder.text("section_loads.csv").starts_with(std::string(section_loads_header) + "\n0,frames,1.5,"));
  Summary summary;
  recorder.summarise(summary);
  const auto& kept = summary.sections.at("frames");
  EXPECT_EQ(kept.axis, "x");
  double largest = 0;
  for (const auto& load : section_loads<2>(record, box.input)) largest = std::max(largest, std::abs(load.shear));
  EXPECT_EQ(std::abs(kept.shear.value), largest);
  EXPECT_GT(kept.hogging.value, 0) << "weights stand further out than what carries them";
}

}  // namespace
}  // namespace splashdown::apps::section_loads_test
