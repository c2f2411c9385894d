#include "apps/record/sections/section_loads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/record/view.hpp"
#include "apps/record/wall_facets.hpp"
#include "apps/scene/patch_region.hpp"

namespace splashdown::apps {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int d>
Vector3d embedded(const Vec<d>& v) {
  Vector3d all = Vector3d::Zero();
  all.template head<d>() = v;
  return all;
}

/// The turning part of a twist or a wrench, body axes.
template <int d>
Vector3d turning(const Twist<d>& twist, const Mat<d>& to_body) {
  if constexpr (d == 2)
    return {0, 0, twist(2)};
  else
    return to_body * twist.template tail<3>();
}

Matrix3d skew(const Vector3d& w) {
  Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

/// Of the water on a part of the hull, about the centre of mass, body axes.
struct WaterLoad {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  double area = 0;  ///< [m, m^2]

  void operator+=(const WaterLoad& other) {
    force += other.force;
    moment += other.moment;
    area += other.area;
  }
};

template <int d>
using Piece = patch_detail::Piece<d>;

/// Linear pressure p over simplices of n corners x_i: integral p = A mean p, integral p x = A (sum x sum p + sum p x) / (n (n + 1)).
template <int d>
WaterLoad load_on(const Piece<d>& piece) {
  WaterLoad load;
  for (std::size_t k = d - 1; k < piece.size; ++k) {
    std::array<Vec<d>, d> simplex;
    Vec<d> places = Vec<d>::Zero(), weighted = Vec<d>::Zero();
    double pressures = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const auto& corner = piece.corners[j == 0 ? 0 : k + j + 1 - d];
      simplex[j] = corner.template head<d>();
      places += simplex[j];
      weighted += corner(d) * simplex[j];
      pressures += corner(d);
    }
    const Vec<d> area = area_vector(simplex);
    load.force += embedded<d>(area) * (pressures / d);
    load.moment += embedded<d>((pressures * places + weighted) / (d * (d + 1))).cross(embedded<d>(area));
    load.area += area.norm();
  }
  return load;
}

/// Wet facets of the body's hull with their pressures, body frame; those of halves with their mirror images.
template <int d>
std::vector<Piece<d>> wet_pieces(const RecordInput<d>& input, std::size_t body) {
  const auto& fluid = *input.fluid;
  const auto wall = static_cast<int>(body);  // body k is wall k
  const auto points = fluid.points();
  const auto pressure = fluid.pressure(), repair = fluid.repair_pressure();
  const auto& mirror = fluid.walls()[body].mirror;
  const Isometry<d> to_body = input.bodies->state(body).pose.inverse();
  std::vector<Piece<d>> pieces;
  const auto add = [&](const Facet<d>& facet, bool image) {
    auto& piece = pieces.emplace_back();
    for (int k = 0; k < d; ++k) {
      const auto node = static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(image ? d - 1 - k : k)]);
      const Vec<d> x = image ? mirror->template image<d>(points[node]) : points[node];
      typename Piece<d>::Corner corner;
      corner << to_body * x, pressure[node] + (repair.empty() ? 0 : repair[node]);
      piece.add(corner);
    }
  };
  for (const auto& facet : fluid.boundary()) {
    if (facet.wall != wall) continue;
    add(facet, false);
    if (mirror) add(facet, true);
  }
  return pieces;
}

/// Where a facet lies on the axis, from its lowest corner to its highest, and whether it looks back: what it bounds lies ahead of it.
struct Reach {
  double low = INFINITY, high = -INFINITY;
  bool looks_back = false;
};

template <int d>
Reach reach_of(const Piece<d>& piece, int axis) {
  Reach reach;
  std::array<Vec<d>, d> corners;
  for (std::size_t k = 0; k < d; ++k) {
    corners[k] = piece.corners[k].template head<d>();
    reach.low = std::min(reach.low, corners[k](axis));
    reach.high = std::max(reach.high, corners[k](axis));
  }
  reach.looks_back = area_vector(corners)(axis) > 0;  // into the body
  return reach;
}

/// Ahead of each station, and all of it behind these. A facet that lies in a section, as the ends of a box do, counts as what it bounds.
template <int d>
std::vector<WaterLoad> water_ahead(const SectionRecord<d>& record, const std::vector<Piece<d>>& pieces) {
  const Vec<d> axis = Vec<d>::Unit(record.axis);
  std::vector<WaterLoad> ahead(record.stations.size() + 1);
  double near = 0;  // roundoff of a turn to the body's frame and back
  for (const auto& station : record.stations) near = std::max(near, 1e-9 * std::abs(station.place));
  for (const auto& piece : pieces) {
    const auto whole = load_on<d>(piece);
    const auto [low, high, looks_back] = reach_of<d>(piece, record.axis);
    ahead.back() += whole;
    for (std::size_t i = 0; i < record.stations.size(); ++i) {
      const double station = record.stations[i].place;
      if (station < low - near || (station < low + near && (high > station + near || looks_back)))
        ahead[i] += whole;
      else if (station < high - near)
        ahead[i] += load_on<d>(patch_detail::cut<d>(piece, {-axis, -station}));
    }
  }
  return ahead;
}

/// What the facets do not account for goes with their area.
template <int d>
void spread_rest(std::vector<WaterLoad>& ahead, const Wrench<d>& total, const Mat<d>& to_body) {
  const auto whole = ahead.back();
  if (!(whole.area > 0)) return;
  const Vector3d force = embedded<d>(Vec<d>(to_body * total.template head<d>())) - whole.force,
                 moment = turning<d>(total, to_body) - whole.moment;
  for (auto& load : ahead) {
    load.force += force * (load.area / whole.area);
    load.moment += moment * (load.area / whole.area);
  }
}

/// Sum of r x (B r) dm for B r r^T dm.
Vector3d axial(const Matrix3d& b) { return {b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1)}; }

/// Up along the section: the body's last axis, across which it bends; the first one for an upright axis.
template <int d>
Vector3d up_of(int axis) {
  if constexpr (d == 2) return axis == 0 ? Vector3d::UnitY() : Vector3d(-Vector3d::UnitX());
  return axis == 2 ? Vector3d::UnitX() : Vector3d::UnitZ();
}

}  // namespace

template <int d>
std::vector<SectionLoad> section_loads(const SectionRecord<d>& record, const RecordInput<d>& input) {
  const auto b = body_index(*input.bodies, record.body);
  const Mat<d> to_body = input.bodies->state(b).pose.linear().transpose();
  auto water = water_ahead<d>(record, wet_pieces<d>(input, b));
  spread_rest<d>(water, input.body_load[b].total(), to_body);
  const Vector3d spin = turning<d>(input.body_velocity_n[b], to_body);
  const Matrix3d turn = skew(turning<d>(input.body_acceleration_n[b], to_body)) + skew(spin) * skew(spin);
  const Vec<d> acceleration = input.body_acceleration_n[b].template head<d>();
  const Vector3d felt = embedded<d>(Vec<d>(to_body * (record.gravity - acceleration)));
  const Vector3d axis = embedded<d>(Vec<d>(Vec<d>::Unit(record.axis))), up = up_of<d>(record.axis);
  std::vector<SectionLoad> loads;
  for (std::size_t i = 0; i < record.stations.size(); ++i) {
    const auto& [place, mass] = record.stations[i];
    auto& load = loads.emplace_back();
    load.station = place + record.centre;
    load.force = water[i].force + mass.mass * felt - turn * mass.first;
    load.moment =
        water[i].moment + mass.first.cross(felt) - axial(turn * mass.second) - (place * axis).cross(load.force);
    load.shear = load.force.dot(up);
    load.bending = -load.moment.dot(axis.cross(up));
  }
  return loads;
}

void write_rows(CsvFile& file, double time, const std::string& record, const std::vector<SectionLoad>& loads) {
  for (const auto& load : loads) {
    file << time << record << load.station;
    for (const auto* vector : {&load.force, &load.moment})
      for (int k = 0; k < 3; ++k) file << (*vector)(k);
    file << load.shear << load.bending;
    file.end_row();
  }
}

void SectionExtremes::offer(double time, const std::vector<SectionLoad>& loads) {
  for (const auto& load : loads) {
    if (std::abs(load.shear) > std::abs(shear_.value)) shear_ = {load.shear, time, load.station};
    if (load.bending > hogging_.value) hogging_ = {load.bending, time, load.station};
    if (load.bending < sagging_.value) sagging_ = {load.bending, time, load.station};
  }
}

template std::vector<SectionLoad> section_loads<2>(const SectionRecord<2>&, const RecordInput<2>&);
template std::vector<SectionLoad> section_loads<3>(const SectionRecord<3>&, const RecordInput<3>&);

}  // namespace splashdown::apps
