// What a step in space costs, beside what no step can do without: one Delaunay triangulation of the nodes and one pressure
// solve (multigrid's setup, solve to the pressure's own tolerance); and what a second thread gains. Wall time, medians of
// interleaved repetitions. A tank of still water with a ball that sinks into it at constant speed.
//   step_cost_3d [NODES]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "fluid/delaunay.hpp"
#include "fluid/parallel.hpp"
#include "fluid/pressure.hpp"
#include "tests/unit/coupling/ball_in_tank.hpp"

namespace {

using namespace splashdown;
namespace scenes = coupling::scenes;
using fluid::Vec;

coupling::Simultaneous<3> sinking_ball(int nodes) {
  constexpr double half = scenes::BallInTank::half;
  // 2 half x 2 half x half of water with elements of h holds about 1.6 (2 half)^3 / 2 h^3 nodes.
  const double size = std::cbrt(1.6 * 4 * half * half * half / nodes);
  auto scene = scenes::ball_in_tank(1, 0, 1, size, size);
  scene.fluid.step = {.cfl = 0.5, .dt_max = 1e-2};
  scene.ball.motion = rigid::Motion::prescribed;
  scene.ball.path = [](double time) {
    rigid::Isometry<3> pose = rigid::Isometry<3>::Identity();
    pose.translation().z() = -time;
    return pose;
  };
  return {scenes::water_of(scene), scenes::bodies_of(scene)};
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void step(coupling::Simultaneous<3>& stepper) {
  if (!stepper.attempt(stepper.stable_dt()).ok()) std::abort();
  stepper.commit();
}

void triangulate(const fluid::Fluid<3>& water) {
  volatile std::size_t cells = fluid::delaunay<3>(water.nodes().x, {}).cells.size();
  static_cast<void>(cells);
}

}  // namespace

int main(int argc, char** argv) {
  const int nodes = argc > 1 ? std::atoi(argv[1]) : 100000;
  constexpr int repetitions = 5;
  auto stepper = sinking_ball(nodes);
  step(stepper), step(stepper);
  const auto& water = stepper.fluid();
  const std::vector<Vec<3>> centres(2, Vec<3>::Zero());
  fluid::PressureEquation<3> equation;
  equation.build(water.nodes(), water.mesh(), water.spec().density, centres, {});
  std::vector<double> rhs(static_cast<std::size_t>(equation.size()));
  for (int i = 0; i < equation.size(); ++i) rhs[static_cast<std::size_t>(i)] = std::sin(0.01 * i);

  std::vector<double> delaunay, solve, one, two;
  for (int k = 0; k < repetitions; ++k) {
    fluid::use_threads(2);
    delaunay.push_back(seconds([&] { triangulate(water); }));
    solve.push_back(seconds([&] {
      fluid::LinearSolver solver(0);
      auto x = rhs;
      if (!solver.factor(equation.matrix()) || !solver.solve(x, 1, 1e-4)) std::abort();
    }));
    two.push_back(seconds([&] { step(stepper); }));
    fluid::use_threads(1);
    one.push_back(seconds([&] { step(stepper); }));
  }
  const double bare = median(delaunay) + median(solve);
  std::printf("%zu nodes: Delaunay %.3f s, pressure solve %.3f s, step %.3f s on two threads (%.1f us a node), %.3f s on one\n",
              water.nodes().size(), median(delaunay), median(solve), median(two),
              1e6 * median(two) / static_cast<double>(water.nodes().size()), median(one));
  std::printf("step / (Delaunay + pressure solve) = %.2f, one thread / two = %.2f\n", median(two) / bare,
              median(one) / median(two));
}
