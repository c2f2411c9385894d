// The slope that both sides know before the first pass, against its definition and against passes that are made.
#include "coupling/accelerators/pass_slope.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling::pass_slope_test {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double dt = 1e-3, kick = dt / 2;

/// Two free circles close to each other and a fixed one between them in the list.
scenes::Scene three_bodies() {
  auto scene = scenes::submerged_circle(0.1);
  const auto small = rigid::circle(0.2, 48);
  scene.add_body(small, 50, {1.2, -1.5}, 0.1);
  scene.add_body(small, 20, {-0.85, -1.5}, 0.1);
  scene.bodies[1].motion = BodyMotion::fixed;
  return scene;
}

struct Begun {
  fluid::Participant<2> fluid;
  rigid::Participant<2> bodies;
  explicit Begun(const scenes::Scene& scene, double laplacian = 0)
      : fluid(scenes::water_of(scene)),
        bodies(std::make_unique<rigid::Bodies<2>>(scene.bodies, std::vector<std::unique_ptr<rigid::Force<2>>>{})) {
    const Step step{.kick = kick, .dt = dt};
    bodies.begin(step);
    InterfaceModel model;
    const LaplacianTerm term(laplacian);
    for (const auto& wall : bodies.walls()) model.interface_operators.push_back(term.interface_operator(wall));
    EXPECT_TRUE(fluid.begin(step, model).ok());
  }
};

Matrix compliance(const scenes::Scene& scene) {
  Matrix C = Matrix::Zero(9, 9);
  for (int b : {0, 2}) {
    const auto& spec = scene.bodies[static_cast<std::size_t>(b)];
    C.diagonal().segment(3 * b, 3) << 1 / spec.mass, 1 / spec.mass, 1 / spec.inertia(0, 0);
  }
  return C;
}

TEST(PassSlope, is_the_added_mass_of_all_free_bodies_over_their_mass) {
  const auto scene = three_bodies();
  Begun begun(scene);
  const std::array<std::size_t, 3> all{0, 1, 2};
  const Matrix M = -begun.fluid.linearised()->slope(all);  // the added mass without the corrections of the pressure
  EXPECT_LE((M - M.transpose()).norm(), 1e-10 * M.norm());
  EXPECT_GT(std::abs(M(0, 6)), 0.01 * M(6, 6)) << "one body feels the other";
  Matrix expected = -compliance(scene) * M;
  expected.middleCols(3, 3).setZero();  // nobody moves the fixed one
  const Matrix J = pass_slope(begun.fluid, begun.bodies);
  EXPECT_LE((J - expected).norm(), 1e-10 * expected.norm());
}

TEST(PassSlope, with_a_laplacian_leads_to_the_same_solution) {
  // x = J x + a: the impulses eliminated, the bodies' part is that without the Laplacian.
  const auto scene = three_bodies();
  Begun without(scene), with(scene, 1);
  const Matrix J = pass_slope(without.fluid, without.bodies);
  const Matrix K = pass_slope(with.fluid, with.bodies);
  ASSERT_EQ(K.rows(), 9 + 12);
  const Matrix left = Matrix::Identity(12, 12) - K.bottomRightCorner(12, 12);
  const Matrix eliminated =
      K.topLeftCorner(9, 9) + K.topRightCorner(9, 12) * left.partialPivLu().solve(K.bottomLeftCorner(12, 9));
  EXPECT_LE((eliminated - J).norm(), 1e-9 * J.norm());
}

TEST(PassSlope, is_that_of_passes_but_for_the_corrections_of_the_pressure) {
  // Corrections find a part of the mesh's error: (h / a)^2 = 0.06 on the larger circle, 0.25 on the small one.
  const auto scene = three_bodies();
  Begun begun(scene);
  const Matrix J = pass_slope(begun.fluid, begun.bodies);
  const auto image = [&](int moved, double by) {
    Velocities velocities = Velocities::Zero(9);
    if (moved >= 0) velocities[moved] = by;
    EXPECT_TRUE(begun.fluid.solve({.velocities = velocities}).ok());
    return Velocities(begun.bodies.solve(begun.fluid.solution().impulse));
  };
  const double speed = 1e-3;  // next to nothing moves
  const Eigen::VectorXd at_rest = image(-1, 0);
  for (int column : {0, 1, 6, 7}) {
    const Eigen::VectorXd slope = (image(column, speed) - at_rest) / speed;
    EXPECT_LE((slope - J.col(column)).norm(), 0.25 * J.col(column).norm()) << column;
  }
}

}  // namespace
}  // namespace splashdown::coupling::pass_slope_test
