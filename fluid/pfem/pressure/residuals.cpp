// The volume that a motion would create, and the motion that an impulse makes.
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/pressure/pressure.hpp"

namespace splashdown::fluid {

// r(q) += int_f q w.n dA, w linear between the facet's nodes.
template <int d>
template <class Velocity>
void PressureEquation<d>::add_flux(const Facet<d>& f, std::span<const Vec<d>> x, Velocity velocity,
                                   std::vector<double>& r) const {
  const Vec<d> area = area_vector_of<d>(f, x) / (d * (d + 1));
  Vec<d> sum = Vec<d>::Zero();
  std::array<Vec<d>, d> w;
  for (int k = 0; k < d; ++k) sum += w[k] = velocity(f.nodes[k]);
  for (int k = 0; k < d; ++k)
    if (unknown_[f.nodes[k]] >= 0) r[unknown_[f.nodes[k]]] += area.dot(sum + w[k]);
}

// r(q) -= int_f q w.n dA of a wall that deforms, by the points at which B is integrated.
template <int d>
void PressureEquation<d>::add_deforming_flux(const Facet<d>& f, std::span<const Vec<d>> x, const WallShape<d>& shape,
                                             const WallVelocity<d>& s, std::vector<double>& r) const {
  if (s.vertices.size() == 0) return;
  const Vec<d> area = area_vector_of<d>(f, x);
  for (const auto& [share, weight] : points_of_facet<d>(shape, size_of<d>(f, x))) {
    const Vec<d> w = anchor_of<d>(shape, point_of<d>(f, share, x)).interpolate(s.vertices);
    for (int k = 0; k < d; ++k)
      if (unknown_[f.nodes[k]] >= 0) r[unknown_[f.nodes[k]]] -= share[k] * weight * area.dot(w);
  }
}

template <int d>
void PressureEquation<d>::flux_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> v,
                                        std::span<const WallVelocity<d>> s, std::span<const WallPlace<d>> places,
                                        std::vector<double>& r) const {
  of_corner_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto& cell = mesh_->cells[c];
    const auto g = volume_gradients<d>(corners(x, cell));
    Vec<d> mean = Vec<d>::Zero();
    for (int n : cell) mean += v[n];
    mean /= d + 1;
    for (int k = 0; k <= d; ++k) of_corner_[c][k] = g.col(k).dot(mean);
  });
  r.resize(size());
  in_parallel(node_.size(), [&](std::size_t i) {
    double sum = 0;
    for (const auto [c, k] : around_.around(node_[i])) sum += of_corner_[c][k];
    r[i] = sum;
  });
  for (const auto& f : mesh_->boundary) {
    if (f.wall >= 0 && places[f.wall].shape()) {
      add_deforming_flux(f, x, *places[f.wall].shape(), s[f.wall], r);
      continue;
    }
    add_flux(
        f, x,
        [&](int n) -> Vec<d> {
          return f.wall < 0 ? Vec<d>(-v[n]) : Vec<d>(-velocity_at<d>(places[f.wall], s[f.wall], x[n]));
        },
        r);
  }
}

template <int d>
void PressureEquation<d>::motion_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u,
                                          std::vector<double>& r) const {
  rate_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto& cell = mesh_->cells[c];
    const auto g = volume_gradients<d>(corners(x, cell));
    double rate = 0;
    for (int k = 0; k <= d; ++k) rate += g.col(k).dot(u[cell[k]]);
    rate_[c] = rate / (d + 1);
  });
  r.resize(size());
  in_parallel(node_.size(), [&](std::size_t i) {
    double sum = 0;
    for (const auto [c, k] : around_.around(node_[i])) sum -= rate_[c];
    r[i] = sum;
  });
}

template <int d>
void PressureEquation<d>::slide_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u,
                                         std::span<const WallVelocity<d>> s, std::span<const WallPlace<d>> places,
                                         std::span<const int> slides, std::vector<double>& r) const {
  for (int k : slides) {
    const auto& f = mesh_->boundary[k];
    if (const WallShape<d>* shape = places[f.wall].shape()) {
      add_flux(
          f, x, [&](int n) -> Vec<d> { return u[n]; }, r);
      add_deforming_flux(f, x, *shape, s[f.wall], r);
      continue;
    }
    add_flux(
        f, x, [&](int n) -> Vec<d> { return u[n] - velocity_at<d>(places[f.wall], s[f.wall], x[n]); }, r);
  }
}

// The volume that these velocities create if walls stand still, in flux form.
template <int d>
Eigen::VectorXd PressureEquation<d>::flux_of(std::span<const Vec<d>> v) const {
  const std::vector<WallVelocity<d>> still(modes_.size(), Twist<d>::Zero());
  const std::vector<WallPlace<d>> anywhere(modes_.size());
  std::vector<double> r;
  flux_residual(nodes_->x, v, still, anywhere, r);
  return Eigen::Map<const Eigen::VectorXd>(r.data(), size());
}

// K phi: the volume that the motion by an impulse takes out, of nodes that nothing holds.
template <int d>
Eigen::VectorXd PressureEquation<d>::taken_by(const Eigen::VectorXd& phi) const {
  std::vector<Vec<d>> v(nodes_->size(), Vec<d>::Zero());
  accelerate({phi.data(), static_cast<std::size_t>(phi.size())}, v);
  held_.hold(v, std::vector<WallVelocity<d>>(modes_.size(), Twist<d>::Zero()));
  return -flux_of(v);
}

// -M_L^-1 int N grad f.
template <int d>
template <class Impulse>
void PressureEquation<d>::lumped_change(Impulse impulse_at, std::size_t nodes) const {
  of_cell_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    Vec<d> sum = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) sum += gradients_[c].col(k) * impulse_at(mesh_->cells[c][k]);
    of_cell_[c] = sum;
  });
  change_.resize(nodes);
  in_parallel(nodes, [&](std::size_t i) {
    const double per_mass = per_nodal_mass_[i];
    Vec<d> sum = Vec<d>::Zero();
    for (const auto [c, k] : around_.around(i)) sum -= per_mass * of_cell_[c];
    change_[i] = sum;
  });
}

// M_L^-1 int_surface N f n.
template <int d>
template <class Impulse>
void PressureEquation<d>::add_surface_change(Impulse impulse_at) const {
  for (const auto& f : mesh_->boundary) {
    if (f.wall >= 0) continue;
    const Vec<d> share = area_vector_of<d>(f, nodes_->x) / d;
    double sum = 0;
    for (int n : f.nodes) sum += impulse_at(n);
    for (int n : f.nodes) change_[n] += per_nodal_mass_[n] * (sum + impulse_at(n)) * share;
  }
}

template <int d>
void PressureEquation<d>::accelerate(std::span<const double> phi, std::span<Vec<d>> v) const {
  const auto impulse_at = [&](int n) { return unknown_[n] < 0 ? 0.0 : phi[unknown_[n]]; };
  lumped_change(impulse_at, v.size());
  add_surface_change(impulse_at);
  spread_change(v);
}

// v += (1 + z + 2 z^2) of the change that lumped masses get.
template <int d>
void PressureEquation<d>::spread_change(std::span<Vec<d>> v) const {
  sweep_(change_, swept_);
  in_parallel(v.size(), [&](std::size_t i) { v[i] += change_[i] + swept_[i] + 2 * sweep_(i, swept_); });
}

template <int d>
std::vector<double> PressureEquation<d>::continued(std::span<const double> surface_impulse) const {
  constexpr int sweeps = 10;  // of averaging: as many elements deep it is smooth
  std::vector<double> all(surface_impulse.begin(), surface_impulse.end()), next;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (nodes_->surface[i]) sum += all[i], ++count;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!nodes_->surface[i]) all[i] = count > 0 ? sum / static_cast<double>(count) : 0.0;
  for (int k = 0; k < sweeps; ++k) {
    next = all;
    in_parallel(all.size(), [&](std::size_t i) {
      const auto around = around_.around(i);
      if (nodes_->surface[i] || around.empty()) return;
      double mean = 0;
      for (const auto at : around)
        for (int n : mesh_->cells[at.cell]) mean += all[n];
      next[i] = mean / static_cast<double>((d + 1) * around.size());
    });
    all.swap(next);
  }
  return all;
}

template <int d>
void PressureEquation<d>::push(std::span<const double> impulse, std::span<Vec<d>> v,
                               std::span<const WallPlace<d>> places, std::span<WallImpulse<d>> on_walls) const {
  lumped_change([&](int n) { return impulse[n]; }, v.size());
  spread_change(v);
  each_wall_row(places, [&](int wall, int n, const auto& row) { row().push(impulse[n], on_walls[wall]); });
}

template <int d>
void PressureEquation<d>::stabilise(std::span<const double> phi, std::span<const Vec<d>> change,
                                    std::span<const double> theta, std::vector<double>& r) const {
  of_corner_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto& cell = mesh_->cells[c];
    Vec<d> mean = Vec<d>::Zero(), slope = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) {
      mean += change[cell[k]] / (d + 1);
      if (const int own = unknown_[cell[k]]; own >= 0) slope += phi[own] * gradients_[c].col(k);
    }
    const Vec<d> left = theta[c] * (mean + per_mass_[c] * slope);
    for (int k = 0; k <= d; ++k) of_corner_[c][k] = gradients_[c].col(k).dot(left);
  });
  in_parallel(node_.size(), [&](std::size_t i) {
    double sum = 0;
    for (const auto [c, k] : around_.around(node_[i])) sum += of_corner_[c][k];
    r[i] -= sum;
  });
}

template <int d>
void PressureEquation<d>::add_sources(std::vector<double>& r) const {
  for (std::size_t k = 0; k < source_.size(); ++k) r[k] += source_[k];
}

template <int d>
void PressureEquation<d>::add_sources(std::vector<double>& r, std::span<const double> phi) const {
  add_sources(r);
  for (std::size_t k = 0; k < diagonal_.size(); ++k) r[k] -= diagonal_[k] * phi[k];
}

// 1 / (1 + z + 2 z^2) as 1 - z + curvature z^2 (z - 1/2): exact in value and slope at z = 0, in value at 1/2 and at the end of
// the spectrum, within 2 % between.
template <int d>
double PressureEquation<d>::kinetic_energy(std::span<const Vec<d>> v) const {
  constexpr double z = shortest<d>, curvature = (1 / inverse_mass(z) - 1 + z) / (z * z * (z - 0.5));
  sweep_(v, swept_);
  const auto mass = lumped_mass();
  const double twice = sum_in_parallel(v.size(), [&](std::size_t i) {
    return mass[i] *
           (v[i].squaredNorm() - v[i].dot(swept_[i]) + curvature * swept_[i].dot(sweep_(i, swept_) - 0.5 * swept_[i]));
  });
  return 0.5 * density_ * twice;
}

template class PressureEquation<2>;
template class PressureEquation<3>;

}  // namespace splashdown::fluid
