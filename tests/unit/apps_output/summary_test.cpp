#include "apps/statistics/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/scratch_folder.hpp"

namespace splashdown::apps::summary_test {
namespace {

Summary full() {
  Summary summary;
  summary.status = "done";
  summary.phases = {{"remesh", 1.0}, {"pressure", 2.0}};
  summary.wall_seconds = 4;
  summary.effects = {{"gravity", 1.0}};
  summary.inactive_effects = {{"viscosity", "the scene has no [fluid.viscosity]"}};
  summary.nodes = RangeCount{10, 20, 15};
  summary.elements = RangeCount{12, 24, 18};
  summary.coupling = CouplingSummary{"iterated", "rigid", 1.5, 3, 2, {{"coupling diverged", 2}}};
  summary.ledger = LedgerSummary{};
  summary.verdict.grade = Grade::doubtful;
  summary.verdict.reasons = {"It looks odd."};
  summary.fluid = FluidSummary{};
  BodySummary body;
  body.acceleration.raw = {12, 0.01};
  body.acceleration.cfc[600] = {{11, 0.011}, 0.002, 0.01, 3.5};
  body.force.raw = {26e3, 0.01};
  body.impulse = {0, 1};
  body.impulse_repair = {0, 0.01};
  body.submergence = {0.2, 0.03};
  body.force.cfc[60] = {{25e3, 0.011}, 0.002, 0.01, 900};
  body.landing.attitude = {{"pitch", {1, {-3, 0.02}, {4, 0.03}}}};
  body.landing.dry_intervals = {{0.02, 0.025}, {0.03, -1}};
  summary.bodies["hull"] = body;
  return summary;
}

TEST(Summary, has_the_keys_of_the_contract) {
  const auto json = nlohmann::json::parse(to_json(full()));
  for (const char* path : {"/status",
                           "/simulated_time",
                           "/steps",
                           "/wall_seconds",
                           "/processor_seconds",
                           "/phases/remesh",
                           "/effects/active/gravity/seconds",
                           "/effects/active/gravity/share",
                           "/effects/inactive/viscosity",
                           "/nodes/initial",
                           "/nodes/max",
                           "/nodes/final",
                           "/elements/initial",
                           "/elements/max",
                           "/elements/final",
                           "/coupling/scheme",
                           "/coupling/interface_term",
                           "/coupling/passes_mean",
                           "/coupling/passes_max",
                           "/coupling/rejected_steps",
                           "/ledger/volume_initial",
                           "/ledger/volume_final",
                           "/ledger/volume_error",
                           "/ledger/volume_remesh_created",
                           "/ledger/volume_remesh_deleted",
                           "/ledger/volume_returned",
                           "/ledger/kinetic_energy",
                           "/ledger/potential_energy",
                           "/ledger/work_on_walls",
                           "/ledger/energy_gain",
                           "/ledger/energy_gain_joule",
                           "/ledger/energy_gain_time",
                           "/ledger/energy_gain_since",
                           "/ledger/energy_scale",
                           "/ledger/energy_scale_from",
                           "/ledger/volume_error_bodies",
                           "/verdict/grade",
                           "/verdict/reasons/0",
                           "/verdict/about",
                           "/verdict/notes",
                           "/verdict/trusted",
                           "/verdict/doubted",
                           "/verdict/advice/0",
                           "/bodies/hull/verdict/grade",
                           "/bodies/hull/verdict/reasons",
                           "/bodies/hull/peak_acceleration_g/raw/value",
                           "/bodies/hull/peak_acceleration_g/raw/time",
                           "/bodies/hull/peak_acceleration_g/cfc600/value",
                           "/bodies/hull/peak_acceleration_g/cfc600/rise_time",
                           "/bodies/hull/peak_acceleration_g/cfc600/duration",
                           "/bodies/hull/peak_acceleration_g/cfc600/delta_v",
                           "/bodies/hull/peak_force/rise_time",
                           "/bodies/hull/peak_force/impulse",
                           "/bodies/hull/peak_force_filtered/cfc60/value",
                           "/bodies/hull/attitude_deg/pitch/end",
                           "/bodies/hull/attitude_deg/pitch/minimum/value",
                           "/bodies/hull/attitude_deg/pitch/maximum/time",
                           "/bodies/hull/maximum_tilt_deg",
                           "/bodies/hull/capsized",
                           "/bodies/hull/capsized_time",
                           "/bodies/hull/settled_time",
                           "/bodies/hull/settled_below",
                           "/bodies/hull/skips",
                           "/bodies/hull/dry_intervals/0/1",
                           "/bodies/hull/first_contact_time",
                           "/bodies/hull/peak_force/value",
                           "/bodies/hull/peak_force/time",
                           "/bodies/hull/impulse/1",
                           "/bodies/hull/maximum_submergence/value",
                           "/bodies/hull/maximum_submergence/time"})
    EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(path))) << path;
  EXPECT_EQ(json["effects"]["active"]["gravity"]["share"], 0.25);
  EXPECT_EQ(json["verdict"]["grade"], "doubtful");
  EXPECT_EQ(json["bodies"]["hull"]["verdict"]["grade"], "resolved");
}

TEST(Summary, what_a_scene_lacks_its_summary_lacks) {
  const auto json = nlohmann::json::parse(to_json(Summary{}));
  for (const char* key : {"nodes", "elements", "coupling", "ledger", "fluid", "equipment", "cause"})
    EXPECT_FALSE(json.contains(key)) << key;
}

TEST(Summary, numbers_that_do_not_exist_are_null) {
  Summary summary = full();
  summary.ledger->volume_error = std::nan("");
  summary.ledger->energy_gain = INFINITY;
  summary.bodies["hull"].force.raw = {};
  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_TRUE(json["ledger"]["volume_error"].is_null());
  EXPECT_TRUE(json["ledger"]["energy_gain"].is_null());
  EXPECT_TRUE(json["ledger"]["energy_gain_time"].is_null());
  EXPECT_TRUE(json["ledger"]["volume_error_bodies"].is_null()) << "a scene without bodies";
  EXPECT_TRUE(json["bodies"]["hull"]["peak_force"].is_null());
  EXPECT_TRUE(json["bodies"]["hull"]["first_contact_time"].is_null());
  EXPECT_TRUE(json["bodies"]["hull"]["settled_time"].is_null());
  EXPECT_TRUE(json["bodies"]["hull"]["dry_intervals"][1][1].is_null());
}

TEST(Summary, text_that_is_no_utf8_does_not_stop_it) {
  Summary summary = full();
  summary.cause = "node \xff";
  EXPECT_NO_THROW(nlohmann::json::parse(to_json(summary)));
}

TEST(Summary, is_written_whole_and_leaves_no_temporary_file) {
  ScratchFolder folder;
  write_summary(folder.path() / "run", full());
  EXPECT_EQ(folder.text("run/summary.json"), to_json(full()));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "run/summary.json.tmp"));
}

TEST(Peak, keeps_the_first_of_equal_values_and_ignores_nan) {
  Peak peak;
  EXPECT_TRUE(peak.offer(-1, 0));
  EXPECT_FALSE(peak.offer(-1, 1));
  EXPECT_TRUE(peak.offer(2, 2));
  EXPECT_FALSE(peak.offer(std::nan(""), 3));
  EXPECT_EQ(peak.value, 2);
  EXPECT_EQ(peak.time, 2);
}

}  // namespace
}  // namespace splashdown::apps::summary_test
