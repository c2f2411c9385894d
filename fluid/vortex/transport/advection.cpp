#include "fluid/vortex/transport/advection.hpp"

#include <algorithm>
#include <array>

#include "core/parallel.hpp"

namespace splashdown::vortex {
namespace {

/// What nodes -reach ... reach from a particle get of it, by how far it has moved, at most a square either way: M'4,
/// M'6 as polynomials of its way ahead and its way back (kernels.hpp), one of which is zero. Each is zero with its
/// way, so that sums need no branch.
template <int reach>
struct Shares;

template <>
struct Shares<2> {
  static double far(double s) { return -0.5 * (1 - s) * s * s; }
  static double next(double s) {
    const double t = 1 - s;
    return 1 + t * t * (1.5 * t - 2.5);
  }
  static double behind(double s) { return -0.5 * s * (1 - s) * (1 - s); }
  static std::array<double, 5> of(double ahead, double back) {
    const double s = ahead + back;
    return {far(back), next(back) + behind(ahead), 1 + s * s * (1.5 * s - 2.5), next(ahead) + behind(back), far(ahead)};
  }
};

template <>
struct Shares<3> {
  static double inner(double a) { return -(a - 1) * ((((25 * a - 38) * a - 3) * a + 12) * a + 12) / 12; }
  static double middle(double a) { return (a - 1) * (a - 2) * (((25 * a - 114) * a + 153) * a - 48) / 24; }
  static double outer(double a) { return -(a - 2) * (a - 3) * (a - 3) * (a - 3) * (5 * a - 8) / 24; }
  static std::array<double, 7> of(double ahead, double back) {
    return {outer(3 - back),     middle(2 - back) + outer(2 + ahead), inner(1 - back) + middle(1 + ahead),
            inner(ahead + back), inner(1 - ahead) + middle(1 + back), middle(2 - ahead) + outer(2 + back),
            outer(3 - ahead)};
  }
};

/// A row of particles and what its neighbours get of each; arrays are as long as the row.
template <int reach>
class RowShares {
 public:
  explicit RowShares(std::size_t count) : count_(count), moved_(count), shares_((2 * reach + 1) * count) {}

  /// Velocities in squares per move, linear between nodes: before, at and after each particle of [first, last).
  void move(const double* before, const double* here, const double* after, PathRule rule, std::size_t first,
            std::size_t last) {
    const auto at = [&](std::size_t i, double x) {
      return here[i] + std::max(x, 0.0) * (after[i] - here[i]) + std::min(x, 0.0) * (here[i] - before[i]);
    };
    if (rule == PathRule::rk2) {
      for (std::size_t i = first; i < last; ++i) moved_[i] = at(i, 0.5 * here[i]);
      return;
    }
    for (std::size_t i = first; i < last; ++i) {
      const double half = at(i, 0.5 * here[i]), third = at(i, 0.5 * half), end = at(i, std::clamp(third, -1.0, 1.0));
      moved_[i] = (here[i] + 2 * half + 2 * third + end) / 6;
    }
  }
  void split(const double* __restrict omega, std::size_t first, std::size_t last) {
    const double* __restrict moved = moved_.data();
    double* __restrict to = shares_.data();  // the compiler is to see that nothing overlaps
    const std::size_t count = count_;
    for (std::size_t i = first; i < last; ++i) {
      const double ahead = std::min(std::max(moved[i], 0.0), 1.0), back = std::min(std::max(-moved[i], 0.0), 1.0);
      const auto share = Shares<reach>::of(ahead, back);
      for (std::size_t k = 0; k < share.size(); ++k) to[k * count + i] = omega[i] * share[k];
    }
  }
  /// Of the node k from each particle.
  const double* share(int k) const { return shares_.data() + static_cast<std::size_t>(k + reach) * count_; }

 private:
  std::size_t count_;
  std::vector<double> moved_, shares_;
};

}  // namespace

template <int reach>
void Advection::along_x(const MidVelocity& velocity, double dt, NodeField& omega) const {
  const auto n = static_cast<std::size_t>(grid_.nx + 1);
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  in_pieces(static_cast<std::size_t>(grid_.ny - 1), 16, [&](std::size_t first, std::size_t end) {
    std::vector<double> u(n);
    RowShares<reach> row(n);
    for (std::size_t j = first + 1; j < end + 1; ++j) {
      double* w = omega.data() + j * n;
      if (std::all_of(w, w + n, [](double x) { return x == 0; })) continue;
      const double *now = velocity.now.u.data() + j * n, *before = velocity.before.u.data() + j * n;
      const double *now_below = now - n, *before_below = before - n;
      for (std::size_t i = 0; i < n; ++i) u[i] = own * (now[i] + now_below[i]) + last * (before[i] + before_below[i]);
      row.move(u.data() - 1, u.data(), u.data() + 1, rule_, 1, n - 1);
      row.split(w, 1, n - 1);
      std::fill_n(w, n, 0.0);
      for (int k = -reach; k <= reach; ++k) {
        const double* share = row.share(k);
        const auto from = static_cast<std::size_t>(std::max(1, 1 - k)),
                   to = n - 1 - static_cast<std::size_t>(std::max(0, k));
        double* shifted = w + k;
        for (std::size_t i = from; i < to; ++i) shifted[i] += share[i];
      }
    }
  });
}

template <int reach>
void Advection::along_y(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const {
  constexpr std::size_t block = 128;
  const auto n = static_cast<std::size_t>(grid_.nx + 1);
  const int ny = grid_.ny;
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  in_pieces((n - 2 + block - 1) / block, 1, [&](std::size_t first, std::size_t end) {
    std::array<std::array<double, block>, 3> v;
    RowShares<reach> row(block);
    for (std::size_t b = first; b < end; ++b) {
      const std::size_t left = 1 + b * block, count = std::min(block, n - 1 - left);
      const auto read = [&](int j, std::array<double, block>& to) {
        const std::size_t at = static_cast<std::size_t>(j) * n + left;
        const double *now = velocity.now.v.data() + at, *before = velocity.before.v.data() + at;
        const double *now_left = now - 1, *before_left = before - 1;
        for (std::size_t i = 0; i < count; ++i)
          to[i] = own * (now[i] + now_left[i]) + last * (before[i] + before_left[i]);
      };
      for (int j = 0; j <= ny; ++j) std::fill_n(&moved[static_cast<std::size_t>(j) * n + left], count, 0.0);
      read(0, v[0]);
      read(1, v[1]);
      for (int j = 1; j < ny; ++j) {
        const auto at = static_cast<std::size_t>(j);
        read(j + 1, v[(at + 1) % 3]);
        row.move(v[(at - 1) % 3].data(), v[at % 3].data(), v[(at + 1) % 3].data(), rule_, 0, count);
        row.split(omega.data() + at * n + left, 0, count);
        for (int k = std::max(-reach, 1 - j); k <= std::min(reach, ny - 1 - j); ++k) {
          double* to = moved.data() + static_cast<std::size_t>(j + k) * n + left;
          const double* share = row.share(k);
          for (std::size_t i = 0; i < count; ++i) to[i] += share[i];
        }
      }
    }
  });
}

template <int reach>
void Advection::strang(NodeField& omega, const MidVelocity& velocity, double dt) {
  moved_.resize(omega.size());
  along_x<reach>(velocity, 0.5 * dt, omega);
  along_y<reach>(velocity, dt, omega, moved_);
  omega.swap(moved_);
  along_x<reach>(velocity, 0.5 * dt, omega);
}

void Advection::move(NodeField& omega, const MidVelocity& velocity, double dt) {
  if (kernel_ == Remeshing::m4)
    strang<2>(omega, velocity, dt);
  else
    strang<3>(omega, velocity, dt);
}

}  // namespace splashdown::vortex
