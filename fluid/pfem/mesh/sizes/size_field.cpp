#include "fluid/pfem/mesh/sizes/size_field.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {
namespace {
// Of distances, relative. In 2D exact ones cost next to nothing.
template <int d>
constexpr double slack = d == 2 ? 0.0 : 0.02;
}  // namespace

double size_at_bend(const SizeSpec& spec, double wall_size, double radius) {
  constexpr double least = 0.25;
  return std::max(spec.curvature * radius, least * wall_size);
}

template <int d>
std::vector<SizeSource<d>> spots_of(const SizeSpec& spec, const Wall<d>& wall, double wall_size) {
  std::vector<SizeSource<d>> spots;
  for (const auto& bend : wall.bends()) {
    const double size = size_at_bend(spec, wall.spec().size, bend.radius);
    if (size < wall_size) spots.push_back({bend.at, size});
  }
  if (spec.corner < 1 && !wall.encloses_fluid())
    for (int v : wall.corners())
      if (!wall.is_smooth(v)) spots.push_back({wall.spec().surface.vertices.col(v), spec.corner * wall_size});
  return spots;
}

template <int d>
SizeField<d>::SizeField(const SizeSpec& spec, const WallsAt<d>& walls, std::span<const double> wetted,
                        std::span<const Vec<d>> x, const Mesh<d>& mesh)
    : spec_(spec), walls_(walls), wall_size_(walls.walls.size()), points_(spec.growth) {
  for (std::size_t w = 0; w < wall_size_.size(); ++w) {
    // Half the wetted measure as a length: the half width of a wetted bottom, its mirror image included.
    const double images = walls.walls[w].spec().mirror ? 2 : 1;
    const double length = 0.5 * std::pow(images * wetted[w], 1.0 / (d - 1));
    wall_size_[w] = std::max(walls.walls[w].spec().size, spec.wetted_fraction * length);
  }
  find_spots();
  if (std::isfinite(spec.hollow)) find_hollows(x, mesh);
  points_.plant();
  if (spec.surface >= spec.far) return;  // the far size already resolves the surface
  std::vector<std::array<Vec<d>, d>> free;
  for (const auto& f : mesh.boundary)
    if (f.wall < 0) free.push_back(corners_of(f, x));
  surface_ = FacetTree<d>(free);
}

template <int d>
void SizeField<d>::find_spots() {
  std::vector<Source> found;
  for (std::size_t w = 0; w < wall_size_.size(); ++w)
    for (const Source& spot : spots_of(spec_, walls_.walls[w], wall_size_[w]))
      found.push_back({walls_.walls[w].carried(walls_.poses[w], spot.at), spot.size});
  add(std::move(found));
}

// Sources that others already imply are dropped.
template <int d>
void SizeField<d>::add(std::vector<Source> found) {
  std::sort(found.begin(), found.end(), [](const Source& a, const Source& b) { return a.size < b.size; });
  for (const Source& s : found)
    if (s.size < (*this)(s.at)) points_.add(s);
}

// Curvature along a facet's edge from the nodes' normals, (n_j - n_i).(x_j - x_i) / |x_j - x_i|^2, averaged
// at the nodes; negative where the liquid is hollow.
template <int d>
void SizeField<d>::find_hollows(std::span<const Vec<d>> x, const Mesh<d>& mesh) {
  const auto& boundary = mesh.boundary;
  std::vector<Vec<d>> normal(x.size(), Vec<d>::Zero());
  std::vector<double> curvature(x.size(), 0.0), edges(x.size(), 0.0);
  for (const auto& f : boundary)
    if (f.wall < 0)
      for (int n : f.nodes) normal[n] += area_vector_of<d>(f, x);
  for (const auto& f : boundary) {
    if (f.wall >= 0) continue;
    for (int k = 0; k < d; ++k) {
      const int i = f.nodes[k], j = f.nodes[(k + 1) % d];
      const Vec<d> e = x[j] - x[i];
      const double along = (normal[j].normalized() - normal[i].normalized()).dot(e) / e.squaredNorm();
      for (int n : {i, j}) curvature[n] += along, edges[n] += 1;
    }
  }
  // Thin sheets and spray, cells without an inner node, have no root to resolve.
  const std::vector<char> on_boundary = nodes_of(boundary, x.size());
  std::vector<char> bulk(x.size(), 0);
  for (const auto& cell : mesh.cells)
    if (std::any_of(cell.begin(), cell.end(), [&](int n) { return !on_boundary[n]; }))
      for (int n : cell) bulk[n] = 1;
  std::vector<Source> found;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!bulk[i] || edges[i] == 0 || curvature[i] >= 0) continue;
    const double size = std::max(spec_.hollow_min, -spec_.hollow * edges[i] / curvature[i]);
    if (size < (*this)(x[i])) found.push_back({x[i], size});
  }
  add(std::move(found));
}

template <int d>
double SizeField<d>::operator()(const Vec<d>& point, int on_wall) const {
  double h = spec_.far;
  for (std::size_t w = 0; w < wall_size_.size(); ++w) {
    const double reach = (h - wall_size_[w]) / spec_.growth;
    if (reach <= 0) continue;
    const Wall<d>& wall = walls_.walls[w];
    const double distance = d == 3 && static_cast<int>(w) == on_wall && !wall.ends_at_mirror()
                                ? 0.0
                                : wall.distance_of_solid(walls_.poses[w], point, reach, slack<d>);
    h = wall_size_[w] + spec_.growth * distance;
  }
  h = points_.least(point, h);
  const double reach = (h - spec_.surface) / spec_.growth;
  if (!surface_.empty() && reach > 0)
    h = spec_.surface + spec_.growth * std::sqrt(surface_.nearest(point, reach, slack<d>).squared_distance);
  return h;
}

template std::vector<SizeSource<2>> spots_of<2>(const SizeSpec&, const Wall<2>&, double);
template std::vector<SizeSource<3>> spots_of<3>(const SizeSpec&, const Wall<3>&, double);
template class SizeField<2>;
template class SizeField<3>;

}  // namespace splashdown::fluid
