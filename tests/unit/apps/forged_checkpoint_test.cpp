// Checkpoints whose bytes nobody vouches for: damaged anywhere, cut anywhere, forged with a checksum that agrees. None is
// believed, none allocates what its lengths claim, none ends the program.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <random>

#include "apps/run/run.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::forged_checkpoint_test {
namespace {

namespace fs = std::filesystem;

using PlaneRun = Run<2>;  // testing::Test has a Run of its own

const std::string coarse_wedge = R"([time]
end = 0.1
[gravity]
[tank]
min = [-1, -0.6]
max = [1, 0.6]
[fluid]
density = 1000
[fluid.size]
surface = 0.08
far = 0.2
[[fluid.region]]
shape = "box"
min = [-1, -0.6]
max = [1, 0]
[[body]]
name = "wedge"
mass = 60
position = [0, -0.02]
velocity = [0, -3]
size = 0.05
shape = { type = "wedge", deadrise_deg = 30, breadth = 0.4, height = 0.2 }
[output]
frames = 0.002
[coupling]
interface_term = "none"
accelerator = "iqn_ils"
reuse = 3
[[record]]
kind = "pressure"
name = "keel"
body = "wedge"
point = [0, 0]
[[record]]
kind = "acceleration"
name = "seat"
body = "wedge"
point = [0, 0.1]
[[record]]
kind = "maximum_pressure"
body = "wedge"
[[record]]
kind = "pressure_patch"
name = "panel"
body = "wedge"
min = [-0.1, -0.1]
max = [0.1, 0.1]
)";

/// A run that has ended, its newest checkpoint, and a run that may be continued from it again and again.
class Forged : public ::testing::Test {
 protected:
  Forged() {
    make(folder())->go();
    good_ = read_checkpoints(folder() / "checkpoint").good.at(0).state;
    bytes_ = scratch_.text("run/checkpoint/state");
    fs::copy(folder(), scratch_.path() / "kept", fs::copy_options::recursive);
    run_ = make(folder());
  }

  fs::path folder() const { return scratch_.path() / "run"; }

  std::unique_ptr<PlaneRun> make(const fs::path& directory) {
    RunPlan plan{directory, file_.resolved, file_.scene.time.end, {}, std::chrono::steady_clock::now()};
    return std::make_unique<PlaneRun>(file_.scene, build_world<2>(file_.scene),
                                      recorder_settings<2>(file_.scene, directory), std::move(plan), progress_);
  }

  /// Whether the run goes on from it; what else it throws is a failure. Tables that it cut back are put back.
  bool accepts(const Checkpoint& checkpoint) {
    bool taken = false;
    try {
      run_->resume(checkpoint);
      taken = true;
    } catch (const std::bad_alloc&) {
      ADD_FAILURE() << "a forged length was believed";
    } catch (const std::length_error&) {
      ADD_FAILURE() << "a forged length was believed";
    } catch (const std::exception&) {
    }
    for (const char* table : {"bodies.csv", "fluid.csv", "probes.csv"})
      fs::copy_file(scratch_.path() / "kept" / table, folder() / table, fs::copy_options::overwrite_existing);
    return taken;
  }

  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  /// A bit, a length or the end of some bytes.
  std::string mutated(std::string bytes) {
    constexpr std::uint64_t lengths[] = {~0ull,      1ull << 63,    1ull << 40, 1ull << 32,
                                         1ull << 31, 1000000007ull, 65536,      0};
    switch (below(4)) {
      case 0:
        bytes[below(bytes.size())] ^= static_cast<char>(1u << below(8));
        break;
      case 1:
        bytes.resize(below(bytes.size()));
        break;
      default:
        const auto length = lengths[below(std::size(lengths))];
        bytes.replace(below(bytes.size() - sizeof length), sizeof length, reinterpret_cast<const char*>(&length),
                      sizeof length);
    }
    return bytes;
  }

  static long megabytes_at_most() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  }

  const ScratchFolder scratch_;
  const SceneFile file_ = read_scene_text(coarse_wedge, "scene.toml");
  Progress progress_{Progress::Style::none};
  Checkpoint good_;
  std::string bytes_;
  std::unique_ptr<PlaneRun> run_;
  std::mt19937_64 random_{15};
};

TEST_F(Forged, a_good_checkpoint_is_taken_again_and_again) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(accepts(good_));
}

TEST_F(Forged, damage_is_seen_wherever_it_is_and_not_believed) {
  const auto file = folder() / "checkpoint" / "state";
  fs::remove(folder() / "checkpoint" / "previous");
  for (int i = 0; i < 2000; ++i) {
    const auto bytes = mutated(bytes_);
    if (bytes == bytes_) continue;
    std::ofstream(file, std::ios::binary) << bytes;
    const auto stored = read_checkpoints(folder() / "checkpoint");
    ASSERT_TRUE(stored.good.empty()) << i;
    ASSERT_EQ(stored.bad.size(), 1u) << i;
  }
}

TEST_F(Forged, every_single_byte_of_the_first_and_last_is_looked_at) {
  const auto file = folder() / "checkpoint" / "state";
  fs::remove(folder() / "checkpoint" / "previous");
  for (std::size_t i = 0; i < 400; ++i) {
    auto bytes = bytes_;
    bytes[i < 200 ? i : bytes.size() + 199 - i] ^= 1;
    std::ofstream(file, std::ios::binary) << bytes;
    ASSERT_TRUE(read_checkpoints(folder() / "checkpoint").good.empty()) << i;
  }
}

TEST_F(Forged, payloads_with_an_agreeing_checksum_neither_allocate_nor_crash) {
  const long before = megabytes_at_most();
  int taken = 0;
  for (int i = 0; i < 2000; ++i) {
    auto checkpoint = good_;
    auto& part = i % 2 ? checkpoint.stepper : checkpoint.recorder;
    part = mutated(part);
    taken += accepts(checkpoint);
  }
  EXPECT_LT(taken, 2000);
  // One state is well below a megabyte; forged lengths claim gigabytes.
#ifdef __SANITIZE_ADDRESS__
  constexpr long quarantine = 256;  // freed memory that the sanitizer holds back
#else
  constexpr long quarantine = 0;
#endif
  EXPECT_LT(megabytes_at_most() - before, 200 + quarantine);
  EXPECT_TRUE(accepts(good_)) << "what was refused leaves nothing behind";
}

TEST_F(Forged, lengths_in_the_first_bytes_of_the_frame_are_bounded) {
  const auto file = folder() / "checkpoint" / "state";
  fs::remove(folder() / "checkpoint" / "previous");
  for (const std::size_t at : {0u, 31u, 39u})
    for (const std::uint64_t length : {~0ull, 1ull << 34, 1ull << 63}) {
      auto bytes = bytes_;
      bytes.replace(at, sizeof length, reinterpret_cast<const char*>(&length), sizeof length);
      std::ofstream(file, std::ios::binary) << bytes;
      EXPECT_TRUE(read_checkpoints(folder() / "checkpoint").good.empty()) << at << ' ' << length;
    }
  EXPECT_LT(megabytes_at_most(), 4000);
}

TEST_F(Forged, tables_outside_the_folder_are_not_touched) {
  const auto victim = scratch_.write("victim.csv", "a year's data\n");
  auto checkpoint = good_;
  const auto at = checkpoint.recorder.find("bodies.csv");
  ASSERT_NE(at, std::string::npos);
  checkpoint.recorder.replace(at, 10, "../vict.cs");
  fs::copy_file(victim, scratch_.path() / "vict.cs");
  EXPECT_FALSE(accepts(checkpoint));
  EXPECT_EQ(scratch_.text("vict.cs"), "a year's data\n");
}

}  // namespace
}  // namespace splashdown::apps::forged_checkpoint_test
