// New meshes where bodies have moved theirs too far: what they keep, what they cost, how far bodies may go.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "bodies_in_flow.hpp"
#include "core/geometry.hpp"

namespace splashdown::ale::remesh_test {
namespace {

using std::numbers::pi;

/// A flow with a body that is moved by its twist.
struct Carried {
  AleFlow flow;
  Isometry<2> pose;
  double before = 0;

  explicit Carried(const AleFlowSpec& spec) : flow(spec), pose(spec.walls[0].pose) {}
  /// False: it is refused.
  bool tried(double dt, const Twist<2>& twist) {
    if (!flow.begin(0.5 * (before + dt), dt).ok() || !flow.solve(twist).ok() || !flow.acceptable().ok()) return false;
    pose = moved<2>(pose, twist, dt);
    flow.commit(pose.matrix().topRows<2>().reshaped());
    before = dt;
    return true;
  }
  void step(double dt, const Twist<2>& twist) { ASSERT_TRUE(tried(dt, twist)) << flow.time(); }
};

Surface<2> ellipse(double a, double b) {
  auto outline = scenes::circle(1);
  outline.vertices.row(0) *= a;
  outline.vertices.row(1) *= b;
  return outline;
}

/// Corners on a circle at random angles.
Surface<2> random_polygon(double radius, std::mt19937& random) {
  const int corners = std::uniform_int_distribution<>(3, 7)(random);
  std::vector<Vec<2>> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * (k + std::uniform_real_distribution<>(0, 0.6)(random)) / corners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return scenes::polygon(points);
}

// Bodies of all shapes that go with the stream, along and across the whole box: nothing acts on them.
TEST(AleRemesh, keeps_a_uniform_flow_to_roundoff) {
  std::mt19937 random(3);
  for (int n = 0; n < 4; ++n) {
    const auto within = [&](double least, double most) {
      return std::uniform_real_distribution<>(least, most)(random);
    };
    const Vec<2> stream(1, within(-0.2, 0.2));
    AleFlowSpec spec{.density = 1000, .viscosity = 1, .min = {0, -1}, .max = {4, 1}};
    spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::inflow, BoundaryKind::inflow};
    spec.inflow = [&](const Vec<2>&, double) { return stream; };
    spec.start = spec.inflow;
    spec.far = 0.5;
    spec.extension = n % 3 == 1 ? ExtensionLaw::biharmonic : ExtensionLaw::laplace;
    auto outline = n % 2 == 0 ? random_polygon(0.25, random) : ellipse(within(0.1, 0.3), within(0.1, 0.3));
    const Twist<2> twist(stream.x(), stream.y(), 0);
    const Vec<2> start(0.6, -1.2 * stream.y());
    spec.walls = {{.name = "body", .surface = outline, .pose = scenes::at(start.x(), start.y()), .velocity = twist}};
    spec.walls[0].size = within(0.08, 0.15);
    Carried body(spec);
    for (int k = 0; k < 28; ++k) {
      body.step(0.1, twist);
      EXPECT_LT(body.flow.loads()[0].physical.norm(), 1e-8 * spec.density * 0.04 / 0.1);
    }
    EXPECT_LT(scenes::error(body.flow.mesh(), body.flow.places(), body.flow.velocity(),
                            [&](const Vec<2>&) { return stream; }),
              1e-10);
    EXPECT_GE(body.flow.remeshings(), 1) << n;
    // Edges that a new mesh cuts otherwise keep the outline's area by 2e-5 of it (FlowMesh in mesh_test.cpp).
    EXPECT_LT(std::abs(body.flow.ledger().energy_remesh), 2e-5 * body.flow.ledger().kinetic_energy);
  }
}

/// A wall that flows along with a parabola: its first coordinate is how fast, its placement how far.
class Flowing final : public MovingWall {
 public:
  explicit Flowing(const Nodes& nodes) : nodes_(nodes), speeds_(Nodes::Zero(2, nodes.cols())) {
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) speeds_.col(a) = speed(nodes.col(a));
  }
  static Vec<2> speed(const Vec<2>& x) { return {4 * x.y() * (1 - x.y()), 0}; }
  Eigen::Index coordinates() const override { return 3; }
  Eigen::VectorXd first() const override { return Eigen::VectorXd::Zero(1); }
  Nodes positions(const Eigen::VectorXd& placement) const override { return nodes_ + placement[0] * speeds_; }
  Eigen::MatrixXd basis(const Eigen::VectorXd&) const override {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(speeds_.size(), 3);
    all.col(0) = speeds_.reshaped();
    return all;
  }
  Eigen::VectorXd moved(const Eigen::VectorXd& placement, const Eigen::VectorXd& rate, double dt) const override {
    return placement + dt * rate.head<1>();
  }
  Isometry<2> pose(const Eigen::VectorXd&) const override { return Isometry<2>::Identity(); }

 private:
  Nodes nodes_, speeds_;
};

/// Of Poiseuille's flow around a body of fluid that it bends and carries along, with meshes of such elements.
double error_of_poiseuille(double size) {
  AleFlowSpec spec{.density = 1, .viscosity = 0.1, .min = {0, 0}, .max = {4, 1}};
  spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.inflow = [](const Vec<2>& x, double) { return Flowing::speed(x); };
  spec.start = spec.inflow;
  spec.far = 2.5 * size;
  spec.scheme.damped_steps = 0;
  spec.walls = {{.name = "body",
                 .surface = scenes::circle(0.2),
                 .pose = scenes::at(0.8, 0.4),
                 .velocity = Twist<2>(1, 0, 0),
                 .size = size}};
  spec.motions = {[](const Nodes& nodes) { return std::make_unique<Flowing>(nodes); }};
  AleFlow flow(spec);
  const Eigen::VectorXd rate = Twist<2>(1, 0, 0);
  const double dt = 0.05;
  double before = 0;
  int steps = 0;
  for (; steps < 14; ++steps) scenes::step(flow, dt, before, rate, Eigen::VectorXd::Constant(1, dt * (steps + 1)));
  EXPECT_GE(flow.remeshings(), 1);
  EXPECT_LT(std::abs(flow.ledger().energy_remesh), 1e-5 * flow.ledger().kinetic_energy);
  return scenes::error(flow.mesh(), flow.places(), flow.velocity(), Flowing::speed);
}

// Quadratic elements have the parabola itself but where hulls are curved.
TEST(AleRemesh, keeps_poiseuilles_flow_by_the_order_of_its_elements) {
  const double coarse = error_of_poiseuille(0.08), fine = error_of_poiseuille(0.04);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, coarse / 6) << coarse;
}

/// A cylinder moved along a channel of viscous fluid, one end of which is open.
AleFlowSpec channel(double viscosity, double size) {
  AleFlowSpec spec{.density = 1, .viscosity = viscosity, .min = {0, -2}, .max = {14, 2}};
  spec.sides = {BoundaryKind::no_slip, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.far = 5 * size;
  spec.growth = 0.2;
  spec.walls = {{.name = "body", .surface = scenes::circle(0.5), .pose = scenes::at(3, 0), .size = size}};
  return spec;
}

/// The greatest integral over the continuity equation's test functions of the velocity's divergence, over that of its size.
double divergence_of(const AleFlow& flow, const Nodes& places) {
  const FlowEquations equations(flow.mesh(), 1, 1, {});
  Unknowns at = Unknowns::Zero(equations.size());
  at.head(2 * flow.mesh().size()) = flow.velocity().reshaped();
  Eigen::VectorXd residual;
  const Nodes none = Nodes::Zero(2, flow.mesh().size());
  equations.residual({.x = places, .x_after = places, .before = none, .mesh_velocity = none}, at, residual);
  return residual.tail(flow.mesh().corners).cwiseAbs().maxCoeff();
}

// What is carried over fulfils the new mesh's equation of continuity where walls were at t_{n-1/2}.
TEST(AleRemesh, makes_velocities_free_of_divergence) {
  const double dt = 0.1;
  Carried body(channel(0.5, 0.2));
  for (int k = 0; k < 60 && body.flow.remeshings() == 0; ++k) body.step(dt, Twist<2>(1, 0, 0));
  ASSERT_EQ(body.flow.remeshings(), 1);
  Nodes d = Nodes::Zero(2, body.flow.mesh().size());
  for (const auto& edge : body.flow.mesh().boundary)
    for (const int a : edge.nodes)
      if (edge.wall >= 0) d(0, a) = -0.5 * dt;
  Extension(body.flow.mesh()).extend(d);
  EXPECT_LT(divergence_of(body.flow, body.flow.places() + d), 1e-13);
}

// In the frame of the cylinder fluid and walls come by at its speed. What is left of the start decays by
// exp(-pi^2 viscosity t/(4 height^2)) and faster.
TEST(AleRemesh, drag_is_that_of_a_frame_that_moves_along) {
  const double viscosity = 2, size = 0.15, dt = 0.1;
  auto frame = channel(viscosity, size);
  frame.walls[0].pose = scenes::at(7, 0);
  frame.sides = {BoundaryKind::outflow, BoundaryKind::inflow, BoundaryKind::inflow, BoundaryKind::inflow};
  frame.inflow = [](const Vec<2>&, double) { return Vec<2>(-1, 0); };
  frame.scheme = {.theta = 1, .is_steady = true};
  AleFlow steady(frame);
  double before = 0;
  scenes::step(steady, 1, before);
  const double drag = steady.loads()[0].physical[0];
  EXPECT_LT(drag, 0);

  Carried body(channel(viscosity, size));
  double last[2] = {0, 0}, spike = 0, worst = 0;
  bool is_new = false;
  for (int k = 0; k < 75; ++k) {
    const long count = body.flow.remeshings();
    body.step(dt, Twist<2>(1, 0, 0));
    const double now = body.flow.loads()[0].physical[0];
    if (k > 25) worst = std::max(worst, std::abs(now / drag - 1));
    if (k > 25 && is_new) spike = std::max(spike, std::abs((now - 2 * last[1] + last[0]) / drag));
    last[0] = last[1];
    last[1] = now;
    is_new = body.flow.remeshings() > count;
  }
  EXPECT_GE(body.flow.remeshings(), 4);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(spike, 0.002);
}

// A wall by its vertices, all of which move alike, is the rigid one, but for meshes that roundoff makes others.
TEST(AleRemesh, knows_walls_by_their_vertices) {
  auto spec = channel(2, 0.25);
  spec.walls[0].surface.vertices = spec.walls[0].pose * spec.walls[0].surface.vertices;
  spec.walls[0].pose = Isometry<2>::Identity();
  Carried rigid(spec);
  spec.walls[0].deforms = true;
  spec.motions = {deforming_wall(spec.walls[0].surface)};
  AleFlow flow(spec);
  const AtVertices<2> start = spec.walls[0].surface.vertices;
  AtVertices<2> velocity = AtVertices<2>::Zero(2, start.cols());
  velocity.row(0).setOnes();
  const double dt = 0.1;
  double before = 0;
  for (int k = 0; k < 40; ++k) {
    rigid.step(dt, Twist<2>(1, 0, 0));
    const AtVertices<2> now = start + (k + 1) * dt * velocity;
    scenes::step(flow, dt, before, velocity.reshaped(), now.reshaped());
    const double drag = rigid.flow.loads()[0].physical[0];
    EXPECT_NEAR(flow.loads()[0].physical[0], drag, 5e-4 * std::abs(drag));
  }
  EXPECT_GE(flow.remeshings(), 1);
  EXPECT_EQ(flow.remeshings(), rigid.flow.remeshings());
}

// A paddle: each half round is like the one before.
TEST(AleRemesh, a_body_turns_ten_rounds) {
  AleFlowSpec spec{.density = 1, .viscosity = 0.1, .min = {-1, -1}, .max = {1, 1}};
  spec.sides = {BoundaryKind::no_slip, BoundaryKind::no_slip, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.far = 0.8;
  spec.walls = {{.name = "paddle", .surface = scenes::box(1, 0.25), .size = 0.2}};
  Carried body(spec);
  constexpr int a_round = 28, rounds = 10;
  const double dt = 0.05, turn = 2 * pi / a_round / dt;
  double by_half[2] = {0, 0};
  for (int k = 0; k < rounds * a_round; ++k) {
    body.step(dt, Twist<2>(0, 0, turn));
    const int half = k / (a_round / 2) - (2 * rounds - 2);
    if (half >= 0) by_half[half] += body.flow.loads()[0].physical[2] / (a_round / 2);
  }
  EXPECT_LT(by_half[1], 0);
  EXPECT_NEAR(by_half[0] / by_half[1], 1, 0.02);
  EXPECT_GE(body.flow.remeshings(), rounds);
}

/// A body in a tall box, let go near its bottom or top.
scenes::FreeBody falling(double density) {
  return {.outline = scenes::box(0.8, 0.4),
          .area = 0.32,
          .polar = 0.32 * 0.8 / 12,
          .density = density,
          .angle = 0.4,
          .half = 2.5,
          .far = 0.8,
          .size = 0.25,
          .viscosity = 0.02};
}

// Some three lengths of its own: what appears from nowhere is as little as on a mesh that keeps its cells.
TEST(AleRemesh, keeps_the_balance_of_energy) {
  for (const double density : {0.3, 2.}) {
    auto made = scenes::coupled(falling(density));
    double most = 0, lost = 0;
    const auto unexplained = [&] {
      const auto& ledger = made.fluid->ledger();
      return ledger.kinetic_energy + ledger.potential_energy + ledger.work_on_walls - ledger.work_of_effects;
    };
    const double from = unexplained();
    while (std::abs(made.bodies->state(0).pose.translation().y()) < 1.5) {
      made.step(0.05);
      most = std::max(most, unexplained() - from - lost);
      lost = std::min(lost, unexplained() - from);
    }
    const auto& ledger = made.fluid->ledger();
    EXPECT_GE(made.fluid->remeshings(), 1) << density;
    EXPECT_LT(most, 0.02 * std::abs(ledger.work_on_walls)) << density;
    EXPECT_LT(std::abs(ledger.energy_remesh), 0.002 * std::abs(ledger.work_on_walls)) << density;
  }
}

std::string saved(const coupling::Coupled& stepper) {
  std::ostringstream out;
  stepper.save(out);
  return out.str();
}

// Stored before and after a new mesh, loaded where there is the same one, another one or none.
TEST(AleRemesh, goes_on_from_what_was_saved_with_the_same_bits) {
  auto straight = scenes::coupled(falling(0.3)), resumed = scenes::coupled(falling(0.3));
  const auto step = [](auto& made) { made.step(0.08); };
  std::vector<std::string> states;
  while (straight.fluid->remeshings() == 0) {
    states.push_back(saved(*straight.stepper));
    step(straight);
  }
  states.push_back(saved(*straight.stepper));
  for (int k = 0; k < 3; ++k) step(straight);
  const std::string end = saved(*straight.stepper);
  const auto count = static_cast<int>(states.size());
  for (const int back : {1, 3, 1}) {
    std::istringstream in(states[static_cast<std::size_t>(count - back)]);
    resumed.stepper->load(in);
    EXPECT_EQ(resumed.fluid->remeshings(), back == 1 ? 1 : 0);
    for (int k = 0; k < 3 + back - 1; ++k) step(resumed);
    EXPECT_EQ(saved(*resumed.stepper), end);
  }
}

// Random bodies on random ways, which come near the sides: a step that is refused is taken in halves, as in a run.
TEST(AleRemesh, bears_random_bodies_on_random_ways) {
  std::mt19937 random(11);
  const auto within = [&](double least, double most) { return std::uniform_real_distribution<>(least, most)(random); };
  for (int n = 0; n < 3; ++n) {
    AleFlowSpec spec{.density = 1, .viscosity = within(0.05, 1), .min = {-1.5, -1.5}, .max = {1.5, 1.5}};
    spec.sides = {BoundaryKind::no_slip, BoundaryKind::outflow, BoundaryKind::slip, BoundaryKind::no_slip};
    spec.far = 0.6;
    spec.corner = within(0.5, 1);
    spec.walls = {{.name = "body",
                   .surface = n % 2 == 0 ? random_polygon(0.35, random) : ellipse(within(0.1, 0.4), within(0.1, 0.3)),
                   .pose = scenes::at(0, 0.9 * std::sin(1)),
                   .size = 0.15}};
    Carried body(spec);
    const double across = within(1, 2), up = within(1, 2), turn = within(-2, 2);
    int refused = 0;
    double dt = 0.05;
    while (body.flow.time() < 1.2) {
      const double t = body.flow.time() + 0.5 * dt;
      const Twist<2> twist(0.9 * across * std::cos(across * t), 0.9 * up * std::cos(up * t + 1), turn);
      const bool is_taken = body.tried(dt, twist);
      refused += is_taken ? 0 : 1;
      dt = is_taken ? std::min(0.05, 1.5 * dt) : 0.5 * dt;
      ASSERT_GT(dt, 1e-3) << n << " " << t;
      ASSERT_TRUE(body.flow.loads()[0].physical.allFinite());
      ASSERT_GT(body.flow.diagnostics()[1].second, 0) << n << " " << t;
    }
    EXPECT_GE(body.flow.remeshings(), 1) << n;
    EXPECT_LE(refused, 3) << n;
  }
}

}  // namespace
}  // namespace splashdown::ale::remesh_test
