#include "fluid/mesh/delaunay/patch.hpp"

#include <algorithm>

#include "fluid/parallel.hpp"

namespace splashdown::fluid {
namespace {

int place_of(int value, const MovedCells::Cell& in) {
  return static_cast<int>(std::find(in.begin(), in.end(), value) - in.begin());
}

}  // namespace

// ---- cells whose points have moved

MovedCells::MovedCells(ClosedDelaunay& m, std::span<const Vec<3>> points)
    : mesh(m), infinity(static_cast<int>(points.size()) + ClosedDelaunay::far), at(points.size()) {
  in_parallel(points.size(), [&](std::size_t i) { at[i] = cgal_point(points[i]); });
  for (const auto& x : far_points(mesh.extent)) at.push_back(cgal_point(x));
}

bool MovedCells::finite(const Cell& cell) const { return place_of(infinity, cell) == 4; }

bool MovedCells::lost_a_corner(const Cell& cell) {
  return std::any_of(cell.begin(), cell.end(), [](int n) { return n < 0; });
}

bool MovedCells::positive(const Cell& cell) const {
  return is_.orientation(at[cell[0]], at[cell[1]], at[cell[2]], at[cell[3]]) == CGAL::POSITIVE;
}

bool MovedCells::in_conflict(const Cell& cell, int point) const {
  return is_.side_of_oriented_sphere(at[cell[0]], at[cell[1]], at[cell[2]], at[cell[3]], at[point], true) ==
         CGAL::ON_POSITIVE_SIDE;
}

bool MovedCells::locally_delaunay(const FacetAt& f) const {
  const FacetAt other = beyond(f);
  const int opposite = mesh.cells[other.cell][other.corner];
  return opposite < 0 || opposite == infinity || !in_conflict(mesh.cells[f.cell], opposite);
}

FacetAt MovedCells::beyond(const FacetAt& f) const {
  const int cell = mesh.neighbours[f.cell][f.corner];
  return {cell, place_of(f.cell, mesh.neighbours[cell])};
}

std::array<int, 3> MovedCells::facet_of(const Cell& cell, int corner) {
  auto facet = facet_nodes(cell, corner);
  std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  return facet;
}

int MovedCells::locate(int point, int start) const {
  int c = start;
  for (std::size_t step = 0; step < mesh.cells.size() && finite(mesh.cells[c]); ++step) {
    int through = -1;
    for (int k = 0; k < 4 && through < 0; ++k) {
      Cell towards = mesh.cells[c];
      towards[k] = point;
      if (is_.orientation(at[towards[0]], at[towards[1]], at[towards[2]], at[towards[3]]) == CGAL::NEGATIVE)
        through = k;
    }
    if (through < 0) return c;
    c = mesh.neighbours[c][through];
  }
  return c;
}

// ---- patches

Patches::Patches(const std::vector<FacetAt>& wrong, const ClosedDelaunay& mesh) {
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

void PatchGrower::grow(Patches& patches, int number, const MovedCells& mesh, std::atomic<std::ptrdiff_t>& budget) {
  Patch::State state = Patch::waiting;
  if (!patches.list[number].state->compare_exchange_strong(state, Patch::growing)) return;
  patches_ = &patches;
  mesh_ = &mesh;
  budget_ = &budget;
  begin(number);
  while (goes_on()) {
    extend();
    if (!goes_on()) return;
    if (cut_out()) {
      *patch().state = Patch::found;
      return;
    }
    // It is too small.
    const std::size_t cells = patch().old.size();
    for (const FacetAt& f : patch().rim)
      if (const int n = mesh_->beyond(f).cell; mesh_->finite(mesh_->mesh.cells[n])) meet(n);
    if (patch().old.size() == cells) *patch().state = Patch::failed;
  }
}

void PatchGrower::begin(int number) {
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
void PatchGrower::extend() {
  Patch& p = patch();
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t i = 0; i < p.old.size(); ++i)
      for (int k = 0; k < 4; ++k) {
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
    for (int k = 0; k < 4; ++k)
      if (!has(mesh_->mesh.neighbours[c][k])) p.rim.push_back({c, k});
}

void PatchGrower::take_in(int cell) {
  if (has(cell)) return;
  cells_[cell] = stamp_;
  patch().old.push_back(cell);
  for (int n : mesh_->mesh.cells[cell]) insert(n);
  if (const auto more = mesh_->to_insert.find(cell); more != mesh_->to_insert.end())
    for (int n : more->second) insert(n);
}

void PatchGrower::meet(int cell) {
  const auto found = patches_->of.find(cell);
  if (found != patches_->of.end() && found->second != number_) {
    Patch& other = patches_->list[found->second];
    Patch::State state = Patch::waiting;
    if (other.state->compare_exchange_strong(state, Patch::yielded))
      for (int c : other.seed_cells) take_in(c);
    else if (state == Patch::found || (state == Patch::growing && found->second < number_))
      *patch().state = Patch::yielded;
  }
  take_in(cell);
}

void PatchGrower::insert(int point) {
  if (point < 0 || points_[point] == stamp_) return;
  points_[point] = stamp_;
  taken_.push_back(point);
  const auto v = vertex_of_[point] = t_.insert(mesh_->at[point], hint_);
  v->info() = point;
  hint_ = v->cell();
  if (--*budget_ < 0 || t_.number_of_vertices() != taken_.size()) *patch().state = Patch::failed;
}

MovedCells::Cell PatchGrower::corners_of(Handle cell) const {
  return {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()};
}

// The cell of the patch's triangulation on the side of the facet where the old cell is.
std::optional<PatchGrower::Inner> PatchGrower::within(const FacetAt& f) const {
  if (t_.dimension() < 3) return {};
  const auto facet = MovedCells::facet_of(mesh_->mesh.cells[f.cell], f.corner);
  std::array<Triangulation::Vertex_handle, 3> v;
  for (int i = 0; i < 3; ++i) {
    if (facet[i] < 0) return {};
    v[i] = vertex_of_[facet[i]];
  }
  Handle cell;
  int a, b, c;
  if (!t_.is_facet(v[0], v[1], v[2], cell, a, b, c)) return {};
  const int opposite = 6 - a - b - c;
  if (MovedCells::facet_of(corners_of(cell), opposite) == facet) return Inner{cell, opposite};
  const Handle other = cell->neighbor(opposite);
  return Inner{other, other->index(cell)};
}

// The facet may be part of the rim: the cell beyond leaves the new one within alone. One that has lost a corner others mend.
bool PatchGrower::holds(const FacetAt& f) const {
  const auto inner = within(f);
  if (!inner) return false;
  const FacetAt other = mesh_->beyond(f);
  const Cell& beyond = mesh_->mesh.cells[other.cell];
  if (MovedCells::lost_a_corner(beyond) || !mesh_->finite(beyond)) return true;
  return mesh_->positive(beyond) && !mesh_->in_conflict(beyond, inner->cell->vertex(inner->corner)->info());
}

// The cells within the rim. False if the patch is too small for its points.
bool PatchGrower::cut_out() {
  Patch& p = patch();
  std::vector<Cell> cells, neighbours;
  int count = 0;
  for (auto c : t_.all_cell_handles()) c->info() = count++;
  for (auto c : t_.all_cell_handles()) {
    cells.push_back(corners_of(c));
    neighbours.push_back(
        {c->neighbor(0)->info(), c->neighbor(1)->info(), c->neighbor(2)->info(), c->neighbor(3)->info()});
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

}  // namespace splashdown::fluid
