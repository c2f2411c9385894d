#include "apps/new/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "apps/check/cost.hpp"
#include "apps/check/questions.hpp"
#include "apps/check/words.hpp"
#include "apps/new/hull.hpp"
#include "apps/new/plan.hpp"
#include "apps/new/text.hpp"
#include "apps/process/exit.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/shell_word.hpp"
#include "core/surface/repair.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

struct Written {
  fs::path scene, hull;  ///< `hull`: empty where none is written
};

Written places(const NewOptions& options, const NewHull& hull) {
  const fs::path out = options.out.empty() ? fs::path(hull.name) : options.out;
  Written written{out.extension() == ".toml" ? out : out / "scene.toml", {}};
  const auto is_read = [&](const fs::path& file) {
    return fs::exists(options.hull) && fs::exists(file) && fs::equivalent(file, options.hull);
  };
  if (hull.write) {
    written.hull = written.scene.parent_path() / (hull.name + ".stl");
    if (is_read(written.hull)) written.hull.replace_filename(hull.name + "_repaired.stl");
  }
  std::vector<fs::path> files = {written.scene};
  if (hull.write) files.push_back(written.hull);
  for (const auto& file : files) {
    if (is_read(file))
      throw NewError(
          fmt::format("{}: is the hull that is read. Use another folder with --out, or --name", file.string()));
    if (fs::exists(file) && !options.force)
      throw NewError(
          fmt::format("{}: is there already. Use --out for another folder, or --force to replace it", file.string()));
  }
  return written;
}

/// Of the hull's file, as the scene names it.
std::string file_in_scene(const NewOptions& options, const Written& written) {
  if (options.hull.empty()) return {};
  if (!written.hull.empty()) return written.hull.filename().string();
  const auto folder = fs::weakly_canonical(fs::absolute(written.scene).parent_path());
  return fs::proximate(fs::weakly_canonical(options.hull), folder).string();
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw NewError(path.string() + ": cannot be written. Is the folder yours, with space on the disk?");
}

/// A mesh, and what a run on it is predicted to take on one core.
struct Offer {
  std::string refine;  ///< "standard": the scene's own
  double seconds = 0;
};

constexpr double few_minutes =
    100;  // predicted; five minutes where that is too low by a factor of three (docs/guide.md) [s]

/// The scene's own mesh, and the finest of those for a first look that takes a few minutes, else the coarsest.
std::vector<Offer> offered(const fs::path& scene) {
  const auto offer = [&](const std::string& refine) {
    const std::vector<std::string> set = {fmt::format("--refine {0}: fluid.size.refine={0}", refine)};
    return Offer{refine, predicted_seconds(read_scene(scene, set).scene)};
  };
  std::vector<Offer> all = {offer("standard")};
  for (const auto* refine : {"draft", "0.25", "0.18", "0.12"}) {
    std::optional<Offer> first;
    try {
      first = offer(refine);
    } catch (const SceneError&) {  // its elements are larger than the water
      break;
    }
    if (all.size() == 2) all.pop_back();
    all.push_back(*first);
    if (first->seconds <= few_minutes) break;
  }
  return all;
}

template <int d>
void tell_questions(const SceneFile& file) {
  const auto asked = questions<d>(file.scene, predicted_cost<d>(file.scene));
  if (asked.empty()) return;
  fmt::print("questions\n");
  for (const auto& question : asked) fmt::print("  {}\n", question);
}

void tell_next(const fs::path& scene) {
  const auto word = shell_word(scene.string());
  const auto all = offered(scene);
  fmt::print("Next (times are predicted for one core, and may be wrong by a factor of three):\n");
  const auto line = [](const std::string& command, const std::string& what) {
    fmt::print("  {:<56} {}\n", command, what);
  };
  line("splashdown check " + word, "what would run");
  line(fmt::format("splashdown run {} --refine {}", word, all.back().refine),
       "a first look, " + clock_text(all.back().seconds));
  line("splashdown run " + word, clock_text(all.front().seconds));
  line(fmt::format("splashdown run {} --seconds {:g}", word, 3 * few_minutes),
       "the finest mesh for five minutes, with bands");
}

/// Nothing stays of a scene that is refused.
SceneFile write_and_read(const Written& written, const NewHull& hull, const std::string& text) {
  const auto folder = written.scene.parent_path();
  const bool made = !folder.empty() && fs::create_directories(folder);
  if (hull.write) write_stl(written.hull, *hull.write);
  write(written.scene, text);
  try {
    return read_scene(written.scene);
  } catch (const SceneError&) {
    fs::remove(written.scene);
    if (hull.write) fs::remove(written.hull);
    if (made) fs::remove(folder);
    throw;
  }
}

template <int d>
int write_scene(const NewOptions& options) {
  const auto hull = new_hull(options);
  const auto written = places(options, hull);
  const auto plan = landing_plan<d>(options, hull);
  const auto text = scene_text<d>(options, hull, plan, file_in_scene(options, written));
  const auto file = write_and_read(written, hull, text);
  fmt::print("{}: {}\n", written.scene.string(), plan.scene.title);
  if (hull.write) row("file", fmt::format("the hull is written to {}", written.hull.string()));
  for (const auto& told : plan.told) row(told.about, told.text);
  tell_questions<d>(file);
  tell_next(written.scene);
  return exit_code::done;
}

}  // namespace

int new_command(const NewOptions& options) {
  const auto refused = [](std::string text) { return bad_input(text.ends_with(".") ? text : text + "."); };
  try {
    check_numbers(options);
    return options.plane ? write_scene<2>(options) : write_scene<3>(options);
  } catch (const fs::filesystem_error& error) {
    return bad_input(trouble(error));
  } catch (const SceneError& error) {
    return bad_input(error.what());
  } catch (const NewError& error) {
    return refused(error.what());
  } catch (const std::invalid_argument& error) {  // a shape that is none
    return refused(error.what());
  }
}

}  // namespace splashdown::apps
