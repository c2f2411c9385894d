// What people look at and no step needs.
#include "fluid/fluid_state.hpp"

namespace splashdown::fluid {

template <int d>
double Fluid<d>::density() const {
  return s_->spec.density;
}

template <int d>
std::span<const WallSpec<d>> Fluid<d>::walls() const {
  return s_->spec.walls;
}

template <int d>
double Fluid<d>::potential(const Vec<d>& point) const {
  double sum = 0;
  for (const auto& effect : s_->effects) sum += effect->potential(point);
  return sum;
}

template <int d>
std::vector<std::pair<std::string, double>> Fluid<d>::diagnostics() const {
  const auto& at = nodes();
  const std::vector<double> lumped_mass = nodal_sums(mesh(), at.size(), [&](std::size_t c) {
    const Mat<d> edges = edge_matrix<d>(corners(at.x, mesh().cells[c]));
    return s_->spec.density * edges.determinant() / factorial<d> / (d + 1);
  });
  std::vector<std::pair<std::string, double>> all;
  std::size_t booked = 0;
  for (const auto& effect : s_->effects) {
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
template double Fluid<2>::potential(const Vec<2>&) const;
template double Fluid<3>::potential(const Vec<3>&) const;
template std::vector<std::pair<std::string, double>> Fluid<2>::diagnostics() const;
template std::vector<std::pair<std::string, double>> Fluid<3>::diagnostics() const;

}  // namespace splashdown::fluid
