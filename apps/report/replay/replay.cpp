#include "apps/report/replay/replay.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/record/frames/vtu_blocks.hpp"
#include "apps/report/look/scripts.hpp"
#include "apps/report/pictures/picture.hpp"
#include "apps/report/replay/moving_picture.hpp"
#include "apps/report/replay/packed_picture.hpp"
#include "apps/report/replay/viewer.hpp"
#include "apps/report/words.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr std::size_t replay_frames = 60;
// Debian's libjs-three: classic scripts, which a page that is opened from disk may hold (modules may not).
const std::filesystem::path three = "/usr/share/javascript/three";
constexpr const char* three_license = "<!-- holds three.js r111, (c) 2010-2019 three.js authors, MIT License -->\n";

/// three.js and its OrbitControls; nothing if they are not there.
std::string three_text() {
  const auto library = library_text(three / "three.min.js"),
             controls = library_text(three / "examples/js/controls/OrbitControls.js");
  return library.empty() || controls.empty() ? std::string() : library + "\n" + controls;
}

std::string replay_caption(const MovingPicture& picture, double limit) {
  const auto colours =
      limit > 0 ? fmt::format("colours: pressure from 0 to {}; ", with_unit(limit, "Pa")) : std::string();
  const char* hands = picture.dimension == 2
                          ? "drag to move, wheel to zoom"
                          : "water is darker in troughs and paler on crests; drag to turn, right button to move, "
                            "wheel to zoom";
  return fmt::format("{} frames from {} to {}; {}{}", picture.frames.size(),
                     with_unit(picture.frames.front().time, "s"), with_unit(picture.frames.back().time, "s"), colours,
                     hands);
}

std::string view_options() {
  std::string options;
  for (const auto& [name, label, direction] : replay_views)
    options += fmt::format("<option value=\"{},{}\">{}</option>", direction[0], direction[1], label);
  return options;
}

/// Figure, data and scripts. `film`: an empty object in a replay for readers.
std::string replay_html(const MovingPicture& picture, const std::string& library, const std::string& title,
                        const nlohmann::json& film) {
  const auto [text, bytes, limit, step] = packed(picture);
  auto info = nlohmann::json::parse(text);
  if (!film.empty()) info["film"] = film;
  for (const auto& [at, red, green, blue] : pressure_colours())
    info["colours"].push_back(nlohmann::json::array({at, red, green, blue}));
  const char* in_space = picture.dimension == 3 ? "" : " hidden";
  auto html = fmt::format(
      R"(<style>{}</style>
<figure id="replay"{}><div class="view"><div class="stamp"></div>{}<div class="ruler"></div><div class="key" hidden><span class="what"></span><div class="bar"></div><div class="ticks"></div></div></div>
<p class="state" hidden></p><div class="hands"><button type="button">Play</button><input type="range" min="0" value="0" aria-label="frame"><span class="clock"></span>
<label{}><select class="from" aria-label="view">{}</select></label><label{}><input type="checkbox" class="so-far"> highest pressure so far</label><label{}><input type="checkbox" class="follow"> follow</label><label><input type="checkbox" class="mesh"> mesh</label></div>
<figcaption>{}</figcaption></figure>
{}<script type="text/plain" id="replay-library">{}</script>
<script type="application/json" id="replay-info">{}</script>
<script type="text/plain" id="replay-bytes">{}</script>
)",
      replay_style, film.empty() ? "" : " class=\"film\"",
      film.empty() ? std::string() : "<div class=\"name\">" + html_escaped(title) + "</div>", in_space, view_options(),
      in_space, picture.names.empty() ? " hidden" : "", replay_caption(picture, limit), three_license,
      stream_of(library), json_in_script(info.dump()), stream_of(bytes));
  for (const char* script : replay_scripts) html += script_element(script);
  return html;
}

}  // namespace

Replay replay_of(const std::filesystem::path& run) {
  Replay replay;
  try {
    const auto picture = moving_picture(run, replay_frames);
    if (picture.frames.size() < 2) return replay;
    if (const auto library = three_text(); !library.empty())
      replay.html = "<h2>Replay</h2>\n" + replay_html(picture, library, {}, nlohmann::json::object());
    else
      replay.warnings.push_back(fmt::format("no replay: {}, then splashdown report", no_three));
  } catch (const std::exception& error) {
    replay.warnings.push_back(fmt::format("no replay: {}", error.what()));
  }
  return replay;
}

std::optional<std::string> film_page(const MovingPicture& picture, const FilmLook& look) {
  const auto library = three_text();
  if (library.empty()) return {};
  const nlohmann::json film{
      {"view", look.view}, {"zoom", look.zoom}, {"follow", look.follow}, {"so_far", look.so_far}, {"mesh", look.mesh}};
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + html_escaped(look.title) +
         "</title></head><body>\n" + replay_html(picture, library, look.title, film) + "</body></html>\n";
}

}  // namespace splashdown::apps
