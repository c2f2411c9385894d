// A body of a scene as an elastic solid.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/effects/elastic/elastic.hpp"
#include "elastic/assembly/solid.hpp"
#include "elastic/mesh/inner_lines.hpp"

namespace splashdown::elastic {
template <int d>
struct SolidSpec;
template <int d>
struct SolidGoal;
}  // namespace splashdown::elastic

namespace splashdown::apps {

/// What may stand for `law` and `scheme`, in the order of docs/scene.md.
std::vector<std::string> elastic_laws();
std::vector<std::string> elastic_schemes();
/// What may be looked at in a point.
std::vector<std::string> elastic_signals();

/// The mesh of a shape in space, made once for equal shapes and sizes, and how long that took [s]. Throws elastic::MeshError.
struct MeshInSpace {
  elastic::SolidMesh<3> mesh;
  double seconds = 0;
};
MeshInSpace mesh_in_space(const Body& body, const ElasticTable& table);
/// What density makes the mass of: meshes of shapes in space enclose less than the shape, by their chords.
template <int d>
double meshed_volume(const Body& body, const ElasticTable& table, const elastic::SolidMesh<d>& mesh);
/// Of what is no part [kg/m^3].
template <int d>
double density_of(const Body& body, const ElasticTable& table, const elastic::SolidMesh<d>& mesh);
/// Undeformed, in the shape's frame. Throws elastic::MeshError.
template <int d>
elastic::SolidMesh<d> solid_mesh(const Body& body, const ElasticTable& table);
/// Throws std::invalid_argument for moduli that no solid has; axes in the world frame at t = 0.
template <int d>
std::unique_ptr<const elastic::Law<d>> solid_law(const Body& body, const ElasticMaterial& material);
/// The number of each cell's material: 0 of the body's own, else one more than that of the last part that covers the middle
/// of the cell.
template <int d>
std::vector<int> parts_of(const ElasticTable& table, const elastic::SolidMesh<d>& mesh);
/// Lines along which elements of the plane lie: outlines of parts.
elastic::InnerLines lines_of(const ElasticTable& table);
/// Whether a clamp covers a point of the shape's frame, but for roundoff.
bool covers(const ElasticRegion& clamp, const Point& point, double roundoff);
/// Whether a clamp holds what it covers along an axis of the world.
bool holds(const ElasticClamp& clamp, int axis);
/// Whether any of the boundary is loaded; mesh in the shape's frame.
template <int d>
bool meets_boundary(const ElasticPatch& patch, const elastic::SolidMesh<d>& mesh);
/// Of a body at a time: all [[body.force]] tables and patches [N, N/m]; empty: there are none. `mesh`: in the shape's frame.
template <int d>
std::function<elastic::Field(double)> solid_loads(const Scene& scene, const ElasticTable& table,
                                                  const elastic::Solid<d>& solid, const elastic::SolidMesh<d>& mesh);
/// The place of a point of the shape's frame in the mesh; within a thousandth of the extent beside it.
template <int d>
std::optional<elastic::Place<d>> place_in(const elastic::SolidMesh<d>& mesh, const Point& point);

/// The solid in the world frame at t = 0 with clamps and point masses.
template <int d>
std::unique_ptr<elastic::Solid<d>> make_solid(const Body& body, const ElasticTable& table);
/// The same on a mesh of its own, in the shape's frame.
template <int d>
std::unique_ptr<elastic::Solid<d>> make_solid(const Body& body, const ElasticTable& table,
                                              const elastic::SolidMesh<d>& mesh);
/// What is asked of it; `mesh` in the shape's frame.
template <int d>
std::vector<elastic::SolidGoal<d>> solid_goals(const Body& body, const ElasticTable& table,
                                               const elastic::SolidMesh<d>& mesh);
/// `solid_loads` on any mesh of the body at a time.
template <int d>
std::function<elastic::Field(const elastic::Solid<d>&, double)> loads_on(const Scene& scene, const ElasticTable& table);
/// The mesh of a body, refined for its goals as often as its table says, in the shape's frame: of displacements in equilibrium
/// with the loads of the run's end. Throws elastic::MeshError, and std::runtime_error where there is no equilibrium.
template <int d>
elastic::SolidMesh<d> goal_mesh(const Scene& scene, const ElasticTable& table);
/// The surface that a fluid meets: facets between all nodes of the solid's boundary, world frame at t = 0.
template <int d>
Surface<d> solid_surface(const Body& body, const ElasticTable& table);
/// Of all elastic bodies of a scene, with its gravity and its forces; with walls where there is a fluid.
template <int d>
std::vector<elastic::SolidSpec<d>> solid_specs(const Scene& scene);

}  // namespace splashdown::apps
