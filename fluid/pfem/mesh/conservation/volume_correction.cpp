#include "fluid/pfem/mesh/conservation/volume_correction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fluid/pfem/mesh/conservation/shares.hpp"

namespace splashdown::fluid {
namespace {

constexpr double most = 0.5;  // of its reach that a surface moves by at once
constexpr int passes = 6;     // where that leaves more than this of a part's volume:
constexpr double worth = 1e-5;

/// Connected water.
struct Part {
  double volume = 0, owed = 0;
  double room = 0;    // volume by which it grows when its surface moves outwards by its reach
  double growth = 0;  // what it moves by, over that

  void grow() {
    const double before = growth;
    if (room > 0) growth = std::clamp(growth + owed / room, -most, most);
    owed -= (growth - before) * room;
  }
};

/// What parts have no room for goes to the largest one: shreds that a flip has cut off carry shares of cells larger than they
/// are. Water that a part has too much of is its own to lose, as far as it can: another's would stand still where this one flies.
void settle(std::vector<Part>& parts, bool last) {
  if (parts.empty()) return;
  Part& largest = *std::ranges::max_element(parts, {}, &Part::volume);
  double left = 0;
  for (Part& part : parts) {
    part.grow();
    if (&part != &largest && (last || part.owed > 0 || part.volume <= 0)) left += std::exchange(part.owed, 0.0);
  }
  largest.owed += left;
  largest.grow();
}

/// Kinetic energy of a part, over the density (volume_correction.hpp).
struct PartEnergy {
  double carried = 0, kept = 0, returning = 0;
  double share() const { return returning > 0 ? std::clamp((carried - kept) / returning, 0.0, 1.0) : 0.0; }
};

/// The free surface around each node: area vector and measure.
template <int d>
struct FreeSurface {
  std::vector<Vec<d>> area;
  std::vector<double> measure;

  FreeSurface(const Nodes<d>& nodes, const Mesh<d>& mesh)
      : area(nodes.size(), Vec<d>::Zero()), measure(nodes.size(), 0.0) {
    for (const auto& facet : mesh.boundary) {
      if (facet.wall >= 0) continue;
      const Vec<d> share = area_vector_of<d>(facet, nodes.x) / d;
      for (int n : facet.nodes) area[n] += share, measure[n] += share.norm();
    }
  }

  /// The way outwards of node i, as long as its reach: the water's thickness there, and no longer than its facets.
  Vec<d> outwards(std::size_t i, double volume) const {
    if (measure[i] <= 0) return Vec<d>::Zero();
    return std::min(volume / measure[i], std::pow(measure[i], 1.0 / (d - 1))) / measure[i] * area[i];
  }
};

/// Whether a node would come as near to a wall as it moves: contact is what the next step finds.
template <int d>
bool meets_wall(const WallsAt<d>& walls, const Vec<d>& from, const Vec<d>& to) {
  const double reach = (to - from).norm();
  for (std::size_t w = 0; w < walls.walls.size(); ++w) {
    const auto& wall = walls.walls[w];
    if (reach > 0 && wall.may_touch(walls.poses[w], to, reach) &&
        wall.nearest(walls.poses[w], to, reach).distance < reach)
      return true;
  }
  return false;
}

/// Where nodes may move, and the cells that change with them.
template <int d>
class NearSurface {
 public:
  NearSurface(const Nodes<d>& nodes, const Mesh<d>& mesh)
      : moves_(nodes.size(), 0), changes_(nodes.size(), 0), mesh_(mesh) {
    for (const auto& facet : mesh.boundary)
      for (int n : facet.nodes)
        if (facet.wall < 0 && !nodes.spray[n] && nodes.tie[n].wall < 0) moves_[n] = 1;
    const auto has = [](const std::array<int, d + 1>& cell, const std::vector<char>& flag) {
      return std::any_of(cell.begin(), cell.end(), [&](int n) { return flag[n] != 0; });
    };
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      if (!has(mesh.cells[c], moves_)) continue;
      moving_.push_back(static_cast<int>(c));
      for (int n : mesh.cells[c]) changes_[n] = 1;
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      if (has(mesh.cells[c], changes_)) beside_.push_back(static_cast<int>(c));
  }

  bool may_move(std::size_t i) const { return moves_[i] != 0; }

  /// Nodes that would squash a cell stay where they are.
  void keep_order(const std::vector<Vec<d>>& x, std::vector<Vec<d>>& moved) const {
    constexpr double least = 0.5;  // of a cell's volume
    for (bool again = true; again;) {
      again = false;
      for (int c : moving_) {
        const auto& cell = mesh_.cells[c];
        if (std::all_of(cell.begin(), cell.end(), [&](int n) { return moved[n] == x[n]; })) continue;
        if (volume<d>(corners(moved, cell)) >= least * volume<d>(corners(x, cell))) continue;
        for (int n : cell) moved[n] = x[n];
        again = true;
      }
    }
  }

  /// What nodal_volumes(mesh, x) is, given what it was before these nodes moved.
  void renew(const std::vector<Vec<d>>& x, std::vector<double>& volumes) const {
    for (std::size_t i = 0; i < volumes.size(); ++i)
      if (changes_[i]) volumes[i] = 0;
    for (int c : beside_) {
      const double share = volume<d>(corners(x, mesh_.cells[c])) / (d + 1);
      for (int n : mesh_.cells[c])
        if (changes_[n]) volumes[n] += share;
    }
  }

 private:
  std::vector<char> moves_, changes_;  // of nodes
  std::vector<int> moving_, beside_;   // cells with a node that may move; with one whose volume changes
  const Mesh<d>& mesh_;
};

/// The places of a part's surface that may move, and the nodes there.
template <int d>
struct PartSurface {
  std::vector<int> nodes;
  std::vector<SurfacePlace<d>> places;
};

template <int d>
struct Books {
  Nodes<d>& nodes;
  const Mesh<d>& mesh;
  const WallsAt<d>& walls;
  const std::vector<int>& part;
  const NearSurface<d> near{nodes, mesh};

  /// Of nodes in the growth of their part: its centre of mass stays where it was. `outwards`: as far as they move at most.
  std::vector<double> shares(const std::vector<double>& volumes, const std::vector<Part>& parts,
                             const std::vector<Vec<d>>& outwards, const FreeSurface<d>& surface) const {
    const std::size_t count = nodes.size();
    std::vector<Vec<d>> lost(count, Vec<d>::Zero());  // volume times place
    std::map<int, PartSurface<d>> surfaces;
    for (std::size_t i = 0; i < count; ++i) {
      if (nodes.spray[i] || !(std::abs(parts[part[i]].owed) > worth * std::abs(parts[part[i]].volume))) continue;
      lost[part[i]] += (nodes.volume[i] + nodes.owed[i] - volumes[i]) * nodes.x[i];
      if (!near.may_move(i)) continue;
      surfaces[part[i]].nodes.push_back(static_cast<int>(i));
      surfaces[part[i]].places.push_back({nodes.x[i], outwards[i].dot(surface.area[i])});
    }
    std::vector<double> shares(count, 1.0);
    for (const auto& [k, surface_of_part] : surfaces) {
      const auto of_part = shares_about<d>(lost[k] / parts[k].owed, surface_of_part.places);
      for (std::size_t j = 0; j < of_part.size(); ++j) shares[surface_of_part.nodes[j]] = of_part[j];
    }
    return shares;
  }

  /// Moves the surface, and books what comes back with it, if a part is owed anything, or `worth` behind the first pass. In the
  /// first one by shares; what these leave comes back everywhere. In the last one what a part cannot lose the largest one does.
  bool grow(const std::vector<double>& volumes, int pass) {
    const bool first = pass == 0, last = pass + 1 == passes;
    const double least = first ? 0 : worth;
    const std::size_t count = nodes.size();
    std::vector<Part> parts(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (nodes.spray[i]) continue;
      parts[part[i]].volume += volumes[i];
      parts[part[i]].owed += nodes.volume[i] + nodes.owed[i] - volumes[i];
    }
    if (std::ranges::none_of(parts, [&](const Part& p) { return std::abs(p.owed) > least * p.volume; })) return false;
    const FreeSurface<d> surface(nodes, mesh);
    std::vector<Vec<d>> outwards(count, Vec<d>::Zero());
    for (std::size_t i = 0; i < count; ++i) {
      if (!near.may_move(i)) continue;
      outwards[i] = surface.outwards(i, volumes[i]);
      parts[part[i]].room += outwards[i].dot(surface.area[i]);
    }
    const auto share = first ? shares(volumes, parts, outwards, surface) : std::vector<double>(count, 1.0);
    settle(parts, last);
    std::vector<Vec<d>> moved = nodes.x;
    for (std::size_t i = 0; i < count; ++i) {
      const Part& p = parts[part[i]];
      if (nodes.spray[i]) continue;
      const double more = p.volume > 0 ? (p.growth * p.room + p.owed) / p.volume : 0.0;
      nodes.owed[i] = volumes[i] * (1 + more) - nodes.volume[i];
      if (!near.may_move(i)) continue;
      const Vec<d> to = nodes.x[i] + std::clamp(p.growth * share[i], -most, most) * outwards[i];
      if (!meets_wall(walls, nodes.x[i], to)) moved[i] = to;
    }
    near.keep_order(nodes.x, moved);
    nodes.x = std::move(moved);
    return true;
  }
};

/// Velocities with what has come back: `volumes` have become `now`.
template <int d>
void slow_down(Nodes<d>& nodes, const FreeWater<d>& free, std::span<const double> carried,
               std::span<const double> volumes, std::span<const double> now) {
  const std::vector<int>& part = free.part();
  const auto moments = free.moments(volumes, nodes.v);
  const auto mean = [&](std::size_t i) {
    return moments.empty() ? Vec<d>(Vec<d>::Zero()) : free.kept(i, moments[part[i]].mean_velocity());
  };
  std::vector<PartEnergy> energies(nodes.size());
  std::vector<double> its_own(nodes.size(), 0.0);  // of what a node gains, what it had carried
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.spray[i]) continue;
    const double of_volume = 0.5 * (nodes.v[i] - mean(i)).squaredNorm(), before = std::max(0.0, volumes[i]);
    its_own[i] = std::max(0.0, std::min(carried[i], now[i]) - before);
    PartEnergy& e = energies[part[i]];
    e.carried += carried[i] * of_volume;
    e.kept += std::clamp(now[i], 0.0, before) * of_volume;
    e.returning += its_own[i] * of_volume;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const double before = std::max(0.0, volumes[i]); now[i] > before) {
      const Vec<d> w = mean(i);
      const double moving = before + energies[part[i]].share() * its_own[i];
      nodes.v[i] = w + std::sqrt(moving / now[i]) * (nodes.v[i] - w);
    }
}

}  // namespace

template <int d>
std::vector<double> return_volume(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                                  const FreeWater<d>& free, const std::vector<double>& volumes,
                                  std::span<const double> carried) {
  const std::vector<int>& part = free.part();
  std::vector<double> now = volumes;
  Books<d> books{nodes, mesh, walls, part};
  for (int pass = 0; pass < passes && books.grow(now, pass); ++pass) books.near.renew(nodes.x, now);
  slow_down<d>(nodes, free, carried, volumes, now);
  return now;
}

template std::vector<double> return_volume(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, const FreeWater<2>&,
                                           const std::vector<double>&, std::span<const double>);
template std::vector<double> return_volume(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, const FreeWater<3>&,
                                           const std::vector<double>&, std::span<const double>);

}  // namespace splashdown::fluid
