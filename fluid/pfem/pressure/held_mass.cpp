#include "fluid/pfem/pressure/held_mass.hpp"

#include <algorithm>

namespace splashdown::fluid {

template <int d>
void HeldMass<d>::build(std::vector<HeldNode<d>> held, std::size_t walls, double density,
                        std::span<const double> lumped) {
  held_ = std::move(held);
  std::stable_sort(held_.begin(), held_.end(), [](const auto& a, const auto& b) { return a.wall < b.wall; });
  first_.assign(walls + 1, 0);
  mass_.clear();
  for (const auto& h : held_) {
    ++first_[h.wall + 1];
    mass_.push_back(density * lumped[h.node]);
  }
  for (std::size_t w = 0; w < walls; ++w) first_[w + 1] += first_[w];
}

template <int d>
typename HeldMass<d>::Lever HeldMass<d>::lever(const Vec<d>& arm) {
  Lever to_wrench;
  for (int k = 0; k < d; ++k) to_wrench.col(k) = wrench_of<d>(arm, Vec<d>::Unit(k));
  return to_wrench;
}

template <int d>
Mat<freedoms<d>> HeldMass<d>::inertia(std::size_t wall) const {
  Mat<freedoms<d>> sum = Mat<freedoms<d>>::Zero();
  for (int k = first_[wall]; k < first_[wall + 1]; ++k) {
    const Lever to_wrench = lever(held_[k].arm);
    sum += mass_[k] * to_wrench * held_[k].directions * to_wrench.transpose();
  }
  return sum;
}

template <int d>
std::vector<WallImpulse<d>> HeldMass<d>::excess(std::span<const Vec<d>> v, std::span<const WallVelocity<d>> s) const {
  std::vector<WallImpulse<d>> on_walls(first_.size() - 1, Wrench<d>::Zero());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const HeldNode<d>& h = held_[k];
    const Vec<d> lost = mass_[k] * (h.directions * (v[h.node] - rigid_velocity<d>(s[h.wall].rigid, h.arm)));
    on_walls[h.wall].rigid += wrench_of<d>(h.arm, lost);
  }
  return on_walls;
}

template <int d>
void HeldMass<d>::hold(std::span<Vec<d>> v, std::span<const WallVelocity<d>> s) const {
  for (const HeldNode<d>& h : held_)
    v[h.node] += h.directions * (rigid_velocity<d>(s[h.wall].rigid, h.arm) - v[h.node]);
}

// The transpose of the acceleration a(phi) = (1 + z + 2 z^2) M_L^-1 f(phi), z = 1 - M_L^-1 M_C, applied to sum_i N_i^T P_i m_i
// at the held nodes: three rings of cells around them.
template <int d>
std::vector<typename HeldMass<d>::Column> HeldMass<d>::load(std::size_t wall, const AccelerationWeights<d>& w) const {
  const auto& cells = w.mesh.cells;
  std::vector<int> slot(w.x.size(), -1);  // of nodes that a held one's acceleration depends on
  std::vector<int> ring;
  std::vector<int> near, all;  // cells around held nodes and their neighbours, around those cells' nodes
  auto take = [&](int n) {
    if (slot[n] < 0) slot[n] = static_cast<int>(ring.size()), ring.push_back(n);
  };
  auto gather = [&](std::vector<int>& found) {
    for (int n : ring)
      for (const auto [c, k] : w.around.around(n)) found.push_back(c);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  };
  for (int k = first_[wall]; k < first_[wall + 1]; ++k) take(held_[k].node);
  for (int k = 0; k < 2; ++k) {
    near.clear();
    gather(near);
    for (int c : near)
      for (int n : cells[c]) take(n);
  }

  std::vector<Lever> of_held(ring.size(), Lever::Zero());
  for (int k = first_[wall]; k < first_[wall + 1]; ++k)
    of_held[slot[held_[k].node]] += mass_[k] * lever(held_[k].arm) * held_[k].directions;
  auto swept = [&](std::vector<Lever> u) {  // (1 - M_C M_L^-1) u
    const std::vector<Lever> before = u;
    for (int c : near) {
      Lever sum = Lever::Zero();
      for (int n : cells[c]) sum += w.per_nodal_mass[n] * before[slot[n]];
      for (int n : cells[c]) u[slot[n]] -= w.cell_mass_share[c] * (sum + w.per_nodal_mass[n] * before[slot[n]]);
    }
    return u;
  };
  const std::vector<Lever> once = swept(of_held), twice = swept(once);
  std::vector<Lever> weight(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) weight[i] = of_held[i] + once[i] + 2 * twice[i];
  for (std::size_t i = 0; i < ring.size(); ++i) weight[i] *= w.per_nodal_mass[ring[i]];

  const std::size_t moved = ring.size();
  gather(all);
  for (int c : all)
    for (int n : cells[c]) take(n);
  std::vector<Wrench<d>> column(ring.size(), Wrench<d>::Zero());
  auto weight_of = [&](int n) -> Lever {
    const auto s = static_cast<std::size_t>(slot[n]);
    return s < moved ? weight[s] : Lever(Lever::Zero());
  };
  for (int c : all) {
    Lever sum = Lever::Zero();
    for (int n : cells[c]) sum += weight_of(n);
    for (int k = 0; k <= d; ++k) column[slot[cells[c][k]]] -= sum * w.gradients[c].col(k);
  }
  for (const auto& f : w.mesh.boundary) {
    if (f.wall >= 0) continue;
    if (std::any_of(f.nodes.begin(), f.nodes.end(), [&](int n) { return slot[n] < 0; })) continue;  // no moved node
    const Vec<d> share = area_vector_of<d>(f, w.x) / d;
    Lever sum = Lever::Zero();
    for (int n : f.nodes) sum += weight_of(n);
    for (int n : f.nodes) column[slot[n]] += (sum + weight_of(n)) * share;
  }
  std::vector<Column> out;
  for (std::size_t i = 0; i < ring.size(); ++i) out.push_back({ring[i], column[i]});
  return out;
}

template class HeldMass<2>;
template class HeldMass<3>;

}  // namespace splashdown::fluid
