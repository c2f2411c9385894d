// What joints do together, on members whose answer is known: doors, taut lines, chains, frames.
#include "rigid/ties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::ties_test {
namespace {

using Joints = std::vector<JointSpec>;
using Numbers = std::vector<std::size_t>;

template <int d>
BodySpec<d> box_at(const Vec<d>& centre) {
  auto spec = free_body<d>(1, Inertia<d>::Identity());
  spec.pose.translation() = centre;
  return spec;
}

JointSpec hinge(std::size_t body, Eigen::Vector3d point, Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(),
                std::optional<std::size_t> other = {}) {
  return {JointType::hinge, body, other, point, axis};
}
JointSpec slider(std::size_t body, double angle, std::optional<std::size_t> other = {}) {
  return {JointType::slider, body, other, Eigen::Vector3d::Zero(), {std::cos(angle), std::sin(angle), 0}};
}

template <int d>
Ties examined(const std::vector<BodySpec<d>>& bodies, const Joints& joints) {
  return examine_ties<d>(bodies, joints);
}

TEST(Ties, of_two_sliders_hold_a_body_unless_they_are_along_one_line) {
  const std::vector bodies{box_at<2>({0, 0})};
  for (int i = 0; i < 36; ++i) {
    const double first = 0.3, second = first + i * std::numbers::pi / 36;
    const auto ties = examined<2>(bodies, {slider(0, first), slider(0, second)});
    EXPECT_TRUE(ties.contradicting.empty());
    EXPECT_EQ(ties.repeated, i == 0 ? Numbers{1} : Numbers{}) << i;
    ASSERT_EQ(ties.held.size(), i == 0 ? 0u : 1u) << i;
    if (i > 0) EXPECT_EQ(ties.held[0].joints, (Numbers{0, 1}));
  }
}

TEST(Ties, of_a_door_repeat_each_other_on_one_axis_and_hold_it_on_two) {
  const std::vector bodies{box_at<3>({0.5, 0, 1})};
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const auto door = examined<3>(bodies, {hinge(0, {0, 0, 0.2}, up), hinge(0, {0, 0, 1.8}, up)});
  EXPECT_EQ(door.repeated, Numbers{1});
  EXPECT_TRUE(door.held.empty());
  for (const double aside : {1.0, 1e-2, 1e-4, 1e-6}) {
    const auto stuck = examined<3>(bodies, {hinge(0, {0, 0, 0.2}, up), hinge(0, {aside, 0, 1.8}, up)});
    EXPECT_EQ(stuck.held.size(), 1u) << aside;
  }
}

TEST(Ties, hold_a_body_by_the_least_of_them_and_its_freedoms) {
  auto body = box_at<2>({0, 0});
  const auto three = examined<2>({body}, {slider(0, 0), hinge(0, {1, 0, 0}), slider(0, 0)});
  ASSERT_EQ(three.held.size(), 1u);
  EXPECT_EQ(three.held[0].joints.size(), 2u);
  body.free = {false, true, false};  // y
  EXPECT_TRUE(examined<2>({body}, {slider(0, std::numbers::pi / 2)}).held.empty());
  const auto across = examined<2>({body}, {slider(0, 0)});
  ASSERT_EQ(across.held.size(), 1u);
  EXPECT_EQ(across.held[0].joints, Numbers{0});
}

TEST(Ties, leave_a_chain_of_links_its_motions_until_both_ends_are_fast) {
  constexpr std::size_t links = 6;
  std::vector<BodySpec<2>> bodies;
  Joints joints{hinge(0, {0, 0, 0})};
  double x = 0, y = 0;
  for (std::size_t i = 0; i < links; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    const double to_x = x + std::cos(angle), to_y = y + std::sin(angle);
    bodies.push_back(box_at<2>({(x + to_x) / 2, (y + to_y) / 2}));
    if (i + 1 < links) joints.push_back(hinge(i, {to_x, to_y, 0}, Eigen::Vector3d::UnitZ(), i + 1));
    x = to_x, y = to_y;
  }
  EXPECT_TRUE(examined<2>(bodies, joints).held.empty());
  joints.push_back(hinge(links - 1, {x, y, 0}));
  EXPECT_TRUE(examined<2>(bodies, joints).held.empty());  // six links, four motions
  for (std::size_t i = 0; i + 1 < links; ++i) {           // stiffened link by link: a truss of three is held
    joints.push_back({JointType::weld, i, i + 1, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()});
    EXPECT_EQ(examined<2>(bodies, joints).held.size(), links - i - 1 <= 2 ? links : 0u) << i;
  }
}

TEST(Ties, contradict_each_other_where_a_body_is_tied_to_two_that_part) {
  auto still = box_at<2>({-1, 0}), moving = box_at<2>({1, 0});
  still.motion = BodyMotion::fixed;
  moving.motion = BodyMotion::prescribed;
  for (const double speed : {0., 1e-3, 5.}) {
    moving.velocity << speed, 0, 0;
    const auto weld = [](std::size_t a, std::size_t b) {
      return JointSpec{JointType::weld, a, b, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
    };
    const std::vector bodies{box_at<2>({0, 0}), still, moving};
    EXPECT_EQ(examined<2>(bodies, {weld(0, 1), weld(0, 2)}).contradicting, speed > 0 ? (Numbers{0, 1}) : Numbers{});
    EXPECT_TRUE(examined<2>(bodies, {slider(0, 0, 1), weld(0, 2)}).contradicting.empty());
  }
}

TEST(Ties, contradict_a_velocity_that_a_held_freedom_keeps) {
  auto body = box_at<2>({0, 0});
  body.free = {false, true, true};
  body.velocity << 3, 0, 0;  // towed along x for ever
  EXPECT_EQ(examined<2>({body}, {slider(0, std::numbers::pi / 2)}).contradicting, Numbers{0});
  EXPECT_TRUE(examined<2>({body}, {hinge(0, {0, 1, 0})}).contradicting.empty());  // it turns below the hinge
  EXPECT_TRUE(examined<2>({body}, {slider(0, 0)}).contradicting.empty());
}

TEST(Ties, tell_velocities_that_they_do_not_leave) {
  auto pendulum = box_at<2>({0, -2});
  pendulum.velocity << 0, 0, 1;
  EXPECT_EQ(examined<2>({pendulum}, {hinge(0, {0, 0, 0})}).jolted, Numbers{0});
  pendulum.velocity << 2, 0, 1;  // w x r
  EXPECT_TRUE(examined<2>({pendulum}, {hinge(0, {0, 0, 0})}).jolted.empty());
}

}  // namespace
}  // namespace splashdown::rigid::ties_test
