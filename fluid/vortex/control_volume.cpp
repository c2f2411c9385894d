#include "fluid/vortex/control_volume.hpp"

namespace splashdown::vortex {
namespace {

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// In the middle of a change.
struct Middle {
  const Grid& grid;
  const Change& change;

  double omega(int i, int j) const {
    const std::size_t k = grid.at(i, j);
    return 0.5 * (change.omega[k] + change.omega_after[k]);
  }
  Vec<2> velocity(int i, int j) const {
    const std::size_t k = grid.at(i, j), row = static_cast<std::size_t>(grid.nx + 1);
    const auto &a = change.velocity, &b = change.velocity_after;
    return 0.25 * Vec<2>(a.u[k] + a.u[k - row] + b.u[k] + b.u[k - row], a.v[k] + a.v[k - 1] + b.v[k] + b.v[k - 1]);
  }
};

/// What a node of a side gives, a unit of length.
Wrench<2> flux_at(const Middle& middle, int i, int j, const Eigen::Vector2i& out, double viscosity,
                  const Vec<2>& about) {
  const Vec<2> r = middle.grid.node(i, j) - about, n = out.cast<double>(), u = middle.velocity(i, j),
               arm(r.y(), -r.x());
  const double w = middle.omega(i, j), through = u.dot(n);
  const double slope =
      (middle.omega(i + out.x(), j + out.y()) - middle.omega(i - out.x(), j - out.y())) / (2 * middle.grid.h);
  const Vec<2> momentum = 0.5 * u.squaredNorm() * n - through * u;
  Wrench<2> flux;
  flux.head<2>() = arm * (w * through - viscosity * slope) - momentum + viscosity * w * Vec<2>(n.y(), -n.x());
  flux[2] = -0.5 * r.squaredNorm() * (w * through - viscosity * slope) - cross(r, momentum) - viscosity * w * r.dot(n);
  return flux;
}

}  // namespace

Wrench<2> force_in(const Grid& grid, const NodeBox& box, const Change& change, double viscosity, const Vec<2>& about) {
  const Middle middle{grid, change};
  Wrench<2> sides = Wrench<2>::Zero(), inside = Wrench<2>::Zero();
  const auto end = [](int k, int first, int last) { return k == first || k == last ? 0.5 : 1.0; };
  for (int j = box.first_j; j <= box.last_j; ++j) {
    const double along = end(j, box.first_j, box.last_j);
    sides += along * (flux_at(middle, box.first_i, j, {-1, 0}, viscosity, about) +
                      flux_at(middle, box.last_i, j, {1, 0}, viscosity, about));
    for (int i = box.first_i; i <= box.last_i; ++i) {
      const std::size_t k = grid.at(i, j);
      const double weight = along * end(i, box.first_i, box.last_i);
      const double gained = weight * (change.omega_after[k] - change.omega[k]) / change.time;
      const Vec<2> r = grid.node(i, j) - about;
      inside += Wrench<2>(gained * r.y(), -gained * r.x(),
                          -0.5 * gained * r.squaredNorm() + 2 * viscosity * weight * middle.omega(i, j));
    }
  }
  for (int i = box.first_i; i <= box.last_i; ++i)
    sides += end(i, box.first_i, box.last_i) * (flux_at(middle, i, box.first_j, {0, -1}, viscosity, about) +
                                                flux_at(middle, i, box.last_j, {0, 1}, viscosity, about));
  return grid.h * sides + grid.h * grid.h * inside;
}

}  // namespace splashdown::vortex
