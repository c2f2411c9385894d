// What the exact rigid term costs: the pressure part of a step with one free body in the pressure equation, over that
// with the same body held. A circle under water, 10 000 nodes. One thread, medians of processor time over interleaved
// repetitions.
//   rigid_term_cost [--max_ratio=R] [--benchmark_...]     exit 1 if the free body costs more than R of the held one
#include <cstdio>

#include "tests/benchmark/medians.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace {

using namespace splashdown;
namespace scenes = coupling::scenes;

constexpr int nodes = 10000;
constexpr double dt = 1e-3;

std::unique_ptr<coupling::scenes::Watched<2>> circle(bool free) {
  const double h = std::sqrt(5.0 * 3.0 / nodes) * 0.96;  // what fills the tank with so many
  auto scene = scenes::submerged_circle(1.0 / 3, h);
  scene.fluid.size = {.surface = h, .far = h};
  // The first steps are made with the body held, so that both cases have the same mesh, as irregular as in any run.
  scene.bodies[0].free.fill(false);
  const auto held = scenes::coupled(scene);
  for (int k = 0; k < 5; ++k) {
    if (!held->attempt(dt).ok()) std::abort();
    held->commit();
  }
  std::stringstream state(scenes::saved(*held));
  scene.bodies[0].free.fill(free);
  auto made = scenes::coupled(scene);
  made->load(state);
  if (!made->attempt(dt).ok()) std::abort();
  return made;
}

// A step that is tried again keeps its mesh: what is left is to assemble and to factor the pressure equation, and the
// solves of one pass.
void pressure_part(benchmark::State& state, coupling::Stepper& stepper) {
  for (auto _ : state)
    if (const auto report = stepper.attempt(dt); !report.ok() || report.passes != 1) state.SkipWithError("refused");
}

}  // namespace

int main(int argc, char** argv) {
  double max_ratio = 0;
  if (!measured::begin(argc, argv, max_ratio)) return 2;
  const auto held = circle(false), free = circle(true);
  measured::add("held", nodes, [&](benchmark::State& state) { pressure_part(state, *held); });
  measured::add("free", nodes, [&](benchmark::State& state) { pressure_part(state, *free); });
  measured::Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  const double ratio = medians.of("free", nodes) / medians.of("held", nodes);
  std::printf("%zu nodes: pressure part of a step, body free / body held = %.3f\n", held->fluid().nodes().size(),
              ratio);
  return ratio > max_ratio ? 1 : 0;
}
