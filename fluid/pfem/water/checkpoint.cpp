// What of a fluid a checkpoint holds, written as it is and read as if nobody vouched for it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "core/stored.hpp"
#include "fluid/pfem/mesh/parts.hpp"
#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {
namespace {

/// Both ways of a checkpoint: values as they lie in memory, lists with their lengths.
struct Saver {
  std::ostream& out;
  template <class T>
  void value(const T& v) {
    out.write(reinterpret_cast<const char*>(&v), sizeof v);
  }
  template <class T>
  void list(const std::vector<T>& values) {
    value(static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  }
  /// Poses and twists; then, of walls that deform, places and velocities of their vertices.
  template <int d>
  void walls(const std::vector<WallPlace<d>>& places, const std::vector<WallVelocity<d>>& velocities) {
    std::vector<Isometry<d>> poses;
    std::vector<Twist<d>> twists;
    for (const auto& place : places) poses.push_back(place.pose());
    for (const auto& velocity : velocities) twists.push_back(velocity.rigid);
    list(poses), list(twists);
    for (std::size_t w = 0; w < places.size(); ++w) {
      if (!places[w].shape()) continue;
      for (const Vec<d> x : places[w].shape()->vertices.colwise()) value(x);
      AtVertices<d> of_vertices = velocities[w].vertices;
      if (of_vertices.size() == 0) of_vertices.setZero(d, places[w].shape()->vertices.cols());
      for (const Vec<d> v : of_vertices.colwise()) value(v);
    }
  }
};

template <int d>
struct Loader {
  std::istream& in;
  const std::vector<Wall<d>>& of;
  template <class T>
  void value(T& v) const {
    in.read(reinterpret_cast<char*>(&v), sizeof v);
  }
  template <class T>
  void list(std::vector<T>& values) const {
    values.resize(stored_count(in, sizeof(T)));
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  }
  void walls(std::vector<WallPlace<d>>& places, std::vector<WallVelocity<d>>& velocities) const {
    std::vector<Isometry<d>> poses;
    std::vector<Twist<d>> twists;
    list(poses), list(twists);
    places.assign(poses.begin(), poses.end());
    velocities.assign(twists.begin(), twists.end());
    for (std::size_t w = 0; w < std::min({of.size(), places.size(), velocities.size()}); ++w) {
      if (!of[w].spec().deforms) continue;
      AtVertices<d> x(d, of[w].spec().surface.vertices.cols()), v(d, x.cols());
      for (auto numbers : {&x, &v})
        in.read(reinterpret_cast<char*>(numbers->data()),
                static_cast<std::streamsize>(numbers->size() * sizeof(double)));
      if (!in || !x.allFinite()) throw std::runtime_error("the water's state is damaged or of another scene");
      places[w] = of[w].shaped(std::move(x));
      velocities[w] = WallVelocity<d>::at_vertices(std::move(v));
    }
  }
};

template <class Stream, class State>
void archive_present(Stream stream, State& s) {
  stream.value(s.time), stream.value(s.dt), stream.value(s.acceleration_dt), stream.value(s.ledger);
  stream.list(s.nodes.x), stream.list(s.nodes.v), stream.list(s.nodes.p), stream.list(s.nodes.compression);
  stream.list(s.nodes.tie), stream.list(s.nodes.surface), stream.list(s.nodes.separates);
  stream.list(s.nodes.spray), stream.list(s.nodes.volume), stream.list(s.nodes.owed), stream.list(s.nodes.h),
      stream.list(s.nodes.wall_pressure);
  stream.list(s.mesh.cells), stream.list(s.mesh.boundary);
  stream.walls(s.poses, s.velocity);
  stream.list(s.wetted), stream.list(s.chords), stream.list(s.resting_loads);
}

template <class T>
bool all_finite(const std::vector<T>& values) {
  return std::ranges::all_of(values, [](const auto& v) {
    if constexpr (std::is_arithmetic_v<T>)
      return std::isfinite(v);
    else
      return v.allFinite();
  });
}

/// Throws std::runtime_error unless every index and number is one that a step can begin with.
template <int d>
void check(const Present<d>& s, const std::vector<Wall<d>>& walls) {
  const Nodes<d>& nodes = s.nodes;
  const std::size_t count = nodes.size(), wall_count = walls.size();
  bool good = count > 0 && std::isfinite(s.time) && std::isfinite(s.dt) && s.acceleration_dt > 0;
  for (const std::size_t size :
       {nodes.v.size(), nodes.p.size(), nodes.tie.size(), nodes.surface.size(), nodes.separates.size(),
        nodes.spray.size(), nodes.volume.size(), nodes.owed.size(), nodes.h.size(), nodes.wall_pressure.size()})
    good = good && size == count;
  good = good && (nodes.compression.empty() || nodes.compression.size() == count) &&
         std::ranges::all_of(nodes.compression, [](const auto& c) {
           return std::ranges::all_of(c.pressure, [](double p) { return std::isfinite(p); }) && std::isfinite(c.rate) &&
                  c.density > 0;
         });
  good = good && s.poses.size() == wall_count && s.velocity.size() == wall_count && s.wetted.size() == wall_count &&
         s.chords.size() == wall_count && (s.resting_loads.empty() || s.resting_loads.size() == wall_count);
  good = good && all_finite(nodes.x) && all_finite(nodes.v) && all_finite(nodes.p) && all_finite(nodes.volume) &&
         all_finite(nodes.wall_pressure) && all_finite(nodes.owed) && all_finite(s.velocity) && all_finite(s.wetted) &&
         all_finite(s.chords) && all_finite(s.resting_loads) &&
         std::ranges::all_of(nodes.h, [](double h) { return h > 0 && std::isfinite(h); });
  constexpr double roundoff = 1e-6;  // of rotations, far above what they gather
  for (const auto& place : s.poses)
    good = good && place.pose().matrix().allFinite() && place.linear().isUnitary(roundoff);
  const auto is_node = [&](int i) { return i >= 0 && static_cast<std::size_t>(i) < count; };
  for (const auto& cell : s.mesh.cells) good = good && std::ranges::all_of(cell, is_node);
  for (const auto& facet : s.mesh.boundary)
    good = good && std::ranges::all_of(facet.nodes, is_node) && facet.wall >= -1 &&
           facet.wall < static_cast<int>(wall_count);
  for (const auto& tie : nodes.tie) {
    if (!good) break;
    good = tie.wall >= -1 && tie.wall < static_cast<int>(wall_count) && (tie.wall < 0 || walls[tie.wall].has(tie));
  }
  if (!good) throw std::runtime_error("the water's state is damaged or of another scene");
}

}  // namespace

template <int d>
void Water<d>::save(std::ostream& out) const {
  archive_present(Saver{out}, now);
  for (const auto& effect : effects)
    for (const double number : effect->memory()) Saver{out}.value(number);
}
template <int d>
void Water<d>::load(std::istream& in) {
  Present<d> loaded;
  const Loader<d> loader{in, walls};
  archive_present(loader, loaded);
  std::vector<double> remembered;  // of all effects
  for (const auto& effect : effects)
    for (std::size_t k = effect->memory().size(); k > 0; --k) loader.value(remembered.emplace_back());
  if (!in) throw std::runtime_error("ends in the middle of the water's state");
  check(loaded, walls);
  if (!all_finite(remembered)) throw std::runtime_error("the water's state is damaged or of another scene");
  auto next = remembered.begin();
  for (const auto& effect : effects)
    for (double& number : effect->memory()) number = *next++;
  now = std::move(loaded);
  now.nodes.vertex.assign(now.nodes.size(), -1);
  now.nodes.inherited.assign(now.nodes.size(), {});
  now.nodes.field_energy.assign(now.nodes.size(), 0.0);
  now.displaced = displaced_volumes(now.mesh, now.nodes.x, walls.size(), mirror());
  now.nodes.part = parts_of(now.mesh, now.nodes.size());
  prepared = false;
}

template struct Water<2>;
template struct Water<3>;

}  // namespace splashdown::fluid
