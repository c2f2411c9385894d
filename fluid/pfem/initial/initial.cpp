#include "fluid/pfem/initial/initial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fluid/pfem/contact/attachment.hpp"
#include "fluid/pfem/initial/gaps.hpp"
#include "fluid/pfem/initial/parts.hpp"
#include "fluid/pfem/mesh/adapt/adapt.hpp"
#include "fluid/pfem/mesh/sizes/narrow_strips.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

// While nodes are still few, cells are large for their size field and only the outline tells what is fluid.
constexpr Alpha outline_decides{std::numeric_limits<double>::infinity(), 0.0, 0.0};
// Until the node spacing no longer changes visibly; Mesh_3 has done most of it in 3D.
template <int d>
constexpr int smoothing_sweeps = d == 2 ? 30 : 4;

bool stays_anywhere(int, double) { return true; }

[[noreturn]] void refuse_nothing() {
  throw std::invalid_argument("no liquid: every region lies outside the tank or inside a body");
}

template <int d>
class Filler {
 public:
  Filler(const FluidSpec<d>& spec, const WallsAt<d>& walls)
      : spec_(spec), walls_(walls), dry_(walls.walls.size(), 0.0) {}

  InitialLiquid<d> run() {
    for (const auto& liquid : spec_.liquids) outline<d>(liquid, spec_, walls_, out_);
    if (out_.nodes.size() == 0) refuse_nothing();
    refine();
    if constexpr (d == 3) refuse_holes(out_, spec_.liquids, walls_);
    set_velocities();
    return std::move(out_);
  }

 private:
  // Of several regions that counts whose outline contains the node, or is nearest to it.
  void set_velocities() {
    const auto& liquids = spec_.liquids;
    if (std::none_of(liquids.begin(), liquids.end(), [](const auto& liquid) { return bool(liquid.velocity); })) return;
    const auto outlines = liquids.size() > 1 ? outlines_of<d>(liquids) : std::vector<Wall<d>>{};
    for (std::size_t i = 0; i < out_.nodes.size(); ++i) {
      const Vec<d>& x = out_.nodes.x[i];
      double best = std::numeric_limits<double>::max();
      std::size_t in = 0;
      for (std::size_t k = 0; k < outlines.size(); ++k) {
        const Wall<d>& wall = outlines[k];
        const double distance =
            wall.nearest(Isometry<d>::Identity(), x, 2 * wall.box().diagonal().norm() + 1e3).distance;
        if (distance < best) best = distance, in = k;
      }
      out_.nodes.v[i] = liquids[in].velocity ? liquids[in].velocity(x) : Vec<d>::Zero();
    }
  }

  void refine() {
    std::vector<double>& h = out_.nodes.h;
    auto sizes = [&] {
      const SizeField<d> field(spec_.size, walls_, dry_, out_.nodes.x, out_.mesh);
      in_parallel(h.size(), [&](std::size_t i) { h[i] = field(out_.nodes.x[i]); });
      if constexpr (d == 3) resolve_narrow_strips(out_.nodes, out_.mesh, stays_anywhere);
    };
    sizes();
    const std::vector<WallVelocity<d>> at_rest(walls_.walls.size(), Twist<d>::Zero());
    attach_nodes<d>(out_.nodes, out_.mesh, walls_, at_rest, 0);
    sizes();
    for (int sweep = 0, settled = 0; settled < smoothing_sweeps<d>; ++sweep) {
      if (spec_.while_meshing) spec_.while_meshing();
      cut();
      if (d == 3 && sweep == 0) sizes();  // strips are known now
      if (settled + 1 == smoothing_sweeps<d>) break;
      const auto report = adapt<d>(out_.nodes, out_.mesh, walls_, stays_anywhere);
      const bool quiet = report.inserted + report.removed < 1 + static_cast<int>(h.size()) / 200;
      if (quiet || sweep > 60) ++settled;
      if (report.inserted + report.removed > 0) cut();
      smooth();
      sizes();
    }
    // What has come to pass a crease between its nodes, and cuts a piece of the wall off, gets a node there. Few pass twice.
    constexpr int most_rounds = 5;
    for (int round = 0; round < most_rounds && attach_nodes<d>(out_.nodes, out_.mesh, walls_, at_rest, 0); ++round) {
      sizes();
      cut();
    }
  }

  // What is water, without inner nodes that keep the triangulation from a wall, then without those that smoothing pushed through
  // one: they have no cell, and are no drops either. As long as the boundary is the old one its nodes stay.
  void cut() {
    for (;;) {
      auto found = recognise<d>(out_.nodes, out_.mesh.boundary, walls_, outline_decides);
      std::vector<char> goes(out_.nodes.size(), 0);
      for (int n : found.piercing) goes[n] = 1;
      if (found.piercing.empty()) {
        goes = out_.nodes.spray;
        out_.mesh = std::move(found);
      }
      if (!discard(goes, out_.nodes, out_.mesh.boundary)) return;
    }
  }

  // Inner nodes move towards the mean of their neighbours, weighted by how far apart they should be.
  void smooth() {
    auto& x = out_.nodes.x;
    const auto& h = out_.nodes.h;
    std::vector<Vec<d>> push(x.size(), Vec<d>::Zero());
    std::vector<double> weight(x.size(), 0.0);
    const std::vector<char> fixed = nodes_of(out_.mesh.boundary, x.size());
    for (const auto& cell : out_.mesh.cells)
      for (int a = 0; a <= d; ++a)
        for (int b = 0; b <= d; ++b) {
          if (a == b) continue;
          const int i = cell[a], j = cell[b];
          const Vec<d> e = x[i] - x[j];
          const double target = 0.5 * (h[i] + h[j]);
          push[i] += e * (target / e.norm() - 1.0);
          weight[i] += 1;
        }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!fixed[i] && weight[i] > 0) x[i] += 1.2 * push[i] / weight[i];
  }

  const FluidSpec<d>& spec_;
  const WallsAt<d>& walls_;
  const std::vector<double> dry_;
  InitialLiquid<d> out_;
};

}  // namespace

template <int d>
WallTie tie_at(const Vec<d>& x, const WallsAt<d>& walls) {
  for (std::size_t w = 0; w < walls.walls.size(); ++w) {
    const double tiny = on_wall * walls.walls[w].box().diagonal().norm();
    const auto near = walls.walls[w].nearest(walls.poses[w], x, 2 * tiny);
    if (std::abs(near.distance) < tiny)
      return {static_cast<int>(w), near.sharp() ? -1 : near.patch, near.vertex, near.crease};
  }
  return {};
}

template <int d>
std::optional<Gap> look_at_start(const FluidSpec<d>& spec, const WallsAt<d>& walls) {
  std::optional<Gap> narrowest;
  bool is_empty = true;
  for (const auto& liquid : spec.liquids) {
    const auto [nothing, gap] = sketch<d>(liquid, spec, walls);
    is_empty = is_empty && nothing;
    if (gap && (!narrowest || gap->width * narrowest->size < narrowest->width * gap->size)) narrowest = gap;
  }
  if (is_empty) refuse_nothing();
  return narrowest;
}

template <int d>
InitialLiquid<d> fill(const FluidSpec<d>& spec, const WallsAt<d>& walls) {
  return Filler<d>(spec, walls).run();
}

template WallTie tie_at(const Vec<2>&, const WallsAt<2>&);
template WallTie tie_at(const Vec<3>&, const WallsAt<3>&);
template std::optional<Gap> look_at_start(const FluidSpec<2>&, const WallsAt<2>&);
template std::optional<Gap> look_at_start(const FluidSpec<3>&, const WallsAt<3>&);
template InitialLiquid<2> fill(const FluidSpec<2>&, const WallsAt<2>&);
template InitialLiquid<3> fill(const FluidSpec<3>&, const WallsAt<3>&);

}  // namespace splashdown::fluid
