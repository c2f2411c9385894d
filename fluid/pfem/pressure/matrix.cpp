// Which nodes carry pressure, and the matrix of the pressure equation.
#include <algorithm>
#include <cmath>

#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/pressure/pressure.hpp"

namespace splashdown::fluid {

template <int d>
bool PressureEquation<d>::build(const Nodes<d>& nodes, const Mesh<d>& mesh, double density,
                                std::span<const WallPlace<d>> places, const WallLayout<d>& layout,
                                const InterfaceModel& structure, std::vector<HeldNode<d>> held) {
  nodes_ = &nodes;
  mesh_ = &mesh;
  structure_ = structure;
  layout_ = layout;
  around_.build(mesh.cells, nodes.size());
  measure(density);
  choose_unknowns();
  wall_modes(places);
  hold_mass(std::move(held), density);
  laplacian_.build(nodes, mesh, unknown_, structure.interface_operators);
  assemble(matrix_);
  laplacian_.add_to(matrix_);
  diagonal_.clear(), source_.clear();
  return (size() == 0 || factored()) && add_bodies();
}

template <int d>
bool PressureEquation<d>::set_terms(std::span<const double> diagonal, std::span<const double> source) {
  source_ = of_unknowns(source);
  const std::vector<double> replaced = std::exchange(diagonal_, of_unknowns(diagonal));
  if (diagonal_.empty() && replaced.empty()) return true;
  for (std::size_t k = 0; k < replaced.size(); ++k) matrix_.value[matrix_.column_start[k]] -= replaced[k];
  for (std::size_t k = 0; k < diagonal_.size(); ++k) matrix_.value[matrix_.column_start[k]] += diagonal_[k];
  return solver_.factor(matrix_) && add_bodies();
}

template <int d>
std::vector<double> PressureEquation<d>::of_unknowns(std::span<const double> of_nodes) const {
  std::vector<double> values;
  for (int n : node_)
    if (!of_nodes.empty()) values.push_back(of_nodes[n]);
  return values;
}

// Of a cell, over that at t = 0.
template <int d>
double PressureEquation<d>::relative_density(std::size_t cell) const {
  if (nodes_->compression.empty()) return 1;
  double sum = 0;
  for (int n : mesh_->cells[cell]) sum += nodes_->compression[n].density;
  return sum / (d + 1);
}

template <int d>
void PressureEquation<d>::measure(double density) {
  const std::size_t count = nodes_->size();
  density_ = density;
  gradients_.resize(mesh_->cells.size());
  per_mass_.resize(mesh_->cells.size());
  share_of_mass_.resize(mesh_->cells.size());
  rate_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto at = corners(nodes_->x, mesh_->cells[c]);
    gradients_[c] = volume_gradients<d>(at);
    const double volume = (at(d) - at(0)).dot(gradients_[c].col(d));
    const double here = density * relative_density(c);
    per_mass_[c] = 1 / (here * volume);
    share_of_mass_[c] = here * volume / (d + 2);
    rate_[c] = volume / (d + 1);
  });
  around_.sum(rate_, lumped_);
  if (!nodes_->compression.empty()) {
    for (std::size_t c = 0; c < rate_.size(); ++c) rate_[c] *= relative_density(c);
    around_.sum(rate_, lumped_mass_);
  }
  const auto mass = lumped_mass();
  // Nodes of slivers weigh next to nothing and would be shot away; they resist like a small part of a neighbour. In 2D that is
  // for those beside the free surface: gaps between walls are thin on purpose, and what resists more than it weighs
  // no hydrostatic pressure carries.
  constexpr double lightest = 0.02, lightest_within = d == 2 ? 1e-4 : lightest;
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    rate_[c] = 0;
    for (int n : mesh_->cells[c]) rate_[c] = std::max(rate_[c], mass[n]);
  });
  per_nodal_mass_.resize(count);
  std::vector<double> keeps(count);
  in_parallel(count, [&](std::size_t i) {
    double heaviest = 0;
    bool near_surface = false;
    for (const auto [c, k] : around_.around(i)) {
      heaviest = std::max(heaviest, rate_[c]);
      if constexpr (lightest_within < lightest)
        for (int n : mesh_->cells[c]) near_surface = near_surface || nodes_->surface[n];
    }
    const double resists = std::max(mass[i], (near_surface ? lightest : lightest_within) * heaviest);
    per_nodal_mass_[i] = resists > 0 ? 1 / (density * (d + 1) * resists) : 0.0;
    keeps[i] = resists > 0 ? 1 - mass[i] / ((d + 2) * resists) : 0.0;
  });
  sweep_.build(mesh_->cells, around_, share_of_mass_, per_nodal_mass_, keeps);
  free_area_.assign(count, Vec<d>::Zero());
  free_measure_.assign(count, 0.0);
  free_spread_.assign(count, 0.0);
  std::vector<int> facets(count, 0);
  for (const auto& f : mesh_->boundary) {
    if (f.wall >= 0) continue;
    const Vec<d> share = area_vector_of<d>(f, nodes_->x) / d;
    for (int n : f.nodes) {
      free_area_[n] += share;
      free_measure_[n] += share.norm();
      free_spread_[n] += share.squaredNorm();
      ++facets[n];
    }
  }
  for (std::size_t i = 0; i < count; ++i) free_spread_[i] *= facets[i];
}

// Contact lines keep phi = 0 where the water is a thin wedge there or separates. Steep ones keep their volume like the rest
// of the surface: held to p = 0 they push still water about.
template <int d>
bool PressureEquation<d>::at_contact_line(int node) const {
  // Volume over surface^(d/(d-1)): 0.7 to 1.3 (plane), 0.6 (space) at a right angle, 0.3, 0.2 at 30 degrees.
  constexpr double steep = 0.3;
  const WallTie& tie = nodes_->tie[node];
  if (tie.wall < 0) return false;
  return nodes_->separates[node] || lumped_[node] < steep * std::pow(free_measure_[node], d / (d - 1.0));
}

template <int d>
void PressureEquation<d>::choose_unknowns() {
  // All surface nodes but those on a spike of the bulk: a volume this small for its surface, 0.43 on a flat one in
  // 2D, would be thrown by what little is left of the volume's error. Sheets are thin by nature, and their volume is kept
  // like any other's: left to fly, they gain volume, hence energy, while they stretch.
  auto on_sheet = [&](std::size_t i) {
    const auto around = around_.around(i);
    return std::any_of(around.begin(), around.end(), [&](const auto& at) {
      const auto& cell = mesh_->cells[at.cell];
      return std::all_of(cell.begin(), cell.end(), [&](int n) { return nodes_->surface[n]; });
    });
  };
  unknown_.assign(nodes_->size(), -1);
  node_.clear();
  for (std::size_t i = 0; i < nodes_->size(); ++i) {
    auto on_spike = [&] {
      return lumped_[i] < lightest_on_surface * std::pow(free_measure_[i], d / (d - 1.0)) && !on_sheet(i);
    };
    const bool held = on_surface_ == SurfaceUnknowns::without_spikes && nodes_->surface[i] &&
                      (at_contact_line(static_cast<int>(i)) || on_spike());
    if (held || nodes_->spray[i]) {
      free_area_[i].setZero();
      continue;
    }
    unknown_[i] = static_cast<int>(node_.size());
    node_.push_back(static_cast<int>(i));
  }
}

template <int d>
void PressureEquation<d>::wall_modes(std::span<const WallPlace<d>> places) {
  modes_.resize(places.size());
  vertex_modes_.resize(places.size());
  for (auto& m : modes_) m.clear();
  for (auto& m : vertex_modes_) m.clear();
  each_wall_row(places, [&](int wall, int n, const auto& row_of) {
    if (unknown_[n] < 0) return;
    const WallRow<d> row = row_of();
    if (!places[wall].shape()) modes_[wall].push_back({unknown_[n], row.rigid});
    for (const auto& [vertex, part] : row.at_vertices) vertex_modes_[wall].push_back({unknown_[n], vertex, part});
  });
}

template <int d>
void PressureEquation<d>::hold_mass(std::vector<HeldNode<d>> held, double density) {
  held_.build(std::move(held), modes_.size(), density, lumped_mass());
  held_modes_.assign(modes_.size(), {});
  if (held_.empty()) return;
  const AccelerationWeights<d> weights{*mesh_, nodes_->x, around_, gradients_, share_of_mass_, per_nodal_mass_};
  for (std::size_t w = 0; w < modes_.size(); ++w) {
    if (!moves_wall<d>(structure_.modal, layout_, w)) continue;
    for (const auto& column : held_.load(w, weights))
      if (unknown_[column.node] >= 0) held_modes_[w].push_back({unknown_[column.node], column.wrench});
  }
}

template <int d>
void PressureEquation<d>::assemble(SymmetricMatrix& matrix) {
  assembly_.build(mesh_->cells, around_, unknown_, node_, [&](int c, int a, int b) {
    const int i = mesh_->cells[c][a], j = mesh_->cells[c][b];
    const auto of_a = gradients_[c].col(a), of_b = gradients_[c].col(b);
    double entry = of_a.dot(of_b) * per_mass_[c];
    if (nodes_->surface[i]) entry -= free_area_[i].dot(of_b) * per_nodal_mass_[i];
    if (nodes_->surface[j]) entry -= free_area_[j].dot(of_a) * per_nodal_mass_[j];
    return entry;
  });
  matrix.column_start.swap(assembly_.column_start);
  matrix.row.swap(assembly_.row);
  matrix.value.swap(assembly_.value);
  for (int k = 0; k < size(); ++k)
    matrix.value[matrix.column_start[k]] += 2 * free_spread_[node_[k]] * (d + 1) * per_nodal_mass_[node_[k]];
}

// Liquid that walls enclose on all sides has no free surface to fix its pressure: its block is singular, and
// a shift far below the discretisation error makes it definite.
template <int d>
bool PressureEquation<d>::factored() {
  if (solver_.factor(matrix_)) return true;
  constexpr double shift = 1e-9;
  for (int i = 0; i < size(); ++i) matrix_.value[matrix_.column_start[i]] *= 1 + shift;
  return solver_.factor(matrix_);
}

template class PressureEquation<2>;
template class PressureEquation<3>;

}  // namespace splashdown::fluid
