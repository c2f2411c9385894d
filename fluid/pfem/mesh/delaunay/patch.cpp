#include "fluid/pfem/mesh/delaunay/patch.hpp"

#include <algorithm>

namespace splashdown::fluid {
template <int d>
Patches<d>::Patches(const std::vector<FacetAt>& wrong, const ClosedDelaunay<d>& mesh) {
  std::vector<int> cells, parent;  // of[cells[i]]: i, in the end its patch
  auto number_of = [&](int c) {
    const auto [found, is_new] = of.try_emplace(c, static_cast<int>(cells.size()));
    if (is_new) cells.push_back(c), parent.push_back(found->second);
    return found->second;
  };
  auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const FacetAt& f : wrong) {
    const int a = root(number_of(f.cell));
    if (f.corner == FacetAt::whole_cell) continue;
    const int b = root(number_of(mesh.neighbours[f.cell][f.corner]));
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
    const int first = root(i);
    if (first == i) list.emplace_back();
    const int patch = first == i ? static_cast<int>(list.size()) - 1 : of.at(cells[first]);
    of[cells[i]] = patch;
    list[patch].seed_cells.push_back(cells[i]);
  }
  for (const FacetAt& f : wrong) list[of.at(f.cell)].seeds.push_back(f);
}

// ---- growth

template <int d>
void PatchGrower<d>::grow(Patches<d>& patches, int number, const MovedCells<d>& mesh,
                          std::atomic<std::ptrdiff_t>& budget) {
  typename Patch<d>::State state = Patch<d>::waiting;
  if (!patches.list[number].state->compare_exchange_strong(state, Patch<d>::growing)) return;
  patches_ = &patches;
  mesh_ = &mesh;
  budget_ = &budget;
  begin(number);
  while (goes_on()) {
    extend();
    if (!goes_on()) return;
    if (cut_out()) {
      *patch().state = Patch<d>::found;
      return;
    }
    // It is too small.
    const std::size_t cells = patch().old.size();
    for (const FacetAt& f : patch().rim)
      if (const int n = mesh_->beyond(f).cell; mesh_->finite(mesh_->mesh.cells[n])) meet(n);
    if (patch().old.size() == cells) *patch().state = Patch<d>::failed;
  }
}

template <int d>
void PatchGrower<d>::begin(int number) {
  number_ = number;
  ++stamp_;
  t_.clear();
  t_.infinite_vertex()->info() = mesh_->infinity;
  hint_ = {};
  taken_.clear();
  cells_.resize(mesh_->mesh.cells.size(), 0);
  points_.resize(mesh_->at.size(), 0);
  vertex_of_.resize(mesh_->at.size());
  for (int c : patch().seed_cells) take_in(c);
}

// Points that come with a cell may take away facets that held before.
template <int d>
void PatchGrower<d>::extend() {
  Patch<d>& p = patch();
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t i = 0; i < p.old.size(); ++i)
      for (int k = 0; k <= d; ++k) {
        const FacetAt f{p.old[i], k};
        const int n = mesh_->mesh.neighbours[f.cell][k];
        if (has(n) || holds(f)) continue;
        meet(n);
        if (!goes_on()) return;
        grew = true;
      }
  }
  p.rim.clear();
  for (int c : p.old)
    for (int k = 0; k <= d; ++k)
      if (!has(mesh_->mesh.neighbours[c][k])) p.rim.push_back({c, k});
}

template <int d>
void PatchGrower<d>::take_in(int cell) {
  if (has(cell)) return;
  cells_[cell] = stamp_;
  patch().old.push_back(cell);
  for (int n : mesh_->mesh.cells[cell]) insert(n);
  if (const auto more = mesh_->to_insert.find(cell); more != mesh_->to_insert.end())
    for (int n : more->second) insert(n);
}

template <int d>
void PatchGrower<d>::meet(int cell) {
  const auto found = patches_->of.find(cell);
  if (found != patches_->of.end() && found->second != number_) {
    Patch<d>& other = patches_->list[found->second];
    typename Patch<d>::State state = Patch<d>::waiting;
    if (other.state->compare_exchange_strong(state, Patch<d>::yielded))
      for (int c : other.seed_cells) take_in(c);
    else if (state == Patch<d>::found || (state == Patch<d>::growing && found->second < number_))
      *patch().state = Patch<d>::yielded;
  }
  take_in(cell);
}

template <int d>
void PatchGrower<d>::insert(int point) {
  if (point < 0 || points_[point] == stamp_) return;
  points_[point] = stamp_;
  taken_.push_back(point);
  const auto v = vertex_of_[point] = t_.insert(mesh_->at[point], hint_);
  v->info() = point;
  hint_ = Cgal<d>::cell_of(v);
  if (--*budget_ < 0 || t_.number_of_vertices() != taken_.size()) *patch().state = Patch<d>::failed;
}

template <int d>
auto PatchGrower<d>::corners_of(Handle cell) const -> Cell {
  Cell corners;
  for (int k = 0; k <= d; ++k) corners[k] = cell->vertex(k)->info();
  return corners;
}

// One of the two cells of a facet of the patch's triangulation.
template <int d>
auto PatchGrower<d>::cell_at(const std::array<Vertex, d>& facet) const -> std::optional<Inner> {
  Inner found;
  if (t_.dimension() < d) return {};
  if constexpr (d == 2) {
    if (!t_.is_edge(facet[0], facet[1], found.cell, found.corner)) return {};
  } else {
    int a, b, c;
    if (!t_.is_facet(facet[0], facet[1], facet[2], found.cell, a, b, c)) return {};
    found.corner = 6 - a - b - c;
  }
  return found;
}

// The cell of the patch's triangulation on the side of the facet where the old cell is.
template <int d>
auto PatchGrower<d>::within(const FacetAt& f) const -> std::optional<Inner> {
  const auto facet = MovedCells<d>::facet_of(mesh_->mesh.cells[f.cell], f.corner);
  std::array<Vertex, d> v;
  for (int i = 0; i < d; ++i) {
    if (facet[i] < 0) return {};
    v[i] = vertex_of_[facet[i]];
  }
  const auto found = cell_at(v);
  if (!found || MovedCells<d>::facet_of(corners_of(found->cell), found->corner) == facet) return found;
  const Handle other = found->cell->neighbor(found->corner);
  return Inner{other, other->index(found->cell)};
}

// The facet may be part of the rim: there is a new cell within, which the cell beyond leaves alone. One that has lost a corner
// others mend.
template <int d>
bool PatchGrower<d>::holds(const FacetAt& f) const {
  const auto inner = within(f);
  if (!inner) return false;
  const FacetAt other = mesh_->beyond(f);
  const Cell& beyond = mesh_->mesh.cells[other.cell];
  if (MovedCells<d>::lost_a_corner(beyond) || !mesh_->finite(beyond)) return true;
  const int opposite = inner->cell->vertex(inner->corner)->info();
  return opposite != mesh_->infinity && mesh_->positive(beyond) && !mesh_->in_conflict(beyond, opposite);
}

// The cells within the rim. False if the patch is too small for its points.
template <int d>
bool PatchGrower<d>::cut_out() {
  Patch<d>& p = patch();
  std::vector<Cell> cells, neighbours;
  int count = 0;
  for (auto c : Cgal<d>::cells(t_)) c->info() = count++;
  for (auto c : Cgal<d>::cells(t_)) {
    Cell beyond;
    cells.push_back(corners_of(c));
    for (int k = 0; k <= d; ++k) beyond[k] = c->neighbor(k)->info();
    neighbours.push_back(beyond);
  }
  constexpr int outside = -1;
  std::vector<int> number(count, outside), reached, beyond_rim;
  auto reach = [&](int c) {
    if (number[c] == outside) number[c] = static_cast<int>(reached.size()), reached.push_back(c);
  };
  for (std::size_t r = 0; r < p.rim.size(); ++r) {
    const auto inner = within(p.rim[r]);
    if (!inner) return false;
    const int c = inner->cell->info();
    beyond_rim.push_back(std::exchange(neighbours[c][inner->corner], -1 - static_cast<int>(r)));
    reach(c);
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int n : neighbours[reached[i]])
      if (n >= 0) reach(n);
  // Where the rim has turned inside out, within it lies all that is without.
  if (!std::all_of(beyond_rim.begin(), beyond_rim.end(), [&](int c) { return number[c] == outside; }) ||
      !std::all_of(reached.begin(), reached.end(), [&](int c) { return mesh_->finite(cells[c]); }))
    return false;
  std::size_t corners = 0;
  for (int c : reached)
    for (int n : cells[c])
      if (points_[n] == stamp_) points_[n] = 0, ++corners;
  for (int n : taken_) points_[n] = stamp_;
  if (corners != taken_.size()) return false;
  p.cells.clear(), p.neighbours.clear();
  for (int c : reached) {
    p.cells.push_back(cells[c]);
    Cell beyond = neighbours[c];
    for (int& n : beyond)
      if (n >= 0) n = number[n];
    p.neighbours.push_back(beyond);
  }
  return true;
}

template struct Patches<2>;
template struct Patches<3>;
template class PatchGrower<2>;
template class PatchGrower<3>;

}  // namespace splashdown::fluid
