#include "tests/stability/ensemble/release.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>
#include <string>

#include "apps/quantity/table.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::ensemble {

namespace {

double first_of(const quantity::Table& table, const std::string& column) {
  const auto* const values = table.find(column);
  if (values == nullptr || values->empty()) throw std::runtime_error("there is no value of " + column);
  return values->front();
}

template <int d>
double error(const std::filesystem::path& run, const apps::Scene& scene, double displaced) {
  constexpr int n = d + rigid::rotations<d>;
  using Matrix = Eigen::Matrix<double, n, n>;
  const auto body = apps::mass_properties<d>(scene.bodies.front());
  const Eigen::Matrix<double, d, d> R = apps::rotation<d>(scene.bodies.front().attitude);
  const std::string axes = d == 2 ? "xyr" : "xyzpqr";
  const quantity::Table added = quantity::read_table(run, "added_mass.csv"),
                        moved = quantity::read_table(run, "bodies.csv");

  Matrix M = Matrix::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j) {
      const auto at = [&](int k) { return axes[static_cast<std::size_t>(k)]; };
      M(i, j) = M(j, i) = first_of(added, std::string("m_") + at(i) + at(j));
    }
  M.template topLeftCorner<d, d>().diagonal().array() += body.mass;
  M.template bottomRightCorner<rigid::rotations<d>, rigid::rotations<d>>() += body.inertia;
  Eigen::Matrix<double, n, 1> wrench = Eigen::Matrix<double, n, 1>::Zero();
  wrench.template head<d>() = (displaced - body.mass) * g * R.transpose() * Eigen::Matrix<double, d, 1>::Unit(d - 1);
  // A hull without mass and without friction turns about its axis of symmetry as it likes: least squares leave that
  // at rest.
  const Eigen::Matrix<double, n, 1> a = M.completeOrthogonalDecomposition().solve(wrench);
  const Eigen::Matrix<double, d, 1> expected = R * a.template head<d>();
  Eigen::Matrix<double, d, 1> found;
  for (int k = 0; k < d; ++k) found(k) = first_of(moved, std::string("a") + "xyz"[k]);
  return (found - expected).norm() / expected.norm();
}

}  // namespace

std::optional<ReleaseLaw> release_law(double viscosity, double size, double thickness, double liquid) {
  const double layer = std::sqrt(viscosity / water * 0.1 * std::sqrt(size / g));
  if (layer >= 0.01 * thickness) return std::nullopt;
  return ReleaseLaw{.water = liquid};
}

double release_error(const std::filesystem::path& run, double water_volume) {
  const auto scene = apps::read_scene(run / "scene.resolved.toml").scene;
  const double displaced = water * (water_volume - first_of(quantity::read_table(run, "fluid.csv"), "volume"));
  return scene.dimension == 2 ? error<2>(run, scene, displaced) : error<3>(run, scene, displaced);
}

}  // namespace splashdown::ensemble
