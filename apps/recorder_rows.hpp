// Columns of the csv files and how a row is filled. Files of 2D scenes have the columns of 3D ones.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "apps/csv.hpp"
#include "fluid/fluid.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::apps {

inline constexpr const char* bodies_header =
    "time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,ax,ay,az,alphax,alphay,alphaz,fx,fy,fz,mx,my,mz,wetted,"
    "fx_repair,fy_repair,fz_repair,mx_repair,my_repair,mz_repair";
inline constexpr const char* probes_header = "time,probe,value";

/// `effect_columns`: behind all others.
std::string fluid_header(const std::vector<std::string>& effect_columns);
std::string surface_pressure_header(int dimension);

template <int d>
struct BodyRow {
  double time;
  const std::string& body;
  rigid::Isometry<d> pose;
  rigid::Twist<d> velocity, acceleration;
  fluid::WallLoad<d> load;
};

struct FluidRow {
  double time, dt;
  std::size_t nodes, elements;
  const fluid::Ledger& ledger;
  int passes;
  double residual, wall_seconds;
  double max_speed;
  std::vector<double> effect_values;  ///< in the order of the header's effect columns
};

template <int d>
void write_row(CsvFile& file, const BodyRow<d>& row);
void write_row(CsvFile& file, const FluidRow& row);

}  // namespace splashdown::apps
