// Passes of all walls together, by velocities of the whole grid.
#include "fluid/vortex/penalised/wall.hpp"

namespace splashdown::vortex {

void PenalisedWall::begin_passes() {
  found_.box = chi_.box;
  found_.field.reset(chi_.box.size());
  for (auto& answer : answers_) answer.reset(chi_.box.size());
  answers_to_.clear();
}

void PenalisedWall::pass_from(const FaceField& velocity, double share, std::size_t mover, int mode, bool is_mover,
                              NodeField& curl) {
  FaceField* sum = &found_.field;
  if (mode >= 0 && is_mover) sum = &answers_[static_cast<std::size_t>(mode)];
  if (mode >= 0 && !is_mover) {
    auto& fields = answers_to_[mover];
    sum = &fields[static_cast<std::size_t>(mode)];
    if (sum->u.empty()) sum->reset(chi_.box.size());
  }
  BoxField f{chi_.box, {}};
  f.field.reset(chi_.box.size());
  const Vec<2> about = pose_.translation();
  const auto& box = chi_.box;
  const double moves = is_mover ? 1 : 0;
  for (int j = 0; j < box.height; ++j)
    for (int i = 0; i < box.width; ++i) {
      const std::size_t k = box.at(i, j), at = grid_.at(box.i0 + i, box.j0 + j);
      const Vec<2> arm = grid_.node(box.i0 + i, box.j0 + j) + Vec<2>::Constant(0.5 * grid_.h) - about;
      const double nu = moves * (mode == 0 ? 1 : mode == 2 ? -arm.y() : 0);
      const double nv = moves * (mode == 1 ? 1 : mode == 2 ? arm.x() : 0);
      f.field.u[k] = share * chi_.field.u[k] * (nu - velocity.u[at]);
      f.field.v[k] = share * chi_.field.v[k] * (nv - velocity.v[at]);
      sum->u[k] += f.field.u[k];
      sum->v[k] += f.field.v[k];
    }
  add_curl_of(f, 1, curl);
}

Eigen::Matrix3d PenalisedWall::answer_to(std::size_t mover, double density) const {
  Eigen::Matrix3d answer = Eigen::Matrix3d::Zero();
  const auto found = answers_to_.find(mover);
  if (found == answers_to_.end()) return answer;
  for (int m = 0; m < 3; ++m)
    answer.col(m) = density * impulse_of({chi_.box, found->second[static_cast<std::size_t>(m)]}, pose_.translation());
  return answer;
}

void PenalisedWall::settle_answer_to(std::size_t mover, const Twist<2>& twist) {
  const auto found = answers_to_.find(mover);
  if (found == answers_to_.end()) return;
  for (int m = 0; m < 3; ++m)
    for (std::size_t k = 0; k < found_.box.size(); ++k) {
      found_.field.u[k] += twist[m] * found->second[static_cast<std::size_t>(m)].u[k];
      found_.field.v[k] += twist[m] * found->second[static_cast<std::size_t>(m)].v[k];
    }
  answers_to_.erase(found);
}

std::pair<Wrench<2>, Wrench<2>> PenalisedWall::sums(const Twist<2>& twist, double ratio) const {
  const Vec<2> about = pose_.translation();
  Wrench<2> found = impulse_of(found_, about);
  for (int m = 0; m < 3 && !moments_.is_inside_out(); ++m)
    found += twist[m] * impulse_of({found_.box, answers_[static_cast<std::size_t>(m)]}, about);
  Wrench<2> all = found + impulse_of(predicted_, about);
  if (!force_.field.u.empty()) all += 0.5 * ratio * impulse_of(force_, placed_.translation());
  return {found, all};
}

}  // namespace splashdown::vortex
