// Checkpoints on disk: they read back, two generations are kept, damage is found, scenes are told apart.
#include "apps/simulation/checkpoint.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "apps/run/folder/resume.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::checkpoint_test {
namespace {

namespace fs = std::filesystem;

class CheckpointFolder : public ::testing::Test {
 protected:
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "checkpoint";
};

Checkpoint at(double time) {
  Checkpoint c;
  c.scene = "title = \"x\"\n";
  c.loop = {.dt_previous = 0.1, .dt_cap = 0.2, .steps = 7, .rejected = {{"inverted", 3}}};
  c.time = time;
  c.phases = {{"mesh", 1.5}};
  c.stepper = std::string(1000, '\0').append("end");
  c.recorder = "rows";
  return c;
}

std::optional<Checkpoint> newest(const fs::path& folder) {
  const auto stored = read_checkpoints(folder);
  return stored.good.empty() ? std::nullopt : std::optional(stored.good.front().state);
}

void cut(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }

TEST_F(CheckpointFolder, reads_back_what_was_written) {
  write_checkpoint(folder, at(1));
  const auto c = newest(folder);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->time, 1);
  EXPECT_EQ(c->scene, at(1).scene);
  EXPECT_EQ(c->loop.steps, 7);
  EXPECT_EQ(c->loop.dt_cap, 0.2);
  EXPECT_EQ(c->loop.rejected, at(1).loop.rejected);
  EXPECT_EQ(c->phases, at(1).phases);
  EXPECT_EQ(c->stepper, at(1).stepper);
  EXPECT_EQ(c->recorder, "rows");
}

TEST_F(CheckpointFolder, falls_back_to_the_generation_before_a_damaged_one) {
  write_checkpoint(folder, at(1));
  write_checkpoint(folder, at(2));
  EXPECT_EQ(newest(folder)->time, 2);
  cut(folder / "state");
  EXPECT_EQ(newest(folder)->time, 1);
  cut(folder / "previous");
  EXPECT_FALSE(newest(folder));
}

TEST_F(CheckpointFolder, finds_a_changed_byte) {
  write_checkpoint(folder, at(1));
  std::fstream file(folder / "state", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(500);
  file.put('x');
  file.close();
  EXPECT_FALSE(newest(folder));
}

TEST_F(CheckpointFolder, survives_a_kill_between_the_two_renames) {
  write_checkpoint(folder, at(1));
  write_checkpoint(folder, at(2));
  fs::rename(folder / "state", folder / "state.new");
  EXPECT_EQ(newest(folder)->time, 2);
}

TEST_F(CheckpointFolder, may_be_absent_or_full_of_something_else) {
  EXPECT_FALSE(newest(folder));
  fs::create_directories(folder);
  std::ofstream(folder / "state") << "not a checkpoint";
  EXPECT_FALSE(newest(folder));
  std::ofstream(folder / "state") << "";
  EXPECT_FALSE(newest(folder));
}

std::string resolved(std::vector<std::string> overrides) {
  return read_scene_text(testing::wedge_drop, "scene.toml", overrides).resolved;
}

TEST(Resume, tells_scenes_apart_by_what_the_state_depends_on) {
  EXPECT_TRUE(differences(resolved({}), resolved({})).empty());
  EXPECT_TRUE(
      differences(resolved({"time.end=1", "title=other", "time.cfl=0.2", "coupling.tolerance=1e-4"}), resolved({}))
          .empty());
  const auto found = differences(resolved({"body.wedge.mass=100"}), resolved({}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "body[0].mass = 100.0, in the checkpoint 241.0");
  EXPECT_EQ(differences(resolved({"fluid.viscosity={}"}), resolved({})).at(0),
            "fluid.viscosity.dynamic = 0.001, in the checkpoint absent");
}

TEST_F(CheckpointFolder, of_another_scene_is_refused) {
  auto checkpoint = at(1);
  checkpoint.scene = resolved({});
  write_checkpoint(folder / "checkpoint", checkpoint);
  EXPECT_EQ(find_checkpoints(folder, resolved({"time.end=3"})).good.size(), 1u);
  const auto messages = testing::refusal_of([&] { find_checkpoints(folder, resolved({"fluid.density=900"})); });
  ASSERT_FALSE(messages.empty());
  EXPECT_TRUE(messages[0].starts_with("--resume: fluid.density = 900.0, in the checkpoint 1000.0")) << messages[0];
  EXPECT_TRUE(find_checkpoints(folder / "nowhere", resolved({})).good.empty());
}

/// The last message of a refusal says what to do, those before what is wrong.
void expect_refused(const fs::path& folder, const std::string& reason) {
  const auto messages = testing::refusal_of([&] { find_checkpoints(folder, resolved({})); });
  ASSERT_GE(messages.size(), 2u) << reason;
  EXPECT_NE(messages[0].find(reason), std::string::npos) << messages[0];
  EXPECT_NE(messages.back().find("nothing was changed. Continue it with the version that wrote it, or begin anew"),
            std::string::npos)
      << messages.back();
}

TEST_F(CheckpointFolder, that_cannot_be_read_is_refused_and_never_taken_for_none) {
  auto checkpoint = at(1);
  checkpoint.scene = resolved({});
  write_checkpoint(folder / "checkpoint", checkpoint);
  const auto state = folder / "checkpoint" / "state";
  const auto good = scratch.text("checkpoint/checkpoint/state");
  const auto holds = [&](const std::string& bytes) { std::ofstream(state, std::ios::binary) << bytes; };
  holds(good.substr(0, good.size() - 1));
  expect_refused(folder, "state is cut short, or its length is damaged");
  auto flipped = good;
  flipped[good.size() / 2] ^= 1;
  holds(flipped);
  expect_refused(folder, "state is damaged: its checksum does not agree");
  auto older = good;
  const auto number = older.find("checkpoint ") + 11;
  older[number] = '1';
  holds(older);
  expect_refused(folder, "state was written by another version of splashdown (format " + older.substr(number, 2) +
                             ", this one reads " + good.substr(number, 2) + ")");
  holds("not a checkpoint");
  expect_refused(folder, "state is no checkpoint, or its first bytes are damaged");
  fs::remove_all(folder / "checkpoint");
  EXPECT_TRUE(find_checkpoints(folder, resolved({})).good.empty()) << "no run has begun there";
  std::ofstream(folder / "bodies.csv") << "time\n";
  expect_refused(folder, "holds tables of a run, but no checkpoint");
}

}  // namespace
}  // namespace splashdown::apps::checkpoint_test
