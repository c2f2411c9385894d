// Light hulls from files, in space: convex ones with random corners, prisms with hollow sides, an aircraft; free,
// hinged, in piles.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/surface/surface_file.hpp"
#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/random.hpp"
#include "tests/stability/ensemble/release.hpp"
#include "tests/stability/ensemble/scene_text.hpp"

namespace splashdown::ensemble {

namespace {

using Eigen::Vector3d;

struct Hull {
  std::string kind;
  std::vector<Vector3d> corners{};
  std::vector<std::array<std::size_t, 3>> facets{};  ///< outward
  double shortest = 0;                               ///< [m]
  double lightness = 8;                              ///< water that it displaces over its least added mass, at most

  Vector3d normal(const std::array<std::size_t, 3>& f) const {
    return (corners[f[1]] - corners[f[0]]).cross(corners[f[2]] - corners[f[0]]);
  }
  /// Cones from the origin to the facets.
  double volume() const {
    double sum = 0;
    for (const auto& f : facets) sum += corners[f[0]].dot(normal(f)) / 6;
    return sum;
  }
  std::string stl() const {
    std::string text = "solid hull\n";
    for (const auto& f : facets) {
      const Vector3d n = normal(f).normalized();
      text += fmt::format("facet normal {:.6g} {:.6g} {:.6g}\nouter loop\n", n.x(), n.y(), n.z());
      for (const std::size_t i : f)
        text += fmt::format("vertex {:.6g} {:.6g} {:.6g}\n", corners[i].x(), corners[i].y(), corners[i].z());
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid hull\n";
  }
};

Vector3d rounded(const Vector3d& x) {
  return {ensemble::rounded(x.x()), ensemble::rounded(x.y()), ensemble::rounded(x.z())};
}

/// The convex hull of points in general position: a triple is a facet if all others are on one side of it.
Hull hull_of(std::vector<Vector3d> points) {
  Hull hull{.kind = "polyhedron", .corners = std::move(points)};
  const auto& x = hull.corners;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j)
      for (std::size_t k = j + 1; k < x.size(); ++k) {
        const Vector3d n = hull.normal({i, j, k});
        bool above = false, below = false;
        double width = 0;
        for (const Vector3d& y : x) {
          const double side = n.dot(y - x[i]);
          if (&y == &x[i] || &y == &x[j] || &y == &x[k]) continue;
          above |= side > 0, below |= side < 0;
          width = std::max(width, std::abs(side) / n.norm());
        }
        if (above && below) continue;
        hull.facets.push_back(below ? std::array{i, j, k} : std::array{i, k, j});
        hull.shortest = hull.shortest > 0 ? std::min(hull.shortest, width) : width;
      }
  return hull;
}

/// Corners on an ellipsoid, no two of them near each other; at least a quarter as thick as it is long.
Hull polyhedron(Random& random, double L) {
  const int corners = random.integer(5, 12);
  const Vector3d axes = 0.5 * L * Vector3d(1, random.uniform(0.5, 1), random.uniform(0.35, 0.8));
  // As far apart as n points can nearly be: each has a cap of a third of its share of the sphere to itself.
  const double apart = std::sqrt(16.0 / (3 * corners));
  for (;;) {
    std::vector<Vector3d> directions, points;
    for (int tries = 0; tries < 1000 && static_cast<int>(directions.size()) < corners; ++tries) {
      const double z = random.uniform(-1, 1), turn = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
      const Vector3d d(r * std::cos(turn), r * std::sin(turn), z);
      if (std::all_of(directions.begin(), directions.end(), [&](const Vector3d& o) { return (o - d).norm() > apart; }))
        directions.push_back(d);
    }
    if (static_cast<int>(directions.size()) < corners) continue;
    for (const Vector3d& d : directions) points.push_back(rounded(axes.cwiseProduct(d)));
    Hull hull = hull_of(points);
    if (hull.shortest > 0.25 * L) return hull;
  }
}

/// A star of three to six points, extruded: edges that turn inwards, and sharp ones beside them.
Hull star(Random& random, double L) {
  const int tips = random.integer(3, 6);
  const double outer = 0.5 * L, inner = random.uniform(0.45, 0.8) * outer, half = 0.5 * random.uniform(0.35, 0.8) * L;
  Hull hull{.kind = fmt::format("star of {}", tips)};
  for (const double z : {-half, half}) {
    for (int i = 0; i < 2 * tips; ++i) {
      const double r = i % 2 ? inner : outer, angle = std::numbers::pi * i / tips;
      hull.corners.push_back(rounded({r * std::cos(angle), r * std::sin(angle), z}));
    }
    hull.corners.push_back(rounded({0, 0, z}));
  }
  const auto n = static_cast<std::size_t>(2 * tips), top = n + 1;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    hull.facets.push_back({n, next, i});
    hull.facets.push_back({top + n, top + i, top + next});
    hull.facets.push_back({i, next, top + next});
    hull.facets.push_back({i, top + next, top + i});
  }
  hull.shortest = std::min(2 * half, inner);
  return hull;
}

/// The aircraft of examples/uav_landing, L long.
Hull aircraft(Random&, double L) {
  static const auto surface =
      read_surface_file(std::filesystem::path(SPLASHDOWN_SOURCE) / "examples/uav_landing/uav.stl").surface;
  const Eigen::Vector3d low = surface.vertices.rowwise().minCoeff(), high = surface.vertices.rowwise().maxCoeff();
  const double scale = L / (high - low).maxCoeff();
  Hull hull{.kind = "aircraft"};
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i)
    hull.corners.push_back(rounded(scale * (surface.vertices.col(i) - (low + high) / 2)));
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    hull.facets.push_back({static_cast<std::size_t>(surface.facets(0, f)),
                           static_cast<std::size_t>(surface.facets(1, f)),
                           static_cast<std::size_t>(surface.facets(2, f))});
  // Its wings' chord is a tenth of its length; along its axis it is as a spheroid of 6 : 1, 0.045 (Lamb 1932, art. 114).
  hull.shortest = 0.1 * L;
  hull.lightness = 22;
  return hull;
}

}  // namespace

Member light_hull(std::uint64_t seed) {
  Random random("light_hulls", seed);
  const double L = random.log_uniform(0.1, 3);
  const std::string tie = random.pick<const char*>({"free", "free", "free", "hinged", "pile"});
  std::string start = random.pick<const char*>({"under water", "under water", "at the surface", "dropped"});
  if (tie == "hinged" && start == "dropped") start = "at the surface";  // it would swing in the air
  const int bodies = tie == "pile" ? 2 : 1;
  const std::string walls = random.pick<const char*>({"", "", "slip", "no_slip"});
  const double viscosity = random.log_uniform(1e-6, 1e3),
               V = ensemble::rounded(random.uniform(0.5, 2) * std::sqrt(g * L));
  const bool under = start == "under water", dropped = start == "dropped";

  Member m;
  m.what = fmt::format("{} {} L={:.3g}", start, tie, L);
  if (!walls.empty()) m.what += fmt::format(" {} {:.1g} Pa s", walls, viscosity);
  // The solids' times.
  const double end = dropped ? 0.5 * L / V : 0.35 * std::sqrt(L / g);
  const Basin basin{.title = "Light hulls",
                    .end = end,
                    .half_width = 2.5 * L,
                    .depth = (bodies + 2.5) * L,
                    .air = 3 * L,
                    .surface = 0.5 * L,
                    .far = 0.7 * L,
                    .dimension = 3};
  SceneText s = basin.scene();
  if (!walls.empty()) s.table("fluid.viscosity").set("dynamic", viscosity).word("walls", walls);
  double displaced = 0, finest = L, lightness = 0, floor = 0;
  for (int b = 0; b < bodies; ++b) {
    Hull (*const shapes[])(Random&, double) = {polyhedron, polyhedron, star, aircraft};
    const Hull hull = shapes[random.integer(0, tie == "free" ? 3 : 2)](random, L);
    double ratio = random.chance(0.1) ? 0 : random.log_uniform(1e-6, 2);
    if (dropped || (b > 0 && !under)) ratio = std::max(ratio, 1e-6);  // light, but for the fall
    if (ratio > 0.8 && ratio < 1.25) ratio = 0.5;
    const double heading = random.uniform(0, 360), pitch = random.uniform(-90, 90), roll = random.uniform(-180, 180);
    const double size = hull.shortest / (hull.kind == "aircraft" ? 1 : random.pick({2, 2, 2, 3, 3, 3, 4, 4, 6}));
    const double degree = std::numbers::pi / 180;
    const Eigen::Matrix3d R =
        (Eigen::AngleAxisd(heading * degree, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-pitch * degree, Vector3d::UnitY()) * Eigen::AngleAxisd(roll * degree, Vector3d::UnitX()))
            .toRotationMatrix();
    double low = L, high = -L;
    for (const Vector3d& x : hull.corners) low = std::min(low, (R * x).z()), high = std::max(high, (R * x).z());
    // Under water the highest point is L deep. Dropped, the lowest one is a hundredth of L above the surface. At the
    // surface, the middle of the lowest body is there. Piles go up by a thousandth of L.
    const double height = b > 0     ? floor - low
                          : under   ? -(bodies > 1 ? 2.2 : 1) * L - high
                          : dropped ? 0.01 * L - low
                                    : 0;
    floor = height + high + 1e-3 * L;
    m.what += fmt::format("; {} ratio={:.2g} h={:.2g}L", hull.kind, ratio, size / L);
    const std::string name = fmt::format("hull{}", b);
    m.texts.push_back({name + ".stl", hull.stl()});
    s.list("body").word("name", name).toml("shape", fmt::format("{{type = \"surface\", file = \"{}.stl\"}}", name));
    s.set("density", ensemble::rounded(water * ratio)).set("position", Point{0, 0, height});
    s.set("heading_deg", heading).set("pitch_deg", pitch).set("roll_deg", roll).set("size", size);
    if (dropped) s.set("velocity", Point{0, 0, -V});
    displaced += hull.volume(), finest = std::min(finest, size), lightness = std::max(lightness, hull.lightness);
    if (tie == "hinged") {
      const Vector3d at = R * hull.corners[0] + height * Vector3d::UnitZ();
      const Vector3d axis = (R * hull.corners[0]).cross(Vector3d::UnitZ()).normalized();
      s.list("joint").word("type", "hinge").word("body", name);
      s.set("point", Point{at.x(), at.y(), at.z()}).set("axis", Point{axis.x(), axis.y(), axis.z()});
    }
  }
  if (bodies > 1) s.table("contact");
  const bool release = under && tie == "free";
  if (release) s.list("record").word("kind", "added_mass").word("body", "hull0").set("times", Point{0});
  m.scene = s.text();

  m.laws.energy = EnergyLaw{.bound = 0.02, .scale = water * g * displaced * L};
  // The solids' law; a hull that turns has its corners faster by as much again, as the polygons' have.
  const double lift = lightness * 0.35 * std::sqrt(g * L),
               fall = std::sqrt((dropped ? V * V : 0) + (under ? 0 : 2 * g * bodies * L));
  m.laws.speed = SpeedLaw{.nodes = 6 * lift + 10 * fall, .bodies = 2 * lift + fall};
  if (bodies > 1) m.laws.passes.reset();
  m.laws.may_not_be_meshed = bodies > 1;
  if (release) m.laws.release = release_law(walls.empty() ? 0 : viscosity, finest, finest, basin.water());
  return m;
}

}  // namespace splashdown::ensemble
