// A good study of a wedge that drops, for the tests of studies.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/study/study.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::testing {

inline const std::string good_study = R"toml(title = "study"
scene = "scene.toml"
set = ["time.end=0.01"]
budget = 30
[constants]
g = 9.81
[[axis]]
name = "ratio"
key = "body.wedge.mass"
scale = 100
values = [1, 0.5, 0.1]
[[axis]]
name = "scheme"
[[axis.case]]
name = "plain"
set = ["coupling.interface_term=none", "coupling.relaxation=1"]
[[axis.case]]
name = "exact"
set = ["coupling.interface_term=rigid"]
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
reference = {scheme = "exact"}
[[quantity]]
name = "fall"
quantity = "speed/g"
exact = "ratio"
scale = "2*g"
[chart]
x = "ratio"
series = "scheme"
y = ["passes_mean", "speed_error"]
)toml";

class StudyTest : public ::testing::Test, protected ScratchFolder {
 protected:
  StudyTest() { write("scene.toml", wedge_drop); }

  Study read(const std::string& text = good_study) const { return read_study(write("study.toml", text)); }
  std::vector<std::string> messages_of(const std::string& text) const {
    return refusal_of([&] { plan_study(write("study.toml", text)); });
  }
  /// What a run of this scene would leave behind.
  void leave(const StudyRun& run, const std::string& status, const std::string& cause, double speed) const {
    write(std::filesystem::path(run.name) / "scene.resolved.toml", run.resolved + "\n[provenance]\n");
    write(std::filesystem::path(run.name) / "bodies.csv",
          "time,body,vy\n0,wedge,0\n1,wedge," + std::to_string(speed) + "\n");
    write(std::filesystem::path(run.name) / "summary.json",
          R"({"status": ")" + status + R"(", "cause": ")" + cause +
              R"(", "wall_seconds": 31, "coupling": {"passes_mean": 3.5}})");
  }
  std::vector<StudyRun> resolved(const Study& study) const {
    auto runs = expand(study);
    resolve(study, runs);
    return runs;
  }
};

}  // namespace splashdown::apps::testing
