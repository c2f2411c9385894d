#include "fluid/vortex/transport/shares.hpp"

#include <cmath>

#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

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

/// The same of nodes -3 ... 3 by M'6. A particle on its way to a node, s = |m| = 1/2 + t, gives pairs of nodes before and behind the
/// middle of the way even parts in t plus and minus odd ones; four of the six have the factor s (1 - s).
inline void share_by_m6(double way, double w, double* a, double* b, double* c, double* d, double* e, double* f,
                        double* g) {
  const double m = within_one(way), s = std::abs(m), t = s - 0.5, q = t * t;
  const double product = w / 24 * (s * (1 - s));
  const double far_even = product * (1.125 - 0.5 * q), far_odd = product * t * (5 * q - 3.25);
  const double middle_even = product * (1.5 * q - 9.375), middle_odd = product * t * (20.25 - 25 * q);
  const double near_even = w / 12 * ((25 * q - 22.5) * q + 14.0625), near_odd = w / 12 * (t * (12 * q - 7));
  const double two_behind = far_even + far_odd, one_behind = middle_even + middle_odd;
  const double one_ahead = s * (near_even - near_odd), two_ahead = middle_even - middle_odd;
  const double three_ahead = far_even - far_odd;
  const bool is_back = m < 0;
  *a = is_back ? three_ahead : 0.0;
  *b = is_back ? two_ahead : two_behind;
  *c = is_back ? one_ahead : one_behind;
  *d = (1 - s) * (near_even + near_odd);
  *e = is_back ? one_behind : one_ahead;
  *f = is_back ? two_behind : two_ahead;
  *g = is_back ? 0.0 : three_ahead;
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
SPLASHDOWN_WIDE void gather_five(const std::array<const double*, Shares::most>& from, std::size_t count,
                                 double* __restrict to) {
  const double *a = from[0], *b = from[1], *c = from[2], *d = from[3], *e = from[4];
  for (std::size_t i = 0; i < count; ++i) to[i] = (a[i] + e[i]) + (b[i] + d[i]) + c[i];
}
SPLASHDOWN_WIDE void gather_seven(const std::array<const double*, Shares::most>& from, std::size_t count,
                                  double* __restrict to) {
  const double *a = from[0], *b = from[1], *c = from[2], *d = from[3], *e = from[4], *f = from[5], *g = from[6];
  for (std::size_t i = 0; i < count; ++i) to[i] = (a[i] + g[i]) + (b[i] + f[i]) + (c[i] + e[i]) + d[i];
}

}  // namespace

void Shares::give(const Velocities& v, const double* omega, std::size_t count, std::size_t pitch, double* to) const {
  const auto row = [&](std::size_t k) { return to + k * pitch; };
  const bool midpoint = paths_ == PathRule::rk2;
  if (kernel_ == Remeshing::m4)
    (midpoint ? m4_by_midpoint : m4_by_four_stages)(v.before, v.here, v.after, omega, count, row(0), row(1), row(2),
                                                    row(3), row(4));
  else
    (midpoint ? m6_by_midpoint : m6_by_four_stages)(v.before, v.here, v.after, omega, count, row(0), row(1), row(2),
                                                    row(3), row(4), row(5), row(6));
}

void Shares::gather(const std::array<const double*, most>& from, std::size_t count, double* to) const {
  (kernel_ == Remeshing::m4 ? gather_five : gather_seven)(from, count, to);
}

}  // namespace splashdown::vortex
