// What a step in space costs, beside what no step can do without: one Delaunay triangulation of the nodes and one pressure
// solve (multigrid's setup, solve to the pressure's own tolerance); what a second thread gains; and what a direct solve of
// the same matrix would cost. Wall time, medians over interleaved repetitions. A tank of still water with a ball that
// sinks into it at constant speed.
//   step_cost_3d [--max_ratio=R] [--benchmark_...]     exit 1 if a step on two threads costs more than R of both
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <numeric>

#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/pressure/pressure.hpp"
#include "tests/benchmark/medians.hpp"
#include "tests/unit/coupling/ball_in_tank.hpp"

namespace {

using namespace splashdown;
namespace scenes = coupling::scenes;
using fluid::Vec;
using Stepper = coupling::scenes::Watched<3>;

Stepper sinking_ball(int nodes) {
  constexpr double half = scenes::BallInTank::half;
  // 2 half x 2 half x half of water with elements of h holds about 1.6 (2 half)^3 / 2 h^3 nodes.
  const double size = std::cbrt(1.6 * 4 * half * half * half / nodes);
  auto scene = scenes::ball_in_tank(1, 0, 1, size, size);
  scene.fluid.step = {.cfl = 0.5, .dt_max = 1e-2};
  scene.ball.motion = BodyMotion::prescribed;
  scene.ball.path = [](double time) {
    rigid::Isometry<3> pose = rigid::Isometry<3>::Identity();
    pose.translation().z() = -time;
    return pose;
  };
  return {scenes::water_of(scene), scenes::bodies_of(scene)};
}

void attempt(Stepper& stepper) {
  if (const auto status = stepper.attempt(stepper.stable_dt()); !status.ok()) {
    std::fprintf(stderr, "a step was refused: %s\n", status.cause.c_str());
    std::exit(1);
  }
}

// Steps are made once for all that is measured, and one more is under way: its nodes and mesh are those of a step.
Stepper& moving(int nodes) {
  static std::map<int, Stepper> cases;
  const auto found = cases.find(nodes);
  if (found != cases.end()) return found->second;
  Stepper& made = cases.emplace(nodes, sinking_ball(nodes)).first->second;
  for (int k = 0; k < 3; ++k) {
    if (k > 0) made.commit();
    attempt(made);
  }
  return made;
}

void step(benchmark::State& state, int nodes, int threads) {
  Stepper& stepper = moving(nodes);
  fluid::use_threads(threads);
  for (auto _ : state) {
    stepper.commit();
    attempt(stepper);
  }
  state.counters["nodes"] = static_cast<double>(stepper.fluid().nodes().size());
}

void triangulate(benchmark::State& state, int nodes) {
  const auto& x = moving(nodes).fluid().nodes().x;
  fluid::use_threads(2);
  for (auto _ : state) benchmark::DoNotOptimize(fluid::delaunay<3>(x, {}));
}

// The triangulation of nodes that move to and fro by a step.
void follow(benchmark::State& state, int nodes) {
  const Stepper& stepper = moving(nodes);
  const auto& water = stepper.fluid().nodes();
  std::vector<int> numbers(water.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const double dt = stepper.stable_dt();
  auto there = water.x;
  for (std::size_t i = 0; i < there.size(); ++i) there[i] += dt * water.v[i];
  fluid::MovingDelaunay<3> triangulation;
  triangulation.follow(water.x, numbers, {});
  fluid::use_threads(2);
  bool away = false;
  for (auto _ : state) {
    away = !away;
    benchmark::DoNotOptimize(triangulation.follow(away ? there : water.x, numbers, {}));
  }
}

void solve(benchmark::State& state, int nodes, int largest_direct, double tolerance) {
  const auto& water = moving(nodes).fluid();
  const std::vector<fluid::WallPlace<3>> places(2);
  fluid::PressureEquation<3> equation;
  equation.build(water.nodes(), water.mesh(), water.spec().density, places, fluid::WallLayout<3>::rigid(2), {});
  std::vector<double> rhs(static_cast<std::size_t>(equation.size()));
  for (int i = 0; i < equation.size(); ++i) rhs[static_cast<std::size_t>(i)] = std::sin(0.01 * i);
  fluid::use_threads(2);
  for (auto _ : state) {
    fluid::LinearSolver solver(largest_direct);
    auto x = rhs;
    if (!solver.factor(equation.matrix()) || !solver.solve(x, 1, tolerance)) state.SkipWithError("not solved");
  }
  state.counters["unknowns"] = equation.size();
}

}  // namespace

int main(int argc, char** argv) {
  double max_ratio = 0;
  if (!measured::begin(argc, argv, max_ratio)) return 2;
  constexpr int sizes[] = {20000, 100000};
  constexpr int all = std::numeric_limits<int>::max(), most_factored = 20000;  // more takes minutes and gigabytes
  constexpr double closely = 1e-4;
  for (const int nodes : sizes) {
    auto in_wall_time = [&](const char* name, auto run) { measured::add(name, nodes, run)->UseRealTime(); };
    in_wall_time("delaunay", [=](benchmark::State& state) { triangulate(state, nodes); });
    in_wall_time("follow", [=](benchmark::State& state) { follow(state, nodes); });
    in_wall_time("multigrid", [=](benchmark::State& state) { solve(state, nodes, 0, closely); });
    if (nodes <= most_factored)
      in_wall_time("cholesky", [=](benchmark::State& state) { solve(state, nodes, all, closely); });
    in_wall_time("step_on_1_thread", [=](benchmark::State& state) { step(state, nodes, 1); });
    in_wall_time("step_on_2_threads", [=](benchmark::State& state) { step(state, nodes, 2); });
  }
  measured::Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);

  bool holds = true;
  for (const int nodes : sizes) {
    const double bare = medians.of("delaunay", nodes) + medians.of("multigrid", nodes);
    const double two = medians.of("step_on_2_threads", nodes), ratio = two / bare;
    if (std::isnan(ratio)) continue;  // filtered out
    std::printf(
        "%d nodes: step / (Delaunay + multigrid) = %.2f, one thread / two = %.2f, %.1f us a node on two, "
        "Delaunay that follows / from nothing = %.2f\n",
        nodes, ratio, medians.of("step_on_1_thread", nodes) / two, 1e3 * two / nodes,
        medians.of("follow", nodes) / medians.of("delaunay", nodes));
    holds = holds && !(ratio > max_ratio);
  }
  return holds ? 0 : 1;
}
