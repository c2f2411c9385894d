// How walls answer a step, alone or together, and how a wake fades.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "fluid/vortex/fluid.hpp"

namespace splashdown::vortex {

/// A pass leaves 1 - M_f/(M_f + M_a) of an error in a rigid motion: slender bodies, beside whose filling much moves
/// with them, take more, and most before there is a prediction.
int GridFlow::passes_of(std::size_t wall, bool answers) const {
  constexpr int at_start = 8, few = 4, slender = 8;
  const auto& m = penalised_[wall].moments();
  if (m.is_inside_out()) return 1;
  const auto& p = spec_.penalisation;
  const double filling = m.area,
               moved = std::numbers::pi * m.length * m.length / 16;  // of a plate as long as half the outline
  const double share = filling / (filling + moved);
  const bool is_slender = share < 0.2;                                           // a plate of 1 : 4 or thinner
  if (steps_ <= 1 && is_slender) return static_cast<int>(std::ceil(5 / share));  // e^-5
  if (is_starting()) return std::max(at_start, answers ? p.passes : p.prescribed_passes);
  if (!answers) return p.prescribed_passes;
  return p.passes > 0 ? p.passes : is_slender ? slender : few;
}

/// Later steps have a prediction, in which walls and other bodies have had their say: their passes are those of bodies alone.
void GridFlow::find_answers(double share, std::span<const char> answers) {
  const bool is_alone = penalised_.size() == 1 && spec_.sides == SideKind::free;
  if (is_starting() && !is_alone && !penalised_.empty()) return find_answers_together(share, answers);
  for (std::size_t w = 0; w < penalised_.size(); ++w)
    penalised_[w].make_rigid(trial_velocity_, share, passes_of(w, w < answers.size() && answers[w]), projections_);
}

void GridFlow::find_answers_together(double share, std::span<const char> answers) {
  int passes = 1;
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    penalised_[w].begin_passes();
    passes = std::max(passes, passes_of(w, w < answers.size() && answers[w]));
  }
  pass_together(share, passes, 0, -1, answers);
  for (std::size_t w = 0; w < penalised_.size(); ++w)
    for (int mode = 0; mode < 3 && !penalised_[w].moments().is_inside_out(); ++mode)
      pass_together(share, passes, w, mode, answers);
}

/// With all that is in the grid: u_{k+1} = u_k + P f_k by Poisson's equation on it. Other bodies that the fluid moves let the
/// motion of one pass: what they do to each other comes a step later.
void GridFlow::pass_together(double share, int passes, std::size_t mover, int mode, std::span<const char> answers) {
  FaceField u = trial_velocity_, change;
  if (mode >= 0) u.reset(spec_.grid.nodes());
  NodeField curl;
  for (int k = 0; k < passes; ++k) {
    curl.assign(spec_.grid.nodes(), 0.0);
    for (std::size_t w = 0; w < penalised_.size(); ++w) {
      const bool is_mover = mode >= 0 && w == mover, is_free = w < answers.size() && answers[w];
      if (mode < 0 || is_mover || !is_free) penalised_[w].pass_from(u, share, mover, mode, is_mover, curl);
    }
    if (k + 1 == passes) return;
    stream_function_.solve(curl, psi_);
    velocities_of(spec_.grid, psi_, Vec<2>::Zero(), change);
    for (std::size_t i = 0; i < u.u.size(); ++i) {
      u.u[i] += change.u[i];
      u.v[i] += change.v[i];
    }
  }
}

/// How far before each side that the stream leaves by vorticity fades: half of the way there from the last body.
Vec<2> GridFlow::fading(const Vec<2>& stream) const {
  if (spec_.sides != SideKind::free || stream.isZero() || poses_.empty()) return Vec<2>::Zero();
  constexpr double share = 0.5;
  Vec<2> way = spec_.grid.max() - spec_.grid.min;
  for (std::size_t w = 0; w < poses_.size(); ++w) {
    const double reach = spec_.walls[w].surface.vertices.colwise().norm().maxCoeff();
    const Vec<2> at = poses_[w].translation();
    for (int k = 0; k < 2; ++k)
      way[k] = std::min(way[k], (stream[k] > 0 ? spec_.grid.max()[k] - at[k] : at[k] - spec_.grid.min[k]) - reach);
  }
  return share * way.cwiseMax(0).cwiseProduct(stream.normalized());
}

}  // namespace splashdown::vortex
