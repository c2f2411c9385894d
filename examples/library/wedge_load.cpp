// Drops a wedge on water and prints its load: a scene stepped by hand. 2D: all values per metre of depth.
#include <cstdio>

#include "apps/simulation/simulation.hpp"

const char* const scene = R"(
time = {end = 0.01}
gravity = {}
tank = {min = [-3, -3], max = [3, 1]}

[fluid]
density = 1000
size = {surface = 0.1, far = 0.3}
region = [{shape = "box", min = [-3, -3], max = [3, 0]}]

[[body]]
name = "wedge"
shape = {type = "wedge", deadrise_deg = 30, breadth = 0.5, height = 0.3}
mass = 241
velocity = [0, -6.15]
free = ["y"]
size = 0.01
)";

int main() try {
  auto simulation = splashdown::Simulation::of_text(scene);
  while (simulation.advance()) {  // everything at this instant is known
    const auto wedge = simulation.bodies().front();
    std::printf("%8.3f ms  %8.3f m/s  %8.2f kN/m\n", 1e3 * simulation.time(), wedge.velocity.y(),
                1e-3 * wedge.force.y());
  }
} catch (const std::exception& error) {  // a scene that is wrong, or a step that cannot be made
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
