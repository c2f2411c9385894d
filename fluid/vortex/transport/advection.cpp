#include "fluid/vortex/transport/advection.hpp"

#include <algorithm>
#include <array>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr std::size_t block = 256;      // particles at a time: their shares stay in the nearest cache
constexpr std::size_t most_shares = 7;  // of M'6
constexpr std::size_t rim = 3;          // nodes beyond a block that its particles reach

/// Velocities of a row of nodes in squares a move, means of two faces each of two instants.
struct FaceRows {
  const double *now, *now_beside, *before, *before_beside;
  double own, last;
};

SPLASHDOWN_WIDE void velocities(const FaceRows& faces, std::size_t count, double* __restrict to) {
  const double *__restrict now = faces.now, *__restrict now_beside = faces.now_beside, *__restrict before = faces.before,
               *__restrict before_beside = faces.before_beside;
  const double own = faces.own, last = faces.last;
  for (std::size_t i = 0; i < count; ++i)
    to[i] = own * (now[i] + now_beside[i]) + last * (before[i] + before_beside[i]);
}

/// How far particles move, in squares: velocities before, at and after them, linear in between.
SPLASHDOWN_WIDE void paths_of_midpoints(const double* __restrict before, const double* __restrict here,
                                        const double* __restrict after, std::size_t count, double* __restrict moved) {
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 0.5 * here[i], ahead = std::max(x, 0.0);
    moved[i] = here[i] + ahead * (after[i] - here[i]) + (x - ahead) * (here[i] - before[i]);
  }
}

SPLASHDOWN_WIDE void paths_of_four_stages(const double* __restrict before, const double* __restrict here,
                                          const double* __restrict after, std::size_t count, double* __restrict moved) {
  for (std::size_t i = 0; i < count; ++i) {
    const double right = after[i] - here[i], left = here[i] - before[i];
    const auto at = [&](double x) { return here[i] + std::max(x, 0.0) * right + std::min(x, 0.0) * left; };
    const double half = at(0.5 * here[i]), third = at(0.5 * half);
    const double end = at(std::min(std::max(third, -1.0), 1.0));
    moved[i] = (here[i] + 2 * half + 2 * third + end) / 6;
  }
}

/// What nodes -2 ... 2 from particles get of them by M'4 (kernels.hpp), for ways m of at most a square: with s = |m|, its
/// even and odd parts. `pitch`: between rows of shares.
SPLASHDOWN_WIDE void shares_of_m4(const double* __restrict omega, const double* __restrict moved, std::size_t count,
                                  double* __restrict to, std::size_t pitch) {
  double* __restrict far_back = to, * __restrict back = to + pitch, * __restrict own = to + 2 * pitch, * __restrict ahead = to + 3 * pitch, * __restrict far_ahead = to + 4 * pitch;
  for (std::size_t i = 0; i < count; ++i) {
    const double m = std::min(std::max(moved[i], -1.0), 1.0), p = std::max(m, 0.0), q = p - m, s = p + q;
    const double g = s * (1 - s), half = 0.5 * omega[i], far = half * g;
    const double even = half * (s * s * (3 - 2 * s)), odd = half * (m * (1 + g));
    far_back[i] = -far * q;
    back[i] = even - odd;
    own[i] = omega[i] * (1 + s * s * (1.5 * s - 2.5));
    ahead[i] = even + odd;
    far_ahead[i] = -far * p;
  }
}

inline double inner(double a) { return -(a - 1) * ((((25 * a - 38) * a - 3) * a + 12) * a + 12) / 12; }
inline double middle(double a) { return (a - 1) * (a - 2) * (((25 * a - 114) * a + 153) * a - 48) / 24; }
inline double outer(double a) { return -(a - 2) * (a - 3) * (a - 3) * (a - 3) * (5 * a - 8) / 24; }

/// The same of nodes -3 ... 3 by M'6: each share is a polynomial of the way ahead plus one of the way back, one of
/// which is zero with its way.
SPLASHDOWN_WIDE void shares_of_m6(const double* __restrict omega, const double* __restrict moved, std::size_t count,
                                  double* __restrict to, std::size_t pitch) {
  for (std::size_t i = 0; i < count; ++i) {
    const double p = std::min(std::max(moved[i], 0.0), 1.0), q = std::min(std::max(-moved[i], 0.0), 1.0), w = omega[i];
    to[i] = w * outer(3 - q);
    to[pitch + i] = w * (middle(2 - q) + outer(2 + p));
    to[2 * pitch + i] = w * (inner(1 - q) + middle(1 + p));
    to[3 * pitch + i] = w * inner(p + q);
    to[4 * pitch + i] = w * (inner(1 - p) + middle(1 + q));
    to[5 * pitch + i] = w * (middle(2 - p) + outer(2 + q));
    to[6 * pitch + i] = w * outer(3 - p);
  }
}

/// Sums of what particles give to each of `count` nodes.
SPLASHDOWN_WIDE void gather_five(const std::array<const double*, most_shares>& from, std::size_t count,
                                 double* __restrict to) {
  const double *a = from[0], *b = from[1], *c = from[2], *d = from[3], *e = from[4];
  for (std::size_t i = 0; i < count; ++i) to[i] = (a[i] + e[i]) + (b[i] + d[i]) + c[i];
}
SPLASHDOWN_WIDE void gather_seven(const std::array<const double*, most_shares>& from, std::size_t count,
                                  double* __restrict to) {
  const double *a = from[0], *b = from[1], *c = from[2], *d = from[3], *e = from[4], *f = from[5], *g = from[6];
  for (std::size_t i = 0; i < count; ++i) to[i] = (a[i] + g[i]) + (b[i] + f[i]) + (c[i] + e[i]) + d[i];
}

/// The rules of a kernel and of paths.
struct Rules {
  std::size_t reach;
  decltype(&paths_of_midpoints) paths;
  decltype(&shares_of_m4) shares;
  decltype(&gather_five) gather;
};

Rules rules_of(Remeshing kernel, PathRule rule) {
  const auto paths = rule == PathRule::rk2 ? &paths_of_midpoints : &paths_of_four_stages;
  if (kernel == Remeshing::m4) return {2, paths, &shares_of_m4, &gather_five};
  return {3, paths, &shares_of_m6, &gather_seven};
}

constexpr std::size_t widest = block + 2 * rim + 2;

}  // namespace

void Advection::along_x(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const {
  const auto rules = rules_of(kernel_, rule_);
  const auto n = static_cast<std::size_t>(grid_.nx + 1);
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  clear_row(moved.data(), n);
  clear_row(moved.data() + static_cast<std::size_t>(grid_.ny) * n, n);
  in_pieces(static_cast<std::size_t>(grid_.ny - 1), 16, [&](std::size_t first, std::size_t end) {
    std::array<double, widest> u, way;
    std::array<double, most_shares * widest> shares;
    for (std::size_t j = first + 1; j < end + 1; ++j) {
      const double* w = omega.data() + j * n;
      double* to = moved.data() + j * n;
      to[0] = to[n - 1] = 0;
      for (std::size_t left = 1; left < n - 1; left += block) {
        const std::size_t right = std::min(left + block, n - 1);  // nodes [left, right) get theirs
        // From particles of the inner nodes around.
        const std::size_t from = left > rules.reach ? left - rules.reach : 1,
                          till = std::min(right + rules.reach, n - 1);
        if (all_zero(w + from, till - from)) {
          clear_row(to + left, right - left);
          continue;
        }
        const auto row = [&](const std::vector<double>& f) { return f.data() + j * n + from - 1; };
        const double *now = row(velocity.now.u), *before = row(velocity.before.u);
        velocities({now, now - n, before, before - n, own, last}, till - from + 2, u.data());
        rules.paths(u.data(), u.data() + 1, u.data() + 2, till - from, way.data());
        // Shares stand `rim` further, between zeros: there are no particles beyond.
        for (std::size_t k = 0; k <= 2 * rules.reach; ++k) {
          double* share = shares.data() + k * widest;
          std::fill_n(share, rim, 0.0);
          std::fill_n(share + rim + till - from, rim, 0.0);
        }
        rules.shares(w + from, way.data(), till - from, shares.data() + rim, widest);
        std::array<const double*, most_shares> given{};
        for (std::size_t k = 0; k <= 2 * rules.reach; ++k)  // node i gets share k of the particle i - (k - reach)
          given[k] = shares.data() + k * widest + rim + left - from + rules.reach - k;
        rules.gather(given, right - left, to + left);
      }
    }
  });
}

void Advection::along_y(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const {
  const auto rules = rules_of(kernel_, rule_);
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny);
  const std::size_t ring = 2 * rules.reach + 1;
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  in_pieces((n - 2 + block - 1) / block, 1, [&](std::size_t first, std::size_t end) {
    std::array<std::array<double, block>, 3> v;
    std::array<double, block> way;
    std::vector<double> shares(ring * ring * block);  // of the last rows of particles, in turn
    std::array<bool, most_shares> is_calm;
    for (std::size_t b = first; b < end; ++b) {
      const std::size_t left = 1 + b * block, count = std::min(block, n - 1 - left);
      const auto read = [&](std::size_t j) {
        const double *now = velocity.now.v.data() + j * n + left, *before = velocity.before.v.data() + j * n + left;
        velocities({now, now - 1, before, before - 1, own, last}, count, v[j % 3].data());
      };
      const auto calm = [&](std::size_t j) {
        const std::size_t slot = j % ring;
        if (is_calm[slot]) return;
        clear_row(shares.data() + slot * ring * block, ring * block);
        is_calm[slot] = true;
      };
      is_calm.fill(false);
      for (std::size_t j = 0; j < ring; ++j) calm(j);
      clear_row(&moved[left], count);
      clear_row(&moved[ny * n + left], count);
      std::size_t known = 0;  // rows of velocities below this one have been read
      for (std::size_t j = 1; j < ny + rules.reach; ++j) {
        if (j >= ny || all_zero(omega.data() + j * n + left, count)) {
          calm(j);
        } else {
          for (known = std::max(known, j - 1); known <= j + 1; ++known) read(known);
          rules.paths(v[(j - 1) % 3].data(), v[j % 3].data(), v[(j + 1) % 3].data(), count, way.data());
          rules.shares(omega.data() + j * n + left, way.data(), count, shares.data() + j % ring * ring * block, block);
          is_calm[j % ring] = false;
        }
        if (j <= rules.reach) continue;
        const std::size_t row = j - rules.reach;  // nodes of it have all that particles give them
        double* to = moved.data() + row * n + left;
        if (std::all_of(is_calm.begin(), is_calm.begin() + static_cast<std::ptrdiff_t>(ring),
                        [](bool b) { return b; })) {
          clear_row(to, count);
          continue;
        }
        std::array<const double*, most_shares> given{};
        for (std::size_t k = 0; k < ring;
             ++k)  // share k of the row of particles row - (k - reach), at 2 reach - k below j
          given[k] = shares.data() + ((j + ring - k) % ring * ring + k) * block;
        rules.gather(given, count, to);
      }
    }
  });
  for (std::size_t j = 0; j <= ny; ++j) moved[j * n] = moved[(j + 1) * n - 1] = 0;
}

void Advection::move(NodeField& omega, const MidVelocity& velocity, double dt) {
  moved_.resize(omega.size());
  along_x(velocity, 0.5 * dt, omega, moved_);
  along_y(velocity, dt, moved_, omega);
  along_x(velocity, 0.5 * dt, omega, moved_);
  omega.swap(moved_);
}

}  // namespace splashdown::vortex
