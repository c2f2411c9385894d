// The fluid on a moving mesh behind the seam: schemes agree, steps repeat, states are saved, light bodies bear it.
#include <gtest/gtest.h>

#include <sstream>

#include "bodies_in_flow.hpp"
#include "core/parallel.hpp"

namespace splashdown::ale::seam_test {
namespace {

using scenes::coupled;
using scenes::FreeBody;
using std::numbers::pi;

std::string saved(const coupling::Coupled& stepper) {
  std::ostringstream out;
  stepper.save(out);
  return out.str();
}

FreeBody tilted(double density) {
  const double b = 1, h = 0.3;
  return {.outline = scenes::box(b, h),
          .area = b * h,
          .polar = b * h * (b * b + h * h) / 12,
          .density = density,
          .angle = 0.4};
}

TEST(AleSeam, partitioned_passes_come_to_the_exact_term) {
  auto exact = coupled(tilted(2)), passes = coupled(tilted(2), std::make_unique<coupling::IqnIls>(0.5, 0));
  for (int k = 0; k < 6; ++k) {
    exact.step(0.02);
    EXPECT_GT(passes.step(0.02).passes, 1);
  }
  const auto &a = exact.bodies->state(0).velocity, &b = passes.bodies->state(0).velocity;
  EXPECT_NEAR((a - b).norm(), 0, 1e-6 * a.norm());  // tolerance 1e-8 a step
}

TEST(AleSeam, a_step_that_is_repeated_or_refused_leaves_no_trace) {
  auto once = coupled(tilted(0.3)), twice = coupled(tilted(0.3));
  for (int k = 0; k < 5; ++k) {
    once.step(0.02);
    ASSERT_TRUE(twice.stepper->attempt(0.04).ok());
    ASSERT_TRUE(twice.stepper->attempt(0.02).ok());
    twice.step(0.02);
  }
  EXPECT_EQ(saved(*once.stepper), saved(*twice.stepper));
}

TEST(AleSeam, goes_on_from_what_was_saved_with_the_same_bits) {
  auto straight = coupled(tilted(0.3)), resumed = coupled(tilted(0.3));
  for (int k = 0; k < 5; ++k) straight.step(0.02);
  std::istringstream in(saved(*straight.stepper));
  resumed.stepper->load(in);
  for (int k = 0; k < 4; ++k) {
    straight.step(0.02);
    resumed.step(0.02);
  }
  EXPECT_EQ(saved(*straight.stepper), saved(*resumed.stepper));
}

TEST(AleSeam, refuses_to_load_what_is_no_state) {
  auto made = coupled(tilted(1));
  std::istringstream in("short");
  EXPECT_THROW(made.stepper->load(in), std::runtime_error);
}

// A circle far from all sides has its own mass of fluid to move (Lamb 1932, article 68). Images in the box's sides add twice the
// square of r/half of it. No slip drags a layer along, a tenth of an element thick, at twice the sine of potential flow.
TEST(AleSeam, a_circle_moves_as_much_fluid_as_it_displaces) {
  const double radius = 0.5;
  FreeBody scene{.half = 6, .far = 1.5, .size = 0.03, .growth = 0.3, .viscosity = 1e-6};
  const double displaced = pi * radius * radius, layer = 0.1 * scene.size,
               more = 4 * pi * radius * layer + 2 * std::pow(radius / scene.half, 2) * displaced;
  Participant fluid(std::make_unique<AleFlow>(scene.fluid()));
  coupling::InterfaceModel model;
  model.modal.modes.resize(3, 0);
  model.modal.inertia.resize(0, 0);
  ASSERT_TRUE(fluid.begin({1e-4, 2e-4}, model).ok());
  ASSERT_TRUE(fluid.solve({.velocities = Eigen::Vector3d::Zero()}).ok());
  const std::size_t wall = 0;
  const Eigen::MatrixXd mass = fluid.linearised()->added_mass({&wall, 1});
  EXPECT_NEAR(mass(0, 0), displaced, more);
  EXPECT_NEAR(mass(1, 1), displaced, more);
  EXPECT_NEAR(mass(2, 2), 0, 2 * pi * std::pow(radius, 3) * layer);
  EXPECT_LT((mass - mass.transpose()).norm(), 1e-8 * mass.norm());
}

// From rest a0 = g (1 - s)/(s + 1), whatever the density: lighter bodies only go the faster.
TEST(AleSeam, bodies_of_any_density_start_with_their_added_mass) {
  for (const double density : {4., 1., 0.1, 1e-3}) {
    FreeBody scene{.density = density, .half = 6, .far = 1.5, .size = 0.03, .growth = 0.3, .viscosity = 1e-6};
    auto made = coupled(scene);
    const double dt = 1e-3;
    made.step(dt);
    const double a0 = scenes::g * (1 - density) / (density + 1), speed = made.bodies->state(0).velocity[1];
    EXPECT_NEAR(speed, 0.5 * dt * a0, 0.03 * 0.5 * dt * scenes::g) << density;
    for (int k = 0; k < 3; ++k) EXPECT_LE(made.step(dt).passes, 1);
  }
}

TEST(AleSeam, light_bodies_rise_without_an_explosion) {
  auto made = coupled(tilted(1e-3));
  for (int k = 0; k < 20; ++k) made.step(0.03);
  const auto& state = made.bodies->state(0);
  EXPECT_GT(state.pose.translation().y(), 0.02);
  EXPECT_LT(state.velocity.norm(), 2);  // sqrt of twice the fall of as much fluid
}

/// A circle that breathes: one coordinate, the rate of its radius; its placement is the radius.
class Breathing final : public MovingWall {
 public:
  explicit Breathing(const Nodes& nodes) : directions_(nodes.colwise().normalized()), radius_(nodes.col(0).norm()) {}
  Eigen::Index coordinates() const override { return 1; }
  Eigen::VectorXd first() const override { return Eigen::VectorXd::Constant(1, radius_); }
  Nodes positions(const Eigen::VectorXd& placement) const override { return placement[0] * directions_; }
  Eigen::MatrixXd basis(const Eigen::VectorXd&) const override { return directions_.reshaped(); }
  Eigen::VectorXd moved(const Eigen::VectorXd& placement, const Eigen::VectorXd& rate, double dt) const override {
    return placement + dt * rate;
  }
  Isometry<2> pose(const Eigen::VectorXd&) const override { return Isometry<2>::Identity(); }

 private:
  Nodes directions_;
  double radius_;
};

// Walls in other coordinates than a twist: what it grows by leaves through the open side, and the fluid resists by an inertia.
TEST(AleSeam, a_wall_that_breathes_pushes_out_what_it_grows_by) {
  FreeBody scene{.outline = scenes::circle(0.5, 4000), .viscosity = 1e-3};
  auto spec = scene.fluid();
  spec.gravity.setZero();
  spec.motions = {[](const Nodes& nodes) { return std::make_unique<Breathing>(nodes); }};
  AleFlow flow(spec);
  const Eigen::VectorXd rate = Eigen::VectorXd::Constant(1, 0.2);
  double before = 0, radius = 0.5;
  for (int k = 0; k < 5; ++k) {
    const double dt = 0.05, middle = radius + (k == 0 ? 0 : 0.5 * dt * rate[0]);  // as it is foreseen
    radius += dt * rate[0];
    ASSERT_TRUE(flow.begin(0.5 * (before + dt), dt).ok());
    ASSERT_TRUE(flow.solve(rate).ok());
    const double inertia = flow.answer(Eigen::MatrixXd::Identity(1, 1))(0, 0);
    EXPECT_GT(inertia, pi * 0.25);
    EXPECT_EQ(flow.impulse().size(), 1);
    if (k == 0) {  // from rest
      EXPECT_NEAR(flow.impulse()[0], -inertia * rate[0], 0.1 * inertia * rate[0]);
    }
    flow.commit(Eigen::VectorXd::Constant(1, radius));
    before = dt;
    double flux = 0;
    for (const auto& edge : flow.mesh().boundary)
      if (edge.side == top) {
        const auto& v = flow.velocity();
        const double length = (flow.mesh().nodes.col(edge.nodes[1]) - flow.mesh().nodes.col(edge.nodes[0])).norm();
        flux += length * (v(1, edge.nodes[0]) + 4 * v(1, edge.nodes[2]) + v(1, edge.nodes[1])) / 6;
      }
    EXPECT_NEAR(flux, 2 * pi * middle * rate[0], 1e-3 * flux);
  }
  EXPECT_NEAR((flow.places().colwise().norm()).minCoeff(), radius, 1e-4);
}

TEST(AleSeam, refuses_walls_and_operators_that_it_does_not_know) {
  Participant fluid(std::make_unique<AleFlow>(FreeBody{}.fluid()));
  coupling::InterfaceModel model;
  model.interface_operators = {{.laplacian = 1, .robin = 0}};
  EXPECT_THROW(fluid.begin({0.01, 0.02}, model), std::invalid_argument);
  EXPECT_THROW(fluid.solve({.velocities = coupling::Velocities::Zero(4)}), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::ale::seam_test
