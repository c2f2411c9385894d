#include "apps/record/sections/velocity_lines.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace splashdown::apps {

template <int d>
std::vector<std::optional<Vec<d>>> velocities_at(const FluidView<d>& fluid, const std::vector<Vec<d>>& points) {
  constexpr double edge = 1e-9;  // a point on an edge belongs to either cell
  std::vector<std::optional<Vec<d>>> found(points.size());
  Eigen::AlignedBox<double, d> box;
  for (const auto& point : points) box.extend(point);
  const auto places = fluid.points();
  for (const auto& cell : fluid.cells()) {
    const Vec<d>& origin = places[static_cast<std::size_t>(cell[0])];
    Eigen::AlignedBox<double, d> around(origin);
    Eigen::Matrix<double, d, d> edges;
    for (int k = 0; k < d; ++k) {
      const Vec<d>& corner = places[static_cast<std::size_t>(cell[static_cast<std::size_t>(k + 1)])];
      around.extend(corner);
      edges.col(k) = corner - origin;
    }
    if (!box.intersects(around)) continue;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (found[i] || !around.contains(points[i])) continue;
      const Vec<d> weights = edges.inverse() * (points[i] - origin);
      if (!(weights.minCoeff() >= -edge && weights.sum() <= 1 + edge)) continue;
      Vec<d> velocity = (1 - weights.sum()) * fluid.velocity_n(static_cast<std::size_t>(cell[0]));
      for (int k = 0; k < d; ++k)
        velocity += weights(k) * fluid.velocity_n(static_cast<std::size_t>(cell[static_cast<std::size_t>(k + 1)]));
      found[i] = velocity;
    }
  }
  return found;
}

template <int d>
void write_rows(CsvFile& file, double time, const VelocityLineRecord<d>& line, const FluidView<d>& fluid) {
  const auto is_image = [&](const Vec<d>& point) { return line.mirror && point(line.mirror->axis) < line.mirror->at; };
  auto points = line.points;
  for (auto& point : points)
    if (is_image(point)) point = line.mirror->template image<d>(point);
  const auto velocities = velocities_at<d>(fluid, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!velocities[i]) continue;
    const Vec<d>& place = line.points[i];
    Vec<d> velocity = *velocities[i];
    if (is_image(place)) velocity(line.mirror->axis) *= -1;
    file << time << line.name << (place - line.points.front()).norm();
    for (int k = 0; k < 3; ++k) file << (k < d ? place(std::min(k, d - 1)) : 0.);
    for (int k = 0; k < 3; ++k) file << (k < d ? velocity(std::min(k, d - 1)) : 0.);
    file.end_row();
  }
}

template std::vector<std::optional<Vec<2>>> velocities_at<2>(const FluidView<2>&, const std::vector<Vec<2>>&);
template std::vector<std::optional<Vec<3>>> velocities_at<3>(const FluidView<3>&, const std::vector<Vec<3>>&);
template void write_rows<2>(CsvFile&, double, const VelocityLineRecord<2>&, const FluidView<2>&);
template void write_rows<3>(CsvFile&, double, const VelocityLineRecord<3>&, const FluidView<3>&);

}  // namespace splashdown::apps
