#include "apps/study/campaign/envelope.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace splashdown::apps {
namespace {

constexpr double narrowest = 0.6;  // b in steps: then neighbours count a quarter
constexpr double farthest = 3;     // in b: what is beyond does not count
constexpr double certain = 20;     // draws that an answer without chance is worth: nearby it is then believed up to 2 b

/// Whether the run's answer is yes; half for one that its own band leaves open.
std::optional<double> answer_in(const Outcome& outcome, const std::string& limit) {
  const auto found = outcome.limits.find(limit);
  if (outcome.status != Outcome::Status::converged || found == outcome.limits.end() || found->second.empty()) return {};
  return found->second == "yes" ? 1 : found->second == "no" ? 0 : 0.5;
}

/// What chance has drawn for a run, as a number: runs of different cells may share it.
std::size_t draw_of(const Study& study, const StudyRun& run) {
  std::size_t draw = 0;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (const auto& axis = study.axes[a]; (axis.sampled || axis.replicates) && axis.leader == a)
      draw = draw * axis.values.size() + run.value[a];
  return draw;
}

}  // namespace

EnvelopePlane::EnvelopePlane(const Study& study, const std::vector<StudyRun>& runs,
                             const std::vector<Outcome>& outcomes, const std::vector<std::size_t>& at_work)
    : envelope_(*study.envelope), height_(study.axes[envelope_.y].values.size()) {
  for (std::size_t x = 0; x < study.axes[envelope_.x].values.size(); ++x)
    for (std::size_t y = 0; y < height_; ++y) cells_.push_back({.x = x, .y = y, .next = {}});
  if (std::ranges::none_of(study.axes, [](const Axis& axis) { return axis.sampled || axis.replicates; }))
    worth_ = certain;
  const auto cell_of = [&](std::size_t run) {
    return runs[run].value[envelope_.x] * height_ + runs[run].value[envelope_.y];
  };
  std::vector<char> is_begun(runs.size(), 0);
  for (const std::size_t run : at_work) is_begun[run] = 1;
  std::vector<Answer> answers;
  std::map<std::size_t, std::size_t> used;  // draws, by how many runs
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (outcomes[i].finished() || is_begun[i]) ++used[draw_of(study, runs[i])];
    if (!outcomes[i].finished()) continue;
    auto& cell = cells_[cell_of(i)];
    const auto yes = answer_in(outcomes[i], envelope_.limit);
    if (!yes) continue;
    answers.push_back({cell_of(i), *yes});
    (*yes > 0.5 ? cell.yes : *yes < 0.5 ? cell.no : cell.open) += 1;
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto& cell = cells_[cell_of(i)];
    if (outcomes[i].finished() || is_begun[i]) continue;
    if (!cell.next || used[draw_of(study, runs[i])] < used[draw_of(study, runs[*cell.next])]) cell.next = i;
  }
  judge(answers);
  if (at_work.empty()) return;
  for (const std::size_t run : at_work) {
    const std::size_t cell = cell_of(run);
    answers.push_back({cell, cells_[cell].probability > envelope_.level ? 1. : 0.});
  }
  judge(answers);
}

double EnvelopePlane::steps_between(std::size_t cell, std::size_t other) const {
  const auto& a = cells_[cell];
  const auto& b = cells_[other];
  const double x = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double y = static_cast<double>(a.y) - static_cast<double>(b.y);
  return x * x + y * y;
}

void EnvelopePlane::judge(const std::vector<Answer>& answers) {
  told_.clear();
  for (const auto& answer : answers) told_.push_back(answer.cell);
  std::ranges::sort(told_);
  told_.erase(std::unique(told_.begin(), told_.end()), told_.end());
  const double size = static_cast<double>(cells_.size()), number = std::max(1., static_cast<double>(told_.size()));
  const double b = std::max(narrowest, std::sqrt(size / (std::numbers::pi * number)));
  std::vector<double> yes(cells_.size(), 0.5), no(cells_.size(), 0.5);  // Jeffreys
  const auto reach = static_cast<std::size_t>(farthest * b);
  const auto near = [&](std::size_t at, std::size_t number) {
    return std::pair(at - std::min(at, reach), std::min(at + reach + 1, number));
  };
  for (const auto& [at, share] : answers) {
    const auto [left, right] = near(cells_[at].x, cells_.size() / height_);
    const auto [low, high] = near(cells_[at].y, height_);
    for (std::size_t x = left; x < right; ++x)
      for (std::size_t c = x * height_ + low; c < x * height_ + high; ++c) {
        const double steps = steps_between(c, at);
        if (steps > farthest * farthest * b * b) continue;
        const double weight = worth_ * std::exp(-steps / (2 * b * b));
        yes[c] += share * weight;
        no[c] += (1 - share) * weight;
      }
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    auto& cell = cells_[c];
    const double own = static_cast<double>(cell.yes + cell.no);
    if (worth_ > 1 && own > 0 && !cell.next) {  // nothing is left to chance
      cell.probability = static_cast<double>(cell.yes) / own;
      cell.doubt = 0;
      continue;
    }
    cell.probability = yes[c] / (yes[c] + no[c]);
    const double below = boost::math::cdf(boost::math::beta_distribution<>(yes[c], no[c]), envelope_.level);
    cell.doubt = std::min(below, 1 - below);
  }
}

std::optional<std::size_t> EnvelopePlane::next() const {
  constexpr double alike = 1e-6;
  const auto distance = [&](std::size_t cell) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t told : told_) least = std::min(least, steps_between(cell, told));
    return least;
  };
  double most = 0;
  for (const auto& cell : cells_)
    if (cell.next) most = std::max(most, cell.doubt);
  if (!(most > envelope_.doubt)) return {};
  std::optional<std::size_t> best;
  double best_distance = -1;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (!cells_[c].next || cells_[c].doubt < most - alike) continue;
    const double far = distance(c);
    if (far > best_distance) best = cells_[c].next, best_distance = far;
  }
  return best;
}

}  // namespace splashdown::apps
