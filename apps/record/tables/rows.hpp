// Columns of the csv files and how a row is filled. Files of 2D scenes have the columns of 3D ones.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "apps/files/csv.hpp"
#include "core/bodies_view.hpp"
#include "core/fluid_view.hpp"
#include "core/solids_view.hpp"

namespace splashdown::apps {

inline constexpr const char* bodies_header =
    "time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,ax,ay,az,alphax,alphay,alphaz,fx,fy,fz,mx,my,mz,wetted,"
    "fx_repair,fy_repair,fz_repair,mx_repair,my_repair,mz_repair,roll_deg,pitch_deg,heading_deg,submergence";
inline constexpr const char* probes_header = "time,probe,value";
/// x, y, z: in the undeformed body at t = 0, world frame.
inline constexpr const char* elastic_header =
    "time,body,strain_energy,kinetic_energy,potential_energy,dissipated_energy,clamp_work,"
    "von_mises,von_mises_x,von_mises_y,von_mises_z";

/// `effect_columns`: behind all others.
std::string fluid_header(const std::vector<std::string>& effect_columns);
/// x, y, z: world frame; x_body, ...: frame of the body's shape.
/// Of lines, joints and contacts: their columns behind the time.
std::string forces_header(const std::vector<std::string>& columns);
std::string surface_pressure_header(int dimension);
/// The upper triangle by rows. Indices: x, y, z for translations, p, q, r for rotations about them (2D: x, y, r).
std::string added_mass_header(int dimension);

template <int d>
struct BodyRow {
  double time;
  const std::string& body;
  Isometry<d> pose;
  Twist<d> velocity, acceleration;
  WallLoad<d> load;
  double submergence;  ///< of the lowest point below still water, negative above; nan without water [m]
};

template <int d>
struct ElasticRow {
  double time;
  const std::string& body;
  Deformation<d> now;
};

struct FluidRow {
  double time, dt;
  std::size_t nodes, elements;
  const Ledger& ledger;
  int passes;
  double residual, wall_seconds;
  double max_speed;
  double energy_gain;                 ///< energy_statistics.hpp [J, J/m]
  std::vector<double> effect_values;  ///< in the order of the header's effect columns
};

template <int d>
void write_row(CsvFile& file, const BodyRow<d>& row);
void write_row(CsvFile& file, const FluidRow& row);
template <int d>
void write_row(CsvFile& file, const ElasticRow<d>& row);
/// `matrix`: as Fluid::added_mass of one wall, in the world frame; `pose` of the wall.
template <int d>
void write_added_mass_row(CsvFile& file, double time, const std::string& body, const Eigen::MatrixXd& matrix,
                          const Isometry<d>& pose);

}  // namespace splashdown::apps
