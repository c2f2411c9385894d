#include "apps/new/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

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
  if (hull.write) written.hull = written.scene.parent_path() / (hull.name + ".stl");
  std::vector<fs::path> files = {written.scene};
  if (hull.write) files.push_back(written.hull);
  for (const auto& file : files) {
    if (fs::exists(options.hull) && fs::exists(file) && fs::equivalent(file, options.hull))
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

/// A mesh to begin with, and what a run on it costs.
struct Offer {
  std::string refine;
  double seconds = 0;  ///< on one core
};

// Predictions may be a factor of three too low (docs/guide.md): 20 s become a minute, 100 s five.
constexpr double at_once = 20, few_minutes = 100;  // [s]

/// The scene's own mesh where it is predicted to take a minute at most, else the finest of these that is to take five.
std::vector<Offer> offered(const fs::path& scene) {
  std::vector<Offer> all;
  for (const auto* refine : {"standard", "draft", "0.25", "0.18", "0.12"}) {
    const std::vector<std::string> set = {fmt::format("--refine {0}: fluid.size.refine={0}", refine)};
    all.push_back({refine, predicted_seconds(read_scene(scene, set).scene)});
    if (all.back().seconds <= (all.size() == 1 ? at_once : few_minutes)) break;
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

void tell(const fs::path& scene, const SceneFile& file) {
  const auto all = offered(scene);
  std::string costs;
  for (const auto& offer : all)
    costs += fmt::format("{}{} {}", costs.empty() ? "" : ", ", offer.refine, clock_text(offer.seconds));
  row("cost", fmt::format("predicted for one core, by --refine: {}; may be wrong by a factor of three", costs));
  if (file.scene.dimension == 2)
    tell_questions<2>(file);
  else
    tell_questions<3>(file);
  const auto word = shell_word(scene.string());
  fmt::print("Next:\n  splashdown check {}\n  splashdown run {} --refine {}\n", word, word, all.back().refine);
}

template <int d>
int write_scene(const NewOptions& options) {
  const auto hull = new_hull(options);
  const auto written = places(options, hull);
  const auto plan = landing_plan<d>(options, hull);
  const auto text = scene_text<d>(options, hull, plan, file_in_scene(options, written));
  const auto folder = written.scene.parent_path();
  if (!folder.empty()) fs::create_directories(folder);
  if (hull.write) write_stl(written.hull, *hull.write);
  write(written.scene, text);
  SceneFile file;
  try {
    file = read_scene(written.scene);
  } catch (const SceneError&) {
    fs::remove(written.scene);
    if (hull.write) fs::remove(written.hull);
    throw;
  }
  fmt::print("{}: {}\n", written.scene.string(), plan.scene.title);
  if (hull.write) row("file", fmt::format("the hull is written to {}", written.hull.string()));
  for (const auto& told : plan.told) row(told.about, told.text);
  tell(written.scene, file);
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
