// Checkpoints on disk: they read back, two generations are kept, damage is found, scenes are told apart.
#include "apps/checkpoint.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "apps/resume.hpp"
#include "apps/scene_read.hpp"
#include "scenes.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps {
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
  c.stepper = std::string(1000, '\0') + "end";
  c.recorder = "rows";
  return c;
}

void cut(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }

TEST_F(CheckpointFolder, reads_back_what_was_written) {
  write_checkpoint(folder, at(1));
  const auto c = read_checkpoint(folder);
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
  EXPECT_EQ(read_checkpoint(folder)->time, 2);
  cut(folder / "state");
  EXPECT_EQ(read_checkpoint(folder)->time, 1);
  cut(folder / "previous");
  EXPECT_FALSE(read_checkpoint(folder));
}

TEST_F(CheckpointFolder, finds_a_changed_byte) {
  write_checkpoint(folder, at(1));
  std::fstream file(folder / "state", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(500);
  file.put('x');
  file.close();
  EXPECT_FALSE(read_checkpoint(folder));
}

TEST_F(CheckpointFolder, survives_a_kill_between_the_two_renames) {
  write_checkpoint(folder, at(1));
  write_checkpoint(folder, at(2));
  fs::rename(folder / "state", folder / "state.new");
  EXPECT_EQ(read_checkpoint(folder)->time, 2);
}

TEST_F(CheckpointFolder, may_be_absent_or_full_of_something_else) {
  EXPECT_FALSE(read_checkpoint(folder));
  fs::create_directories(folder);
  std::ofstream(folder / "state") << "not a checkpoint";
  EXPECT_FALSE(read_checkpoint(folder));
  std::ofstream(folder / "state") << "";
  EXPECT_FALSE(read_checkpoint(folder));
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
  EXPECT_TRUE(find_checkpoint(folder, resolved({"time.end=3"})));
  const auto messages = testing::refusal_of([&] { find_checkpoint(folder, resolved({"fluid.density=900"})); });
  ASSERT_FALSE(messages.empty());
  EXPECT_TRUE(messages[0].starts_with("--resume: fluid.density = 900.0, in the checkpoint 1000.0")) << messages[0];
  EXPECT_FALSE(find_checkpoint(folder / "nowhere", resolved({})));
}

}  // namespace
}  // namespace splashdown::apps
