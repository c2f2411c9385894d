// Elastic modes beside rigid ones in the exact interface term, M + Z^T G Z, against that formula: in a fluid of a hundred
// lines, whose walls bend, and in the pressure equation, whose walls a spring ties.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"
#include "tests/unit/coupling/toys.hpp"

namespace splashdown::coupling::elastic_mode_test {
namespace {

using toys::Matrix;
using toys::Modal;
using toys::Vector;
using toys::Water;

/// Symmetric and positive; every coordinate is coupled to every other one.
Matrix full(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  const Matrix R = fluid::scenes::random_vector(random, Matrix(n, n));
  return Matrix::Identity(n, n) + R.transpose() * R;
}

/// A wall of the plane with its twist and one elastic mode, whose stiffness is that of the mode alone.
struct Bending {
  Matrix G = 5 * full(4, 1), M = full(4, 2), S = 3e4 * Matrix(Vector(Vector::Unit(4, 3)).asDiagonal());
  Vector F = Eigen::Vector4d(1, -20, 3, 4);
  Matrix shapes = Matrix::Identity(4, 4);

  std::unique_ptr<Water> water() const {
    return std::make_unique<Water>(G, Matrix::Zero(4, 4), Matrix::Zero(4, 4), std::vector<std::size_t>(4, 0));
  }
  std::unique_ptr<Modal> body() const {
    return std::make_unique<Modal>(Modal::Made{shapes, shapes.transpose() * M * shapes, shapes.transpose() * S * shapes,
                                               shapes.transpose() * F, toys::one_wall(4, 1)});
  }
};

/// Drives both a stepper and the formula (Z^T (M + G) Z) da' = kick Z^T (F - S Z a).
void moves_by_the_formula(const Bending& made, Stepper& stepper, const Modal& body, int passes, double tolerance) {
  const Matrix inertia = made.shapes.transpose() * (made.M + made.G) * made.shapes;
  Vector a = Vector::Zero(inertia.rows()), rate = a;
  const double dt = 1e-3;
  for (int k = 0; k < 20; ++k) {
    const auto report = stepper.attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_LE(report.passes, passes);
    stepper.commit();
    const double kick = k == 0 ? dt / 2 : dt;
    rate += inertia.ldlt().solve(made.shapes.transpose() * kick * (made.F - made.S * made.shapes * a));
    a += dt * rate;
    ASSERT_LE((body.rate() - rate).norm(), tolerance * rate.norm()) << k;
    ASSERT_LE((body.amplitude() - a).norm(), tolerance * a.norm()) << k;
  }
  EXPECT_GT(std::abs(a[a.size() - 1]), 0) << "it bends";
}

TEST(ElasticMode, beside_rigid_ones_is_inside_the_exact_term) {
  Bending made;
  // Roundoff times the condition of M + G, a step.
  const double roundoff = 20 * 1e3 * scenes::eps;
  for (const bool held : {false, true}) {
    if (held) made.shapes = made.shapes(Eigen::all, std::array{1, 3}).eval();  // heave and the mode
    auto body = made.body();
    const Modal& seen = *body;
    Simultaneous stepper(made.water(), std::move(body));
    moves_by_the_formula(made, stepper, seen, 1, roundoff);
  }
}

TEST(ElasticMode, beside_rigid_ones_is_found_by_passes_with_a_slope) {
  const Bending made;
  auto body = made.body();
  const Modal& seen = *body;
  Partitioned stepper(made.water(), std::move(body), std::make_unique<NoTerm>(), std::make_unique<Probe>(1),
                      {.tolerance = 1e-11});
  // The second pass of an affine map is exact. Passes end at 1e-11 of the motion, as far as 1 + |M^-1 G| from it.
  const double condition = 1 + (made.M.inverse() * made.G).norm();
  moves_by_the_formula(made, stepper, seen, 2, 20 * condition * 1e-11);
}

/// Two circles on a spring: they rise together, and the distance between them changes.
class Fork final : public Modal {
 public:
  Fork(Made made, std::array<Eigen::Vector2d, 2> centres) : Modal(std::move(made)), centres_(centres) {}
  Placement placement() const override {
    const Vector moved = made().shapes * next_amplitude();
    Placement all(12);
    for (int w : {0, 1}) {
      const Eigen::Matrix2d turn = Eigen::Rotation2Dd(moved[3 * w + 2]).toRotationMatrix();
      all.segment<4>(6 * w) = turn.reshaped();
      all.segment<2>(6 * w + 4) = centres_[static_cast<std::size_t>(w)] + moved.segment<2>(3 * w);
    }
    return all;
  }

 private:
  std::array<Eigen::Vector2d, 2> centres_;
};

TEST(ElasticMode, of_walls_in_water_is_inside_the_pressure_equation) {
  const std::array<Eigen::Vector2d, 2> centres{Eigen::Vector2d(-0.4, -1.2), Eigen::Vector2d(0.25, -0.7)};
  scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid = fluid::scenes::still_water(5, 3, 0.3);
  scene.fluid.size = {.surface = 0.3, .far = 0.3, .growth = 0.2};
  scene.add_body(rigid::circle(0.4, 64), 1, centres[0], 0.1);
  scene.add_body(rigid::circle(0.2, 48), 1, centres[1], 0.1);

  Matrix shapes = Matrix::Zero(6, 2);  // rise; opening
  shapes.col(0) << 0, 1, 0, 0, 1, 0;
  shapes.col(1) << 0, -0.5, 0, 0, 0.5, 0;
  const Matrix M = Eigen::Vector2d(300, 70).asDiagonal(), S = Eigen::Vector2d(0, 4e4).asDiagonal();
  const Vector F = Eigen::Vector2d(200, -500);
  std::vector<WallCoordinates> walls;
  for (Eigen::Index w : {0, 1})
    walls.push_back({.name = "circle", .first = 3 * w, .count = 3, .answers = true, .mass = 150, .volume = 0.4});
  auto body = std::make_unique<Fork>(Modal::Made{shapes, M, S, F, walls}, centres);
  Fork& fork = *body;
  fork.amplitude()[1] = 1e-3;  // opened, but the walls are where they are drawn: the spring alone knows
  auto water = std::make_unique<fluid::Participant<2>>(scenes::water_of(scene));
  const FluidPart& fluid = *water;
  Simultaneous stepper(std::move(water), std::move(body));

  const double dt = 1e-4;
  const auto report = stepper.attempt(dt);
  ASSERT_TRUE(report.ok()) << report.cause;
  EXPECT_EQ(report.passes, 1);
  const std::array<std::size_t, 2> both{0, 1};
  const Matrix G = shapes.transpose() * fluid.linearised()->added_mass(both) * shapes;
  const Matrix uncorrected = -shapes.transpose() * fluid.linearised()->slope(both) * shapes;
  EXPECT_GT(std::abs(G(0, 1)), 0.01 * G.norm()) << "the water couples what the body does not";
  const Vector expected = (M + G).ldlt().solve(dt / 2 * (F - S * Vector(Eigen::Vector2d(0, 1e-3))));
  // Corrections are cut off, and what they leave depends on what the body does: a hundredth of what they do.
  const double left = 0.01 * ((M + G).inverse() * (G - uncorrected)).norm();
  EXPECT_LE((fork.trial_rate() - expected).norm(), left * expected.norm());
  stepper.commit();
  ASSERT_TRUE(stepper.attempt(dt).ok()) << "and it goes on";
}

}  // namespace
}  // namespace splashdown::coupling::elastic_mode_test
