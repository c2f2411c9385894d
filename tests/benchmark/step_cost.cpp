// What a step costs, beside what no step can do without: one Delaunay triangulation of the nodes and one
// Cholesky solve (analyse, factor, solve) of their Laplacian. One thread: medians of processor time over
// interleaved repetitions.
//   step_cost [--max_ratio=R] [--benchmark_...]     exit 1 if a step without effects costs more than R of both
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>

#include "fluid/effects/gravity/gravity.hpp"
#include "fluid/pfem/mesh/delaunay/delaunay.hpp"
#include "fluid/pfem/pressure/pressure.hpp"
#include "tests/benchmark/medians.hpp"
#include "tests/unit/coupling/watched.hpp"

namespace {

using namespace splashdown;
using fluid::Vec;

fluid::Surface<2> box(const Vec<2>& low, const Vec<2>& high, bool clockwise) {
  fluid::Surface<2> s;
  s.vertices.resize(2, 4);
  s.vertices << low.x(), high.x(), high.x(), low.x(), low.y(), low.y(), high.y(), high.y();
  if (clockwise) s.vertices = s.vertices.rowwise().reverse().eval();
  s.facets.resize(2, 4);
  s.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  return s;
}

// A basin twice as long as deep with about `nodes` nodes and the velocity of a sloshing mode: after some steps
// the mesh is as irregular as in any run, and a few nodes come and go.
coupling::scenes::Watched<2> basin(int nodes, std::vector<std::unique_ptr<fluid::Effect<2>>> effects) {
  const double size = std::sqrt(2.0 / nodes) * 0.97;  // what fills the basin with so many
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = size, .far = size};
  spec.step = {.cfl = 0.5, .dt_max = 1e-3};
  fluid::WallSpec<2> tank;
  tank.name = "tank";
  tank.surface = box({-1, -1}, {1, 1}, true);
  tank.size = size;
  spec.walls.push_back(tank);
  fluid::LiquidSpec<2> water;
  water.boundary = box({-1, -1}, {1, 0}, false);
  const double k = std::numbers::pi;
  water.velocity = [k](const Vec<2>& x) -> Vec<2> {
    return 0.1 / std::sinh(k) *
           Vec<2>(std::sin(k * x.x()) * std::cosh(k * (x.y() + 1)), -std::cos(k * x.x()) * std::sinh(k * (x.y() + 1)));
  };
  spec.liquids.push_back(water);
  return coupling::scenes::Watched<2>(std::make_unique<fluid::Fluid<2>>(std::move(spec), std::move(effects)));
}

void step(coupling::scenes::Watched<2>& stepper) {
  if (!stepper.attempt(stepper.stable_dt()).ok()) std::abort();
  stepper.commit();
}

coupling::scenes::Watched<2>& moving(int nodes, bool with_gravity) {
  static std::map<std::pair<int, bool>, coupling::scenes::Watched<2>> cases;
  const auto found = cases.find({nodes, with_gravity});
  if (found != cases.end()) return found->second;
  std::vector<std::unique_ptr<fluid::Effect<2>>> effects;
  if (with_gravity) effects.push_back(std::make_unique<fluid::Gravity<2>>(Vec<2>(0, -9.81)));
  auto& made = cases.emplace(std::pair{nodes, with_gravity}, basin(nodes, std::move(effects))).first->second;
  for (int k = 0; k < 10; ++k) step(made);
  return made;
}

void triangulate(benchmark::State& state, int nodes) {
  const auto& x = moving(nodes, false).fluid().nodes().x;
  for (auto _ : state) benchmark::DoNotOptimize(fluid::delaunay<2>(x, {}));
  state.counters["nodes"] = static_cast<double>(x.size());
}

void solve_laplacian(benchmark::State& state, int nodes) {
  const auto& f = moving(nodes, false).fluid();
  const std::vector<fluid::WallPlace<2>> places(1);
  fluid::PressureEquation<2> equation;
  equation.build(f.nodes(), f.mesh(), f.spec().density, places, fluid::WallLayout<2>::rigid(1), {});
  fluid::LinearSolver solver;
  std::vector<double> rhs(static_cast<std::size_t>(equation.size()), 1.0);
  for (auto _ : state)
    if (!solver.factor(equation.matrix()) || !solver.solve(rhs)) state.SkipWithError("not positive definite");
  state.counters["unknowns"] = equation.size();
}

void whole_step(benchmark::State& state, int nodes, bool with_gravity) {
  auto& stepper = moving(nodes, with_gravity);
  for (auto _ : state) step(stepper);
  state.counters["nodes"] = static_cast<double>(stepper.fluid().nodes().size());
}

}  // namespace

int main(int argc, char** argv) {
  double max_ratio = 0;
  if (!measured::begin(argc, argv, max_ratio)) return 2;
  const int sizes[] = {10000, 100000};
  for (const int nodes : sizes) {
    measured::add("delaunay", nodes, [nodes](benchmark::State& state) { triangulate(state, nodes); });
    measured::add("cholesky", nodes, [nodes](benchmark::State& state) { solve_laplacian(state, nodes); });
    measured::add("step", nodes, [nodes](benchmark::State& state) { whole_step(state, nodes, false); });
    measured::add("step_with_gravity", nodes, [nodes](benchmark::State& state) { whole_step(state, nodes, true); });
  }
  measured::Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);

  bool holds = true;
  for (const int nodes : sizes) {
    const double bare = medians.of("delaunay", nodes) + medians.of("cholesky", nodes);
    const double ratio = medians.of("step", nodes) / bare;
    std::printf("%d nodes: step / (Delaunay + Cholesky) = %.2f, with gravity %.2f\n", nodes, ratio,
                medians.of("step_with_gravity", nodes) / bare);
    holds = holds && !(ratio > max_ratio);
  }
  return holds ? 0 : 1;
}
