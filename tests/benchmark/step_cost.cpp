// What a step costs, beside what no step can do without: one Delaunay triangulation of the nodes and one
// Cholesky solve (analyse, factor, solve) of their Laplacian. One thread: medians of processor time over
// interleaved repetitions.
//   step_cost [--max_ratio=R] [--benchmark_...]     exit 1 if a step without effects costs more than R of both
#include <benchmark/benchmark.h>
#include <cblas.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "coupling/steppers.hpp"
#include "fluid/delaunay.hpp"
#include "fluid/pressure.hpp"

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
coupling::FluidOnly<2> basin(int nodes, std::vector<std::unique_ptr<fluid::Term<2>>> terms) {
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
  return coupling::FluidOnly<2>(std::make_unique<fluid::Fluid<2>>(std::move(spec), std::move(terms)));
}

void step(coupling::FluidOnly<2>& stepper) {
  if (!stepper.attempt(stepper.stable_dt()).ok()) std::abort();
  stepper.commit();
}

coupling::FluidOnly<2>& moving(int nodes, bool with_gravity) {
  static std::map<std::pair<int, bool>, coupling::FluidOnly<2>> cases;
  const auto found = cases.find({nodes, with_gravity});
  if (found != cases.end()) return found->second;
  std::vector<std::unique_ptr<fluid::Term<2>>> terms;
  if (with_gravity) terms.push_back(std::make_unique<fluid::Gravity<2>>(Vec<2>(0, -9.81)));
  auto& made = cases.emplace(std::pair{nodes, with_gravity}, basin(nodes, std::move(terms))).first->second;
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
  const std::vector<Vec<2>> centres(1, Vec<2>::Zero());
  const std::vector<fluid::WallResponse<2>> held(1);
  fluid::PressureEquation<2> equation;
  equation.build(f.nodes(), f.mesh(), f.spec().density, centres, held);
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

class Medians : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const auto& run : runs)
      if (run.aggregate_name == "median") seconds_[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }
  double of(const std::string& name, int nodes) const {
    const auto found = seconds_.find(name + "/" + std::to_string(nodes));
    return found == seconds_.end() ? std::nan("") : found->second;
  }

 private:
  std::map<std::string, double> seconds_;  // in the benchmarks' unit
};

double take_max_ratio(int& argc, char** argv) {
  const std::string key = "--max_ratio=";
  double value = INFINITY;
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    if (std::string(argv[i]).starts_with(key))
      value = std::atof(argv[i] + key.size());
    else
      argv[kept++] = argv[i];
  }
  argc = kept;
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  openblas_set_num_threads(1);
  const double max_ratio = take_max_ratio(argc, argv);
  std::vector<char*> arguments(argv, argv + argc);
  char interleave[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  const int sizes[] = {10000, 100000};
  for (const int nodes : sizes) {
    const auto add = [nodes](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((name + "/" + std::to_string(nodes)).c_str(), run)
          ->Unit(benchmark::kMillisecond)
          ->Repetitions(9)
          ->ReportAggregatesOnly();
    };
    add("delaunay", [nodes](benchmark::State& state) { triangulate(state, nodes); });
    add("cholesky", [nodes](benchmark::State& state) { solve_laplacian(state, nodes); });
    add("step", [nodes](benchmark::State& state) { whole_step(state, nodes, false); });
    add("step_with_gravity", [nodes](benchmark::State& state) { whole_step(state, nodes, true); });
  }
  Medians medians;
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
