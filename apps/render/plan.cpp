#include "apps/render/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/record/frames/frames.hpp"
#include "apps/report/ablation.hpp"
#include "apps/report/data.hpp"
#include "apps/report/price.hpp"
#include "apps/report/study/study.hpp"
#include "apps/scene/rules/problems.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {
namespace {

std::runtime_error refused(std::string text) { return std::runtime_error(std::move(text)); }

/// Two numbers with one character between them; nothing for anything else.
template <class Number>
std::optional<std::array<Number, 2>> pair_of(const std::string& text, char between) {
  const auto middle = text.find(between);
  if (middle == std::string::npos) return {};
  std::array<Number, 2> pair{};
  const char *begin = text.data(), *parts[] = {begin, begin + middle, begin + middle + 1, begin + text.size()};
  for (std::size_t k = 0; k < 2; ++k)
    if (const auto [end, trouble] = std::from_chars(parts[2 * k], parts[2 * k + 1], pair[k]);
        trouble != std::errc() || end != parts[2 * k + 1])
      return {};
  return pair;
}

std::array<int, 2> size_of(const RenderOptions& options) {
  constexpr int least = 64, most = 4096;
  const auto size = pair_of<int>(options.size, 'x');
  const auto fits = [](int pixels) { return pixels >= least && pixels <= most; };
  if (!size || !std::ranges::all_of(*size, fits))
    throw refused(fmt::format("--size {}: must be WIDTHxHEIGHT, each from {} to {} pixels, e.g. --size 1920x1080",
                              options.size, least, most));
  if (!options.movie.empty() && ((*size)[0] % 2 != 0 || (*size)[1] % 2 != 0))
    throw refused(fmt::format("--size {}: an MP4 has even numbers of pixels. Use --size {}x{}", options.size,
                              (*size)[0] / 2 * 2, (*size)[1] / 2 * 2));
  return *size;
}

/// Of the picture's file: where it goes and what it ends with.
void check_file(const char* option, const std::filesystem::path& file, const char* extension) {
  if (file.extension() != extension)
    throw refused(fmt::format("{} {}: must end with {}. Use {} {}", option, file.string(), extension, option,
                              shell_word(std::filesystem::path(file).replace_extension(extension).string())));
  const auto folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw refused(
        fmt::format("{} {}: there is no folder {}. Make it, or name another", option, file.string(), folder.string()));
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    throw refused(fmt::format("{} {}: its folder cannot be written. Name another", option, file.string()));
  if (std::filesystem::is_directory(file))
    throw refused(fmt::format("{} {}: is a folder. Name a file in it", option, file.string()));
}

std::array<double, 2> view_of(const std::string& text, int dimension) {
  if (text.empty()) return FilmLook{}.view;
  if (dimension == 2) throw refused(fmt::format("--view {}: a plane scene has one view. Leave it out", text));
  std::vector<std::string> names;
  for (const auto& view : replay_views) {
    if (text == view.name) return view.direction;
    names.emplace_back(view.name);
  }
  const auto angles = pair_of<double>(text, ',');
  const auto near = nearest(text, names);
  if (!angles || !(std::abs((*angles)[0]) <= 360) || !(std::abs((*angles)[1]) < 90))
    throw refused(
        fmt::format("--view {}: must be {}, or two angles in degrees: where the camera stands, turned from ahead to "
                    "port (-360 to 360), and how high (-89 to 89), e.g. --view -55,16{}",
                    text, fmt::join(names, ", "), near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  return *angles;
}

/// Why a folder has no frames that could be shown, and what to do.
std::runtime_error no_frames(const std::filesystem::path& run) {
  if (std::filesystem::exists(run / "frames.pvd"))
    return refused(fmt::format("{}: lists no frames: it is cut short or damaged. Run the scene again",
                               (run / "frames.pvd").string()));
  const auto data = read_run(run);  // throws where there is no run
  const double end = data.end_time();
  const double every = end > 0 ? std::pow(10, std::floor(std::log10(end / 25))) : 0.01;
  return refused(fmt::format(
      "{}: the run recorded no frames: frames.pvd is not there. Put \"frames = {:g}\" (s) below [output] of "
      "the scene, or --set output.frames={:g} behind the command, and run it again",
      run.string(), every, every));
}

/// What a killed or copied folder lacks.
void check_files(const std::filesystem::path& run, const std::vector<ListedFrame>& frames) {
  std::vector<std::string> missing;
  for (const auto& frame : frames)
    for (const auto& [part, file] : frame.pieces)
      if (!std::filesystem::exists(run / file)) missing.push_back(file);
  if (missing.empty()) return;
  const std::size_t told = std::min<std::size_t>(missing.size(), 3);
  throw refused(fmt::format(
      "{}: names {} files that are not there: {}{}. Copy the whole folder, frames/ included, or run the scene again",
      (run / "frames.pvd").string(), missing.size(),
      fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(told), ", "),
      told < missing.size() ? " ..." : ""));
}

void check_folder(const std::filesystem::path& run) {
  if (run.extension() == ".toml")
    throw refused(
        fmt::format("{0}: is a scene. Run it with frames, splashdown run {0} --set output.frames=0.01, and "
                    "name the folder of the run",
                    run.string()));
  if (!std::filesystem::is_directory(run))
    throw refused(
        fmt::format("{}: there is no such folder. Name the folder of a run, e.g. out/wedge_drop", run.string()));
  if (holds_study(run) || holds_price(run) || holds_ablation(run))
    throw refused(fmt::format("{}: holds many runs. Name the folder of one of them", run.string()));
}

/// The frame nearest to a time.
std::size_t frame_at(double time, const std::vector<ListedFrame>& frames) {
  const double first = frames.front().time, last = frames.back().time;
  // Half of the time between frames: somebody asks for the end of a run, whose last frame is a little earlier.
  const double beyond = frames.size() > 1 ? 0.5 * (last - first) / static_cast<double>(frames.size() - 1) : 0;
  if (!(time >= first - beyond && time <= last + beyond))
    throw refused(
        fmt::format("--time {:g}: the run has frames from {} to {}. Use a time between them, e.g. --time {:g}", time,
                    with_unit(first, "s"), with_unit(last, "s"), time < first ? first : last));
  const auto nearest =
      std::ranges::min_element(frames, {}, [&](const auto& frame) { return std::abs(frame.time - time); });
  return static_cast<std::size_t>(nearest - frames.begin());
}

/// All frames in so many seconds, as the report plays them; not as slow as slides, nor faster than screens.
double default_fps(std::size_t frames) {
  constexpr double seconds = 5, least = 5, most = 60;
  return std::clamp(std::round(static_cast<double>(frames) / seconds), least, most);
}

/// Title, and what its summary says of the run.
void look_at_summary(const std::filesystem::path& run, RenderPlan& plan) {
  plan.look.title = std::filesystem::absolute(run).lexically_normal().filename().string();
  try {
    const auto summary = read_json(run / "summary.json");
    if (summary.contains("scene") && summary["scene"].is_string())
      plan.look.title = summary["scene"].get<std::string>();
    if (summary.contains("status") && summary["status"] == "done") return;
  } catch (const std::exception&) {  // the run goes on, or was killed
  }
  plan.note = "the run is not finished";
}

}  // namespace

RenderPlan render_plan(const RenderOptions& options) {
  RenderPlan plan;
  plan.is_movie = !options.movie.empty();
  if (plan.is_movie == options.time.has_value())
    throw refused(
        plan.is_movie
            ? "--time and --movie: a still or a film, not both. Use --time T -o FILE.png, or --movie FILE.mp4"
            : "neither --time nor --movie: what is to be rendered? Use --time T -o FILE.png, or --movie FILE.mp4");
  if (plan.is_movie && !options.out.empty())
    throw refused("-o: is of a still, the film goes to where --movie says. Leave it out");
  if (!plan.is_movie && options.fps) throw refused("--fps: is of a film. Use it with --movie FILE.mp4");
  check_folder(options.directory);
  plan.size = size_of(options);
  plan.file = plan.is_movie ? options.movie : options.out.empty() ? options.directory / "render.png" : options.out;
  check_file(plan.is_movie ? "--movie" : "-o", plan.file, plan.is_movie ? ".mp4" : ".png");
  const auto frames = listed_frames(options.directory);
  if (frames.empty()) throw no_frames(options.directory);
  check_files(options.directory, frames);
  if (plan.is_movie && frames.size() < 2)
    throw refused(fmt::format("--movie: the run has one frame. Use --time {:g}, or record more: --set output.frames=T",
                              frames.front().time));
  if (!plan.is_movie) plan.frame = frame_at(*options.time, frames);
  plan.fps = options.fps.value_or(default_fps(frames.size()));
  plan.picture = moving_picture(options.directory, std::numeric_limits<std::size_t>::max());
  look_at_summary(options.directory, plan);
  plan.look.view = view_of(options.view, plan.picture.dimension);
  plan.look.zoom = options.zoom;
  plan.look.follow = options.follow;
  plan.look.so_far = options.so_far;
  plan.look.mesh = options.mesh;
  if (options.follow && plan.picture.names.empty()) throw refused("--follow: the scene has no body. Leave it out");
  return plan;
}

}  // namespace splashdown::apps
