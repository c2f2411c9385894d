#include "fluid/vortex/transport/advection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

// Without branches, which would keep loops out of wide registers; exact.
inline double positive_part(double x) { return 0.5 * (x + std::abs(x)); }
inline double within_one(double x) { return x - std::copysign(positive_part(std::abs(x) - 1), x); }

/// How far a particle moves, in squares: velocities before, at and after it, linear in between.
inline double way_by_midpoint(double before, double here, double after) {
  const double x = 0.5 * here, ahead = positive_part(x);
  return here + ahead * (after - here) + (x - ahead) * (here - before);
}
inline double way_by_four_stages(double before, double here, double after) {
  const double right = after - here, left = here - before;
  const auto at = [&](double x) { return here + positive_part(x) * right - positive_part(-x) * left; };
  const double half = at(0.5 * here), third = at(0.5 * half);
  const double end = at(within_one(third));
  return (here + 2 * half + 2 * third + end) / 6;
}

/// What nodes -2 ... 2 from a particle get of it by M'4 (kernels.hpp), for a way m of at most a square: with s = |m|, its even and odd
/// parts.
inline void share_by_m4(double way, double omega, double* far_back, double* back, double* own, double* ahead,
                        double* far_ahead) {
  const double m = within_one(way), s = std::abs(m), p = 0.5 * (s + m), q = 0.5 * (s - m);
  const double g = s * (1 - s), half = 0.5 * omega, far = half * g;
  const double even = half * (s * s * (3 - 2 * s)), odd = half * (m * (1 + g));
  *far_back = -far * q;
  *back = even - odd;
  *own = omega * (1 + s * s * (1.5 * s - 2.5));
  *ahead = even + odd;
  *far_ahead = -far * p;
}

inline double inner(double a) { return -(a - 1) * ((((25 * a - 38) * a - 3) * a + 12) * a + 12) / 12; }
inline double middle(double a) { return (a - 1) * (a - 2) * (((25 * a - 114) * a + 153) * a - 48) / 24; }
inline double outer(double a) { return -(a - 2) * (a - 3) * (a - 3) * (a - 3) * (5 * a - 8) / 24; }

/// The same of nodes -3 ... 3 by M'6: each share is a polynomial of the way ahead plus one of the way back, one of
/// which is zero with its way.
inline void share_by_m6(double way, double w, double* a, double* b, double* c, double* d, double* e, double* f,
                        double* g) {
  const double m = within_one(way), p = positive_part(m), q = positive_part(-m);
  *a = w * outer(3 - q);
  *b = w * (middle(2 - q) + outer(2 + p));
  *c = w * (inner(1 - q) + middle(1 + p));
  *d = w * inner(p + q);
  *e = w * (inner(1 - p) + middle(1 + q));
  *f = w * (middle(2 - p) + outer(2 + q));
  *g = w * outer(3 - p);
}

/// Rows of particles: velocities before, at and after each [squares a move], and its circulation; what nodes around get of it. (Each row
/// is a parameter of its own, that the compiler sees that none overlaps another.)
SPLASHDOWN_WIDE void m4_by_midpoint(const double* __restrict before, const double* __restrict here,
                                    const double* __restrict after, const double* __restrict w, std::size_t count,
                                    double* __restrict a, double* __restrict b, double* __restrict c,
                                    double* __restrict d, double* __restrict e) {
  for (std::size_t i = 0; i < count; ++i)
    share_by_m4(way_by_midpoint(before[i], here[i], after[i]), w[i], a + i, b + i, c + i, d + i, e + i);
}
SPLASHDOWN_WIDE void m4_by_four_stages(const double* __restrict before, const double* __restrict here,
                                       const double* __restrict after, const double* __restrict w, std::size_t count,
                                       double* __restrict a, double* __restrict b, double* __restrict c,
                                       double* __restrict d, double* __restrict e) {
  for (std::size_t i = 0; i < count; ++i)
    share_by_m4(way_by_four_stages(before[i], here[i], after[i]), w[i], a + i, b + i, c + i, d + i, e + i);
}
SPLASHDOWN_WIDE void m6_by_midpoint(const double* __restrict before, const double* __restrict here,
                                    const double* __restrict after, const double* __restrict w, std::size_t count,
                                    double* __restrict a, double* __restrict b, double* __restrict c,
                                    double* __restrict d, double* __restrict e, double* __restrict f,
                                    double* __restrict g) {
  for (std::size_t i = 0; i < count; ++i)
    share_by_m6(way_by_midpoint(before[i], here[i], after[i]), w[i], a + i, b + i, c + i, d + i, e + i, f + i, g + i);
}
SPLASHDOWN_WIDE void m6_by_four_stages(const double* __restrict before, const double* __restrict here,
                                       const double* __restrict after, const double* __restrict w, std::size_t count,
                                       double* __restrict a, double* __restrict b, double* __restrict c,
                                       double* __restrict d, double* __restrict e, double* __restrict f,
                                       double* __restrict g) {
  for (std::size_t i = 0; i < count; ++i)
    share_by_m6(way_by_four_stages(before[i], here[i], after[i]), w[i], a + i, b + i, c + i, d + i, e + i, f + i,
                g + i);
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
  Remeshing kernel;
  PathRule paths;
  std::size_t reach() const { return kernel == Remeshing::m4 ? 2 : 3; }

  /// `here`: velocities along a row, of which those before and after are read, too; `pitch`: between rows of shares.
  void share(const double* here, const double* omega, std::size_t count, std::size_t pitch, double* to) const {
    share(here - 1, here, here + 1, omega, count, [&](std::size_t k) { return to + k * pitch; });
  }
  template <class Row>
  void share(const double* before, const double* here, const double* after, const double* omega, std::size_t count,
             Row row) const {
    const bool midpoint = paths == PathRule::rk2;
    if (kernel == Remeshing::m4)
      (midpoint ? m4_by_midpoint : m4_by_four_stages)(before, here, after, omega, count, row(0), row(1), row(2), row(3),
                                                      row(4));
    else
      (midpoint ? m6_by_midpoint : m6_by_four_stages)(before, here, after, omega, count, row(0), row(1), row(2), row(3),
                                                      row(4), row(5), row(6));
  }
  void gather(const std::array<const double*, most_shares>& from, std::size_t count, double* to) const {
    (kernel == Remeshing::m4 ? gather_five : gather_seven)(from, count, to);
  }
};

constexpr std::size_t widest = block + 4 * rim + 2;  // particles of a block and its rims, and zeros on both sides

}  // namespace

void Advection::along_x(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const {
  const Rules rules{kernel_, rule_};
  const auto n = static_cast<std::size_t>(grid_.nx + 1);
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  clear_row(moved.data(), n);
  clear_row(moved.data() + static_cast<std::size_t>(grid_.ny) * n, n);
  in_pieces(static_cast<std::size_t>(grid_.ny - 1), 16, [&](std::size_t first, std::size_t end) {
    std::array<double, widest> u;
    std::array<double, most_shares * widest> shares;
    for (std::size_t j = first + 1; j < end + 1; ++j) {
      const double* w = omega.data() + j * n;
      double* to = moved.data() + j * n;
      to[0] = to[n - 1] = 0;
      for (std::size_t left = 1; left < n - 1; left += block) {
        const std::size_t right = std::min(left + block, n - 1);  // nodes [left, right) get theirs
        // From particles of the inner nodes around.
        const std::size_t from = left > rules.reach() ? left - rules.reach() : 1,
                          till = std::min(right + rules.reach(), n - 1);
        if (all_zero(w + from, till - from)) {
          clear_row(to + left, right - left);
          continue;
        }
        const auto row = [&](const std::vector<double>& f) { return f.data() + j * n + from - 1; };
        const double *now = row(velocity.now.u), *before = row(velocity.before.u);
        velocities({now, now - n, before, before - n, own, last}, till - from + 2, u.data());
        // Shares stand `rim` further, between zeros: there are no particles beyond.
        for (std::size_t k = 0; k <= 2 * rules.reach(); ++k) {
          double* share = shares.data() + k * widest;
          std::fill_n(share, rim, 0.0);
          std::fill_n(share + rim + till - from, rim, 0.0);
        }
        rules.share(u.data() + 1, w + from, till - from, widest, shares.data() + rim);
        std::array<const double*, most_shares> given{};
        for (std::size_t k = 0; k <= 2 * rules.reach(); ++k)  // node i gets share k of the particle i - (k - reach)
          given[k] = shares.data() + k * widest + rim + left - from + rules.reach() - k;
        rules.gather(given, right - left, to + left);
      }
    }
  });
}

void Advection::along_y(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const {
  const Rules rules{kernel_, rule_};
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny);
  const std::size_t ring = 2 * rules.reach() + 1;
  const double own = 0.5 * dt / grid_.h * (1 + velocity.ahead), last = -0.5 * dt / grid_.h * velocity.ahead;
  in_pieces((n - 2 + block - 1) / block, 1, [&](std::size_t first, std::size_t end) {
    std::array<std::array<double, block>, 3> v;
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
      for (std::size_t j = 1; j < ny + rules.reach(); ++j) {
        if (j >= ny || all_zero(omega.data() + j * n + left, count)) {
          calm(j);
        } else {
          for (known = std::max(known, j - 1); known <= j + 1; ++known) read(known);
          double* to = shares.data() + j % ring * ring * block;
          rules.share(v[(j - 1) % 3].data(), v[j % 3].data(), v[(j + 1) % 3].data(), omega.data() + j * n + left, count,
                      [to](std::size_t k) { return to + k * block; });
          is_calm[j % ring] = false;
        }
        if (j <= rules.reach()) continue;
        const std::size_t row = j - rules.reach();  // nodes of it have all that particles give them
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
