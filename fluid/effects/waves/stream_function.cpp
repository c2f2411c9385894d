// The equations of steady_wave.hpp, made dimensionless by g and the linear wave's k, and their Newton iteration.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/steady_wave.hpp"

namespace splashdown::fluid {
namespace {

using std::numbers::pi;

// sinh and cosh of j k (d + z), over cosh(j k d), and their slopes with k.
struct Profile {
  double sinh, cosh, sinh_by_k, cosh_by_k;
  Profile(int j, double k, double z, double d) {
    const double image = std::exp(-2 * j * k * (z + d)), bed = std::exp(-2 * j * k * d);
    const double scale = std::exp(j * k * z) / (1 + bed);
    sinh = scale * (1 - image), cosh = scale * (1 + image);
    const double of_scale = j * z + 2 * j * d * bed / (1 + bed), of_image = 2 * j * (z + d) * image * scale;
    sinh_by_k = sinh * of_scale + of_image;
    cosh_by_k = cosh * of_scale - of_image;
  }
};

}  // namespace

/// Unknowns: the surface in N + 1 points from crest to trough, b_1 ... b_N, k, u_m, q = u_m d - (flux under the wave), and
/// Bernoulli's constant over that of still water.
class StreamFunction {
 public:
  StreamFunction(const SteadyWaveSpec& spec, int order)
      : order_(order), gravity_(spec.gravity), depth_(spec.depth), transport_(spec.transport) {
    // The current that the transport is over shallow water is the wave's own business.
    unit_ = spec.length > 0 ? 2 * pi / spec.length
                            : fluid::wave_number(2 * pi / spec.period, spec.depth, spec.gravity, spec.transport);
    period_ = spec.length > 0 ? 0 : spec.period * std::sqrt(gravity_ * unit_);
    depth_ *= unit_;
    transport_ *= std::sqrt(unit_ / gravity_);
    x_.resize(2 * order_ + 5);
  }

  // From the linear wave up in steps of a share of the breaking height; false if some height has no solution.
  bool solve(double height, double step) {
    const double highest = breaking_height(2 * pi, depth_), all = unit_ * height;
    const int steps = 1 + static_cast<int>(all / (step * highest));
    start(all / steps);
    Eigen::VectorXd before = x_;
    for (int k = 1; k <= steps; ++k) {
      height_ = all * k / steps;
      const Eigen::VectorXd last = x_;
      if (k > 2) x_ += last - before;
      if (k == 2) x_.head(2 * order_ + 1) *= 2;
      if (!newton() || !falls()) return false;
      before = last;
    }
    return true;
  }

  SteadyWave wave() const {
    SteadyWave out;
    out.wave_number_ = k() * unit_;
    const double speed = std::sqrt(gravity_ / unit_);
    out.celerity_ = celerity() * speed;
    out.current_ = (celerity() - mean()) * speed;
    for (int j = 1; j <= order_; ++j) {
      double sum = 0;
      for (int m = 0; m <= order_; ++m) sum += weight(m) * x_[m] * std::cos(j * m * pi / order_);
      out.elevation_.push_back((j == order_ ? 1 : 2) * sum / order_ / unit_);
      out.speed_.push_back(b(j) * speed);
    }
    out.tail_ = std::abs(out.elevation_.back()) * unit_ / height_;
    constexpr double nothing = 1e-13;  // of the first term
    while (out.speed_.size() > 1 && std::abs(out.speed_.back()) < nothing * std::abs(out.speed_[0]) &&
           std::abs(out.elevation_.back()) < nothing * std::abs(out.elevation_[0]))
      out.speed_.pop_back(), out.elevation_.pop_back();
    out.set_depth(depth_ / unit_);
    return out;
  }

 private:
  double b(int j) const { return x_[order_ + j]; }
  double k() const { return x_[2 * order_ + 1]; }
  double mean() const { return x_[2 * order_ + 2]; }
  double flux() const { return x_[2 * order_ + 3]; }
  double celerity() const { return mean() - flux() / depth_ + transport_; }
  double weight(int m) const { return m == 0 || m == order_ ? 0.5 : 1.0; }

  void start(double height) {
    const double a = 0.5 * height, own = std::sqrt(std::tanh(depth_));
    x_.setZero();
    for (int m = 0; m <= order_; ++m) x_[m] = a * std::cos(m * pi / order_);
    x_[order_ + 1] = a / own;
    x_.tail(4) << 1, own, 0.5 * a * a / own, 0.5 * own * own;
  }

  // From crest to trough: waves with more than one crest a length solve the equations, too.
  bool falls() const {
    for (int m = 0; m < order_; ++m)
      if (x_[m + 1] > x_[m]) return false;
    return true;
  }

  // The equations' residuals and their slopes.
  void equations(Eigen::VectorXd& f, Eigen::MatrixXd& slope) const {
    const int n = order_, at_k = 2 * n + 1, at_mean = at_k + 1, at_flux = at_k + 2, at_head = at_k + 3;
    const double k = this->k(), d = std::min(depth_, deep_water / k);
    f.setZero(2 * n + 5);
    slope.setZero(2 * n + 5, 2 * n + 5);
    for (int m = 0; m <= n; ++m) {
      const int stream = m, head = n + 1 + m;
      double psi = -mean() * x_[m], u = -mean(), w = 0, u_by_z = 0, w_by_z = 0, psi_by_k = 0, u_by_k = 0, w_by_k = 0;
      for (int j = 1; j <= n; ++j) {
        const Profile p(j, k, x_[m], d);
        const double c = std::cos(j * m * pi / n), s = std::sin(j * m * pi / n), jk = j * k;
        psi += b(j) / jk * p.sinh * c, u += b(j) * p.cosh * c, w += b(j) * p.sinh * s;
        u_by_z += b(j) * jk * p.sinh * c, w_by_z += b(j) * jk * p.cosh * s;
        psi_by_k += b(j) / jk * (p.sinh_by_k - p.sinh / k) * c;
        u_by_k += b(j) * p.cosh_by_k * c, w_by_k += b(j) * p.sinh_by_k * s;
        slope(stream, n + j) = p.sinh * c / jk;
        slope(head, n + j) = p.cosh * c;
        w_by_b_[j] = p.sinh * s;
      }
      for (int j = 1; j <= n; ++j) slope(head, n + j) = u * slope(head, n + j) + w * w_by_b_[j];
      f[stream] = psi - flux();
      f[head] = 0.5 * (u * u + w * w) + x_[m] - x_[at_head];
      slope(stream, m) = u, slope(stream, at_k) = psi_by_k, slope(stream, at_mean) = -x_[m],
                    slope(stream, at_flux) = -1;
      slope(head, m) = u * u_by_z + w * w_by_z + 1, slope(head, at_k) = u * u_by_k + w * w_by_k;
      slope(head, at_mean) = -u, slope(head, at_head) = -1;
    }
    const int level = 2 * n + 2, rise = level + 1, run = level + 2;
    for (int m = 0; m <= n; ++m) f[level] += weight(m) * x_[m], slope(level, m) = weight(m);
    f[rise] = x_[0] - x_[n] - height_, slope(rise, 0) = 1, slope(rise, n) = -1;
    if (period_ == 0) {
      f[run] = k - 1, slope(run, at_k) = 1;
    } else {
      f[run] = k * celerity() * period_ / (2 * pi) - 1, slope(run, at_k) = celerity() * period_ / (2 * pi);
      slope(run, at_mean) = k * period_ / (2 * pi), slope(run, at_flux) = -slope(run, at_mean) / depth_;
    }
  }

  bool newton() {
    constexpr int most = 40;
    constexpr double close = 1e-12;
    w_by_b_.resize(order_ + 1);
    Eigen::VectorXd f;
    Eigen::MatrixXd slope;
    for (int pass = 0; pass < most; ++pass) {
      equations(f, slope);
      const Eigen::VectorXd change = slope.partialPivLu().solve(f);
      if (!change.allFinite()) return false;
      x_ -= change;
      if (!(k() > 0)) return false;
      if (change.lpNorm<Eigen::Infinity>() < close) return true;
    }
    return false;
  }

  int order_;
  double gravity_, depth_, transport_, unit_ = 1, period_ = 0, height_ = 0;
  Eigen::VectorXd x_;
  mutable Eigen::VectorXd w_by_b_;
};

SteadyWave stream_function_wave(const SteadyWaveSpec& spec) {
  constexpr double enough = 1e-9, least = 1e-4;      // tails of the series
  constexpr double steps[] = {0.25, 0.0625, 0.016};  // shallow water needs small ones
  constexpr int first = 16, most = 64;
  SteadyWave best = airy_wave(spec);
  const double highest = breaking_height(best.length(), spec.depth);
  double tail = std::numeric_limits<double>::infinity();
  for (int order = first; order <= most && tail > enough && spec.height <= 1.2 * highest; order *= 2) {
    StreamFunction equations(spec, order);
    if (std::ranges::none_of(steps, [&](double step) { return equations.solve(spec.height, step); })) continue;
    SteadyWave wave = equations.wave();
    if (wave.tail() < tail) best = wave, tail = wave.tail();
  }
  if (tail > least || spec.height > breaking_height(best.length(), spec.depth))
    throw std::invalid_argument(fmt::format(
        "waves {:.4g} m long in water of {:.4g} m break at {:.4g} m or a little below; {:.4g} m is too high",
        best.length(), spec.depth, breaking_height(best.length(), spec.depth), spec.height));
  return best;
}

}  // namespace splashdown::fluid
