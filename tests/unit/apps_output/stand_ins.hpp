// Stand-ins for the fluid and the bodies: a wedge that falls into a box of water, all in closed form, so that
// the recorder can be driven without a solver.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "apps/record/recorder.hpp"

namespace splashdown::apps {

/// A fluid that is what it is set to.
template <int d>
class DrawnFluid final : public FluidView<d> {
 public:
  std::vector<WallSpec<d>> made;
  std::vector<Isometry<d>> poses;
  std::vector<Vec<d>> x, v;
  std::vector<double> p;
  std::vector<PointPlace> places;
  std::vector<std::array<int, d + 1>> simplices;
  std::vector<Facet<d>> facets;
  std::size_t drops = 0;       ///< the last points
  double volume_of_drop = 0;   ///< [m^d]
  std::vector<double> repair;  ///< empty: none was made
  Ledger books;
  double gravity = 0;               ///< 0: no such effect
  std::vector<AtVertices<d>> bent;  ///< of walls, those that deform; empty: all are rigid

  double density() const override { return 1000; }
  std::span<const WallSpec<d>> walls() const override { return made; }
  std::span<const Isometry<d>> wall_poses() const override { return poses; }
  const AtVertices<d>* wall_vertices(std::size_t wall) const override { return bent.empty() ? nullptr : &bent[wall]; }
  std::span<const WallLoad<d>> loads() const override { return {}; }
  std::span<const Vec<d>> points() const override { return x; }
  std::span<const std::array<int, d + 1>> cells() const override { return simplices; }
  std::span<const Facet<d>> boundary() const override { return facets; }
  PointPlace place(std::size_t point) const override { return places[point]; }
  std::optional<double> drop_volume(std::size_t point) const override {
    return point + drops >= x.size() ? std::optional(volume_of_drop) : std::nullopt;
  }
  std::span<const double> pressure() const override { return p; }
  std::span<const double> repair_pressure() const override { return repair; }
  const Ledger& ledger() const override { return books; }
  Vec<d> velocity_n(std::size_t point) const override { return v[point]; }
  std::optional<double> pressure_at(const Vec<d>& point) const override {
    if (point(d - 1) > 0) return std::nullopt;
    return -density() * 9.81 * point(d - 1);
  }
  double potential(const Vec<d>& point) const override { return gravity * point(d - 1); }
  std::vector<std::pair<std::string, double>> diagnostics() const override {
    if (gravity == 0) return {};
    double energy = 0;
    for (const auto& cell : simplices)
      for (const int corner : cell)
        energy += density() * volume<d>(corners(x, cell)) / (d + 1) * potential(x[static_cast<std::size_t>(corner)]);
    return {{"gravity_energy", energy}};
  }
  Eigen::MatrixXd added_mass(std::span<const std::size_t> of) const override {
    Twist<d> mass = Twist<d>::Zero();
    for (int k = 0; k < freedoms<d>; ++k) mass(k) = 100 * (k + 1 + poses[of[0]].translation()(d - 1));
    return mass.asDiagonal();
  }
};

template <int d>
class DrawnBodies final : public BodiesView<d> {
 public:
  std::vector<BodySpec<d>> specs;
  std::vector<BodyState<d>> states;

  std::size_t size() const override { return specs.size(); }
  const BodySpec<d>& spec(std::size_t body) const override { return specs[body]; }
  const BodyState<d>& state(std::size_t body) const override { return states[body]; }
};

/// A wedge drop whose state is a function of time.
class StandInDrop {
 public:
  explicit StandInDrop(int nodes_across = 24);
  StandInDrop(const StandInDrop&) = delete;
  /// The state at t_n with the step that starts there.
  const RecordInput<2>& at(double time, double dt);
  static Surface<2> hull();  ///< body frame

 private:
  DrawnFluid<2> fluid_;
  DrawnBodies<2> bodies_;
  RecordInput<2> input_;
  int nodes_across_;
};

/// A box that lies on a block of water in three dimensions, pressed and turned about the vertical for a while.
class StandInPress {
 public:
  explicit StandInPress(int nodes_across = 8);
  StandInPress(const StandInPress&) = delete;
  const RecordInput<3>& at(double time, double dt);
  static Surface<3> hull();  ///< body frame

 private:
  DrawnFluid<3> fluid_;
  DrawnBodies<3> bodies_;
  RecordInput<3> input_;
};

inline constexpr double press_half_length = 0.5, press_half_height = 0.25;  ///< of the box; it is square from above
/// Pressure under the box above that of the water's weight [Pa].
double press_at(double time);

inline constexpr double wedge_half_breadth = 0.25, wedge_height = 0.144, water_depth = 0.6, tank_half_width = 0.8;
inline constexpr double drop_end = 0.03;

}  // namespace splashdown::apps
