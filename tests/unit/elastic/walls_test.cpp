// Walls that deform, behind the seam: a body against closed laws, and against water of a hundred lines.
#include "walls.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <sstream>

#include "core/geometry.hpp"
#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"

namespace splashdown::elastic::walls_test {
namespace {

using coupling::Accelerator;
using coupling::Partitioned;
using coupling::Simultaneous;
constexpr double eps = std::numeric_limits<double>::epsilon();
template <int d>
void is_closed_and_points_out() {
  const auto mesh = box<d>();
  const auto boundary = boundary_of<d>(mesh);
  Vec<d> sum = Vec<d>::Zero();
  double enclosed = 0;
  for (Eigen::Index f = 0; f < boundary.surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> corners;
    for (int k = 0; k < d; ++k) corners[k] = boundary.surface.vertices.col(boundary.surface.facets(k, f));
    const Vec<d> area = area_vector(corners);
    sum += area;
    enclosed += corners[0].dot(area) / d;
  }
  const double volume = mesh.nodes.rowwise().maxCoeff().prod();
  EXPECT_LT(sum.norm(), 1e-14 * volume);
  EXPECT_NEAR(enclosed / volume, 1, 1e-14);
  EXPECT_EQ(boundary.surface.facets.cols(), static_cast<Eigen::Index>(mesh.facets.size()) * (d == 2 ? 2 : 4));
  for (std::size_t k = 0; k < boundary.nodes.size(); ++k)
    EXPECT_EQ(boundary.surface.vertices.col(static_cast<Eigen::Index>(k)), mesh.nodes.col(boundary.nodes[k]));
}

TEST(Boundary, is_closed_and_points_out_of_the_solid) {
  is_closed_and_points_out<2>();
  is_closed_and_points_out<3>();
}

TEST(ElasticWall, with_clamps_that_move_is_the_one_at_rest_seen_from_a_train) {
  const Vec<2> train(0.3, -0.2);
  for (const bool linear : {true, false})
    for (const int modes : {all_nodes, 6}) {
      Made<2> made{.linear = linear, .clamped = true, .modes = modes, .gravity = {0.002, -0.01}, .damping = {0, 0.05}};
      const auto at_rest = made.part();
      made.drive = [&](double) { return train; };
      made.velocity << train, 0;
      const auto moving = made.part();
      const auto force = [&](double t) -> Vector { return 1e-3 * std::sin(t) * Vector::Ones(moving->scales().size()); };
      double end = 0;
      push_on<2>(*at_rest, 30, 0.3, force, [](double, double) {});
      push_on<2>(*moving, 30, 0.3, force, [&](double, double t) { end = t; });
      const auto solid = made.solid();
      const Field u = at_rest->motion(0).u, v = at_rest->motion(0).v;
      EXPECT_GT(u.cwiseAbs().maxCoeff(), 1e-2);
      EXPECT_LT((moving->motion(0).u - solid->uniform(end * train) - u).norm(), 1e-9 * u.norm()) << linear << modes;
      EXPECT_LT((moving->motion(0).v - solid->uniform(train) - v).norm(), 1e-8 * v.norm()) << linear << modes;
    }
}

/// Strain, motion and what damping has taken are what loads and clamps have given, kick by kick.
TEST(ElasticWall, of_a_linear_body_accounts_for_damping_and_for_what_clamps_give) {
  for (const int modes : {all_nodes, 6})
    for (const bool shaken : {true, false}) {
      Made<2> made{.linear = true, .clamped = true, .modes = modes, .damping = {0.03, 0.2}, .unresolved = 0.1};
      if (shaken) made.drive = [](double t) { return Vec<2>(0.02 * t, 0.1 * std::sin(t)); };
      const auto body = made.part();
      const auto force = [&](double t) -> Vector { return 1e-2 * std::cos(t) * Vector::Ones(body->scales().size()); };
      double given = 0, most = 0, off = 0;
      const auto look = [&](double work, double) {
        given += work;
        const auto now = body->deformation(0);
        most = std::max(most, now.strain_energy + now.kinetic_energy);
        off = std::max(off, std::abs(now.strain_energy + now.kinetic_energy + now.dissipated - now.clamp_work - given));
      };
      push_on<2>(*body, 60, 0.3, force, look, true);
      EXPECT_LT(off, 1e-9 * most) << modes << shaken;
      EXPECT_GT(body->deformation(0).dissipated, 0.05 * most);
      EXPECT_EQ(body->deformation(0).clamp_work != 0, shaken);
    }
}

/// A stepper and what is in it.
template <int d>
struct Pair {
  std::unique_ptr<coupling::Stepper> stepper;
  const Participant<d>* body;
  const Water* water;
};

template <int d>
Pair<d> exact(const Made<d>& made, double heaviness, double spring = 0, bool goes_along = true) {
  auto body = made.part();
  auto water = water_for(*body, heaviness, spring, goes_along);
  Pair<d> pair{nullptr, body.get(), water.get()};
  pair.stepper = std::make_unique<Simultaneous>(std::move(water), std::move(body));
  return pair;
}

template <int d>
Pair<d> by_passes(const Made<d>& made, double heaviness, double spring, std::unique_ptr<Accelerator> accelerator) {
  auto body = made.part();
  auto water = water_for(*body, heaviness, spring);
  Pair<d> pair{nullptr, body.get(), water.get()};
  pair.stepper = std::make_unique<Partitioned>(std::move(water), std::move(body), std::make_unique<coupling::NoTerm>(),
                                               std::move(accelerator),
                                               coupling::CouplingLimits{.tolerance = 1e-10, .max_passes = 2000});
  return pair;
}

/// Most passes of so many steps.
int run(coupling::Stepper& stepper, int steps, double dt) {
  int most = 0;
  for (int k = 0; k < steps; ++k) {
    const auto report = stepper.attempt(dt * (k % 3 == 0 ? 0.7 : 1));  // steps of different lengths
    EXPECT_TRUE(report.ok()) << k << ": " << report.cause;
    if (!report.ok()) return -1;
    most = std::max(most, report.passes);
    stepper.commit();
  }
  return most;
}

TEST(ElasticWall, of_a_linear_body_is_solved_in_one_pass_however_light_it_is) {
  for (const int modes : {all_nodes, 6})
    for (const double heaviness : {0.5, 30.0, 1000.0})
      for (const double spring : {0.0, 0.1}) {
        const Made<2> made{.linear = true, .clamped = true, .modes = modes, .gravity = {0.01, -0.03}};
        const auto pair = exact(made, heaviness, spring);
        EXPECT_EQ(run(*pair.stepper, 20, 0.3), 1) << modes << ' ' << heaviness << ' ' << spring;
      }
}

/// A row of schemes that find the velocities pass by pass. Fixed factors need their map to contract: a light water.
struct Scheme {
  const char* name;
  std::function<std::unique_ptr<Accelerator>()> make;
  double heaviest;
};
const Scheme partitioned_schemes[] = {
    {"constant", [] { return std::make_unique<coupling::ConstantRelaxation>(0.8); }, 0.1},
    {"aitken", [] { return std::make_unique<coupling::Aitken>(0.5); }, 0.1},
    {"anderson", [] { return std::make_unique<coupling::Anderson>(0.1); }, 30},
    {"broyden", [] { return std::make_unique<coupling::Broyden>(0.1); }, 30},
    {"iqn_ils", [] { return std::make_unique<coupling::IqnIls>(0.1); }, 30},
    {"probe", [] { return std::make_unique<coupling::Probe>(1); }, 30}};

TEST(ElasticWall, moves_alike_with_every_scheme) {
  for (const bool linear : {true, false})
    for (const int modes : {all_nodes, 6})
      for (const double heaviness : {0.1, 30.0}) {
        const Made<2> made{.linear = linear, .clamped = true, .modes = modes, .gravity = {0.005, -0.01}};
        const auto one = exact(made, heaviness, 0.1);
        const int passes = run(*one.stepper, 8, 0.5);
        EXPECT_LE(passes, linear ? 1 : 6) << "a chord method: the tangent of the begun step";
        const Vector expected = one.body->motion(0).u;
        EXPECT_GT(expected.norm(), 1e-3);
        for (const auto& scheme : partitioned_schemes) {
          if (heaviness > scheme.heaviest) continue;
          const auto other = by_passes(made, heaviness, 0.1, scheme.make());
          ASSERT_GT(run(*other.stepper, 8, 0.5), 0) << scheme.name;
          // Passes end at 1e-10 (1e-7 within the exact term) of the velocities of a step, as far as 1 + M^-1 G from the solution.
          EXPECT_LT((other.body->motion(0).u - expected).norm(), 8 * (1e-7 + 1e-9 * heaviness) * expected.norm())
              << scheme.name << ' ' << linear << ' ' << modes << ' ' << heaviness;
        }
      }
}

// What the exact term does not have of an impulse is brought by passes: in the end all nodes move as if it had all. The water here weighs
// the same on the shortest waves as on long ones, which no real one does: the answers help least, and must not harm.
TEST(ElasticWall, with_a_few_answers_in_the_exact_term_moves_as_with_all) {
  for (const bool linear : {true, false})
    for (const double heaviness : {0.1, 0.5}) {
      const Made<2> all{.linear = linear, .clamped = true, .modes = all_nodes, .gravity = {0.005, -0.01}};
      Made<2> few = all;
      few.modes = 8;
      few.both = true;
      const auto expected = exact(all, heaviness, 0.1), found = exact(few, heaviness, 0.1);
      const auto without = by_passes(all, heaviness, 0.1, std::make_unique<coupling::IqnIls>(0.1));
      ASSERT_GT(run(*expected.stepper, 8, 0.5), 0);
      const int passes = run(*found.stepper, 8, 0.5), most = run(*without.stepper, 8, 0.5);
      EXPECT_GT(passes, 0);
      EXPECT_LE(passes, most) << linear << ' ' << heaviness;
      const Vector u = expected.body->motion(0).u;
      // Both end where a pass changes velocities by 1e-7.
      EXPECT_LT((found.body->motion(0).u - u).norm(), 8 * 1e-6 * u.norm()) << linear << ' ' << heaviness;
    }
}

/// Momenta of all nodes with the water that hangs on them, at t_n before the kick.
template <int d>
Field momenta_of_both(const Made<d>& made, const Pair<d>& pair, double heaviness) {
  const auto solid = made.solid();
  Field p = solid->mass() * pair.body->motion(0).v;
  const Vector of_water = added_mass(*pair.body, heaviness) * pair.water->state().rate;
  Eigen::Index at = 0;
  for (const int a : boundary_of<d>(solid->mesh()).nodes) p.segment<d>(d * a) += of_water.segment<d>(d * at++);
  return p;
}

TEST(ElasticWall, and_water_keep_the_momentum_that_they_have_together) {
  constexpr double heaviness = 0.7;
  for (const bool linear : {true, false})
    for (const int modes : {all_nodes, 8}) {
      Made<2> made{.linear = linear, .modes = modes};
      made.velocity << 0.03, -0.02, linear ? 0 : 0.05;
      const auto pair = exact(made, heaviness);
      const auto total = [&]() -> Vec<2> {
        return momenta_of_both(made, pair, heaviness).reshaped(2, pair.body->motion(0).u.size() / 2).rowwise().sum();
      };
      const Vec<2> before = total();
      run(*pair.stepper, 30, 0.3);
      // What passes leave of Newton's law, 1e-7 a step.
      EXPECT_LT((total() - before).norm(), 30 * (linear ? 1e-12 : 1e-7) * before.norm()) << linear << ' ' << modes;
    }
}

/// The midpoint rule of body and water: p^T (M + G)^-1 p / 2 + U stays, whatever the steps.
TEST(ElasticWall, of_a_linear_body_and_water_keep_their_energy) {
  constexpr double heaviness = 5;
  for (const bool clamped : {true, false}) {
    Made<2> made{.linear = true, .clamped = clamped};
    made.velocity << 0.03, -0.02, 0;
    const auto pair = exact(made, heaviness, 0, false);
    const auto solid = made.solid();
    Matrix total = Matrix(solid->mass());
    const Matrix G = added_mass(*pair.body, heaviness);
    std::vector<Eigen::Index> vertices;
    for (const int a : boundary_of<2>(solid->mesh()).nodes)
      for (int k : {0, 1}) vertices.push_back(2 * a + k);
    total(vertices, vertices) += G;
    for (std::size_t k = 0; k < solid->held().size(); ++k)
      if (const auto i = static_cast<Eigen::Index>(k); solid->held()[k])
        total.row(i) = total.col(i) = Vector::Unit(total.rows(), i);
    const auto energy = [&] {
      Field p = momenta_of_both(made, pair, heaviness);
      leave_out(solid->held(), p);
      return 0.5 * p.dot(total.ldlt().solve(p)) + solid->strain_energy(pair.body->motion(0).u);
    };
    const double before = energy();
    double most = 0;
    for (int k = 0; k < 300; ++k) {
      run(*pair.stepper, 1, 0.3);
      EXPECT_NEAR(energy() / before, 1, 1e-9) << k;
      most = std::max(most, solid->strain_energy(pair.body->motion(0).u) / before);
    }
    EXPECT_GT(most, 0.05) << "it bends on its way";
  }
}

TEST(ElasticWall, answers_impulses_as_its_response_says) {
  // free + Z M^-1 Z^T I for small I, and symmetric: what the exact term relies on.
  for (const int modes : {all_nodes, 8})
    for (const bool clamped : {true, false}) {
      Made<2> made{.clamped = clamped, .modes = modes, .damping = {0.02, 0.1}};
      made.gravity << 0.002, -0.003;
      const auto body = made.part();
      const Vector none = Vector::Zero(body->scales().size());
      for (int k = 0; k < 3; ++k) {
        body->begin({.kick = 0.5, .dt = 0.5});
        body->solve(none);
        body->commit();
      }
      body->begin({.kick = 0.5, .dt = 0.5});
      const auto response = body->response();
      EXPECT_LT((body->solve(none) - response.free).norm(), 1e-10 * response.free.norm());
      std::mt19937 random(1);
      std::uniform_real_distribution<double> uniform(-1e-6, 1e-6);
      const Vector impulse = Vector::NullaryExpr(none.size(), [&] { return uniform(random); });
      const auto& [Z, M] = response.modal;
      EXPECT_LT((M - M.transpose()).norm(), 1e-14 * M.norm());
      const Vector expected = Z * M.ldlt().solve(Z.transpose() * impulse);
      const Vector found = body->solve(impulse) - response.free;
      // Z and M are those of the middle, or in modes of t_n; the solution's tangent is half a step's turn away.
      EXPECT_LT((found - expected).norm(), (clamped ? 1e-3 : 0.02) * expected.norm()) << modes << clamped;
      const Vector there = body->adopt(response.free + found);
      EXPECT_LT((there - response.free - found).norm(), 1e-9 * there.norm());
      EXPECT_FALSE(body->update_contacts(impulse)) << "an adopted solution is one";
      EXPECT_TRUE(body->update_contacts(impulse + Vector::Constant(impulse.size(), 1e-3)))
          << "of other impulses it is not";
    }
}

TEST(ElasticWall, with_modes_answers_faint_impulses_in_short_steps_without_the_roundoff_of_places) {
  constexpr double dt = 1e-6, faint = 1e-20;  // places are good for eps / dt, 1e-10 in velocity
  for (const bool clamped : {true, false}) {
    const auto body = Made<2>{.linear = true, .clamped = clamped, .modes = 8}.part();
    const Vector impulse = faint * Vector::LinSpaced(body->scales().size(), -1, 1);
    body->begin({.kick = dt, .dt = dt});
    const auto response = body->response();
    const auto& [Z, M] = response.modal;
    const Vector expected = Z * M.ldlt().solve(Z.transpose() * impulse);
    EXPECT_LT((body->solve(impulse) - expected).norm(), 1e-9 * expected.norm()) << clamped;
    EXPECT_LT((body->adopt(expected) - expected).norm(), 1e-9 * expected.norm()) << clamped;
    EXPECT_FALSE(body->update_contacts(impulse)) << clamped;
  }
}

TEST(ElasticWall, goes_on_from_a_checkpoint_bit_by_bit) {
  for (const int modes : {all_nodes, 8}) {
    Made<2> made{.modes = modes, .gravity = {0, -0.01}};
    made.velocity << 0.1, 0.05, 0.03;
    const auto one = exact(made, 3, 0.01), other = exact(made, 3, 0.01);
    run(*one.stepper, 4, 0.3);
    std::stringstream file;
    one.stepper->save(file);
    other.stepper->load(file);
    for (const auto* pair : {&one, &other}) run(*pair->stepper, 4, 0.3);
    EXPECT_EQ(one.body->motion(0).u, other.body->motion(0).u);
    EXPECT_EQ(one.body->motion(0).v, other.body->motion(0).v);
    EXPECT_EQ(one.body->velocities(), other.body->velocities());
    std::stringstream cut(file.str().substr(0, file.str().size() / 2));
    EXPECT_THROW(other.stepper->load(cut), std::runtime_error);
  }
}

TEST(ElasticWall, that_turns_over_is_refused_with_a_cause) {
  const auto body = Made<2>{}.part();
  body->begin({.kick = 0.5, .dt = 1});
  Vector wild = Vector::Zero(body->scales().size());
  wild[0] = 5;  // m in the step, of an element of 1 m
  body->adopt(wild);
  EXPECT_FALSE(body->acceptable().ok());
  body->solve(Vector::Zero(wild.size()));
  EXPECT_TRUE(body->acceptable().ok()) << "the last trial counts";
  EXPECT_THROW(Made<2>{.modes = 2}.part(), std::invalid_argument) << "a free body has three rigid ones";
}

}  // namespace
}  // namespace splashdown::elastic::walls_test
