#include "fluid/viscosity.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace splashdown::fluid {
namespace {

// Sine of half the angle at which Wall calls an edge sharp: facets of a smooth wall differ less from the
// mean normal at a node.
constexpr double same_normal = 0.26;

template <int d>
void hold(Mat<d>& free, const Vec<d>& direction) {
  const Vec<d> rest = free * direction;
  if (rest.norm() > same_normal * direction.norm()) free -= rest * rest.transpose() / rest.squaredNorm();
}

}  // namespace

template <int d>
Status Viscosity<d>::begin(const StepView<d>& step) {
  number_nodes(step);
  find_held(step);
  assemble(step);
  if (!node_.empty() && !solver_.factor(matrix_)) return {"the viscous matrix could not be factored"};
  return {};
}

template <int d>
void Viscosity<d>::number_nodes(const StepView<d>& step) {
  unknown_.assign(step.nodes.size(), -1);
  node_.clear();
  for (std::size_t i = 0; i < step.nodes.size(); ++i)
    if (!step.nodes.spray[i]) {
      unknown_[i] = static_cast<int>(node_.size());
      node_.push_back(static_cast<int>(i));
    }
}

template <int d>
void Viscosity<d>::find_held(const StepView<d>& step) {
  held_.clear();
  held_at_.assign(step.nodes.size(), -1);
  std::vector<Vec<d>> normal;  // of held nodes: mean over their wetted facets
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0) continue;
    const Vec<d> area = area_vector_of<d>(f, step.nodes.x);
    for (int n : f.nodes) {
      if (held_at_[n] < 0) {
        held_at_[n] = static_cast<int>(held_.size());
        held_.push_back({n, step.walls[f.wall].sticks && !step.nodes.surface[n], Mat<d>::Identity()});
        normal.push_back(Vec<d>::Zero());
      }
      normal[held_at_[n]] += area;
    }
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k].sticks)
      held_[k].free.setZero();
    else
      hold<d>(held_[k].free, normal[k]);
  }
  // In corners and along edges a second and a third normal remain.
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0) continue;
    for (int n : f.nodes) hold<d>(held_[held_at_[n]].free, area_vector_of<d>(f, step.nodes.x));
  }
}

template <int d>
void Viscosity<d>::assemble(const StepView<d>& step) {
  const auto& cells = step.mesh.cells;
  gradients_.resize(cells.size());
  volume_.resize(cells.size());
  in_parallel(cells.size(), [&](std::size_t c) {
    const auto at = corners(step.nodes.x, cells[c]);
    gradients_[c] = volume_gradients<d>(at);
    volume_[c] = (at(d) - at(0)).dot(gradients_[c].col(d));
  });
  const int n = static_cast<int>(node_.size());
  blocks_.build(cells, step.around, unknown_, node_, [&](int c, int a, int b) -> Mat<d> {
    const auto& g = gradients_[c];
    const double scale = mu_ * step.kick / volume_[c];
    return scale * (g.col(a).dot(g.col(b)) * Mat<d>::Identity() + g.col(b) * g.col(a).transpose());
  });

  // P (M + kick K) P + (1 - P) M; P = free directions of a node
  matrix_.column_start.assign(1, 0);
  matrix_.row.clear();
  matrix_.value.clear();
  std::vector<Mat<d>> column;
  for (int j = 0; j < n; ++j) {
    const int first = blocks_.column_start[j], last = blocks_.column_start[j + 1];
    const double mass = step.density * step.lumped_volume[node_[j]];
    const int held_j = held_at_[node_[j]];
    column.assign(blocks_.value.begin() + first, blocks_.value.begin() + last);
    for (int k = first; k < last; ++k) {
      Mat<d>& block = column[k - first];
      if (const int held_i = held_at_[node_[blocks_.row[k]]]; held_i >= 0) block = held_[held_i].free * block;
      if (held_j >= 0) block = block * held_[held_j].free;
    }
    column.front() += mass * Mat<d>::Identity();
    for (int b = 0; b < d; ++b) {
      for (int k = first; k < last; ++k)
        for (int a = k == first ? b : 0; a < d; ++a) {
          matrix_.row.push_back(d * blocks_.row[k] + a);
          matrix_.value.push_back(column[k - first](a, b));
        }
      matrix_.column_start.push_back(static_cast<int>(matrix_.row.size()));
    }
  }
}

template <int d>
void Viscosity<d>::stress(const StepView<d>& step, std::span<const Vec<d>> v, std::vector<Vec<d>>& force) const {
  stress_.resize(step.mesh.cells.size());
  in_parallel(stress_.size(), [&](std::size_t c) {
    const auto& cell = step.mesh.cells[c];
    Mat<d> gradient = Mat<d>::Zero();
    for (int k = 0; k <= d; ++k) gradient += v[cell[k]] * gradients_[c].col(k).transpose();
    stress_[c] = mu_ / volume_[c] * (gradient + gradient.transpose());
  });
  force.assign(v.size(), Vec<d>::Zero());
  in_parallel(v.size(), [&](std::size_t i) {
    for (const auto [c, k] : step.around.around(i)) force[i] += stress_[c] * gradients_[c].col(k);
  });
}

template <int d>
void Viscosity<d>::react(const StepView<d>& step, std::span<const Vec<d>> change, std::span<const Vec<d>> moved,
                         std::vector<Wrench<d>>& on_walls) {
  stress(step, moved, force_);
  on_walls.assign(step.walls.size(), Wrench<d>::Zero());
  for (const Held& h : held_) {
    const double mass = step.density * step.lumped_volume[h.node];
    const Vec<d> impulse = mass * change[h.node] + step.kick * force_[h.node];
    const int wall = step.nodes.tie[h.node].wall;
    on_walls[wall] -= wrench_of<d>(step.nodes.x[h.node] - step.poses[wall].translation(), impulse - h.free * impulse);
  }
}

// P (M + kick K) P y = -kick P K (field), field += P y.
template <int d>
bool Viscosity<d>::follow(const StepView<d>& step, std::vector<std::vector<Vec<d>>>& fields) {
  const std::size_t rows = d * node_.size();
  rhs_.resize(rows * fields.size());
  for (std::size_t k = 0; k < fields.size(); ++k) {
    stress(step, fields[k], force_);
    for (std::size_t i = 0; i < node_.size(); ++i) {
      Vec<d> f = -step.kick * force_[node_[i]];
      if (const int held = held_at_[node_[i]]; held >= 0) f = held_[held].free * f;
      std::copy(f.begin(), f.end(), rhs_.begin() + static_cast<std::ptrdiff_t>(rows * k + d * i));
    }
  }
  if (!solver_.solve(rhs_, static_cast<int>(fields.size()))) return false;
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (std::size_t i = 0; i < node_.size(); ++i)
      fields[k][node_[i]] += Eigen::Map<const Vec<d>>(&rhs_[rows * k + d * i]);
  return true;
}

// The bodies' part of the implicit step: their motions take held nodes along, those the water around them.
template <int d>
bool Viscosity<d>::answer(const StepView<d>& step, const Predicted<d>& predicted, std::vector<Wrench<d>>& on_walls) {
  const MotionView& bodies = *step.motions;
  const Eigen::Index count = bodies.modes.cols();
  auto on_motions = [&](std::span<const Wrench<d>> impulses) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
    for (std::size_t w = 0; w < impulses.size(); ++w)
      sum += bodies.modes.middleRows(static_cast<Eigen::Index>(w) * freedoms<d>, freedoms<d>).transpose() * impulses[w];
    return sum;
  };
  std::vector<std::vector<Vec<d>>> fields(count, std::vector<Vec<d>>(step.nodes.size(), Vec<d>::Zero()));
  for (Eigen::Index k = 0; k < count; ++k)
    for (const Held& h : held_) {
      const int wall = step.nodes.tie[h.node].wall;
      const Twist<d> twist = bodies.modes.col(k).template segment<freedoms<d>>(wall * freedoms<d>);
      const Vec<d> w = rigid_velocity<d>(twist, step.nodes.x[h.node] - step.poses[wall].translation());
      fields[k][h.node] = w - h.free * w;
    }
  if (!follow(step, fields)) return false;
  Eigen::MatrixXd total = bodies.inertia;
  std::vector<std::vector<Wrench<d>>> reaction(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    react(step, fields[k], fields[k], reaction[k]);
    total.col(k) -= on_motions(reaction[k]);
  }
  const Eigen::MatrixXd directions =
      bodies.directions.size() > 0 ? bodies.directions : Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd allowed = directions.transpose() * total * directions;
  const Eigen::VectorXd y =
      directions * allowed.completeOrthogonalDecomposition().solve(directions.transpose() * on_motions(on_walls));
  for (Eigen::Index k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < change_.size(); ++i) change_[i] += y[k] * fields[k][i];
    for (std::size_t w = 0; w < on_walls.size(); ++w) on_walls[w] += y[k] * reaction[k][w];
  }
  *predicted.answer += y;
  return true;
}

// dv = c + P y: c is given by sticking walls, y solves what P leaves of the equation.
template <int d>
Status Viscosity<d>::predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) {
  power_ = 0;
  if (node_.empty()) return {};
  const auto& nodes = step.nodes;
  std::vector<std::vector<Vec<d>>> moved(1, {carried.v.begin(), carried.v.end()});
  for (const Held& h : held_) {
    if (!h.sticks) continue;
    const int wall = nodes.tie[h.node].wall;
    moved[0][h.node] = rigid_velocity<d>(carried.walls[wall], nodes.x[h.node] - step.poses[wall].translation());
  }
  if (!follow(step, moved)) return {"the viscous solve failed"};
  change_ = std::move(moved[0]);
  moved_ = change_;
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] -= carried.v[i];
  std::vector<Wrench<d>> on_walls;
  react(step, change_, moved_, on_walls);
  if (step.motions && !answer(step, predicted, on_walls)) return {"the viscous solve failed"};
  for (int i : node_) {
    predicted.v[i] += change_[i];
    const double mass = step.density * step.lumped_volume[i];
    power_ += 0.5 * mass * change_[i].dot(2 * carried.v[i] + change_[i]) / step.kick;
  }
  for (std::size_t w = 0; w < on_walls.size(); ++w) predicted.on_walls[w] += on_walls[w];
  return {};
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace splashdown::fluid
