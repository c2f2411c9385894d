// What a render refuses, with rule and cure, and how it talks to other programs; no browser is needed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <thread>

#include "apps/process/channel.hpp"
#include "apps/process/child_process.hpp"
#include "apps/record/frames/frames.hpp"
#include "apps/render/devtools.hpp"
#include "apps/render/film.hpp"
#include "apps/render/plan.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::render_test {
namespace {

/// Frames from 0 to 0.3 s, a triangle of water each, and what a run leaves beside them.
void write_run(const ScratchFolder& folder, int frames) {
  folder.write("summary.json", R"({"scene": "A scene", "status": "done"})");
  folder.write("fluid.csv", "time,dt\n0,0.1\n0.3,0.1\n");
  FrameSeries series(folder.path());
  for (int i = 0; i < frames; ++i) {
    Frame<2> frame;
    frame.time = 0.1 * i;
    frame.x = {{0, 0}, {1, 0}, {0, 1}};
    frame.v.assign(3, Vec<2>::Zero());
    frame.p = {0, 1, 2};
    frame.drop_diameter.assign(3, 0);
    frame.kind.assign(3, NodeKind::interior);
    frame.wall.assign(3, -1);
    frame.cells = {{0, 1, 2}};
    series.add<2>(frame);
  }
}

std::string refusal(const RenderOptions& options) {
  try {
    render_plan(options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

struct Mistake {
  const char* name;
  void (*make)(RenderOptions&);
  const char* said;
};

class RenderMistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(RenderMistakes, are_named_with_their_cure) {
  ScratchFolder folder;
  write_run(folder, 4);
  RenderOptions options;
  options.directory = folder.path();
  options.time = 0.1;
  ASSERT_EQ(refusal(options), "accepted");
  GetParam().make(options);
  EXPECT_NE(refusal(options).find(GetParam().said), std::string::npos) << refusal(options);
}

INSTANTIATE_TEST_SUITE_P(
    Options, RenderMistakes,
    ::testing::Values(
        Mistake{"nothing", [](RenderOptions& o) { o.time.reset(); }, "Use --time T -o FILE.png, or --movie FILE.mp4"},
        Mistake{"both", [](RenderOptions& o) { o.movie = "f.mp4"; }, "a still or a film, not both"},
        Mistake{"movie_and_out",
                [](RenderOptions& o) {
                  o.time.reset();
                  o.movie = "f.mp4";
                  o.out = "f.png";
                },
                "-o: is of a still"},
        Mistake{"fps", [](RenderOptions& o) { o.fps = 10; }, "--fps: is of a film"},
        Mistake{"size", [](RenderOptions& o) { o.size = "1280"; }, "--size 1280: must be WIDTHxHEIGHT"},
        Mistake{"large", [](RenderOptions& o) { o.size = "9000x20"; }, "each from 64 to 4096 pixels"},
        Mistake{"odd",
                [](RenderOptions& o) {
                  o.time.reset();
                  o.movie = "f.mp4";
                  o.size = "641x480";
                },
                "Use --size 640x480"},
        Mistake{"ending", [](RenderOptions& o) { o.out = "f.jpg"; }, "must end with .png. Use -o f.png"},
        Mistake{"movie_ending",
                [](RenderOptions& o) {
                  o.time.reset();
                  o.movie = "f.avi";
                },
                "must end with .mp4. Use --movie f.mp4"},
        Mistake{"folder_of_file", [](RenderOptions& o) { o.out = "no/such/f.png"; }, "there is no folder no/such"},
        Mistake{"late", [](RenderOptions& o) { o.time = 0.4; },
                "frames from 0 s to 300 ms. Use a time between them, e.g. --time 0.3"},
        Mistake{"early", [](RenderOptions& o) { o.time = -1; }, "e.g. --time 0"},
        Mistake{"not_a_time", [](RenderOptions& o) { o.time = NAN; }, "Use a time between them"},
        Mistake{"view", [](RenderOptions& o) { o.view = "bow"; }, "a plane scene has one view"},
        Mistake{"follow", [](RenderOptions& o) { o.follow = true; }, "--follow: the scene has no body"},
        Mistake{"no_folder", [](RenderOptions& o) { o.directory = "no_such_folder"; }, "there is no such folder"},
        Mistake{"scene", [](RenderOptions& o) { o.directory = "a/scene.toml"; },
                "splashdown run a/scene.toml --set output.frames"}),
    [](const auto& test) { return test.param.name; });

TEST(RenderPlan, takes_the_nearest_frame) {
  ScratchFolder folder;
  write_run(folder, 4);
  RenderOptions options;
  options.directory = folder.path();
  for (const auto& [time, frame] : {std::pair{0., 0U}, {0.04, 0U}, {0.06, 1U}, {0.21, 2U}, {0.3, 3U}, {0.34, 3U}}) {
    options.time = time;
    EXPECT_EQ(render_plan(options).frame, frame) << time;
  }
}

TEST(RenderPlan, plays_all_frames_in_five_seconds) {
  ScratchFolder folder;
  write_run(folder, 60);
  RenderOptions options;
  options.directory = folder.path();
  options.movie = "f.mp4";
  EXPECT_EQ(render_plan(options).fps, 12);
  EXPECT_EQ(render_plan(options).picture.frames.size(), 60U);
  options.fps = 25;
  EXPECT_EQ(render_plan(options).fps, 25);
}

TEST(RenderPlan, of_a_run_without_frames_gives_the_line_that_records_them) {
  ScratchFolder folder;
  write_run(folder, 0);
  RenderOptions options;
  options.directory = folder.path();
  options.time = 0;
  EXPECT_NE(refusal(options).find("Put \"frames = 0.01\" (s) below [output] of the scene"), std::string::npos)
      << refusal(options);
  ScratchFolder empty;
  options.directory = empty.path();
  EXPECT_NE(refusal(options).find("holds neither a run"), std::string::npos) << refusal(options);
}

TEST(RenderPlan, of_a_damaged_folder_says_what_is_missing) {
  ScratchFolder folder;
  write_run(folder, 3);
  RenderOptions options;
  options.directory = folder.path();
  options.time = 0;
  folder.write("frames/000001.vtu", "damaged");
  EXPECT_NE(refusal(options).find("000001.vtu: is not a readable .vtu file"), std::string::npos) << refusal(options);
  std::filesystem::remove(folder.path() / "frames/000001.vtu");
  EXPECT_NE(refusal(options).find("1 files that are not there: frames/000001.vtu"), std::string::npos)
      << refusal(options);
  folder.write("frames.pvd", "<VTKFile><Collec");
  EXPECT_NE(refusal(options).find("lists no frames"), std::string::npos) << refusal(options);
}

TEST(RenderPlan, of_a_run_that_goes_on_says_so) {
  ScratchFolder folder;
  write_run(folder, 3);
  RenderOptions options;
  options.directory = folder.path();
  options.time = 0;
  EXPECT_EQ(render_plan(options).note, "");
  std::filesystem::remove(folder.path() / "summary.json");
  EXPECT_NE(render_plan(options).note, "");
}

TEST(MessageStream, gives_the_same_messages_in_whatever_pieces_they_come) {
  const std::vector<std::string> sent = {"{}", "", std::string(5000, 'x'), "\"ä\"", "last"};
  std::string bytes;
  for (const auto& message : sent) bytes += message + '\0';
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    std::uniform_int_distribution<std::size_t> length(1, round % 2 == 0 ? 3 : 4000);
    MessageStream stream;
    std::vector<std::string> got;
    for (std::size_t begin = 0; begin < bytes.size();) {
      const auto piece = std::min(length(random), bytes.size() - begin);
      stream.add(std::string_view(bytes).substr(begin, piece));
      begin += piece;
      while (auto message = stream.next()) got.push_back(*message);
    }
    EXPECT_EQ(got, sent);
  }
}

/// The other side of a channel: reads a question, says these things.
std::thread answering(const Channel& channel, std::string answer) {
  return std::thread([end = channel.other_end(), answer = std::move(answer)] {
    for (char byte = 'x'; byte != '\0';)
      if (::read(end, &byte, 1) != 1) return;
    ASSERT_EQ(::write(end, answer.data(), answer.size()), static_cast<ssize_t>(answer.size()));
  });
}

std::string said_to(const std::string& answer, std::chrono::milliseconds patience = std::chrono::seconds(20)) {
  Channel channel;
  auto other = answering(channel, answer);
  DevTools tools(channel, patience);
  std::string said;
  try {
    said = tools.value_of("1").dump();
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  other.join();
  return said;
}

TEST(DevTools, takes_the_answer_to_its_question_and_no_event) {
  const auto zero = std::string(1, '\0');
  EXPECT_EQ(said_to("{\"method\":\"Page.loaded\"}" + zero + "{\"id\":7,\"result\":{}}" + zero +
                    "{\"id\":1,\"result\":{\"result\":{\"value\":42}}}" + zero),
            "42");
  EXPECT_NE(said_to("{\"id\":1,\"error\":{\"message\":\"no such page\"}}" + zero).find("refuses: no such page"),
            std::string::npos);
  EXPECT_NE(said_to("{\"id\":1,\"result\":{\"exceptionDetails\":{\"text\":\"Uncaught\"}}}" + zero).find("Uncaught"),
            std::string::npos);
  EXPECT_NE(said_to("no JSON" + zero).find("does not speak"), std::string::npos);
  EXPECT_NE(said_to("{\"id\":1", std::chrono::milliseconds(50)).find("does not answer within 0.05 s"),
            std::string::npos);
}

TEST(DevTools, notices_that_the_browser_has_ended) {
  ScratchFolder folder;
  Channel channel;
  ChildProcess child({"/bin/true"}, folder.path() / "log", {{channel.other_end(), 3}});
  channel.hand_over();
  DevTools tools(channel, std::chrono::seconds(20));
  EXPECT_THROW(tools.call("Page.enable"), std::runtime_error);
  child.wait();
}

TEST(Channel, is_found_by_a_child_under_the_numbers_that_it_expects) {
  ScratchFolder folder;
  Channel channel;
  ChildProcess child({"/bin/sh", "-c", "read question <&3; echo \"$question, too\" >&4"}, folder.path() / "log",
                     {{channel.other_end(), 3}, {channel.other_end(), 4}});
  channel.hand_over();
  ASSERT_TRUE(channel.send("here\n"));
  std::string answer;
  for (auto piece = channel.receive(std::chrono::seconds(20)); piece && !piece->empty();
       piece = channel.receive(std::chrono::seconds(20)))
    answer += *piece;
  EXPECT_EQ(answer, "here, too\n");
  EXPECT_EQ(child.wait().code, 0);
}

TEST(Channel, tells_that_nobody_reads_any_more) {
  Channel channel;
  channel.hand_over();
  EXPECT_FALSE(channel.send("x"));
}

/// A program that stands for ffmpeg: the last word is its file, with "file:" before it.
std::filesystem::path stand_in(const ScratchFolder& folder, const std::string& what) {
  const auto path = folder.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\n" + what + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST(Film, is_there_once_it_is_whole) {
  ScratchFolder folder;
  Film film(stand_in(folder, "cat >\"${last#file:}\""), folder.path() / "f.mp4", 10, folder.path() / "log");
  film.add("one ");
  film.add("two");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "f.mp4"));
  film.finish();
  EXPECT_EQ(folder.text("f.mp4"), "one two");
}

TEST(Film, leaves_nothing_where_it_is_given_up_or_fails) {
  ScratchFolder folder;
  const auto films = [&] {
    return std::ranges::count_if(std::filesystem::directory_iterator(folder.path()), [](const auto& entry) {
      return entry.path().string().find("f.mp4") != std::string::npos;
    });
  };
  {
    Film film(stand_in(folder, "cat >\"${last#file:}\""), folder.path() / "f.mp4", 10, folder.path() / "log");
    film.add("one");
  }
  EXPECT_EQ(films(), 0);
  Film film(stand_in(folder, "echo 'Unknown encoder libx264' >&2; exit 1"), folder.path() / "f.mp4", 10,
            folder.path() / "log");
  try {
    film.finish();
    ADD_FAILURE() << "no failure";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("Unknown encoder libx264"), std::string::npos);
  }
  EXPECT_EQ(films(), 0);
}

}  // namespace
}  // namespace splashdown::apps::render_test
