#include "fluid/vortex/grid.hpp"

#include "core/parallel.hpp"

namespace splashdown::vortex {

void add_curl(const Grid& grid, const FaceField& f, double factor, NodeField& omega) {
  const std::size_t row = static_cast<std::size_t>(grid.nx + 1);
  const double scale = factor / grid.h;
  in_pieces(static_cast<std::size_t>(grid.ny - 1), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first + 1; j < last + 1; ++j)
      for (std::size_t k = j * row + 1; k < (j + 1) * row - 1; ++k)
        omega[k] += scale * (f.v[k] - f.v[k - 1] - f.u[k] + f.u[k - row]);
  });
}

void velocities_of(const Grid& grid, const NodeField& psi, const Vec<2>& stream, FaceField& velocity) {
  const std::size_t row = static_cast<std::size_t>(grid.nx + 1);
  velocity.u.resize(grid.nodes());
  velocity.v.resize(grid.nodes());
  const double scale = 1 / grid.h;
  in_pieces(static_cast<std::size_t>(grid.ny + 1), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      const bool top = j == static_cast<std::size_t>(grid.ny);
      for (std::size_t k = j * row; k < (j + 1) * row; ++k)
        velocity.u[k] = top ? 0 : stream.x() + scale * (psi[k + row] - psi[k]);
      for (std::size_t k = j * row; k < (j + 1) * row - 1; ++k)
        velocity.v[k] = stream.y() - scale * (psi[k + 1] - psi[k]);
      velocity.v[(j + 1) * row - 1] = 0;
    }
  });
}

}  // namespace splashdown::vortex
