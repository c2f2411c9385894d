#include "fluid/vortex/penalised/wall.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/vortex/transport/kernels.hpp"

namespace splashdown::vortex {
namespace {

constexpr int margin = 3;  // nodes around what is covered: M'4 carries forces two squares

void zero(const FaceBox& box, FaceField& field) { field.reset(box.size()); }

/// By M'4 from the samples of a box at a place in its indices; zero outside.
double gathered(const FaceBox& box, const std::vector<double>& field, double x, double y) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  double sum = 0;
  for (int l = std::max(0, j - 1); l <= std::min(box.height - 1, j + 2); ++l)
    for (int k = std::max(0, i - 1); k <= std::min(box.width - 1, i + 2); ++k)
      sum += m4(x - k) * m4(y - l) * field[box.at(k, l)];
  return sum;
}

}  // namespace

BoxProjection& Projections::of(int width, int height) {
  return known_.try_emplace({width, height}, width, height).first->second;
}

PenalisedWall::PenalisedWall(const Grid& grid, const WallSpec<2>& spec, double smoothing, const Vec<2>& stream)
    : grid_(grid),
      outline_(spec.surface),
      moments_(moments_of(spec.surface)),
      width_(smoothing * grid.h),
      placed_(spec.pose),
      filling_(stream.x(), stream.y(), 0),
      pose_(spec.pose) {}

/// visit(local index, place of the u face, place of the v face)
template <class Visit>
void PenalisedWall::visit(const BoxField& on, Visit visit) const {
  for (int j = 0; j < on.box.height; ++j)
    for (int i = 0; i < on.box.width; ++i) {
      const Vec<2> node = grid_.node(on.box.i0 + i, on.box.j0 + j);
      visit(on.box.at(i, j), Vec<2>(node.x(), node.y() + 0.5 * grid_.h), Vec<2>(node.x() + 0.5 * grid_.h, node.y()));
    }
}

void PenalisedWall::add_curl_of(const BoxField& f, double factor, NodeField& omega) const {
  const double scale = factor / grid_.h;
  const auto& box = f.box;
  const auto w = static_cast<std::size_t>(box.width);
  for (int j = 0; j < box.height; ++j) {
    if (box.j0 + j <= 0 || box.j0 + j >= grid_.ny) continue;
    for (int i = 0; i < box.width; ++i) {
      if (box.i0 + i <= 0 || box.i0 + i >= grid_.nx) continue;
      const std::size_t k = box.at(i, j);
      omega[grid_.at(box.i0 + i, box.j0 + j)] +=
          scale * (f.field.v[k] - (i > 0 ? f.field.v[k - 1] : 0.0) - f.field.u[k] + (j > 0 ? f.field.u[k - w] : 0.0));
    }
  }
}

/// int N^T f about a point, without density [m^3/s, m^4/s].
Wrench<2> PenalisedWall::impulse_of(const BoxField& f, const Vec<2>& about) const {
  Wrench<2> sum = Wrench<2>::Zero();
  visit(f, [&](std::size_t k, const Vec<2>& u, const Vec<2>& v) {
    sum[0] += f.field.u[k];
    sum[1] += f.field.v[k];
    sum[2] += (v.x() - about.x()) * f.field.v[k] - (u.y() - about.y()) * f.field.u[k];
  });
  return grid_.h * grid_.h * sum;
}

NodeField PenalisedWall::predict_before(NodeField& omega, double ratio) const {
  NodeField without;
  if (force_.field.u.empty()) return without;
  without.reserve(force_.box.size());
  for (int j = 0; j < force_.box.height; ++j) {
    const double* row = omega.data() + grid_.at(force_.box.i0, force_.box.j0 + j);
    without.insert(without.end(), row, row + force_.box.width);
  }
  add_curl_of(force_, 0.5 * ratio, omega);
  return without;
}

void PenalisedWall::forget_prediction(const NodeField& without, NodeField& omega) const {
  if (without.empty()) return;
  for (int j = 0; j < force_.box.height; ++j)
    std::copy_n(without.begin() + static_cast<std::ptrdiff_t>(force_.box.at(0, j)), force_.box.width,
                omega.begin() + static_cast<std::ptrdiff_t>(grid_.at(force_.box.i0, force_.box.j0 + j)));
}

/// The last step's forces, moved with the wall, where it is now.
void PenalisedWall::carry(double ratio) {
  predicted_.box = chi_.box;
  zero(chi_.box, predicted_.field);
  if (force_.field.u.empty()) return;
  const bool stays = force_.box == chi_.box && placed_.matrix() == pose_.matrix();
  const Isometry<2> back = placed_ * pose_.inverse();
  const Mat<2> turn = back.linear().transpose();
  const auto& from = force_;
  const Vec<2> corner = grid_.node(from.box.i0, from.box.j0);
  const auto force_at = [&](const Vec<2>& x) {
    const Vec<2> at = (back * x - corner) / grid_.h;
    const Vec<2> f(gathered(from.box, from.field.u, at.x(), at.y() - 0.5),
                   gathered(from.box, from.field.v, at.x() - 0.5, at.y()));
    return Vec<2>(0.5 * ratio * turn * f);
  };
  visit(predicted_, [&](std::size_t k, const Vec<2>& u, const Vec<2>& v) {
    if (chi_.field.u[k] > 0) predicted_.field.u[k] = stays ? 0.5 * ratio * from.field.u[k] : force_at(u).x();
    if (chi_.field.v[k] > 0) predicted_.field.v[k] = stays ? 0.5 * ratio * from.field.v[k] : force_at(v).y();
  });
}

void PenalisedWall::cover_at(const Isometry<2>& pose, NodeField& omega, double ratio) {
  const bool stays = is_covered_ && pose.matrix() == pose_.matrix();
  pose_ = pose;
  if (!stays) {  // a refused step leaves nothing but what the same pose would give again
    chi_.box = moments_.is_inside_out() ? FaceBox{0, 0, grid_.nx + 1, grid_.ny + 1}
                                        : box_around(grid_, outline_, pose, width_, margin);
    cover(grid_, chi_.box, outline_, pose, width_, moments_.is_inside_out(), chi_.field);
    is_covered_ = true;
  }
  carry(ratio);
  if (is_on_grid()) add_curl_of(predicted_, 1, omega);
}

bool PenalisedWall::is_on_grid() const {
  const auto& b = chi_.box;
  return b.i0 >= 0 && b.j0 >= 0 && b.i0 + b.width <= grid_.nx + 1 && b.j0 + b.height <= grid_.ny + 1;
}

void PenalisedWall::make_rigid(const FaceField& velocity, double share, int passes, Projections& projections) {
  const auto& box = chi_.box;
  FaceField u;
  zero(box, u);
  found_.box = box;
  zero(box, found_.field);
  for (int j = 0; j < box.height; ++j)
    for (int i = 0; i < box.width; ++i) {
      const std::size_t k = box.at(i, j), at = grid_.at(box.i0 + i, box.j0 + j);
      u.u[k] = velocity.u[at];
      u.v[k] = velocity.v[at];
    }
  answers_to_.clear();
  std::array<FaceField, 3> w;  // of unit twists
  FaceField f;
  const int modes = moments_.is_inside_out() ? 0 : 3;  // a tank never moves
  for (int m = 0; m < modes; ++m) {
    zero(box, w[static_cast<std::size_t>(m)]);
    zero(box, answers_[static_cast<std::size_t>(m)]);
  }
  zero(box, f);
  const Vec<2> about = pose_.translation();
  const auto pass = [&](FaceField& field, int mode, FaceField& sum, bool last) {
    visit(chi_, [&](std::size_t k, const Vec<2>& at_u, const Vec<2>& at_v) {
      const double nu = mode == 0 ? 1 : mode == 2 ? about.y() - at_u.y() : 0;
      const double nv = mode == 1 ? 1 : mode == 2 ? at_v.x() - about.x() : 0;
      f.u[k] = share * chi_.field.u[k] * (nu - field.u[k]);
      f.v[k] = share * chi_.field.v[k] * (nv - field.v[k]);
      sum.u[k] += f.u[k];
      sum.v[k] += f.v[k];
    });
    if (!last) projections.of(box.width, box.height).add(f.u, f.v, field.u, field.v);
  };
  for (int k = 0; k < passes; ++k) {
    const bool last = k + 1 == passes;
    pass(u, -1, found_.field, last);
    for (int m = 0; m < modes; ++m)
      pass(w[static_cast<std::size_t>(m)], m, answers_[static_cast<std::size_t>(m)], last);
  }
}

ImpulseLaw PenalisedWall::law(double density, double kick, double ratio, const Vec<2>& gravity) const {
  const Vec<2> about = pose_.translation();
  ImpulseLaw law;
  law.constant = -density * (impulse_of(predicted_, about) + impulse_of(found_, about));
  if (!force_.field.u.empty()) law.constant -= 0.5 * ratio * density * impulse_of(force_, placed_.translation());
  if (moments_.is_inside_out()) return law;
  BoxField answer{chi_.box, {}};
  for (int m = 0; m < 3; ++m) {
    answer.field = answers_[static_cast<std::size_t>(m)];
    law.answer.col(m) = density * impulse_of(answer, about);
  }
  law.answer = (0.5 * (law.answer + law.answer.transpose())).eval();
  // The fluid that fills it moves with it, and is no part of the body: its inertia as the grid sums it, its weight as
  // it is.
  Eigen::Matrix3d inside = Eigen::Matrix3d::Zero();
  visit(chi_, [&](std::size_t k, const Vec<2>& u, const Vec<2>& v) {
    const Eigen::Vector3d nu(1, 0, about.y() - u.y()), nv(0, 1, v.x() - about.x());
    inside += chi_.field.u[k] * nu * nu.transpose() + chi_.field.v[k] * nv * nv.transpose();
  });
  inside *= density * grid_.h * grid_.h;
  law.answer -= inside;
  law.constant -= inside * filling_;
  const Vec<2> arm = pose_.linear() * moments_.centroid;
  const double mass = density * moments_.area, spin = filling_[2];
  law.constant.head<2>() -= kick * mass * spin * spin * arm;  // it turns about the reference point
  law.constant -= kick * mass * wrench_of<2>(arm, gravity);
  return law;
}

Eigen::Matrix3d PenalisedWall::added_mass(double density, Projections& projections) const {
  const auto& box = chi_.box;
  auto& project = projections.of(box.width, box.height);
  const auto dot = [](const FaceField& a, const FaceField& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.u.size(); ++k) sum += a.u[k] * b.u[k] + a.v[k] * b.v[k];
    return sum;
  };
  const auto masked = [&](FaceField& a) {
    for (std::size_t k = 0; k < a.u.size(); ++k) {
      a.u[k] *= chi_.field.u[k];
      a.v[k] *= chi_.field.v[k];
    }
  };
  const auto add = [](FaceField& to, double factor, const FaceField& from) {
    for (std::size_t k = 0; k < to.u.size(); ++k) {
      to.u[k] += factor * from.u[k];
      to.v[k] += factor * from.v[k];
    }
  };
  const Vec<2> about = pose_.translation();
  Eigen::Matrix3d total, inside;
  std::array<FaceField, 3> rigid;
  for (int m = 0; m < 3; ++m) {
    auto& n = rigid[static_cast<std::size_t>(m)];
    zero(box, n);
    visit(chi_, [&](std::size_t k, const Vec<2>& u, const Vec<2>& v) {
      n.u[k] = chi_.field.u[k] * (m == 0 ? 1 : m == 2 ? about.y() - u.y() : 0);
      n.v[k] = chi_.field.v[k] * (m == 1 ? 1 : m == 2 ? v.x() - about.x() : 0);
    });
  }
  for (int m = 0; m < 3; ++m) {
    FaceField f, r = rigid[static_cast<std::size_t>(m)], direction = r, image;
    zero(box, f);
    double square = dot(r, r);
    const double first = square;
    for (int k = 0; k < 400 && square > 1e-12 * first; ++k) {
      zero(box, image);
      FaceField source = direction;
      masked(source);
      project.add(source.u, source.v, image.u, image.v);
      masked(image);
      const double step = square / dot(direction, image);
      add(f, step, direction);
      add(r, -step, image);
      const double next = dot(r, r), grow = next / square;
      square = next;
      for (std::size_t i = 0; i < r.u.size(); ++i) {
        direction.u[i] = r.u[i] + grow * direction.u[i];
        direction.v[i] = r.v[i] + grow * direction.v[i];
      }
    }
    for (int l = 0; l < 3; ++l) total(l, m) = dot(rigid[static_cast<std::size_t>(l)], f);
  }
  for (int m = 0; m < 3; ++m)
    for (int l = 0; l < 3; ++l) {
      double sum = 0;
      const auto &a = rigid[static_cast<std::size_t>(l)], &b = rigid[static_cast<std::size_t>(m)];
      for (std::size_t k = 0; k < a.u.size(); ++k) {
        if (chi_.field.u[k] > 0) sum += a.u[k] * b.u[k] / chi_.field.u[k];
        if (chi_.field.v[k] > 0) sum += a.v[k] * b.v[k] / chi_.field.v[k];
      }
      inside(l, m) = sum;
    }
  const Eigen::Matrix3d mass = density * grid_.h * grid_.h * (total - inside);
  return 0.5 * (mass + mass.transpose());
}

void PenalisedWall::divide_with(PenalisedWall& other) {
  const auto &a = chi_.box, &b = other.chi_.box;
  const auto one = [](double& mine, double& others) {
    const double sum = mine + others;
    if (sum <= 1) return false;
    mine /= sum;
    others /= sum;
    return true;
  };
  bool any = false;
  for (int j = std::max(a.j0, b.j0); j < std::min(a.j0 + a.height, b.j0 + b.height); ++j)
    for (int i = std::max(a.i0, b.i0); i < std::min(a.i0 + a.width, b.i0 + b.width); ++i) {
      const std::size_t k = a.at(i - a.i0, j - a.j0), l = b.at(i - b.i0, j - b.j0);
      any |= one(chi_.field.u[k], other.chi_.field.u[l]);
      any |= one(chi_.field.v[k], other.chi_.field.v[l]);
    }
  if (any) is_covered_ = other.is_covered_ = false;  // to be made anew in the next step
}

void PenalisedWall::add_forces(const Twist<2>& twist, double kick, double ratio, FaceField& forces) const {
  const auto add = [&](const BoxField& f, double factor) {
    for (int j = 0; j < f.box.height; ++j)
      for (int i = 0; i < f.box.width; ++i) {
        const std::size_t k = f.box.at(i, j), at = grid_.at(f.box.i0 + i, f.box.j0 + j);
        forces.u[at] += factor * f.field.u[k];
        forces.v[at] += factor * f.field.v[k];
      }
  };
  add(found_, 1 / kick);
  add(predicted_, 1 / kick);
  if (!force_.field.u.empty()) add(force_, 0.5 * ratio / kick);
  if (moments_.is_inside_out()) return;
  for (int m = 0; m < 3; ++m) add({found_.box, answers_[static_cast<std::size_t>(m)]}, twist[m] / kick);
}

void PenalisedWall::settle(const Twist<2>& twist, NodeField& omega, bool predicts) {
  for (int m = 0; m < 3 && !moments_.is_inside_out(); ++m)
    for (std::size_t k = 0; k < found_.box.size(); ++k) {
      found_.field.u[k] += twist[m] * answers_[static_cast<std::size_t>(m)].u[k];
      found_.field.v[k] += twist[m] * answers_[static_cast<std::size_t>(m)].v[k];
    }
  add_curl_of(found_, 1, omega);
  force_.box = found_.box;
  force_.field = predicts ? found_.field : FaceField{};
  for (std::size_t k = 0; k < force_.field.u.size(); ++k) {
    force_.field.u[k] += 2 * predicted_.field.u[k];
    force_.field.v[k] += 2 * predicted_.field.v[k];
  }
  placed_ = pose_;
  filling_ = twist;
}

}  // namespace splashdown::vortex
