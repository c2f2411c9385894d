// The water: its nodes, its mesh, the walls around it and the books on it. It is remeshed at t_n and takes in the motion that
// a step has found; what moves it, it does not know.
//
//   remesh    sizes, contact, nodes, the triangulation, which of its cells are water: `now` becomes `work`
//   accept    nodes at t_{n+1}, what they carry, what the mesh has made of their volume: `work` becomes `now`
#pragma once

#include <algorithm>
#include <array>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fluid/effects/effect.hpp"
#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/mesh/adapt/adapt.hpp"
#include "fluid/pfem/mesh/conservation/displaced_volume.hpp"
#include "fluid/pfem/mesh/conservation/free_water.hpp"
#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/timer.hpp"
#include "fluid/pfem/water/motion.hpp"

namespace splashdown::fluid {

/// Phases by their number in the timer; effects come after.
enum Phase : std::size_t { remesh, assemble, momentum, pressure, motion, first_effect };  ///< the others follow

/// What a checkpoint holds: everything at t_n that the next step is computed from.
template <int d>
struct Present {
  double time = 0, dt = 0;  ///< dt: of the step that led here
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<WallPlace<d>> poses;
  std::vector<WallVelocity<d>> velocity;  ///< of walls, at t_{n-1/2}
  std::vector<double> wetted;
  std::vector<double> chords;                 ///< by which hulls hold more than when the water closed around them
  std::vector<DisplacedVolume<d>> displaced;  ///< of walls, in this mesh; not in a checkpoint: it follows from the mesh
  double acceleration_dt = std::numeric_limits<double>::infinity();
  std::vector<Wrench<d>> resting_loads;  ///< on walls, of water that waits; empty: it does not
  Ledger ledger;
};

/// Edges that are short enough to be merged, or lie across a film, limit no time step.
template <int d>
double squared_length(const Present<d>& at, int i, int j) {
  const double short_edge = merge_below * std::min(at.nodes.h[i], at.nodes.h[j]);
  return std::max((at.nodes.x[i] - at.nodes.x[j]).squaredNorm(), short_edge * short_edge);
}

/// The water and its walls. One thread drives it; loops within run on all.
template <int d>
struct Water {
  FluidSpec<d> spec;
  std::vector<std::unique_ptr<Effect<d>>> effects;
  std::vector<Wall<d>> walls;
  WallLayout<d> layout;  ///< of the walls' coordinates
  PhaseTimer timer{{"mesh", "assemble", "momentum", "pressure", "move"}};

  Present<d> now;         ///< committed
  Present<d> work;        ///< now, remeshed
  bool prepared = false;  ///< work belongs to now
  MovingDelaunay<d> triangulation;
  FreeWater<d> free_water;                      ///< of the mesh of work
  typename FreeWater<d>::Moments free_carried;  ///< by it into the step
  FlatCells<d> flat_cells;                      ///< in the mesh of work (Recognised)

  /// Meshes the liquid at t = 0. Throws std::invalid_argument where walls leave none or its outline is no surface.
  Water(FluidSpec<d> spec, std::vector<std::unique_ptr<Effect<d>>> effects);

  /// The plane of symmetry that ends the fluid, if there is one.
  std::optional<Mirror> mirror() const {
    const auto with = std::ranges::find_if(spec.walls, [](const WallSpec<d>& wall) { return wall.mirror.has_value(); });
    return with == spec.walls.end() ? std::nullopt : with->mirror;
  }
  /// The walls at these poses.
  WallsAt<d> walls_at(const std::vector<WallPlace<d>>& poses) const { return {walls, poses}; }

  /// Where the walls are after `by` [s] with velocities s, from where `work` has them.
  std::vector<WallPlace<d>> moved_poses(std::span<const WallVelocity<d>> s, double by) const {
    std::vector<WallPlace<d>> out;
    for (std::size_t w = 0; w < walls.size(); ++w) out.push_back(walls[w].moved(work.poses[w], s[w], by));
    return out;
  }

  /// What all effects give to all water alike [m/s^2].
  Vec<d> gravity() const;
  /// Largest step that mesh, walls and effects allow from t_n [s].
  double stable_dt() const;

  // The mesh of a step (remesh.cpp).
  /// Remeshes `now` into `work`.
  void prepare();
  /// A node for which no step is short enough leaves the begun step's mesh as a drop.
  void let_fragment_fly(int node);

  // What a step has found (accept.cpp).
  /// Takes in a motion. `poses`: of the walls at t_{n+1}.
  void accept(const Motion<d>& motion, std::span<const WallPlace<d>> poses);

  // What lasts (checkpoint.cpp).
  /// Writes `now` and what effects remember.
  void save(std::ostream& out) const;
  /// Reads them. std::runtime_error for what is none of this scene: all stays as it was.
  void load(std::istream& in);

 private:
  /// Gives nodes the energy that the field has around them; that of all water [J].
  double hold_field_energy();
  /// Sets h of nodes from the size field.
  void size_nodes();
  /// Joins drops that touch, and drops in the liquid with it.
  void collect_drops();
  /// Nodes of cells first, in 3D along a space-filling curve; how many they are.
  std::size_t put_drops_last();
  /// The cells of the water. `liquid`: nodes that may be their corners, the first ones.
  void cut(std::size_t liquid);
  /// What nodes of a new mesh carry, and what its volume has changed by.
  void settle(double before);
  /// Whether effects leave momentum of an element's size alone within a step.
  bool is_inviscid(int node) const;
  /// Whether a contact line at this node stays within a quarter of `length` [m], its distance from a corner of its wall,
  /// for a step and for sqrt(h/g).
  bool rests_on_wall(int node, double length) const;
  /// Books volume and momentum of nodes that leave the mesh or come back to it.
  void book_spray(const std::vector<char>& was_spray);
  /// What nodes that go have carried passes to a neighbour that stays.
  void hand_over(const std::vector<char>& goes, const std::vector<std::array<int, d + 1>>& cells);

  // Hulls in the midst of the water (sunken.cpp).
  /// Books what the facets of sunken hulls enclose more or less at `poses`, in volume and potential energy.
  void follow_hulls(std::span<const WallPlace<d>> poses);
  /// Volume of the mesh and of the chords of sunken hulls [m^d].
  double water() const { return enclosed_volume(work.mesh.boundary, work.nodes.x) + work.ledger.hull_chords; }
};

extern template struct Water<2>;
extern template struct Water<3>;

}  // namespace splashdown::fluid
