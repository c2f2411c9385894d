// The first mesh meets the outlines that a scene states as well as its elements can: chords of the size that is asked for there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/closest_point.hpp"
#include "fluid/pfem/initial/initial.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::initial_outline_test {
namespace {

using std::numbers::pi;

// Edges that are longer than this over h are split (fluid/pfem/mesh/adapt.cpp).
constexpr double longest = 1.5;

/// Distance of chords of length `longest` h from a curve of radius 1/kappa, and of the curve's own polygon from it.
double chord_error(double h, double kappa, double edge) {
  return kappa / 8 * (longest * h * longest * h + edge * edge);
}

struct Outline {
  std::string name;
  std::vector<Vec<2>> points;  // of the liquid
  double kappa;                // largest curvature of its curved part [1/m]
  bool walled = false;         // its sides and floor lie on a tank
};

std::ostream& operator<<(std::ostream& out, const Outline& outline) { return out << outline.name; }

/// A wave of crests and troughs between two walls.
Outline wave(double amplitude, double length, double phase) {
  const double width = 1;
  std::vector<Vec<2>> p{{0, -0.5}, {width, -0.5}};
  constexpr int pieces = 400;
  for (int i = pieces; i >= 0; --i) {
    const double x = width * i / pieces;
    p.emplace_back(x, amplitude * std::cos(2 * pi * x / length + phase));
  }
  const double k = 2 * pi / length;
  return {"wave of " + std::to_string(length) + " m", p, amplitude * k * k, true};
}

Outline round(double a, double b) {
  const auto s = scenes::ellipse(a, b, 400);
  Outline outline{"ellipse of " + std::to_string(a) + " by " + std::to_string(b) + " m", {}, a / (b * b)};
  for (Eigen::Index i = 0; i < s.vertices.cols(); ++i) outline.points.push_back(s.vertices.col(i));
  return outline;
}

/// r = R (1 + sum a_k cos(k t + phase_k)), a few per cent each.
Outline random_blob(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  std::array<double, 4> a{}, phase{};
  for (int k = 0; k < 4; ++k) a[k] = 0.08 * any(random) / (k + 1), phase[k] = 2 * pi * any(random);
  Outline outline{"blob " + std::to_string(seed), {}, 0};
  const auto at = [&](double t) {
    double r = 1;
    for (int k = 0; k < 4; ++k) r += a[k] * std::cos((k + 2) * t + phase[k]);
    return Vec<2>(0.4 * r * std::cos(t), 0.4 * r * std::sin(t));
  };
  constexpr int pieces = 400;
  const double dt = 2 * pi / pieces;
  for (int i = 0; i < pieces; ++i) {
    const Vec<2> x = at(i * dt), v = (at((i + 0.5) * dt) - at((i - 0.5) * dt)) / dt,
                 w = (at((i + 1) * dt) - 2 * x + at((i - 1) * dt)) / (dt * dt);
    outline.points.push_back(x);
    outline.kappa = std::max(outline.kappa, std::abs(v.x() * w.y() - v.y() * w.x()) / std::pow(v.norm(), 3));
  }
  return outline;
}

std::vector<Outline> outlines() {
  std::vector<Outline> all{wave(0.005, 1, 0),     wave(0.02, 0.5, 1), wave(0.05, 1, 2),
                           wave(0.01, 0.25, 0.3), round(0.5, 0.5),    round(0.6, 0.3)};
  for (unsigned seed = 1; seed <= 6; ++seed) all.push_back(random_blob(seed));
  return all;
}

InitialLiquid<2> filled(const FluidSpec<2>& spec) {
  const scenes::Placed placed(spec);
  return fill<2>(spec, placed.at());
}

FluidSpec<2> spec_of(const Outline& outline, double surface, double far) {
  FluidSpec<2> spec;
  spec.size = {.surface = surface, .far = far};
  spec.liquids.push_back({scenes::outline(outline.points), {}});
  if (outline.walled)
    spec.walls.push_back(scenes::wall("tank", scenes::turned_inside_out(scenes::rectangle({0, -0.5}, {1, 0.5})), far));
  return spec;
}

double distance(const std::vector<std::array<Vec<2>, 2>>& edges, const Vec<2>& x) {
  double least = std::numeric_limits<double>::max();
  for (const auto& edge : edges) least = std::min(least, (closest_on(edge, x) - x).norm());
  return least;
}

std::vector<std::array<Vec<2>, 2>> edges_of(const std::vector<Vec<2>>& points) {
  std::vector<std::array<Vec<2>, 2>> edges;
  for (std::size_t i = 0; i < points.size(); ++i) edges.push_back({points[i], points[(i + 1) % points.size()]});
  return edges;
}

/// Largest distance of the facets' nodes and middles from an outline, and of those points of it from the facets that are `wet`.
double between(const std::vector<std::array<Vec<2>, 2>>& facets, const std::vector<Vec<2>>& points,
               const std::function<bool(const Vec<2>&)>& wet) {
  const auto outline = edges_of(points);
  double most = 0;
  for (const auto& facet : facets)
    for (const Vec<2>& x : {facet[0], Vec<2>(0.5 * (facet[0] + facet[1]))}) most = std::max(most, distance(outline, x));
  for (const Vec<2>& x : points)
    if (wet(x)) most = std::max(most, distance(facets, x));
  return most;
}

bool anywhere(const Vec<2>&) { return true; }
bool above_the_floor(const Vec<2>& x) { return x.y() > -0.4; }

std::vector<std::array<Vec<2>, 2>> facets_on(const InitialLiquid<2>& liquid, int wall) {
  std::vector<std::array<Vec<2>, 2>> facets;
  for (const auto& f : liquid.mesh.boundary)
    if (f.wall == wall) facets.push_back({liquid.nodes.x[f.nodes[0]], liquid.nodes.x[f.nodes[1]]});
  return facets;
}

TEST(InitialOutline, of_liquid_is_met_within_the_chords_of_the_elements_asked_for_there) {
  for (const auto& outline : outlines())
    for (const double surface : {0.05, 0.02})
      for (const double ratio : {1., 10.}) {
        const auto liquid = filled(spec_of(outline, surface, ratio * surface));
        const double edge = (outline.points[3] - outline.points[2]).norm();
        EXPECT_LE(between(facets_on(liquid, -1), outline.points, outline.walled ? above_the_floor : anywhere),
                  chord_error(surface, outline.kappa, edge))
            << outline << ", " << surface << " m at the surface, " << ratio << " times that inside";
      }
}

/// Round hulls under water and at the surface, finer and coarser than the water around.
TEST(InitialOutline, of_hulls_is_met_within_the_chords_of_their_elements) {
  for (const double depth : {0.5, 0.1})
    for (const double size : {0.05, 0.02})
      for (const double surface : {0.05, 0.02}) {
        auto spec = scenes::still_water(2, 1, surface);
        spec.size.far = 0.2;
        spec.size.curvature = 1e3;  // elements of the size that is asked for, whatever the bend
        auto hull = scenes::wall("hull", scenes::ellipse(0.3, 0.2, 400), size);
        hull.pose.translation() << 0.1, -depth;
        spec.walls.insert(spec.walls.begin(), hull);
        const auto liquid = filled(spec);
        std::vector<Vec<2>> points;
        for (Eigen::Index i = 0; i < hull.surface.vertices.cols(); ++i)
          points.push_back(hull.pose * Vec<2>(hull.surface.vertices.col(i)));
        const double error = chord_error(size, 0.3 / 0.04, 5e-3);
        EXPECT_LE(between(facets_on(liquid, 0), points, [](const Vec<2>& x) { return x.y() < 0; }), error)
            << "depth " << depth << ", hull " << size << ", surface " << surface;
      }
}

/// Trough and crest are where the scene says, and the wave's energy with them: g rho / 2 of the mean square of the elevation.
TEST(InitialOutline, wave_has_its_height_and_energy) {
  const double a = 0.005;
  const auto outline = wave(a, 1, 0);
  for (const double ratio : {1., 4., 10.}) {
    const auto liquid = filled(spec_of(outline, 0.025, 0.025 * ratio));
    double low = 1, high = -1, square = 0;
    for (const auto& [from, to] : facets_on(liquid, -1)) {
      low = std::min({low, from.y(), to.y()}), high = std::max({high, from.y(), to.y()});
      square += std::abs(from.x() - to.x()) * (from.y() * from.y() + from.y() * to.y() + to.y() * to.y()) / 3;
    }
    const double error = chord_error(0.025, outline.kappa, 2.5e-3);
    EXPECT_NEAR(low, -a, error) << ratio;
    EXPECT_NEAR(high, a, error) << ratio;
    EXPECT_NEAR(square, 0.5 * a * a, 2 * a * error) << ratio;
  }
}

/// Smaller than an element of the inside: three pieces at least, and as many as the surface asks for.
TEST(InitialOutline, small_drops_are_round) {
  for (const double radius : {0.03, 0.06, 0.15})
    for (const double far : {0.02, 0.5}) {
      Outline drop = round(radius, radius);
      const auto liquid = filled(spec_of(drop, 0.02, far));
      EXPECT_LE(between(facets_on(liquid, -1), drop.points, anywhere), chord_error(0.02, 1 / radius, 2.5e-3)) << radius;
    }
}

}  // namespace
}  // namespace splashdown::fluid::initial_outline_test
