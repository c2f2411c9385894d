// A closed tank with a regular wave in it, kept alive by zones at its ends, and what a fit makes of its surface.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>

#include "fluid/effects/gravity/gravity.hpp"
#include "fluid/effects/waves/waves.hpp"
#include "fluid/pfem/fluid.hpp"
#include "tests/unit/coupling/watched.hpp"

namespace splashdown::fluid::testing {

struct WaveTank {
  SteadyWaveSpec wave;
  double elements = 40;            ///< a wavelength
  double lengths = 6, zone = 1.5;  ///< of the tank and of its zones, in wavelengths
  double rate = 4;                 ///< over the frequency
  double cfl = 0.5;
  bool linear = false;  ///< reference
  double other = 0;     ///< height of a wave that runs the other way at the start, over the wave's

  SteadyWave solved() const { return linear ? airy_wave(wave) : stream_function_wave(wave); }
  double floor() const { return -std::min(wave.depth, 0.75 * solved().length()); }

  std::unique_ptr<RegularWave<2>> sea() const {
    SeaFrame<2> frame;
    frame.depth = -floor();
    frame.gravity = wave.gravity;
    return std::make_unique<RegularWave<2>>(solved(), frame);
  }

  WaveZones<2> zones() const {
    const double half = 0.5 * lengths * solved().length();
    return {.min = Vec<2>(-half, floor()),
            .max = Vec<2>(half, 2 * wave.height),
            .width = Vec<2>(zone * solved().length(), 0),
            .rate = rate * 2 * std::numbers::pi / solved().period()};
  }

  FluidSpec<2> spec() const {
    const auto z = zones();
    const double h = solved().length() / elements;
    FluidSpec<2> out;
    out.size = {.surface = h, .far = 4 * h};
    out.step = {.cfl = cfl, .dt_max = cfl * std::sqrt(h / wave.gravity)};
    WallSpec<2> tank;
    tank.name = "tank";
    tank.surface = outline({z.min, {z.min.x(), z.max.y()}, z.max, {z.max.x(), z.min.y()}});
    tank.size = 4 * h;
    out.walls.push_back(tank);
    const std::shared_ptr<const RegularWave<2>> at = sea();
    const int pieces = static_cast<int>(100 * lengths);
    std::vector<Vec<2>> points{z.min, {z.max.x(), z.min.y()}};
    double mean = 0;
    for (int i = pieces; i >= 0; --i) {
      const double x = i == pieces ? z.max.x() : z.min.x() + (z.max.x() - z.min.x()) * i / pieces;
      points.emplace_back(x, at->elevation(Vec<2>(x, 0), 0));
      mean += points.back().y() * (i == 0 || i == pieces ? 0.5 : 1) / pieces;
    }
    for (std::size_t i = 2; i < points.size(); ++i) points[i].y() -= mean;
    out.liquids.push_back({outline(points), [at](const Vec<2>& x) { return at->velocity(x, 0); }});
    return out;
  }

  static Surface<2> outline(const std::vector<Vec<2>>& points) {
    Surface<2> s;
    const auto n = static_cast<Eigen::Index>(points.size());
    s.vertices.resize(2, n), s.facets.resize(2, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      s.vertices.col(k) = points[static_cast<std::size_t>(k)];
      s.facets.col(k) << static_cast<int>(k), static_cast<int>((k + 1) % n);
    }
    return s;
  }

  coupling::scenes::Watched<2> stepper() const {
    std::vector<std::unique_ptr<Effect<2>>> effects;
    effects.push_back(std::make_unique<Gravity<2>>(Vec<2>(0, -wave.gravity)));
    effects.push_back(std::make_unique<Waves<2>>(sea(), zones()));
    return coupling::scenes::Watched<2>(std::make_unique<Fluid<2>>(spec(), std::move(effects)));
  }
};

/// Of the surface between the zones over a time: the wave that runs with the reference and the one that runs back, both of the
/// reference's frequency, by least squares over samples of place and time; its wave number from the slope of the phase.
class WaveFit {
 public:
  WaveFit(const SteadyWave& wave, double from, double to) : wave_(wave), from_(from), to_(to) {}

  void sample(double t, const std::function<double(double)>& elevation) {
    for (int i = 0; i < places; ++i) {
      const double x = from_ + (to_ - from_) * i / (places - 1), w = 2 * std::numbers::pi / wave_.period();
      const double value = elevation(x);
      const Eigen::Vector3d basis(1, std::cos(w * t), std::sin(w * t));
      normal_[i] += basis * basis.transpose();
      right_[i] += basis * value;
      highest_ = std::max(highest_, value), lowest_ = std::min(lowest_, value);
    }
  }

  struct Found {
    double amplitude, reflection;  ///< of the first harmonic over the reference's; over the amplitude
    double wave_number;            ///< over the reference's
    double level;                  ///< mean [m]
    double highest, lowest;        ///< [m]
  };
  Found found() const {
    // Complex first harmonics a(x) = A exp(-i k x) + B exp(i k x): least squares for A, B at the k that leaves least.
    Eigen::Matrix<std::complex<double>, places, 1> first;
    double level = 0;
    for (int i = 0; i < places; ++i) {
      const Eigen::Vector3d c = normal_[i].ldlt().solve(right_[i]);
      level += c[0] / places;
      first[i] = {c[1], -c[2]};  // c1 cos + c2 sin = Re((c1 - i c2) exp(i w t))
    }
    double best = std::numeric_limits<double>::infinity(), at = 1;
    Eigen::Vector2cd waves;
    const auto left = [&](double relative) {
      Eigen::Matrix<std::complex<double>, places, 2> basis;
      for (int i = 0; i < places; ++i) {
        const double x = from_ + (to_ - from_) * i / (places - 1), angle = relative * wave_.wave_number() * x;
        basis(i, 0) = std::polar(1.0, -angle), basis(i, 1) = std::polar(1.0, angle);
      }
      const Eigen::Vector2cd fit = (basis.adjoint() * basis).ldlt().solve(basis.adjoint() * first);
      const double error = (basis * fit - first).norm();
      if (error < best) best = error, at = relative, waves = fit;
    };
    for (double relative = 0.95; relative <= 1.05; relative += 1e-4) left(relative);
    double reference = 0;  // of the reference's surface
    for (int j = 0; j < 360; ++j) {
      const double theta = j * std::numbers::pi / 180;
      reference += wave_.elevation(theta) * std::cos(theta) / 180;
    }
    return {std::abs(waves[0]) / reference, std::abs(waves[1]) / std::abs(waves[0]), at, level, highest_, lowest_};
  }

 private:
  static constexpr int places = 41;
  SteadyWave wave_;
  double from_, to_, highest_ = -1e9, lowest_ = 1e9;
  std::array<Eigen::Matrix3d, places> normal_ = zeros<Eigen::Matrix3d>();
  std::array<Eigen::Vector3d, places> right_ = zeros<Eigen::Vector3d>();
  template <class Array>
  static std::array<Array, places> zeros() {
    std::array<Array, places> all;
    all.fill(Array::Zero());
    return all;
  }
};

/// Highest point of the free surface over x [m].
inline double elevation_at(const Fluid<2>& fluid, double x) {
  double highest = -1e9;
  const auto& at = fluid.nodes().x;
  for (const auto& facet : fluid.mesh().boundary) {
    if (facet.wall >= 0) continue;
    const Vec<2>&a = at[static_cast<std::size_t>(facet.nodes[0])], &b = at[static_cast<std::size_t>(facet.nodes[1])];
    if (std::min(a.x(), b.x()) > x || std::max(a.x(), b.x()) < x || a.x() == b.x()) continue;
    highest = std::max(highest, a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
  }
  return highest;
}

}  // namespace splashdown::fluid::testing
