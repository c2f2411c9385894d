// A run's frames as a picture that moves: WebGL by three.js, in HTML that needs no network.
//
// three.js and the frames (packed_picture.hpp) are one zlib stream in base64 each, which the browser unpacks (Compression
// Streams).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

struct MovingPicture;

struct Replay {
  std::string html;                   ///< empty: there are no frames, or no three.js
  std::vector<std::string> warnings;  ///< why, where somebody may wonder
};

/// A part of a page. Of the frames that the run's folder holds, sixty at most, evenly spread. Cost: that of reading them.
Replay replay_of(const std::filesystem::path& run);

/// Where the camera stands in space: turned from ahead (x) to port (y), and raised [deg].
struct ReplayView {
  const char *name, *label;
  std::array<double, 2> direction;
};
inline constexpr ReplayView replay_views[] = {
    {"bow", "from the bow", {-55, 16}}, {"stern", "from the stern", {-125, 16}}, {"side", "from the side", {-90, 6}},
    {"ahead", "from ahead", {0, 8}},    {"above", "from above", {-90, 89}},      {"below", "from below", {-55, -28}}};

/// How a film looks.
struct FilmLook {
  std::string title;
  std::array<double, 2> view = replay_views[0].direction;  ///< in space
  double zoom = 1;
  bool follow = false;  ///< the first body
  bool so_far = false;  ///< the highest pressures so far, not those of the moment
  bool mesh = false;
};

/// A page that fills its window with the picture and waits for splashdown_show(frame) once its figure has data-ready="yes".
/// Nothing if three.js is not there.
std::optional<std::string> film_page(const MovingPicture& picture, const FilmLook& look);

/// What is said of it.
inline constexpr const char* no_three = "three.js is not there (Debian: apt-get install libjs-three)";

}  // namespace splashdown::apps
