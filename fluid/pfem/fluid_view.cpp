// What people look at and no step needs.
#include "fluid/pfem/fluid_state.hpp"

namespace splashdown::fluid {

template <int d>
double Fluid<d>::density() const {
  return s_->water.spec.density;
}

template <int d>
std::span<const WallSpec<d>> Fluid<d>::walls() const {
  return s_->water.spec.walls;
}

template <int d>
std::span<const Vec<d>> Fluid<d>::points() const {
  return nodes().x;
}

template <int d>
std::span<const std::array<int, d + 1>> Fluid<d>::cells() const {
  return mesh().cells;
}

template <int d>
std::span<const Facet<d>> Fluid<d>::boundary() const {
  return mesh().boundary;
}

template <int d>
PointPlace Fluid<d>::place(std::size_t node) const {
  const auto& at = nodes();
  const auto& tie = at.tie[node];
  return {tie.wall, tie.vertex >= 0, at.surface[node] != 0};
}

template <int d>
std::optional<double> Fluid<d>::drop_volume(std::size_t node) const {
  const auto& at = nodes();
  return at.spray[node] ? std::optional(at.volume[node]) : std::nullopt;
}

template <int d>
double Fluid<d>::potential(const Vec<d>& point) const {
  double sum = 0;
  for (const auto& effect : s_->water.effects) sum += effect->potential(point);
  return sum;
}

template <int d>
std::vector<std::pair<std::string, double>> Fluid<d>::diagnostics() const {
  const auto& at = nodes();
  const std::vector<double> lumped_mass = nodal_sums(mesh(), at.size(), [&](std::size_t c) {
    const Mat<d> edges = edge_matrix<d>(corners(at.x, mesh().cells[c]));
    return s_->water.spec.density * edges.determinant() / factorial<d> / (d + 1);
  });
  std::vector<std::pair<std::string, double>> all;
  std::size_t booked = 0;
  for (const auto& effect : s_->water.effects) {
    for (const auto& [name, value] : effect->diagnostics(at, lumped_mass))
      all.emplace_back(effect->name() + "_" + name, value);
    if (!effect->books_work()) continue;
    const auto& powers = s_->result.power_of_effects;
    all.emplace_back(effect->name() + "_work_rate", booked < powers.size() ? powers[booked] : 0.0);
    ++booked;
  }
  if (booked > 0) all.emplace_back("work_of_effects", ledger().work_of_effects);
  return all;
}

template double Fluid<2>::density() const;
template double Fluid<3>::density() const;
template std::span<const WallSpec<2>> Fluid<2>::walls() const;
template std::span<const WallSpec<3>> Fluid<3>::walls() const;
template std::span<const Vec<2>> Fluid<2>::points() const;
template std::span<const Vec<3>> Fluid<3>::points() const;
template std::span<const std::array<int, 3>> Fluid<2>::cells() const;
template std::span<const std::array<int, 4>> Fluid<3>::cells() const;
template std::span<const Facet<2>> Fluid<2>::boundary() const;
template std::span<const Facet<3>> Fluid<3>::boundary() const;
template PointPlace Fluid<2>::place(std::size_t) const;
template PointPlace Fluid<3>::place(std::size_t) const;
template std::optional<double> Fluid<2>::drop_volume(std::size_t) const;
template std::optional<double> Fluid<3>::drop_volume(std::size_t) const;
template double Fluid<2>::potential(const Vec<2>&) const;
template double Fluid<3>::potential(const Vec<3>&) const;
template std::vector<std::pair<std::string, double>> Fluid<2>::diagnostics() const;
template std::vector<std::pair<std::string, double>> Fluid<3>::diagnostics() const;

}  // namespace splashdown::fluid
