// What joints and contacts are told to do to bodies: weights, momenta, springs.
#include <gtest/gtest.h>

#include <map>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::reactions_test {
namespace {

constexpr double g = 9.81;

template <int d>
std::map<std::string, double> told(Bodies<d>& bodies, double dt = 1e-3) {
  bodies.begin(dt, dt);
  bodies.solve(std::vector<Wrench<d>>(bodies.size(), Wrench<d>::Zero()));
  std::map<std::string, double> all;
  for (const auto& [name, value] : bodies.diagnostics()) all[name] = value;
  bodies.commit();
  return all;
}

TEST(Reactions, of_a_hinge_carry_the_weight_and_turn_the_body) {
  BodySpec<2> body = of_shape<2>(box(0.4, 0.2), {0.5, 0}, 3);
  Bodies<2> bodies({body}, pull<2>({0, -g}), {{.point = {0, 0, 0}}});
  const auto at = told(bodies, 1e-5);
  // Let go level: alpha = m g a/(I + m a^2), f_y = m (g - alpha a).
  const double inertia = body.inertia(0, 0), a = 0.5, alpha = 3 * g * a / (inertia + 3 * a * a);
  EXPECT_NEAR(at.at("joint0_fy"), 3 * (g - alpha * a), 1e-3);
  EXPECT_NEAR(at.at("joint0_mz"), -a * at.at("joint0_fy"), 1e-6) << "about the centre of mass; none about the pin";
}

TEST(Reactions, of_a_weld_carry_force_and_moment_in_space) {
  BodySpec<3> body = skew_body();
  body.pose.translation() = Vec<3>(0.3, -0.2, 0.1);
  Bodies<3> bodies({body}, pull<3>({0, 0, -g}), {{.type = JointType::weld, .point = {0.3, -0.2, 0.1}}});
  const auto at = told(bodies);
  EXPECT_NEAR(at.at("joint0_fz"), body.mass * g, 1e-9);
  for (const char* name : {"joint0_fx", "joint0_fy", "joint0_mx", "joint0_my", "joint0_mz"})
    EXPECT_NEAR(at.at(name), 0, 1e-9);
}

TEST(Reactions, of_a_slider_are_those_of_its_spring_and_its_stop) {
  BodySpec<2> body = of_shape<2>(box(0.4, 0.2), {0, 0}, 3);
  const double k = 1e4;
  Bodies<2> hung({body}, pull<2>({0, -g}),
                 {{.type = JointType::slider, .axis = Eigen::Vector3d::UnitY(), .spring = Spring{k, 0, 3 * g / k}}});
  EXPECT_NEAR(told(hung).at("joint0_fy"), 3 * g, 1e-6) << "its spring balances the weight";
  Bodies<2> stopped({body}, pull<2>({0, -g}),
                    {{.type = JointType::slider, .axis = Eigen::Vector3d::UnitY(), .stops = {0, 1}}});
  EXPECT_NEAR(told(stopped).at("joint0_fy"), 3 * g, 1e-6) << "its stop does";
}

TEST(Reactions, of_contacts_carry_the_weight_and_rub) {
  const double slope = 0.2, mu = 0.1;
  ContactSpec<2> contact{.planes = {{{0, 0}, {0, 1}}}, .friction = mu};
  BodySpec<2> body = of_shape<2>(box(0.4, 0.2), {0, 0.1}, 3);
  Bodies<2> bodies({body}, pull<2>({g * std::sin(slope), -g * std::cos(slope)}), {}, contact);
  for (int i = 0; i < 20; ++i) told(bodies);
  const auto at = told(bodies);
  EXPECT_NEAR(at.at("hull_contact_fy"), 3 * g * std::cos(slope), 1e-6);
  EXPECT_NEAR(at.at("hull_contact_fx"), -mu * 3 * g * std::cos(slope), 1e-6) << "it slides";
}

TEST(Reactions, between_bodies_are_equal_and_opposite) {
  BodySpec<2> lower = of_shape<2>(box(0.4, 0.2), {0, 0.1}, 3), upper = of_shape<2>(box(0.4, 0.2), {0, 0.3}, 2);
  lower.name = "lower", upper.name = "upper";
  Bodies<2> bodies({lower, upper}, pull<2>({0, -g}), {}, ContactSpec<2>{.planes = {{{0, 0}, {0, 1}}}});
  for (int i = 0; i < 5; ++i) told(bodies);
  const auto at = told(bodies);
  EXPECT_NEAR(at.at("upper_contact_fy"), 2 * g, 1e-6);
  EXPECT_NEAR(at.at("lower_contact_fy"), 3 * g, 1e-6) << "five from the ground less two from above";
}

TEST(Reactions, are_absent_without_joints_and_contacts) {
  Bodies<2> bodies({of_shape<2>(box(0.4, 0.2), {0, 0}, 3)}, pull<2>({0, -g}));
  EXPECT_TRUE(told(bodies).empty());
}

}  // namespace
}  // namespace splashdown::rigid::reactions_test
