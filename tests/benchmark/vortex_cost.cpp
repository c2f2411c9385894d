// What a step of the fluid on a grid costs, and its parts: a cylinder of 64 squares in a stream, its wake young, on 1024 x
// 1024 squares. Beside them a transform of Fourier's of that grid and back (real numbers, FFTW). One thread, medians of
// processor time over interleaved repetitions.
//   vortex_cost [--max_ratio=NS] [--benchmark_...]     exit 1 if a step costs more than NS nanoseconds a square
#include <fftw3.h>

#include <cstdio>

#include "core/parallel.hpp"
#include "tests/benchmark/medians.hpp"
#include "tests/unit/vortex/shapes.hpp"

namespace {

using namespace splashdown;

constexpr int n = 1024;
constexpr double squares = static_cast<double>(n) * n;

vortex::GridFlowSpec spec() {
  vortex::GridFlowSpec spec;
  spec.density = 1;
  spec.viscosity = 1e-3;
  spec.remeshing = vortex::Remeshing::m6;  // as scenes have it
  spec.diffusion_order = 4;
  spec.grid = vortex::scenes::square_grid(n, 8);
  // Everywhere, so that no row is passed over.
  spec.vorticity = vortex::scenes::sampled(
      spec.grid, [](const Vec<2>& x) { return 0.01 * std::sin(3 * x.x()) * std::sin(2 * x.y() + 1); });
  spec.stream = [](double) { return Vec<2>(1, 0); };
  WallSpec<2> wall;
  wall.name = "cylinder";
  wall.surface = vortex::scenes::circle(0.5);
  wall.pose.translation() = Vec<2>(-4, 0);
  spec.walls = {wall};
  return spec;
}

/// Steps of the flow, which goes on.
struct Steps {
  vortex::GridFlow fluid{spec()};
  double before = 0;
  void make() {
    const double dt = 0.5 * fluid.stable_dt();
    if (!fluid.begin(0.5 * (before + dt), dt, {}).ok()) std::abort();
    fluid.solve({});
    const Isometry<2> pose = fluid.wall_poses()[0];
    fluid.commit({&pose, 1});
    before = dt;
  }
};

/// Real numbers of the grid to their spectrum and back.
class Transforms {
 public:
  Transforms() : data_(fftw_alloc_real(static_cast<std::size_t>(n) * (n + 2))) {
    auto* spectrum = reinterpret_cast<fftw_complex*>(data_);
    forward_ = fftw_plan_dft_r2c_2d(n, n, data_, spectrum, FFTW_MEASURE);
    back_ = fftw_plan_dft_c2r_2d(n, n, spectrum, data_, FFTW_MEASURE);
    std::fill_n(data_, static_cast<std::size_t>(n) * (n + 2), 0.0);
  }
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;
  ~Transforms() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(back_);
    fftw_free(data_);
  }
  void make() {
    fftw_execute(forward_);
    fftw_execute(back_);
  }

 private:
  double* data_;
  fftw_plan forward_, back_;
};

template <class Run>
void part(const char* name, Run run) {
  splashdown::measured::add(name, n, [run](benchmark::State& state) {
    for (auto _ : state) run();
  });
}

}  // namespace

int main(int argc, char** argv) {
  double most = 0;
  if (!measured::begin(argc, argv, most)) return 2;
  use_threads(1);
  Steps steps;
  for (int k = 0; k < 20; ++k) steps.make();
  Transforms transforms;
  const auto made = steps.fluid.spec();
  vortex::Advection advection(made.grid, made.remeshing, made.paths);
  vortex::Diffusion diffusion(made.grid, made.diffusion_order);
  vortex::StreamFunction poisson(made.grid, made.sides);
  auto omega = steps.fluid.vorticity();
  vortex::NodeField moved;
  vortex::NodeField psi;
  vortex::FaceField velocity;
  poisson.solve(omega, psi);
  velocities_of(made.grid, psi, {1, 0}, velocity);
  part("step", [&] { steps.make(); });
  part("advection", [&] { advection.move(omega, {velocity, velocity, 0.5}, 1e-6, moved); });
  part("diffusion", [&] { diffusion.apply(omega, 0.1 * made.grid.h * made.grid.h, 0); });
  part("poisson", [&] { poisson.solve(omega, psi); });
  part("velocities", [&] { velocities_of(made.grid, psi, {1, 0}, velocity); });
  part("two_transforms", [&] { transforms.make(); });
  measured::Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  std::printf("nanoseconds a square:");
  for (const char* name : {"step", "advection", "diffusion", "poisson", "velocities", "two_transforms"})
    std::printf(" %s %.1f", name, 1e6 * medians.of(name, n) / squares);
  std::printf("\n");
  return 1e6 * medians.of("step", n) / squares > most ? 1 : 0;
}
