#include "fluid/effects/viscosity/viscosity.hpp"

#include <algorithm>
#include <numbers>

#include "core/dense.hpp"

namespace splashdown::fluid {
namespace {

// Sine of half the angle at which Wall calls an edge sharp: facets of a smooth wall differ less from the
// mean normal at a node.
constexpr double same_normal = 0.26;

// Part of the kick that a stage of second order takes at once: it leaves nothing of what is stiff.
constexpr double stage = 1 - 1 / std::numbers::sqrt2;

// Past its mirror image water slips.
template <int d>
bool sticks(const StepView<d>& step, const Facet<d>& f) {
  const auto& wall = step.walls[f.wall];
  return wall.sticks && !(wall.mirror && lies_in(*wall.mirror, f, step.nodes.x));
}

template <int d>
void hold(Mat<d>& free, const Vec<d>& direction) {
  const Vec<d> rest = free * direction;
  if (rest.norm() > same_normal * direction.norm()) free -= rest * rest.transpose() / rest.squaredNorm();
}

}  // namespace

template <int d>
Status Viscosity<d>::begin(const StepView<d>& step) {
  implicit_kick_ = step.in_time == InTime::euler ? step.kick : stage * step.kick;
  number_nodes(step);
  find_held(step);
  measure(step);
  find_bonds(step);
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
        held_.push_back({n, Mat<d>::Identity()});
        normal.push_back(Vec<d>::Zero());
      }
      normal[held_at_[n]] += area;
    }
  }
  for (std::size_t k = 0; k < held_.size(); ++k) hold<d>(held_[k].free, normal[k]);
  // In corners and along edges a second and a third normal remain, unless the wall binds the water there.
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0 || sticks<d>(step, f)) continue;
    for (int n : f.nodes) hold<d>(held_[held_at_[n]].free, area_vector_of<d>(f, step.nodes.x));
  }
}

template <int d>
void Viscosity<d>::measure(const StepView<d>& step) {
  const auto& cells = step.mesh.cells;
  gradients_.resize(cells.size());
  volume_.resize(cells.size());
  in_parallel(cells.size(), [&](std::size_t c) {
    const auto at = corners(step.nodes.x, cells[c]);
    gradients_[c] = volume_gradients<d>(at);
    volume_[c] = (at(d) - at(0)).dot(gradients_[c].col(d));
  });
}

template <int d>
void Viscosity<d>::find_bonds(const StepView<d>& step) {
  bonds_.clear();
  bonds_at_.clear();
  for (const auto& f : step.mesh.boundary) {
    if (f.wall < 0 || !sticks<d>(step, f)) continue;
    for (const auto [c, k] : step.around.around(f.nodes[0])) {
      const auto& cell = step.mesh.cells[c];
      auto of_facet = [&](int n) { return std::find(f.nodes.begin(), f.nodes.end(), n) != f.nodes.end(); };
      if (std::count_if(cell.begin(), cell.end(), of_facet) < d) continue;
      const Vec<d> area = area_vector_of<d>(f, step.nodes.x);
      Bond bond{c, f.wall, area.normalized(), area.norm() / d, 0, {}};
      for (int a = 0; a <= d; ++a) bond.held[a] = of_facet(cell[a]) && !step.nodes.surface[cell[a]];
      bonds_.push_back(bond);
    }
  }
  if (bonds_.empty()) return;
  std::stable_sort(bonds_.begin(), bonds_.end(), [](const Bond& p, const Bond& q) { return p.cell < q.cell; });
  bonds_at_.assign(step.mesh.cells.size(), -1);
  std::vector<int> count(step.mesh.cells.size(), 0);
  for (std::size_t k = bonds_.size(); k-- > 0;) {
    bonds_at_[bonds_[k].cell] = static_cast<int>(k);
    ++count[bonds_[k].cell];
  }
  for (Bond& bond : bonds_) bond.stiffness = 4 * count[bond.cell] * mu_ * d * bond.share / volume_[bond.cell];
}

// t(v) of a field that is v_b at corner b and 0 at the others: mu P (G.n + G n^T) v_b, G = grad N_b.
template <int d>
Mat<d> Viscosity<d>::bond_block(const Bond& bond, int a, int b) const {
  const Mat<d> P = Mat<d>::Identity() - bond.normal * bond.normal.transpose();
  auto traction = [&](int k) -> Mat<d> {
    const Vec<d> G = gradients_[bond.cell].col(k) / volume_[bond.cell];
    return mu_ * P * (G.dot(bond.normal) * Mat<d>::Identity() + G * bond.normal.transpose());
  };
  Mat<d> block = Mat<d>::Zero();
  if (bond.held[a]) block -= traction(b);
  if (bond.held[b]) block -= traction(a).transpose();
  if (a == b && bond.held[a]) block += bond.stiffness * P;
  return bond.share * block;
}

template <int d>
void Viscosity<d>::pull(const StepView<d>& step, std::span<const Vec<d>> v, std::span<const WallVelocity<d>> walls,
                        std::vector<Vec<d>>& force, std::vector<WallImpulse<d>>* on_walls) const {
  for (const Bond& bond : bonds_) {
    const auto& cell = step.mesh.cells[bond.cell];
    Mat<d> gradient = Mat<d>::Zero();
    for (int k = 0; k <= d; ++k) gradient += v[cell[k]] * gradients_[bond.cell].col(k).transpose();
    auto tangential = [&](const Vec<d>& x) -> Vec<d> { return x - bond.normal * bond.normal.dot(x); };
    const Vec<d> traction = tangential(mu_ / volume_[bond.cell] * (gradient + gradient.transpose()) * bond.normal);
    Vec<d> slip = Vec<d>::Zero();  // sum over bound nodes
    for (int a = 0; a <= d; ++a) {
      if (!bond.held[a]) continue;
      const WallPlace<d>& place = step.poses[bond.wall];
      const Vec<d> past = tangential(v[cell[a]] - velocity_at<d>(place, walls[bond.wall], step.nodes.x[cell[a]]));
      const Vec<d> f = bond.share * (bond.stiffness * past - traction);
      force[cell[a]] += f;
      if (on_walls) add_impulse<d>(place, step.nodes.x[cell[a]], f, (*on_walls)[bond.wall], step.kick);
      slip += past;
    }
    for (int b = 0; b <= d; ++b) {
      const Vec<d> G = gradients_[bond.cell].col(b) / volume_[bond.cell];
      force[cell[b]] -= bond.share * mu_ * (G.dot(bond.normal) * slip + bond.normal * G.dot(slip));
    }
  }
}

template <int d>
void Viscosity<d>::assemble(const StepView<d>& step) {
  const auto& cells = step.mesh.cells;
  const int n = static_cast<int>(node_.size());
  blocks_.build(cells, step.around, unknown_, node_, [&](int c, int a, int b) -> Mat<d> {
    const auto& g = gradients_[c];
    const double scale = mu_ * implicit_kick_ / volume_[c];
    Mat<d> block = scale * (g.col(a).dot(g.col(b)) * Mat<d>::Identity() + g.col(b) * g.col(a).transpose());
    if (!bonds_.empty())
      for (int k = bonds_at_[c]; k >= 0 && k < std::ssize(bonds_) && bonds_[k].cell == c; ++k)
        block += implicit_kick_ * bond_block(bonds_[k], a, b);
    return block;
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
                         std::span<const WallVelocity<d>> walls, std::vector<WallImpulse<d>>& on_walls) {
  stress(step, moved, force_);
  on_walls.assign(step.walls.size(), Wrench<d>::Zero());
  pull(step, moved, walls, force_, &on_walls);
  for (const Held& h : held_) {
    const double mass = step.density * step.lumped_volume[h.node];
    const Vec<d> impulse = mass * change[h.node] + step.kick * force_[h.node];
    const int wall = step.nodes.tie[h.node].wall;
    add_impulse<d>(step.poses[wall], step.nodes.x[h.node], impulse - h.free * impulse, on_walls[wall], -1);
  }
}

// P (M + kick K) P y = -kick P (K field - what walls pull with), field += P y.
template <int d>
bool Viscosity<d>::follow(const StepView<d>& step, std::vector<Field>& fields) {
  const std::size_t rows = d * node_.size();
  rhs_.resize(rows * fields.size());
  for (std::size_t k = 0; k < fields.size(); ++k) {
    stress(step, fields[k].v, force_);
    pull(step, fields[k].v, fields[k].walls, force_, nullptr);
    for (std::size_t i = 0; i < node_.size(); ++i) {
      Vec<d> f = -implicit_kick_ * force_[node_[i]];
      if (const int held = held_at_[node_[i]]; held >= 0) f = held_[held].free * f;
      std::copy(f.begin(), f.end(), rhs_.begin() + static_cast<std::ptrdiff_t>(rows * k + d * i));
    }
  }
  if (!solver_.solve(rhs_, static_cast<int>(fields.size()))) return false;
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (std::size_t i = 0; i < node_.size(); ++i)
      fields[k].v[node_[i]] += Eigen::Map<const Vec<d>>(&rhs_[rows * k + d * i]);
  return true;
}

// With kick f = (v_1 - v) / g of the first stage.
template <int d>
std::vector<typename Viscosity<d>::Passed> Viscosity<d>::pass(const StepView<d>& step,
                                                              const std::vector<Kicked>& fields) {
  const auto started = [](const Kicked& k, double share) {
    std::vector<Vec<d>> v = k.from.v;
    for (std::size_t i = 0; i < k.change.size(); ++i) v[i] += share * k.change[i];
    return v;
  };
  const auto at = [](const Kicked& k, double share) {
    std::vector<WallVelocity<d>> walls = k.walls;
    for (std::size_t w = 0; w < walls.size(); ++w) walls[w] = k.from.walls[w] + share * (k.walls[w] - k.from.walls[w]);
    return walls;
  };
  std::vector<Passed> out;
  std::vector<Field> first, last;
  if (step.in_time == InTime::euler) {
    for (const Kicked& k : fields) last.push_back({started(k, 1), k.walls});
    if (!follow(step, last)) return {};
    for (Field& f : last) out.push_back({f, f});
    return out;
  }
  for (const Kicked& k : fields) first.push_back({started(k, stage), at(k, stage)});
  if (!follow(step, first)) return {};
  for (std::size_t n = 0; n < fields.size(); ++n) {
    last.push_back({started(fields[n], 1), fields[n].walls});
    const std::vector<Vec<d>> pushed = started(fields[n], stage);
    for (std::size_t i = 0; i < pushed.size(); ++i) last[n].v[i] += (1 - stage) / stage * (first[n].v[i] - pushed[i]);
  }
  if (!follow(step, last)) return {};
  for (std::size_t n = 0; n < fields.size(); ++n) {
    Passed passed{last[n], last[n]};
    for (std::size_t i = 0; i < last[n].v.size(); ++i)
      passed.mean.v[i] = (1 - stage) * first[n].v[i] + stage * last[n].v[i];
    for (std::size_t w = 0; w < last[n].walls.size(); ++w)
      passed.mean.walls[w] = (1 - stage) * first[n].walls[w] + stage * last[n].walls[w];
    out.push_back(std::move(passed));
  }
  return out;
}

// The bodies' part of the implicit step: their motions take held nodes along, those the water around them.
template <int d>
bool Viscosity<d>::answer(const StepView<d>& step, const Predicted<d>& predicted,
                          std::vector<WallImpulse<d>>& on_walls) {
  const ModalInertia& bodies = *step.answers;
  const Eigen::Index count = bodies.modes.cols();
  auto on_modes = [&](std::span<const WallImpulse<d>> impulses) {
    return step.layout.on_modes(bodies.modes, impulses);
  };
  const std::vector<Vec<d>> still(step.nodes.size(), Vec<d>::Zero());
  std::vector<Kicked> kicked(count,
                             {{still, std::vector<WallVelocity<d>>(step.walls.size(), Twist<d>::Zero())}, still, {}});
  for (Eigen::Index k = 0; k < count; ++k) {
    auto& [from, v, walls] = kicked[k];
    for (std::size_t w = 0; w < step.walls.size(); ++w) walls.push_back(step.layout.of_wall(w, bodies.modes.col(k)));
    for (const Held& h : held_) {
      const int wall = step.nodes.tie[h.node].wall;
      const Vec<d> w = velocity_at<d>(step.poses[wall], walls[wall], step.nodes.x[h.node]);
      v[h.node] = w - h.free * w;
    }
  }
  const std::vector<Passed> fields = pass(step, kicked);
  if (std::ssize(fields) < count) return false;
  Eigen::MatrixXd total = bodies.inertia;
  std::vector<std::vector<WallImpulse<d>>> reaction(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    react(step, fields[k].to.v, fields[k].mean.v, fields[k].mean.walls, reaction[k]);
    total.col(k) -= on_modes(reaction[k]);
  }
  const Eigen::VectorXd y = algebra::least_squares(total, on_modes(on_walls));
  for (Eigen::Index k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < change_.size(); ++i) change_[i] += y[k] * fields[k].to.v[i];
    for (std::size_t w = 0; w < on_walls.size(); ++w) on_walls[w] += y[k] * reaction[k][w];
  }
  *predicted.answer += y;
  return true;
}

template <int d>
Status Viscosity<d>::predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) {
  power_ = 0;
  if (node_.empty()) return {};
  const std::vector<WallVelocity<d>> walls(carried.walls.begin(), carried.walls.end());
  std::vector<Passed> passed = pass(step, {{{{carried.v.begin(), carried.v.end()}, walls}, {}, walls}});
  if (passed.empty()) return {"the viscous solve failed"};
  change_ = std::move(passed[0].to.v);
  moved_ = std::move(passed[0].mean.v);
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] -= carried.v[i];
  std::vector<WallImpulse<d>> on_walls;
  react(step, change_, moved_, carried.walls, on_walls);
  if (step.answers && !answer(step, predicted, on_walls)) return {"the viscous solve failed"};
  add(step, carried, {}, predicted);
  for (std::size_t w = 0; w < on_walls.size(); ++w) predicted.on_walls[w] += on_walls[w];
  return {};
}

template <int d>
void Viscosity<d>::add(const StepView<d>& step, const Carried<d>& carried, std::span<const Vec<d>> others,
                       const Predicted<d>& predicted) {
  for (int i : node_) {
    predicted.v[i] += change_[i];
    const double mass = step.density * step.lumped_volume[i];
    Vec<d> twice_the_mean = 2 * carried.v[i] + change_[i];
    if (!others.empty()) twice_the_mean += others[i];
    power_ += 0.5 * mass * change_[i].dot(twice_the_mean) / step.kick;
  }
}

template <int d>
Status Viscosity<d>::follow(const StepView<d>& step, const Carried<d>& carried, const Others<d>& others,
                            const Predicted<d>& predicted) {
  power_ = 0;
  if (node_.empty()) return {};
  std::vector<Passed> passed =
      pass(step, {{{{carried.v.begin(), carried.v.end()}, {carried.walls.begin(), carried.walls.end()}},
                   {others.change.begin(), others.change.end()},
                   {others.walls.begin(), others.walls.end()}}});
  if (passed.empty()) return {"the viscous solve failed"};
  change_ = std::move(passed[0].to.v);
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] -= carried.v[i] + others.change[i];
  std::vector<WallImpulse<d>> on_walls;
  react(step, change_, passed[0].mean.v, passed[0].mean.walls, on_walls);
  add(step, carried, others.change, predicted);
  for (std::size_t w = 0; w < on_walls.size(); ++w) predicted.on_walls[w] += on_walls[w];
  return {};
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace splashdown::fluid
