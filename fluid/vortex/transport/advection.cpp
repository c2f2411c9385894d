#include "fluid/vortex/transport/advection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr std::size_t most_columns = 256;  // of a strip: its rows stay in the nearest caches
constexpr std::size_t fewest_rows =
    128;                        // of a strip, where threads share it: the moves of rows around it are made twice
constexpr std::size_t rim = 3;  // nodes beyond a row that its particles reach

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

/// Neighbouring nodes of a row or column, [first, last).
struct Range {
  std::size_t first, last;
  std::size_t count() const { return last - first; }
  /// So many more on both sides, as far as they are inner nodes of a row of n.
  Range widened(std::size_t by, std::size_t n) const {
    return {first > by ? first - by : 1, std::min(last + by, n - 1)};
  }
};

/// All three moves of some columns. Rows of particles come in one by one, move along x, then along y; as soon as a row
/// of nodes has all that moves along y give it, it moves along x again and is done.
class Strip {
 public:
  Strip(const Grid& grid, const Shares& shares, const MidVelocity& velocity, double dt, Range columns)
      : shares_(shares),
        velocity_(velocity),
        n_(static_cast<std::size_t>(grid.nx + 1)),
        ny_(static_cast<std::size_t>(grid.ny)),
        step_(dt / grid.h),
        columns_(columns),
        through_(columns.widened(shares.reach(), n_)),
        particles_(through_.widened(shares.reach(), n_)),
        ring_(shares.count()),
        moved_(n_),
        crossed_(n_),
        given_x_(ring_ * (particles_.count() + 2 * rim)),
        given_y_(ring_ * ring_ * through_.count()),
        v_(3 * through_.count()),
        u_((shares.reach() + 1) * n_),
        u_of_(shares.reach() + 1, none),
        v_of_(3, none),
        is_calm_(ring_, true) {}

  /// Rows [first, last) of the nodes.
  void run(const NodeField& omega, std::size_t first, std::size_t last, NodeField& to) {
    const std::size_t reach = shares_.reach();
    for (std::size_t j = first > reach ? first - reach : 0; j < last + reach; ++j) {
      take(omega, j);
      if (j < first + reach) continue;
      give(j - reach, to.data() + (j - reach) * n_);
    }
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Of a row, at the nodes of the particles and one beyond on both sides, by columns of the grid.
  const double* u_of(std::size_t j) {
    const std::size_t slot = j % u_of_.size();
    double* u = u_.data() + slot * n_;
    if (std::exchange(u_of_[slot], j) != j) {
      const std::size_t at = particles_.first - 1, here = j * n_ + at, below = here - n_;
      const double *now = velocity_.now.u.data(), *before = velocity_.before.u.data();
      velocities({now + here, now + below, before + here, before + below, 0.25 * step_ * (1 + velocity_.ahead),
                  -0.25 * step_ * velocity_.ahead},
                 particles_.count() + 2, u + at);
    }
    return u;
  }

  /// Of a row, at the nodes that rows of particles go through.
  const double* v_of(std::size_t j) {
    const std::size_t slot = j % v_of_.size();
    double* v = v_.data() + slot * through_.count();
    if (std::exchange(v_of_[slot], j) != j) {
      const std::size_t here = j * n_ + through_.first;
      const double *now = velocity_.now.v.data() + here, *before = velocity_.before.v.data() + here;
      velocities(
          {now, now - 1, before, before - 1, 0.5 * step_ * (1 + velocity_.ahead), -0.5 * step_ * velocity_.ahead},
          through_.count(), v);
    }
    return v;
  }

  /// A row's particles move along x: nodes get their shares. Rows by columns of the grid; false: nothing is there.
  bool move_along_x(std::size_t j, const double* omega, Range nodes, double* to) {
    const std::size_t reach = shares_.reach();
    const Range from = nodes.widened(reach, n_);
    if (all_zero(omega + from.first, from.count())) return false;
    const double* u = u_of(j) + from.first;
    // Shares stand `rim` further, between zeros: there are no particles beyond.
    const std::size_t pitch = particles_.count() + 2 * rim;
    for (std::size_t k = 0; k < ring_; ++k) {
      double* share = given_x_.data() + k * pitch;
      std::fill_n(share, rim, 0.0);
      std::fill_n(share + rim + from.count(), rim, 0.0);
    }
    shares_.give({u - 1, u, u + 1}, omega + from.first, from.count(), pitch, given_x_.data() + rim);
    std::array<const double*, Shares::most> given{};
    for (std::size_t k = 0; k < ring_; ++k)  // node i gets share k of the particle i - (k - reach)
      given[k] = given_x_.data() + k * pitch + rim + nodes.first - from.first + reach - k;
    shares_.gather(given, nodes.count(), to + nodes.first);
    return true;
  }

  /// A row of particles moves along x, and then along y: what it gives is kept.
  void take(const NodeField& omega, std::size_t j) {
    const std::size_t slot = j % ring_;
    double* given = given_y_.data() + slot * ring_ * through_.count();
    if (j > 0 && j < ny_ && move_along_x(j, omega.data() + j * n_, through_, moved_.data())) {
      shares_.give({v_of(j - 1), v_of(j), v_of(j + 1)}, moved_.data() + through_.first, through_.count(),
                   through_.count(), given);
      is_calm_[slot] = false;
    } else if (!is_calm_[slot]) {
      clear_row(given, ring_ * through_.count());
      is_calm_[slot] = true;
    }
  }

  /// A row of nodes that has all of moves along y: along x again.
  void give(std::size_t row, double* to) {
    const std::size_t reach = shares_.reach(), last = row + reach;
    const bool any = std::ranges::any_of(is_calm_, [](char calm) { return !calm; });
    if (any) {
      std::array<const double*, Shares::most> given{};
      for (std::size_t k = 0; k < ring_; ++k)  // share k of the row of particles row - (k - reach)
        given[k] = given_y_.data() + ((last + ring_ - k) % ring_ * ring_ + k) * through_.count();
      shares_.gather(given, through_.count(), crossed_.data() + through_.first);
    }
    if (!any || !move_along_x(row, crossed_.data(), columns_, to)) clear_row(to + columns_.first, columns_.count());
  }

  Shares shares_;
  MidVelocity velocity_;
  std::size_t n_, ny_;
  double step_;
  Range columns_, through_, particles_;  // that are made; that rows of particles go through; that particles come from
  std::size_t ring_;                     // rows that a particle gives to
  std::vector<double> moved_, crossed_;  // a row after its move along x, and after those along y
  std::vector<double> given_x_, given_y_;
  std::vector<double> v_, u_;
  std::vector<std::size_t> u_of_, v_of_;  // rows that slots of them hold
  std::vector<char> is_calm_;             // rows of given_y_ that are zero
};

}  // namespace

void Advection::move(const NodeField& omega, const MidVelocity& velocity, double dt, NodeField& moved) const {
  const Shares shares(kernel_, rule_);
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny), inner = n - 2;
  moved.resize(omega.size());
  const std::size_t strips = (inner + most_columns - 1) / most_columns,
                    parts = std::clamp(ny / fewest_rows, std::size_t{1}, static_cast<std::size_t>(threads()));
  in_pieces(strips * parts, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t strip = k / parts, part = k % parts, rows = ny - 1;
      const Range columns{1 + inner * strip / strips, 1 + inner * (strip + 1) / strips};
      Strip(grid_, shares, velocity, dt, columns)
          .run(omega, 1 + rows * part / parts, 1 + rows * (part + 1) / parts, moved);
    }
  });
  clear_row(moved.data(), n);
  clear_row(moved.data() + ny * n, n);
  for (std::size_t j = 1; j < ny; ++j) moved[j * n] = moved[(j + 1) * n - 1] = 0;
}

}  // namespace splashdown::vortex
