#include "apps/render/command.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "apps/files/csv.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/process/renewed_line.hpp"
#include "apps/render/browser.hpp"
#include "apps/render/film.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

/// A folder that lives as long as this.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "splashdown_render_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error(name + ": cannot make a folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct Programs {
  std::filesystem::path chromium, ffmpeg;
};

/// Throws std::runtime_error: which are missing, and how to get them.
Programs programs_for(bool movie) {
  const auto chromium = find_chromium(), ffmpeg = find_program("ffmpeg");
  std::string missing;
  if (!chromium) missing = "chromium";
  if (movie && !ffmpeg) missing += missing.empty() ? "ffmpeg" : " ffmpeg";
  if (!missing.empty())
    throw std::runtime_error(fmt::format("not installed: {0}. Install with \"sudo apt-get install {0}\"", missing));
  return {*chromium, ffmpeg.value_or("")};
}

/// One line that renews itself on a terminal, a plain line now and then elsewhere.
class FrameCount {
 public:
  FrameCount(std::size_t frames, bool quiet)
      : frames_(frames), quiet_(quiet), line_(!quiet && RenewedLine::is_terminal()) {}
  void show(std::size_t done) {
    constexpr std::chrono::seconds between(5);
    const auto now = std::chrono::steady_clock::now();
    const bool plain = !quiet_ && !RenewedLine::is_terminal() && now - last_ >= between;
    if (!plain && !line_.is_due()) return;
    last_ = now;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    auto text = fmt::format("{:3.0f} %  frame {} of {}",
                            100. * static_cast<double>(done) / static_cast<double>(frames_), done, frames_);
    if (done > 0)
      text += fmt::format("  left {}",
                          clock_text(seconds * static_cast<double>(frames_ - done) / static_cast<double>(done)));
    line_.show(text);
    if (plain) fmt::print("{}\n", text);
    if (plain) std::fflush(stdout);
  }

 private:
  std::size_t frames_;
  bool quiet_;
  RenewedLine line_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), last_ = begin_;
};

/// "10 times slower than the landing"
std::string pace(double factor) {
  if (factor > 0.95 && factor < 1.05) return "as fast as in reality";
  return fmt::format("{:.2g} times {} than in reality", factor > 1 ? factor : 1 / factor,
                     factor > 1 ? "slower" : "faster");
}

std::string told(const RenderPlan& plan, const RenderOptions& options) {
  const auto& frames = plan.picture.frames;
  const auto size = fmt::format("{}x{}", plan.size[0], plan.size[1]);
  if (!plan.is_movie) {
    const double time = frames[plan.frame].time;
    const bool exact = std::abs(time - *options.time) <= 1e-9 * std::abs(time);
    return fmt::format("{}: {}, t = {}{}", plan.file.string(), size, with_unit(time, "s"),
                       exact ? "" : fmt::format(", the frame nearest to {}", with_unit(*options.time, "s")));
  }
  const double seconds = static_cast<double>(frames.size()) / plan.fps,
               of_run = frames.back().time - frames.front().time;
  return fmt::format("{}: {}, {} frames from {} to {}, {:g} a second: {:.3g} s, {}", plan.file.string(), size,
                     frames.size(), with_unit(frames.front().time, "s"), with_unit(frames.back().time, "s"), plan.fps,
                     seconds, pace(seconds / of_run));
}

void render(const RenderPlan& plan, const Programs& programs, const std::string& page, bool quiet) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "page.html", page);
  Browser browser(programs.chromium, folder.path(), plan.size);
  const auto ready = browser.open(folder.path() / "page.html",
                                  "(document.getElementById('replay') || {dataset: {}}).dataset.ready || ''");
  if (ready != "yes") {
    const auto why = browser.value_of("document.querySelector('#replay .state').textContent");
    throw std::runtime_error(why.is_string() ? why.get<std::string>() : "the replay fails");
  }
  const auto picture_of = [&](std::size_t frame) {
    browser.value_of(fmt::format("splashdown_show({})", frame));
    return browser.picture(plan.is_movie);
  };
  if (!plan.is_movie) return write_file_atomically(plan.file, picture_of(plan.frame));
  Film film(programs.ffmpeg, plan.file, plan.fps, folder.path() / "ffmpeg.log");
  const std::size_t frames = plan.picture.frames.size();
  FrameCount count(frames, quiet);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    count.show(frame);
    film.add(picture_of(frame));
  }
  film.finish();
}

}  // namespace

int render_command(const RenderOptions& options) {
  RenderPlan plan;
  Programs programs;
  std::optional<std::string> page;
  try {
    plan = render_plan(options);
    programs = programs_for(plan.is_movie);
    page = film_page(plan.picture, plan.look);
    if (!page) throw std::runtime_error(no_three);
  } catch (const std::runtime_error& error) {
    return bad_input(trouble(error));
  }
  if (!plan.note.empty() && !options.quiet) fmt::print(stderr, "note: {}\n", plan.note);
  catch_interrupts();
  try {
    render(plan, programs, *page, options.quiet);
  } catch (const Interrupted&) {
    fmt::print(stderr, "interrupted: {} is not written\n", plan.file.string());
    return exit_code::interrupted;
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "error: {}\n", trouble(error));
    return exit_code::cannot_go_on;
  }
  if (!options.quiet) fmt::print("{}\n", told(plan, options));
  return exit_code::done;
}

}  // namespace splashdown::apps
