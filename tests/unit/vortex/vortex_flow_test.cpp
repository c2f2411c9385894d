// Flows without bodies against exact ones.
#include <gtest/gtest.h>

#include <sstream>

#include "shapes.hpp"

namespace splashdown::vortex::vortex_flow_test {
namespace {

using scenes::LambOseen;

/// A fluid without walls, stepped with constant dt to a time, the first step half as long as leapfrog has it.
GridFlow after(GridFlowSpec spec, double end, int steps) {
  GridFlow fluid(std::move(spec));
  double before = 0;
  for (int k = 0; k < steps; ++k) {
    const double dt = end / steps;
    EXPECT_EQ(fluid.begin(0.5 * (before + dt), dt, {}).cause, "");
    fluid.solve({});
    fluid.commit({});
    before = dt;
  }
  return fluid;
}

constexpr double core = 0.12, end = 0.2, nu = 2e-3;

/// Largest error of the velocity of a vortex of circulation 1 that has diffused; n squares across.
double error_of_vortex(int n, Remeshing kernel, int order, const Vec<2>& stream) {
  GridFlowSpec spec;
  spec.density = 1;
  spec.viscosity = nu;
  spec.grid = scenes::square_grid(n);
  spec.remeshing = kernel;
  spec.diffusion_order = order;
  const Vec<2> start(-0.1, 0.05);
  const LambOseen young{1, core};
  spec.vorticity = scenes::sampled(spec.grid, [&](const Vec<2>& x) { return young.omega(x - start); });
  if (!stream.isZero()) spec.stream = [stream](double) { return stream; };
  const int steps = n / 2;
  const auto fluid = after(spec, end, steps);
  const double half = end - 0.5 * end / steps;  // what is known is of the half step before
  const LambOseen old{1, std::sqrt(core * core + 4 * nu * half)};
  double error = 0;
  for (std::size_t k = 0; k < fluid.points().size(); ++k) {
    const Vec<2> x = fluid.points()[k] - start - half * stream;
    if (x.norm() < 0.6) error = std::max(error, (fluid.velocity_n(k) - stream - old.velocity(x)).norm());
  }
  EXPECT_NEAR(fluid.diagnostics()[0].second, scenes::circulation(spec.grid, spec.vorticity), 1e-12 * steps);
  return error;
}

TEST(VortexFlow, a_vortex_diffuses_and_drifts_with_second_order) {
  for (const auto kernel : {Remeshing::m4, Remeshing::m6}) {
    const Vec<2> stream(0.3, 0.2);
    const double middle = error_of_vortex(96, kernel, 2, stream), fine = error_of_vortex(192, kernel, 2, stream);
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.2);
  }
}

// Taylor & Green 1937 between walls without friction: vorticity is a function of psi, convection does nothing.
TEST(VortexFlow, taylor_and_greens_cells_decay) {
  const int n = 64;
  GridFlowSpec spec;
  spec.density = 1;
  spec.viscosity = 5e-3;
  spec.grid = {.min = {0, 0}, .h = 1. / n, .nx = n, .ny = n};
  spec.sides = SideKind::slip;
  const double k = 2 * std::numbers::pi;
  spec.vorticity =
      scenes::sampled(spec.grid, [&](const Vec<2>& x) { return std::sin(k * x.x()) * std::sin(k * x.y()); });
  const int steps = 40;
  const double last = 1;
  const auto fluid = after(spec, last, steps);
  const double decay = std::exp(-2 * spec.viscosity * k * k * (last - 0.5 * last / steps));
  // Squares of h k / 12 in the decay, and in what remeshing spreads.
  const double energy = 0.5 * decay * decay / (8 * k * k) * 1.0;
  EXPECT_NEAR(fluid.ledger().kinetic_energy, energy, 0.01 * energy);
}

/// Two Gaussian vortices of opposite sense: their impulse is kept where no wall is near, their pair moves at about Gamma/(2 pi b).
TEST(VortexFlow, a_pair_moves_at_its_own_speed_and_keeps_its_impulse) {
  GridFlowSpec spec;
  spec.density = 1;
  spec.viscosity = 0;
  spec.grid = scenes::square_grid(160);
  const double gamma = 0.5, b = 0.5;
  const LambOseen one{gamma, 0.08};
  spec.vorticity = scenes::sampled(spec.grid, [&](const Vec<2>& x) {
    return one.omega(x - Vec<2>(-0.3, b / 2)) - one.omega(x - Vec<2>(-0.3, -b / 2));
  });
  const auto moments = [&](const GridFlow& fluid) {  // impulse along x; place of the pair
    double impulse = 0, upper = 0, place = 0;
    const auto& g = spec.grid;
    for (std::size_t k = 0; k < g.nodes(); ++k) {
      const Vec<2> x = fluid.points()[k];
      const double w = fluid.vorticity()[k];
      impulse += w * x.y() * g.h * g.h;
      if (w > 0) upper += w, place += w * x.x();
    }
    return std::pair(impulse, place / upper);
  };
  const int steps = 200;
  const double time = 2;
  const auto begin = moments(GridFlow(spec)), last = moments(after(spec, time, steps));
  // The kernel keeps second moments; what paths add to an impulse is of second order, a hundredth of h^2 a step.
  EXPECT_NEAR(last.first, begin.first, 2e-3 * begin.first);
  const double moved = time - 0.5 * time / steps, speed = gamma / (2 * std::numbers::pi * b);
  EXPECT_NEAR((last.second - begin.second) / moved, speed,
              0.02 * speed);  // cores of a third of the distance drift a little
}

// Vortices of a wake that leaves lose their say little by little: the velocity at the body does not jump, and far before the side
// the curl of velocities is all of the vorticity.
TEST(VortexFlow, a_wake_fades_before_it_leaves) {
  GridFlowSpec spec;
  spec.density = 1;
  spec.grid = scenes::square_grid(128, 4);
  spec.stream = [](double) { return Vec<2>(1, 0); };
  WallSpec<2> wall;
  wall.name = "small";
  wall.surface = scenes::circle(0.1, 40);
  wall.pose.translation() = Vec<2>(-2, 0);
  spec.walls = {wall};
  const auto at_body = [&](double x) {  // across the stream, of a vortex there
    const LambOseen vortex{1, 0.3};
    spec.vorticity = scenes::sampled(spec.grid, [&](const Vec<2>& at) { return vortex.omega(at - Vec<2>(x, 0)); });
    const GridFlow fluid(spec);
    return fluid.velocity_n(spec.grid.at(32, 70)).y();
  };
  const double exact = -2.5 / (2 * std::numbers::pi * (2.5 * 2.5 + 0.375 * 0.375));
  EXPECT_NEAR(at_body(0.5), exact, 0.01 * std::abs(exact));
  EXPECT_NEAR(at_body(4), 0, 0.01 * std::abs(exact));
  EXPECT_LT(std::abs(at_body(3)), std::abs(at_body(2)));
}

TEST(VortexFlow, goes_on_from_what_was_saved_with_the_same_bits) {
  GridFlowSpec spec;
  spec.density = 1;
  spec.viscosity = 1e-3;
  spec.grid = scenes::square_grid(64);
  spec.stream = [](double) { return Vec<2>(1, 0); };
  WallSpec<2> wall;
  wall.name = "cylinder";
  wall.surface = scenes::circle(0.2, 60);
  spec.walls = {wall};
  const auto saved = [](const GridFlow& fluid) {
    std::ostringstream out;
    fluid.save(out);
    return out.str();
  };
  const auto step = [](GridFlow& fluid, double before) {
    EXPECT_EQ(fluid.begin(0.5 * (before + 0.01), 0.01, {}).cause, "");
    fluid.solve({});
    const Isometry<2> pose = fluid.wall_poses()[0];
    fluid.commit({&pose, 1});
  };
  GridFlow straight(spec), resumed(spec);
  for (int k = 0; k < 5; ++k) step(straight, k == 0 ? 0 : 0.01);
  const auto state = saved(straight);
  std::istringstream in(state);
  resumed.load(in);
  EXPECT_EQ(saved(resumed), state);
  for (int k = 0; k < 3; ++k) {
    step(straight, 0.01);
    step(resumed, 0.01);
  }
  EXPECT_EQ(saved(resumed), saved(straight));
  std::istringstream half(state.substr(0, state.size() / 2));
  EXPECT_THROW(resumed.load(half), std::runtime_error);
}

}  // namespace
}  // namespace splashdown::vortex::vortex_flow_test
