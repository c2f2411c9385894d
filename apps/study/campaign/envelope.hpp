// Where in the plane of two axes a limit is passed, and which run would tell most about it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/study/study.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {

/// One value of each axis of the plane.
struct EnvelopeCell {
  std::size_t x = 0, y = 0;               ///< values by index
  std::size_t yes = 0, no = 0, open = 0;  ///< answers of its own runs; open: within the run's own band, half a yes
  std::optional<std::size_t> next;        ///< a run that is not begun, of the draw that is used least; nothing: all are
  double probability = 0.5;               ///< of a yes, by its own answers and those nearby
  double doubt = 0.5;                     ///< that the probability lies on the other side of the level
};

/// The plane of `study.envelope`, which is there. Answers count in cells nearby with the weight exp(-d^2/2b^2), d in steps of the axes. With
/// more answers b shrinks: they then cover the plane as before, and more of them lie at the line. With Jeffreys' prior the
/// probability of a cell has a beta distribution, and the doubt is what of it lies on the other side of the level. In studies without
/// chance an answer counts as 20, and a cell that has its own is not in doubt. Of a cell's random runs the next is one whose draw the fewest
/// runs of the plane have: with the same draw everywhere, answers nearby would say the same thing again.
class EnvelopePlane {
 public:
  /// `at_work`: runs that are begun; until they end they count as what is expected of them.
  EnvelopePlane(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                const std::vector<std::size_t>& at_work = {});

  const std::vector<EnvelopeCell>& cells() const { return cells_; }  ///< by x, then by y
  const EnvelopeCell& at(std::size_t x, std::size_t y) const { return cells_[x * height_ + y]; }
  /// A run in the cell that is most in doubt, of equal ones the farthest from all answers; nothing: no doubt is larger than it may be,
  /// or no runs are left.
  std::optional<std::size_t> next() const;

 private:
  struct Answer {
    std::size_t cell;
    double yes;  ///< share of 1
  };
  double steps_between(std::size_t cell, std::size_t other) const;  // squared
  void judge(const std::vector<Answer>& answers);

  const StudyEnvelope& envelope_;
  std::size_t height_ = 0;
  double worth_ = 1;  // draws that an answer counts for
  std::vector<EnvelopeCell> cells_;
  std::vector<std::size_t> told_;  // cells with answers, or with runs at work
};

}  // namespace splashdown::apps
