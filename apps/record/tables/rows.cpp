#include "apps/record/tables/rows.hpp"

#include <cmath>

#include "apps/statistics/attitude.hpp"

namespace splashdown::apps {

namespace {

/// Linear and angular part of a planar or spatial twist or wrench, as x y z, x y z.
template <int d>
std::array<double, 6> spatial(const Eigen::Matrix<double, freedoms<d>, 1>& planar_or_spatial) {
  const auto& t = planar_or_spatial;
  if constexpr (d == 2)
    return {t(0), t(1), 0, 0, 0, t(2)};
  else
    return {t(0), t(1), t(2), t(3), t(4), t(5)};
}

template <int d>
std::array<double, 4> quaternion(const Isometry<d>& pose) {
  if constexpr (d == 2) {
    const double half = 0.5 * std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
    return {std::cos(half), 0, 0, std::sin(half)};
  } else {
    const Eigen::Quaterniond q(pose.linear());
    return {q.w(), q.x(), q.y(), q.z()};
  }
}

template <std::size_t n>
void put(CsvFile& file, const std::array<double, n>& values) {
  for (const double value : values) file << value;
}

}  // namespace

std::string fluid_header(const std::vector<std::string>& effect_columns) {
  std::string header =
      "time,dt,nodes,elements,volume,kinetic_energy,potential_energy,passes,residual,wall_seconds,"
      "max_speed,volume_time_integration,volume_remesh_created,volume_remesh_deleted,volume_returned,volume_spray,"
      "energy_remesh,energy_repair,work_on_walls,energy_gain";
  for (const auto& column : effect_columns) header += "," + column;
  return header;
}

std::string forces_header(const std::vector<std::string>& columns) {
  std::string header = "time";
  for (const auto& column : columns) header += "," + column;
  return header;
}

std::string surface_pressure_header(int dimension) {
  return dimension == 2 ? "time,body,x,y,s,p,x_body,y_body,p_repair"
                        : "time,body,x,y,z,s,p,x_body,y_body,z_body,p_repair";
}

std::string added_mass_header(int dimension) {
  const std::string axes = dimension == 2 ? "xyr" : "xyzpqr";
  std::string header = "time,body";
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = i; j < axes.size(); ++j) header += std::string(",m_") + axes[i] + axes[j];
  return header;
}

template <int d>
void write_row(CsvFile& file, const BodyRow<d>& row) {
  std::array<double, 3> position{};
  for (int k = 0; k < d; ++k) position[static_cast<std::size_t>(k)] = row.pose.translation()(k);
  file << row.time << row.body;
  put(file, position);
  put(file, quaternion<d>(row.pose));
  put(file, spatial<d>(row.velocity));
  put(file, spatial<d>(row.acceleration));
  put(file, spatial<d>(row.load.total()));
  file << row.load.wetted;
  put(file, spatial<d>(row.load.repair));
  put(file, attitude_deg<d>(row.pose.linear()));
  file << row.submergence;
  file.end_row();
}

void write_row(CsvFile& file, const FluidRow& row) {
  const auto& ledger = row.ledger;
  file << row.time << row.dt << row.nodes << row.elements << ledger.volume << ledger.kinetic_energy
       << ledger.potential_energy << row.passes << row.residual << row.wall_seconds << row.max_speed
       << ledger.time_integration << ledger.remesh_created << ledger.remesh_deleted << ledger.returned << ledger.spray
       << ledger.energy_remesh << ledger.energy_repair << ledger.work_on_walls << row.energy_gain;
  for (const double value : row.effect_values) file << value;
  file.end_row();
}

template <int d>
void write_row(CsvFile& file, const ElasticRow<d>& row) {
  const auto& now = row.now;
  std::array<double, 3> at{};
  for (int k = 0; k < d; ++k) at[static_cast<std::size_t>(k)] = now.at(k);
  file << row.time << row.body << now.strain_energy << now.kinetic_energy << now.potential_energy << now.dissipated
       << now.clamp_work << now.von_mises;
  put(file, at);
  file.end_row();
}

// Velocities in body axes are s_world = T s_body, T = diag(R, 1) or diag(R, R); the energy s^T G s stays: T^T G T.
template <int d>
void write_added_mass_row(CsvFile& file, double time, const std::string& body, const Eigen::MatrixXd& matrix,
                          const Isometry<d>& pose) {
  constexpr int m = freedoms<d>;
  Eigen::Matrix<double, m, m> turn = Eigen::Matrix<double, m, m>::Identity();
  for (int k = 0; k + d <= m; k += d) turn.template block<d, d>(k, k) = pose.linear();
  const Eigen::Matrix<double, m, m> in_body = turn.transpose() * matrix * turn;
  file << time << body;
  for (int i = 0; i < m; ++i)
    for (int j = i; j < m; ++j) file << 0.5 * (in_body(i, j) + in_body(j, i));  // symmetric but for roundoff
  file.end_row();
}

template void write_added_mass_row<2>(CsvFile&, double, const std::string&, const Eigen::MatrixXd&, const Isometry<2>&);
template void write_added_mass_row<3>(CsvFile&, double, const std::string&, const Eigen::MatrixXd&, const Isometry<3>&);
template void write_row<2>(CsvFile&, const BodyRow<2>&);
template void write_row<3>(CsvFile&, const BodyRow<3>&);
template void write_row<2>(CsvFile&, const ElasticRow<2>&);
template void write_row<3>(CsvFile&, const ElasticRow<3>&);

}  // namespace splashdown::apps
