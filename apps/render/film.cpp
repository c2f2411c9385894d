#include "apps/render/film.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "apps/process/interrupt.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

std::vector<std::string> words_for(const std::filesystem::path& program, const std::filesystem::path& part,
                                   double pictures_a_second) {
  // Told what comes, ffmpeg begins with the first picture instead of looking at megabytes of them. yuv420p and the index at the
  // beginning: what browsers and slides play. 18: hardly to be told from the pictures.
  return {program.string(),
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "image2pipe",
          "-probesize",
          "32",
          "-analyzeduration",
          "0",
          "-c:v",
          "png",
          "-framerate",
          fmt::format("{}", pictures_a_second),
          "-i",
          "pipe:0",
          "-c:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-crf",
          "18",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          "file:" + part.string()};
}

}  // namespace

Film::Film(const std::filesystem::path& program, std::filesystem::path path, double pictures_a_second,
           std::filesystem::path log)
    : path_(std::move(path)),
      part_(path_.parent_path() / fmt::format(".{}.{}.part", path_.filename().string(), ::getpid())),
      log_(std::move(log)),
      process_(words_for(program, part_, pictures_a_second), log_, {{channel_.other_end(), STDIN_FILENO}}) {
  channel_.hand_over();
}

Film::~Film() {
  if (!ended_) {
    process_.kill_group();
    process_.wait();
  }
  std::error_code none;
  std::filesystem::remove(part_, none);
}

void Film::fail() {
  const auto words = last_line(log_);
  throw std::runtime_error(
      fmt::format("{}: ffmpeg cannot write it{}{}", path_.string(), words.empty() ? "" : ": ", one_line(words)));
}

void Film::add(std::string_view png) {
  if (!channel_.send(png)) fail();
}

void Film::finish() {
  channel_.finish();
  for (;;) {
    if (const auto end = process_.end()) {
      ended_ = true;
      if (end->code != 0) fail();
      std::filesystem::rename(part_, path_);
      return;
    }
    if (interrupt_received()) throw Interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace splashdown::apps
