// Walls that deform, behind the seam: a body against closed laws, and against water of a hundred lines.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <sstream>

#include "core/geometry.hpp"
#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"
#include "elastic/participant.hpp"
#include "rigid/bodies.hpp"
#include "solids.hpp"
#include "tests/unit/coupling/toys.hpp"

namespace splashdown::elastic::walls_test {
namespace {

using coupling::Accelerator;
using coupling::Partitioned;
using coupling::Simultaneous;
using coupling::toys::Matrix;
using coupling::toys::Vector;
using coupling::toys::Water;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int all_nodes = 0;

template <int d>
SolidMesh<d> box() {
  if constexpr (d == 2)
    return box_mesh<2>({4, 1}, {4, 1});
  else
    return box_mesh<3>({3, 1, 1}, {2, 1, 1});
}

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

/// A body of density 1; young_modulus 1 makes waves cross it in its length in seconds.
template <int d>
struct Made {
  bool linear = false, clamped = false;
  int modes = all_nodes;
  bool both = false;  // all nodes move, and the exact term has the modes
  double young_modulus = 1;
  Vec<d> gravity = Vec<d>::Zero();
  Twist<d> velocity = Twist<d>::Zero();
  Rayleigh damping = {};
  std::function<Vec<d>(double)> drive = {};  ///< velocity of what is clamped

  std::unique_ptr<Solid<d>> solid() const {
    const Isotropic moduli{young_modulus, 0.33};
    auto made =
        std::make_unique<Solid<d>>(box<d>(), linear ? small_strain<d>(moduli) : st_venant_kirchhoff<d>(moduli), 1);
    if (clamped) made->clamp([](const Vec<d>& X) { return X.x() < 1e-9; });
    return made;
  }
  std::unique_ptr<Participant<d>> part() const {
    std::vector<SolidSpec<d>> specs;
    auto& spec = specs.emplace_back();
    spec.solid = solid();
    spec.body.name = "box";
    spec.body.pose.translation() = spec.solid->centre(Field::Zero(spec.solid->size()));
    spec.body.velocity = velocity;
    spec.gravity = gravity;
    spec.damping = damping;
    spec.wall = WallChoice{modes, both};
    if (drive)
      spec.drive = [move = drive, held = spec.solid->held()](double t) {
        Field all = Field::Zero(static_cast<Eigen::Index>(held.size()));
        for (std::size_t k = 0; k < held.size(); ++k)
          if (held[k]) all[static_cast<Eigen::Index>(k)] = move(t)[static_cast<Eigen::Index>(k) % d];
        return all;
      };
    return std::make_unique<Participant<d>>(std::move(specs));
  }
};

/// Water that sticks to every vertex, `heaviness` times the body's mass, all of it coupled to all.
Matrix added_mass(const coupling::StructurePart& body, double heaviness) {
  const Eigen::Index n = body.scales().size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Matrix R = Matrix::NullaryExpr(n, n, [&] { return uniform(random); });
  const Matrix G = Matrix::Identity(n, n) + 3. / static_cast<double>(n) * R.transpose() * R;
  return heaviness * 2 * body.walls()[0].mass / G.diagonal().sum() * G;
}

/// It goes along with the body at t = 0, or is hit by it; a spring pulls it back to where it is then.
std::unique_ptr<Water> water_for(const coupling::StructurePart& body, double heaviness, double spring,
                                 bool goes_along = true) {
  const Matrix G = added_mass(body, heaviness), I = Matrix::Identity(G.rows(), G.rows());
  auto water =
      std::make_unique<Water>(G, 0 * I, spring * I, std::vector<std::size_t>(static_cast<std::size_t>(G.rows()), 0));
  water->rest = water->state().place = body.placement();
  if (goes_along) water->state().rate = body.velocities();
  return water;
}

/// Pushes the surface step by step, with steps of different lengths; looks at the body after each.
template <int d>
void push_on(Participant<d>& body, int steps, double dt, const std::function<Vector(double)>& force,
             const std::function<void(double work, double t)>& look, bool same = false) {
  double last = 0, t = 0;
  for (int k = 0; k < steps; ++k) {
    const double length = !same && k % 3 == 0 ? 0.7 * dt : dt, kick = (last + length) / 2;
    const Vector before = body.velocities(), impulse = kick * force(t);
    body.begin({.kick = kick, .dt = length});
    body.solve(impulse);
    ASSERT_TRUE(body.acceptable().ok()) << body.acceptable().cause;
    body.commit();
    t += length;
    last = length;
    look(0.5 * impulse.dot(before + body.velocities()), t);
  }
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
      Made<2> made{.linear = true, .clamped = true, .modes = modes, .damping = {0.03, 0.2}};
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

/// Forces on the vertices in the world frame, from rest: places of the centre and turns at the end.
struct Pushed {
  Vec<2> centre;
  double angle, farthest;
};
const auto push = [](const Vec<2>& X) { return Vec<2>(0.004 + 0.002 * X.y(), 0.003 * (X.x() - 1)); };

Pushed pushed(const Made<2>& made, int steps, double end) {
  const auto body = made.part();
  const auto& rest = body->surface(0).vertices;
  Vector force(rest.size());
  for (Eigen::Index k = 0; k < rest.cols(); ++k) force.segment<2>(2 * k) = push(rest.col(k));
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    const double kick = k == 0 ? dt / 2 : dt;
    body->begin({.kick = kick, .dt = dt});
    body->solve(kick * force);
    EXPECT_TRUE(body->acceptable().ok()) << body->acceptable().cause;
    body->commit();
  }
  const auto& pose = body->state(0).pose;
  return {pose.translation(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)),
          body->motion(0).u.cwiseAbs().maxCoeff()};
}

/// The same of a rigid body.
Pushed pushed_rigid(const Made<2>& made, int steps, double end) {
  const auto part = made.part();
  const auto rest = part->surface(0).vertices;
  rigid::BodySpec<2> spec;
  const Vec<2> centre(2, 0.5);
  spec.surface = part->surface(0);
  spec.surface.vertices.colwise() -= centre;
  spec.mass = 4;
  spec.inertia << 4 * (16. + 1) / 12;
  spec.free.fill(true);
  spec.pose.translation() = centre;
  rigid::Bodies<2> body({spec}, {});
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    Wrench<2> load = Wrench<2>::Zero();
    for (Eigen::Index v = 0; v < rest.cols(); ++v)
      load += wrench_of<2>(body.state(0).pose.linear() * spec.surface.vertices.col(v), push(rest.col(v)));
    body.begin(k == 0 ? dt / 2 : dt, dt);
    body.solve(std::array{load});
    body.commit();
  }
  const auto& pose = body.state(0).pose;
  return {pose.translation(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)), 0};
}

double apart(const Pushed& one, const Pushed& other) {
  return (one.centre - other.centre).norm() + std::abs(one.angle - other.angle);
}

TEST(ElasticWall, with_rigid_modes_alone_is_the_rigid_body) {
  const Made<2> made{.modes = 3};
  constexpr double end = 10;
  const double coarse = apart(pushed(made, 20, end), pushed_rigid(made, 20, end)),
               fine = apart(pushed(made, 80, end), pushed_rigid(made, 80, end));
  EXPECT_GT(std::abs(pushed(made, 80, end).angle), 0.3) << "it turns";
  EXPECT_LT(fine, 1e-3);
  // Both are of second order: turns by the chord and by the arc.
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.3) << coarse << ' ' << fine;
}

TEST(ElasticWall, is_rigid_in_the_limit_of_stiffness) {
  constexpr double end = 4;
  constexpr int steps = 400;
  const auto limit = pushed({.modes = 3}, steps, end);
  double last = 0;
  for (const double young_modulus : {10., 100., 1000.}) {
    const double away = apart(pushed({.young_modulus = young_modulus}, steps, end), limit) * young_modulus;
    EXPECT_LT(away, last > 0 ? 3 * last : 1e9) << "as 1/E, with vibrations in any phase";
    EXPECT_GT(away, 0);
    last = away;
  }
  EXPECT_LT(last / 1000, 1e-4 * limit.farthest);
}

template <int d>
void keeps_its_momenta(const Made<d>& made, double revolution, int revolutions) {
  constexpr int steps = 100;  // a turn
  double energy_before = 0;
  const auto body = made.part();
  const auto before = body->momenta(0);
  energy_before = body->energy(0);
  const double dt = revolution / steps;
  const Vector none = Vector::Zero(body->scales().size());
  for (int k = 0; k < steps * revolutions; ++k) {
    body->begin({.kick = k == 0 ? dt / 2 : dt, .dt = dt});
    body->solve(none);
    ASSERT_TRUE(body->acceptable().ok()) << k << ": " << body->acceptable().cause;
    body->commit();
  }
  const auto after = body->momenta(0);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-9 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-8 * before.angular.norm()) << made.modes;
  // Exact with all nodes; in modes the frame's rotation is that of a variational integrator, whose energy swings.
  EXPECT_NEAR(body->energy(0) / energy_before, 1, made.modes == all_nodes ? 1e-6 : 0.01);
}

TEST(ElasticWall, in_free_flight_keeps_its_momenta_over_many_turns) {
  constexpr double spin = 0.04;
  for (const int modes : {all_nodes, 8}) {
    Made<2> made{.modes = modes};
    made.velocity << 0.1, 0.05, spin;
    keeps_its_momenta(made, 2 * std::numbers::pi / spin, 20);
    Made<3> in_space{.modes = modes == all_nodes ? all_nodes : 10};
    in_space.velocity << 0.1, 0.05, -0.02, spin, 0.4 * spin, -0.3 * spin;
    keeps_its_momenta(in_space, 2 * std::numbers::pi / spin, 5);
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
