// What is asked of a render, checked against the folder of the run before anything is started.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/report/replay/moving_picture.hpp"
#include "apps/report/replay/replay.hpp"

namespace splashdown::apps {

struct RenderOptions {
  std::filesystem::path directory;
  std::optional<double> time;   ///< of a still [s]
  std::filesystem::path out;    ///< of the still; empty: render.png in the folder
  std::filesystem::path movie;  ///< empty: none
  std::optional<double> fps;    ///< absent: all frames in five seconds
  std::string size = "1280x720";
  std::string view;  ///< a name or AZIMUTH,ELEVATION; empty: from the bow
  double zoom = 1;
  bool follow = false, so_far = false, mesh = false;
  bool quiet = false;
};

struct RenderPlan {
  std::array<int, 2> size{};  ///< pixels
  FilmLook look;
  std::filesystem::path file;
  bool is_movie = false;
  double fps = 0;         ///< of a movie
  std::size_t frame = 0;  ///< of a still
  MovingPicture picture;
  std::string note;  ///< what a user should know of the run; mostly empty
};

/// Reads the run. Throws std::runtime_error with option or file, value, rule and cure.
RenderPlan render_plan(const RenderOptions& options);

}  // namespace splashdown::apps
