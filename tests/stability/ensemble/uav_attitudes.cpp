// The aircraft of examples/uav_landing meets the water at eight attitudes, as accidents do.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/surface/surface_file.hpp"
#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

struct Attitude {
  const char* name;
  double heading, pitch, roll;  ///< [deg]
  double dive;                  ///< direction of the motion below the horizontal [deg]
  Point spin;                   ///< [deg/s]
};

const std::array<Attitude, 8> attitudes{{
    {"nose dive", 0, -60, 0, 60, {0, 0, 0}},
    {"cartwheel", 0, 0, 60, 20, {0, 0, 200}},
    {"tail first", 180, 20, 0, 30, {0, 0, 0}},
    {"inverted", 0, 5, 180, 15, {0, 0, 0}},
    {"45 degrees of roll with yaw", 30, 5, 45, 15, {0, 0, 0}},
    {"flat, straight down", 0, 0, 0, 90, {0, 0, 0}},
    {"sideways", 90, 0, 10, 20, {0, 0, 0}},
    {"nose up, pitching down", 0, 30, 0, 20, {0, 60, 0}},
}};

}  // namespace

Member uav_attitude(std::uint64_t seed) {
  Random random("uav_attitudes", seed);
  const Attitude& a = attitudes[seed % attitudes.size()];
  const double speed = random.uniform(5, 25), size = random.pick({0.12, 0.15});
  const std::filesystem::path file = "examples/uav_landing/uav.stl";
  static const auto surface = read_surface_file(std::filesystem::path(SPLASHDOWN_SOURCE) / file).surface;

  const double degree = std::numbers::pi / 180;
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(a.heading * degree, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(-a.pitch * degree, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(a.roll * degree, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  const Eigen::Matrix3Xd x = R * surface.vertices;
  double hull = 0;  // volume of the cones from the origin to the facets
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    hull += x.col(surface.facets(0, f)).dot(x.col(surface.facets(1, f)).cross(x.col(surface.facets(2, f)))) / 6;
  const double length = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();

  Member m;
  m.what = fmt::format("{} at {:.3g} m/s, h={}", a.name, speed, size);
  const double along = speed * std::cos(a.dive * degree), down = speed * std::sin(a.dive * degree);
  const double end = rounded(std::min(0.5 * length / down, length / speed));
  const double W = rounded(1.5 * length + along * end), depth = rounded(length), ratio = 1.0 / 3;
  SceneText s;
  s.word("title", "UAV").set("dimension", 3.0);
  s.table("time").set("end", end);
  s.table("gravity");
  s.table("tank").set("min", Point{-W, -W, -depth}).set("max", Point{W, W, 2 * length});
  s.table("fluid").set("density", water);
  s.table("fluid.size").set("surface", 0.4).set("far", 0.8).set("growth", 0.3).set("curvature", 1.0);
  s.list("fluid.region").word("shape", "box").set("min", Point{-W, -W, -depth}).set("max", Point{W, W, 0});
  s.list("body").word("name", "uav").toml("shape", "{type = \"surface\", file = \"uav.stl\"}");
  // A centimetre over the water. The middle of the run is over the middle of the tank.
  s.set("density", water * ratio).set("position", Point{-along * end / 2, 0, 0.01 - x.row(2).minCoeff()});
  s.set("heading_deg", a.heading).set("pitch_deg", a.pitch).set("roll_deg", a.roll);
  s.set("velocity", Point{along, 0, -down}).set("spin_deg", a.spin).set("size", size);
  m.scene = s.text();
  m.files = {file};

  const double mass = water * ratio * hull;
  m.laws.energy = EnergyLaw{.bound = 0.03, .scale = 0.5 * mass * speed * speed};
  // The speed of the hull's fastest point; sheets leave a face that meets the water at 6 degrees (the wing's
  // dihedral and the belly) at pi / tan 6 times the speed normal to it (Wagner 1932).
  double spin = 0;
  for (const double w : a.spin) spin += std::abs(w) * degree;
  const double fastest = std::sqrt(std::pow(speed + spin * length / 2, 2) + 2 * g * length);
  m.laws.speed = SpeedLaw{.nodes = std::numbers::pi / std::tan(6 * degree) * fastest, .bodies = 1.02 * fastest};
  m.laws.volume = VolumeLaw{.bound = 0.02, .scale = hull};
  return m;
}

}  // namespace splashdown::ensemble
