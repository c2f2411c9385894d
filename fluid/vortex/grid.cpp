#include "fluid/vortex/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

/// to = stream + scale (after - before).
SPLASHDOWN_WIDE void difference(double stream, double scale, const double* __restrict after,
                                const double* __restrict before, std::size_t count, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = stream + scale * (after[i] - before[i]);
}

/// Squares of a row of velocities beyond a stream, summed, and the greatest square of the velocities themselves.
SPLASHDOWN_WIDE void speeds_of_row(const double* __restrict u, const double* __restrict v, double stream_x,
                                   double stream_y, std::size_t count, Speeds& speeds) {
  double sums[lanes] = {}, most[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      const double a = u[i + l], b = v[i + l], x = a - stream_x, y = b - stream_y, square = a * a + b * b;
      sums[l] += x * x + y * y;
      most[l] = most[l] < square ? square : most[l];
    }
  for (; i < count; ++i) {
    const double x = u[i] - stream_x, y = v[i] - stream_y;
    sums[0] += x * x + y * y;
    most[0] = std::max(most[0], u[i] * u[i] + v[i] * v[i]);
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    speeds.squares += sums[l];
    speeds.speed = std::max(speeds.speed, most[l]);
  }
}

Speeds together(const std::vector<Speeds>& rows) {
  Speeds all;
  for (const auto& one : rows) {
    all.squares += one.squares;
    all.speed = std::max(all.speed, one.speed);
  }
  all.speed = std::sqrt(all.speed);
  return all;
}

}  // namespace

Speeds speeds_of(const Grid& grid, const FaceField& velocity, const Vec<2>& stream) {
  const auto row = static_cast<std::size_t>(grid.nx + 1);
  std::vector<Speeds> rows(static_cast<std::size_t>(grid.ny));
  in_pieces(rows.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j)
      speeds_of_row(velocity.u.data() + j * row, velocity.v.data() + j * row, stream.x(), stream.y(), row - 1, rows[j]);
  });
  return together(rows);
}

void add_curl(const Grid& grid, const FaceField& f, double factor, NodeField& omega) {
  const std::size_t row = static_cast<std::size_t>(grid.nx + 1);
  const double scale = factor / grid.h;
  in_pieces(static_cast<std::size_t>(grid.ny - 1), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first + 1; j < last + 1; ++j)
      for (std::size_t k = j * row + 1; k < (j + 1) * row - 1; ++k)
        omega[k] += scale * (f.v[k] - f.v[k - 1] - f.u[k] + f.u[k - row]);
  });
}

Speeds velocities_of(const Grid& grid, const NodeField& psi, const Vec<2>& stream, FaceField& velocity) {
  const std::size_t row = static_cast<std::size_t>(grid.nx + 1), ny = static_cast<std::size_t>(grid.ny);
  velocity.u.resize(grid.nodes());
  velocity.v.resize(grid.nodes());
  const double scale = 1 / grid.h;
  std::vector<Speeds> rows(ny);
  in_pieces(ny + 1, 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      const double* here = psi.data() + j * row;
      double *u = velocity.u.data() + j * row, *v = velocity.v.data() + j * row;
      difference(stream.y(), -scale, here + 1, here, row - 1, v);
      v[row - 1] = 0;
      if (j == ny) {
        clear_row(u, row);
        continue;
      }
      difference(stream.x(), scale, here + row, here, row, u);
      speeds_of_row(u, v, stream.x(), stream.y(), row - 1, rows[j]);
    }
  });
  return together(rows);
}

}  // namespace splashdown::vortex
