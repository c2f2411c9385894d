// What people look at in a fluid on a grid.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/geometry.hpp"
#include "core/leapfrog.hpp"
#include "core/parallel.hpp"
#include "fluid/vortex/control_volume.hpp"
#include "fluid/vortex/fluid.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

double cross_of(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

constexpr double off_the_hull = 1.5;  // squares: pressures on hulls are read where no face is covered

/// Mean of the two faces of each direction at a node, weighted between two instants.
Vec<2> at_node(const Grid& g, const FaceField& f, int i, int j) {
  const std::size_t k = g.at(i, j);
  const auto row = static_cast<std::size_t>(g.nx + 1);
  const double u = j == 0 ? f.u[k] : j == g.ny ? f.u[k - row] : 0.5 * (f.u[k] + f.u[k - row]);
  const double v = i == 0 ? f.v[k] : i == g.nx ? f.v[k - 1] : 0.5 * (f.v[k] + f.v[k - 1]);
  return {u, v};
}

/// Faces beside a row of nodes: below and above, and along it.
struct NodeRows {
  const double *below, *above, *along;
};

/// The greatest square of velocities at the inner nodes of a row of `count`, linear between two instants.
SPLASHDOWN_WIDE double most_square(const NodeRows& before, const NodeRows& after, double ahead, std::size_t count) {
  const double *__restrict a = before.below, *__restrict b = before.above, *__restrict c = before.along,
               *__restrict d = after.below, *__restrict e = after.above, *__restrict f = after.along;
  double most[lanes] = {};
  const auto square = [&](std::size_t i) {
    const double u = 0.5 * (a[i] + b[i]), v = 0.5 * (c[i] + c[i - 1]);
    const double x = u + ahead * (0.5 * (d[i] + e[i]) - u), y = v + ahead * (0.5 * (f[i] + f[i - 1]) - v);
    return x * x + y * y;
  };
  std::size_t i = 1;
  for (; i + lanes < count; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      const double s = square(i + l);
      most[l] = most[l] < s ? s : most[l];
    }
  for (; i + 1 < count; ++i) most[0] = std::max(most[0], square(i));
  return *std::max_element(most, most + lanes);
}

/// Sums of a row and of its squares.
SPLASHDOWN_WIDE std::array<double, 2> sums_of(const double* __restrict row, std::size_t count) {
  double sums[lanes] = {}, squares[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      sums[l] += row[i + l];
      squares[l] += row[i + l] * row[i + l];
    }
  for (; i < count; ++i) {
    sums[0] += row[i];
    squares[0] += row[i] * row[i];
  }
  for (std::size_t l = 1; l < lanes; ++l) {
    sums[0] += sums[l];
    squares[0] += squares[l];
  }
  return {sums[0], squares[0]};
}

}  // namespace

void GridFlow::add_samples() {
  const auto& g = spec_.grid;
  cells_.reserve(2 * static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(g.ny));
  const auto corner = [&](int i, int j) { return static_cast<int>(g.at(i, j)); };
  for (int j = 0; j < g.ny; ++j)
    for (int i = 0; i < g.nx; ++i) {
      cells_.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      cells_.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  for (std::size_t w = 0; w < spec_.walls.size(); ++w) {
    const auto& outline = spec_.walls[w].surface;
    std::vector<int> first(static_cast<std::size_t>(outline.vertices.cols()), -1);  // the sample at a vertex
    std::vector<std::array<int, 2>> open;  // facet to a vertex whose sample may not exist yet
    for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
      const Vec<2> a = outline.vertices.col(outline.facets(0, f)), b = outline.vertices.col(outline.facets(1, f));
      const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / g.h)));
      const Vec<2> out = Vec<2>((b - a).y(), -(b - a).x()).normalized();
      for (int k = 0; k < pieces; ++k) {
        const int number = static_cast<int>(g.nodes() + samples_.size());
        if (k == 0) first[static_cast<std::size_t>(outline.facets(0, f))] = number;
        samples_.push_back({a + k * (b - a) / pieces, out, static_cast<int>(w)});
        if (k > 0) boundary_.push_back({{number, number - 1}, static_cast<int>(w)});
        if (k + 1 == pieces) open.push_back({number, outline.facets(1, f)});
      }
    }
    for (const auto& [from, vertex] : open)
      boundary_.push_back({{first[static_cast<std::size_t>(vertex)], from}, static_cast<int>(w)});
  }
  points_.reserve(g.nodes() + samples_.size());
  for (int j = 0; j <= g.ny; ++j)
    for (int i = 0; i <= g.nx; ++i) points_.push_back(g.node(i, j));
  points_.resize(g.nodes() + samples_.size());
  place_samples();
}

void GridFlow::place_samples() {
  for (std::size_t s = 0; s < samples_.size(); ++s)
    points_[spec_.grid.nodes() + s] = poses_[static_cast<std::size_t>(samples_[s].wall)] * samples_[s].at;
}

PointPlace GridFlow::place(std::size_t point) const {
  const std::size_t nodes = spec_.grid.nodes();
  return {.wall = point < nodes ? -1 : samples_[point - nodes].wall};
}

Vec<2> GridFlow::velocity_n(std::size_t point) const {
  const auto& g = spec_.grid;
  const auto mean = [&](const auto& before, const auto& after) {
    return is_begun_ ? velocity_at_t_n(before, after, dt_before_, dt_) : before;
  };
  if (point >= g.nodes()) {
    const auto w = static_cast<std::size_t>(samples_[point - g.nodes()].wall);
    const Twist<2> twist = is_begun_ && !trial_twists_.empty() ? mean(twists_[w], trial_twists_[w]) : twists_[w];
    return rigid_velocity<2>(twist, points_[point] - poses_[w].translation());
  }
  const int j = static_cast<int>(point / static_cast<std::size_t>(g.nx + 1)),
            i = static_cast<int>(point) - j * (g.nx + 1);
  const Vec<2> before = at_node(g, velocity_, i, j);
  return is_begun_ ? mean(before, at_node(g, trial_velocity_, i, j)) : before;
}

double GridFlow::max_speed() const {
  const auto& g = spec_.grid;
  const auto &before = velocity_, &after = is_begun_ ? trial_velocity_ : velocity_;
  const double ahead = is_begun_ ? dt_before_ / (dt_before_ + dt_) : 0;
  const auto row = static_cast<std::size_t>(g.nx + 1), ny = static_cast<std::size_t>(g.ny);
  std::vector<double> squares(ny + 1);
  in_pieces(ny + 1, 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      const std::size_t below = (j == 0 ? 0 : j - 1) * row, above = (j == ny ? ny - 1 : j) * row;
      const auto rows = [&](const FaceField& f) {
        return NodeRows{f.u.data() + below, f.u.data() + above, f.v.data() + j * row};
      };
      squares[j] = most_square(rows(before), rows(after), ahead, row);
      for (const std::size_t end : {j * row, (j + 1) * row - 1})
        squares[j] = std::max(squares[j], velocity_n(end).squaredNorm());
    }
  });
  double most = std::ranges::max(squares);
  for (std::size_t s = 0; s < samples_.size(); ++s) most = std::max(most, velocity_n(g.nodes() + s).squaredNorm());
  return std::sqrt(most);
}

/// Total head by div grad H = div(u x omega + f), then p = rho (H - u^2/2 + ...): the momentum equation's part with
/// divergence.
void GridFlow::solve_pressure() const {
  const auto& g = spec_.grid;
  const auto row = static_cast<std::size_t>(g.nx + 1);
  pressure_.assign(points_.size(), 0.0);
  FaceField force;
  force.reset(g.nodes());
  const double ratio = kick_before_ > 0 ? kick_ / kick_before_ : 0;
  if (is_begun_)
    for (std::size_t w = 0; w < penalised_.size() && !trial_twists_.empty(); ++w)
      penalised_[w].add_forces(trial_twists_[w], kick_, ratio, force);
  const auto& now = velocity_;
  const auto& next = is_begun_ ? trial_velocity_ : velocity_;
  const auto& omega = is_begun_ ? trial_omega_ : omega_;
  for (int j = 1; j < g.ny - 1; ++j)
    for (int i = 1; i < g.nx - 1; ++i) {
      const std::size_t k = g.at(i, j);
      const auto v = [&](std::size_t at) { return 0.5 * (now.v[at] + next.v[at]); };
      const auto u = [&](std::size_t at) { return 0.5 * (now.u[at] + next.u[at]); };
      const auto w = [&](std::size_t at) { return 0.5 * (omega_[at] + omega[at]); };
      force.u[k] += 0.125 * (w(k) + w(k + row)) * (v(k) + v(k - 1) + v(k + row) + v(k + row - 1));
      force.v[k] -= 0.125 * (w(k) + w(k + 1)) * (u(k) + u(k + 1) + u(k - row) + u(k - row + 1));
    }
  NodeField source(g.nodes(), 0.0), head;
  for (int j = 1; j < g.ny; ++j)
    for (int i = 1; i < g.nx; ++i) {  // minus the mean divergence of the four squares around a node
      const std::size_t k = g.at(i, j);
      const auto &a = force.u, &b = force.v;
      source[k] = -0.25 / g.h *
                  (a[k + 1] + a[k + 1 - row] - a[k - 1] - a[k - 1 - row] + b[k + row] + b[k + row - 1] - b[k - row] -
                   b[k - row - 1]);
    }
  StreamFunction solver(g, SideKind::free);
  solver.solve(source, head);
  const Vec<2> far = stream(time_),
               change =
                   is_begun_
                       ? Vec<2>((stream(time_ + 0.5 * dt_) - stream(std::max(0., time_ - 0.5 * dt_before_))) / kick_)
                       : Vec<2>(Vec<2>::Zero());
  const Vec<2> top = g.max();
  for (std::size_t k = 0; k < g.nodes(); ++k)
    pressure_[k] = spec_.density * (head[k] - 0.5 * (velocity_n(k).squaredNorm() - far.squaredNorm()) +
                                    (spec_.gravity - change).dot(points_[k] - top));
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const auto& pose = poses_[static_cast<std::size_t>(samples_[s].wall)];
    pressure_[g.nodes() + s] = node_pressure(pose * Vec<2>(samples_[s].at + off_the_hull * g.h * samples_[s].out));
  }
}

std::span<const double> GridFlow::pressure() const {
  if (pressure_.empty()) solve_pressure();
  return pressure_;
}

/// Bilinear between nodes.
double GridFlow::node_pressure(const Vec<2>& point) const {
  const auto& g = spec_.grid;
  const Vec<2> at = (point - g.min) / g.h;
  const int i = std::clamp(static_cast<int>(std::floor(at.x())), 0, g.nx - 1),
            j = std::clamp(static_cast<int>(std::floor(at.y())), 0, g.ny - 1);
  const double s = std::clamp(at.x() - i, 0., 1.), t = std::clamp(at.y() - j, 0., 1.);
  const auto p = [&](int k, int l) { return pressure_[g.at(i + k, j + l)]; };
  return (1 - t) * ((1 - s) * p(0, 0) + s * p(1, 0)) + t * ((1 - s) * p(0, 1) + s * p(1, 1));
}

/// How much of the face nearest to a point bodies cover.
double GridFlow::filled(const Vec<2>& point) const {
  const auto& g = spec_.grid;
  double sum = 0;
  for (const auto& wall : penalised_) {
    const auto& [box, chi] = wall.chi();
    if (chi.u.empty()) continue;
    const int i = static_cast<int>(std::lround((point.x() - g.min.x()) / g.h)) - box.i0;
    const int j = static_cast<int>(std::floor((point.y() - g.min.y()) / g.h)) - box.j0;
    if (i >= 0 && j >= 0 && i < box.width && j < box.height) sum += chi.u[box.at(i, j)];
  }
  return sum;
}

std::optional<double> GridFlow::pressure_at(const Vec<2>& point) const {
  const auto& g = spec_.grid;
  if ((point.array() < g.min.array()).any() || (point.array() > g.max().array()).any() || filled(point) > 0.5)
    return {};
  pressure();
  return node_pressure(point);
}

std::vector<Diagnostic> GridFlow::diagnostics() const {
  double circulation = 0, enstrophy = 0;
  const auto row = static_cast<std::size_t>(spec_.grid.nx + 1);
  for (std::size_t first = 0; first < omega_.size(); first += row) {
    const auto [sum, squares] = sums_of(omega_.data() + first, row);
    circulation += sum;
    enstrophy += squares;
  }
  const double cell = spec_.grid.h * spec_.grid.h;
  std::vector<Diagnostic> all = {{"circulation", circulation * cell}, {"enstrophy", enstrophy * cell}};
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    if (penalised_[w].moments().is_inside_out()) continue;
    const auto load = load_by_control_volume(w);
    const char* axes[] = {"fx", "fy", "m"};
    for (int k = 0; k < 3; ++k)
      all.emplace_back(std::string("control_") + axes[k] + "_" + spec_.walls[w].name, load[k]);
  }
  return all;
}

/// Of the step under way, by a rectangle half as far from the body as it is long (control_volume.hpp); its sum for all bodies in it.
/// NaN: it does not fit.
Wrench<2> GridFlow::load_by_control_volume(std::size_t wall) const {
  Wrench<2> load = Wrench<2>::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!is_begun_ || trial_twists_.empty()) return load;
  const auto& g = spec_.grid;
  const auto& of = penalised_[wall].chi().box;
  const int more = std::max(of.width, of.height) / 2;
  const NodeBox box{std::max(2, of.i0 - more), std::max(2, of.j0 - more), std::min(g.nx - 2, of.i0 + of.width + more),
                    std::min(g.ny - 2, of.j0 + of.height + more)};
  const auto holds = [&](const FaceBox& other) {
    return other.i0 > box.first_i && other.j0 > box.first_j && other.i0 + other.width <= box.last_i &&
           other.j0 + other.height <= box.last_j;
  };
  if (!holds(of)) return load;
  const Change change{omega_, trial_omega_, velocity_, trial_velocity_, kick_};
  const auto& pose = poses_[wall];
  const Wrench<2> all = force_in(g, box, change, spec_.viscosity, pose.translation());
  // What the passes found is not in trial_omega_ yet; that of others in the rectangle is taken as they tell it.
  Wrench<2> told = Wrench<2>::Zero();
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    if (w != wall && (penalised_[w].moments().is_inside_out() || !holds(penalised_[w].chi().box))) continue;
    const auto [found, sum] = penalised_[w].sums(trial_twists_[w], ratio_);
    Wrench<2> missing = sum - found;  // of what the rectangle sees
    missing[2] += cross_of(poses_[w].translation() - pose.translation(), missing.head<2>());
    told += missing;
  }
  return loads_[wall].physical - spec_.density * (all - told / kick_);
}

Eigen::MatrixXd GridFlow::added_mass(std::span<const std::size_t> walls) const {
  const auto count = static_cast<Eigen::Index>(walls.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  Projections projections;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& wall = penalised_[walls[static_cast<std::size_t>(k)]];
    if (!wall.moments().is_inside_out() && !wall.chi().field.u.empty())
      all.block<3, 3>(3 * k, 3 * k) = wall.added_mass(spec_.density, projections);
  }
  return all;
}

}  // namespace splashdown::vortex
