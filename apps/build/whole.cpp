#include "apps/build/whole.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "apps/scene/mirror.hpp"

namespace splashdown::apps {
namespace {

/// Whether a number of an effect is a sum over the water or over time, by the name of its column.
bool is_sum(std::string_view name) {
  constexpr std::array<std::string_view, 4> sums{"_energy", "_power", "_work_rate", "work_of_effects"};
  return std::ranges::any_of(sums, [&](std::string_view sum) { return name.ends_with(sum); });
}

/// The axis of a force of an effect, by the name of its column; -1: it is none.
int force_axis(std::string_view name) {
  constexpr std::array<std::string_view, 3> forces{"_fx", "_fy", "_fz"};
  const auto found = std::ranges::find_if(forces, [&](std::string_view force) { return name.ends_with(force); });
  return found == forces.end() ? -1 : static_cast<int>(found - forces.begin());
}

Ledger twice(Ledger ledger) {
  for (double* sum : {&ledger.volume_initial, &ledger.volume, &ledger.time_integration, &ledger.remesh_created,
                      &ledger.remesh_deleted, &ledger.returned, &ledger.spray, &ledger.hull_chords,
                      &ledger.kinetic_energy, &ledger.potential_energy, &ledger.chord_energy, &ledger.energy_remesh,
                      &ledger.energy_repair, &ledger.work_on_walls, &ledger.work_of_effects, &ledger.volume_of_effects})
    *sum *= 2;
  return ledger;
}

}  // namespace

template <int d>
class Whole<d>::Fluid final : public FluidView<d> {
 public:
  Fluid(const Mirror& mirror, const FluidView<d>& half) : mirror_(mirror), half_(half) {
    for (const auto& wall : half.walls()) {
      auto& whole = walls_.emplace_back(wall);
      whole.surface = symmetrised<d>(in_frame<d>(mirror, wall.pose), wall.surface);
    }
  }
  /// At what is true now.
  void look() { ledger_ = twice(half_.ledger()); }

  double density() const override { return half_.density(); }
  std::span<const WallSpec<d>> walls() const override { return walls_; }
  std::span<const Isometry<d>> wall_poses() const override { return half_.wall_poses(); }
  std::span<const WallLoad<d>> loads() const override { return half_.loads(); }  // told as a whole by RecordInput
  std::span<const Vec<d>> points() const override { return half_.points(); }
  std::span<const std::array<int, d + 1>> cells() const override { return half_.cells(); }
  std::span<const Facet<d>> boundary() const override { return half_.boundary(); }
  PointPlace place(std::size_t point) const override { return half_.place(point); }
  std::optional<double> drop_volume(std::size_t point) const override { return half_.drop_volume(point); }
  std::span<const double> pressure() const override { return half_.pressure(); }
  std::span<const double> repair_pressure() const override { return half_.repair_pressure(); }
  const Ledger& ledger() const override { return ledger_; }
  Vec<d> velocity_n(std::size_t point) const override { return half_.velocity_n(point); }
  std::optional<double> pressure_at(const Vec<d>& point) const override {
    return half_.pressure_at(mirror_.distance<d>(point) < 0 ? mirror_.image<d>(point) : point);
  }
  double potential(const Vec<d>& point) const override { return half_.potential(point); }
  std::vector<Diagnostic> diagnostics() const override {
    auto all = half_.diagnostics();
    for (auto& [name, value] : all)
      if (const int axis = force_axis(name); axis >= 0)
        value *= axis == mirror_.axis ? 0 : 2;
      else if (is_sum(name))
        value *= 2;
    return all;
  }
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override { return 2 * half_.added_mass(walls); }

 private:
  Mirror mirror_;
  const FluidView<d>& half_;
  std::vector<WallSpec<d>> walls_;
  Ledger ledger_;
};

template <int d>
class Whole<d>::Bodies final : public BodiesView<d> {
 public:
  explicit Bodies(const BodiesView<d>& half) : half_(half) {
    for (std::size_t b = 0; b < half.size(); ++b) {
      auto& spec = specs_.emplace_back(half.spec(b));
      spec.mass *= 2;
      spec.inertia *= 2;
    }
  }
  std::size_t size() const override { return specs_.size(); }
  const BodySpec<d>& spec(std::size_t body) const override { return specs_.at(body); }
  const BodyState<d>& state(std::size_t body) const override { return half_.state(body); }
  /// Forces see the whole bodies themselves (rigid/forces/half.hpp).
  std::vector<Diagnostic> diagnostics() const override { return half_.diagnostics(); }

 private:
  const BodiesView<d>& half_;
  std::vector<BodySpec<d>> specs_;
};

template <int d>
Whole<d>::Whole(const Mirror& mirror, const FluidView<d>& fluid, const BodiesView<d>* bodies)
    : mirror_(mirror),
      fluid_(std::make_unique<Fluid>(mirror, fluid)),
      bodies_(bodies ? std::make_unique<Bodies>(*bodies) : nullptr) {}

template <int d>
Whole<d>::~Whole() = default;

template <int d>
RecordInput<d> Whole<d>::tell(RecordInput<d> input) const {
  fluid_->look();
  input.fluid = fluid_.get();
  input.bodies = bodies_.get();
  const Wrench<d> kept = 2 * mirror_.kept<d>();
  for (auto& load : input.body_load) {
    load.physical.array() *= kept.array();
    load.repair.array() *= kept.array();
    load.wetted *= 2;
  }
  return input;
}

template class Whole<2>;
template class Whole<3>;

}  // namespace splashdown::apps
