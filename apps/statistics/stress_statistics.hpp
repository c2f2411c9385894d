// The largest von Mises stress of a body that deforms, over all steps. Survives a resume.
#pragma once

#include <string>
#include <vector>

#include "apps/statistics/statistics_archive.hpp"
#include "core/solids_view.hpp"

namespace splashdown::apps {

/// Of one body.
class StressStatistics {
 public:
  template <int d>
  void add(double time, const Deformation<d>& now) {
    if (!peak_.offer(now.von_mises, time)) return;
    error_ = now.von_mises_error;
    point_.assign(now.at.data(), now.at.data() + d);
    part_ = now.part;
  }
  StressSummary summary() const {
    StressSummary all{.peak = peak_, .point = point_, .part = part_, .evidence = {}, .grade = {}};
    all.evidence.stress = error_ / peak_.value;
    return all;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(peak_, error_, point_, part_);
  }

 private:
  Peak peak_;
  double error_ = 0;
  std::vector<double> point_;
  std::string part_;
};

}  // namespace splashdown::apps
