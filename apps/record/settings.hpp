// What a run shall leave behind: plain values, filled from a scene's [output] tables.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/record/sections/section_mass.hpp"
#include "apps/scene/patch_region.hpp"
#include "core/mirror.hpp"
#include "core/types.hpp"

namespace splashdown::apps {

/// Gauge pressure at a point; 0 where it is dry.
template <int d>
struct PressureProbe {
  std::string name;
  Vec<d> point;      ///< [m] world frame, or the frame of `body` (origin at its centre of mass)
  std::string body;  ///< the body it moves with; empty: stays in place
};

/// Height of the free surface on a vertical line, the highest crossing; nan where there is no water.
template <int d>
struct ElevationGauge {
  std::string name;
  Eigen::Matrix<double, d - 1, 1> at;  ///< horizontal position, world frame [m]
};

/// A number that is known without the run, written beside what is measured.
struct Signal {
  std::string name;
  std::function<double(double)> value;  ///< at a time [s]
};

/// A point of a body whose acceleration is wanted: an instrument, a seat.
template <int d>
struct EquipmentPoint {
  std::string name;
  std::string body;
  Vec<d> point;  ///< [m] body frame, origin at its centre of mass
};

/// Mean pressure on a part of a body's hull; its dry parts count with zero.
template <int d>
struct PressurePatch {
  std::string name;
  std::string body;
  PatchRegion<d> region;  ///< body frame, origin at the centre of mass
  double area = 0;        ///< of the hull in it [m, m^2]
  Isometry<d> pose =
      Isometry<d>::Identity();  ///< of the body at t = 0: of one that deforms a patch is what it is there
};

/// The highest pressure of the run at points all over a body's hull, written to hull_NAME.vtu.
template <int d>
struct HullMapRecord {
  std::string body;
  Surface<d> surface;  ///< body frame
  Isometry<d> pose;    ///< at t = 0: says what the keel is
  double size = 0;     ///< distance of the points [m]
};

/// Pressure along the wetted part of a wall, written to surface_pressure.csv.
struct SurfacePressureRecord {
  std::string wall;             ///< name of a body or a tank
  std::optional<double> every;  ///< [s]; 0: each step
  std::vector<double> times;    ///< [s]: first step at or after each
};

/// Instantaneous added mass of a body, written to added_mass.csv.
struct AddedMassRecord {
  std::string body;
  std::optional<double> every;  ///< [s]; 0: each step
  std::vector<double> times;    ///< [s]: first step at or after each
};

/// Residual of each pass of the coupling, written to passes.csv.
struct PassesRecord {
  std::optional<double> every;  ///< [s]; 0: each step
  std::vector<double> times;    ///< [s]: first step at or after each
};

/// Loads between the parts of a body at sections across an axis of its shape, written to section_loads.csv.
template <int d>
struct SectionRecord {
  struct Station {
    double place = 0;  ///< along the axis from the centre of mass [m]
    SectionMass mass;  ///< ahead of it
  };
  std::string name, body;
  int axis = 0;  ///< 0: x
  std::vector<Station> stations;
  double centre = 0;                ///< of mass, along the axis in the frame of the shape [m]
  Vec<d> gravity = Vec<d>::Zero();  ///< world frame [m/s^2]
  std::optional<double> every;      ///< [s]; 0: each step
  std::vector<double> times;        ///< [s]: first step at or after each
};

/// Velocity of the fluid along a line, written to velocity_lines.csv.
template <int d>
struct VelocityLineRecord {
  std::string name;
  std::vector<Vec<d>> points;    ///< world frame [m]
  std::optional<double> every;   ///< [s]; 0: each step
  std::vector<double> times;     ///< [s]: first step at or after each
  std::optional<Mirror> mirror;  ///< of a scene of which half is simulated: points behind it are told by their images
};

template <int d>
struct RecorderSettings {
  std::filesystem::path directory;
  double interval = 0;           ///< of rows in bodies.csv, fluid.csv, probes.csv [s]; 0: each step
  std::optional<double> frames;  ///< interval of frames [s], 0: each step; absent: no frames
  std::vector<PressureProbe<d>> pressure_probes;
  std::vector<ElevationGauge<d>> gauges;
  std::vector<Signal> signals;
  std::vector<EquipmentPoint<d>> equipment;
  std::vector<PressurePatch<d>> patches;
  std::vector<HullMapRecord<d>> hull_maps;
  std::vector<SurfacePressureRecord> surface_pressure;
  std::vector<AddedMassRecord> added_mass;
  std::optional<PassesRecord> passes;
  std::vector<SectionRecord<d>> sections;
  std::vector<VelocityLineRecord<d>> velocity_lines;
  /// Centres of mass of the bodies in the frames of their shapes [m], in which files give points of hulls; without: zero.
  std::map<std::string, Vec<d>> centre_of_mass;
  /// By body: horizontal axes along which symmetry of the scene forbids a load.
  std::map<std::string, std::vector<char>> symmetric;
  std::optional<double> still_water_level;  ///< [m]; absent: top of the free surface at the start
};

}  // namespace splashdown::apps
