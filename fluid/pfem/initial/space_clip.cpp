// In 3D: walls cut the regions exactly (corefinement).
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <map>
#include <set>
#include <stdexcept>

#include "fluid/pfem/initial/space_parts.hpp"

namespace splashdown::fluid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Exact = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;

// What lies in one plane but for roundoff, as the bottom of a body on the floor does, is put into that plane: the strips between
// such faces have edges as long as the hull, and no mesh can fill the corner beside them.
class Aligner {
 public:
  explicit Aligner(double reach) : reach_(reach) {}
  // Each coordinate as that of an earlier vertex, if one is as near as roundoff.
  Vec<3> operator()(Vec<3> x) {
    for (int k = 0; k < 3; ++k) {
      const auto known = known_[k].lower_bound(x[k] - reach_);
      if (known != known_[k].end() && *known <= x[k] + reach_)
        x[k] = *known;
      else
        known_[k].insert(x[k]);
    }
    return x;
  }

 private:
  double reach_;  // [m]
  std::array<std::set<double>, 3> known_;
};

Exact exact(const Surface<3>& surface, const Isometry<3>& pose, Aligner& align) {
  Exact mesh;
  std::vector<Exact::Vertex_index> at;
  for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v) {
    const Vec<3> x = align(pose * Vec<3>(surface.vertices.col(v)));
    at.push_back(mesh.add_vertex({x.x(), x.y(), x.z()}));
  }
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    mesh.add_face(at[surface.facets(0, f)], at[surface.facets(1, f)], at[surface.facets(2, f)]);
  return mesh;
}

Exact cut_by_walls(const LiquidSpec<3>& liquid, const WallsAt<3>& walls) {
  constexpr double roundoff = 1e-12;  // of coordinates, over the liquid's size: that of a pose, many times over
  const auto& corners = liquid.boundary.vertices;
  Aligner align(roundoff * (corners.rowwise().maxCoeff() - corners.rowwise().minCoeff()).norm());
  Exact region = exact(liquid.boundary, Isometry<3>::Identity(), align);
  for (std::size_t w = 0; w < walls.walls.size(); ++w) {
    Exact wall = exact(walls.walls[w].spec().surface, walls.poses[w].pose(), align), cut;
    bool simple;
    if (walls.walls[w].encloses_fluid()) {
      pmp::reverse_face_orientations(wall);
      simple = pmp::corefine_and_compute_intersection(region, wall, cut);
    } else {
      simple = pmp::corefine_and_compute_difference(region, wall, cut);
    }
    if (!simple)
      throw std::invalid_argument("the liquid around '" + walls.walls[w].spec().name +
                                  "' would meet itself in an edge or a corner: move the body or the liquid a little");
    region = std::move(cut);
  }
  region.collect_garbage();
  return region;
}

}  // namespace

Surface<3> clipped(const LiquidSpec<3>& liquid, const WallsAt<3>& walls) {
  const Exact region = cut_by_walls(liquid, walls);
  Surface<3> surface;
  surface.vertices.resize(3, static_cast<Eigen::Index>(region.number_of_vertices()));
  surface.facets.resize(3, static_cast<Eigen::Index>(region.number_of_faces()));
  std::map<Exact::Vertex_index, int> at;
  for (auto v : region.vertices()) {
    const auto& p = region.point(v);
    const int k = at.emplace(v, static_cast<int>(at.size())).first->second;
    surface.vertices.col(k) << CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z());
  }
  int f = 0;
  for (auto face : region.faces()) {
    int k = 0;
    for (auto v : region.vertices_around_face(region.halfedge(face))) surface.facets(k++, f) = at[v];
    ++f;
  }
  return surface;
}

}  // namespace splashdown::fluid
