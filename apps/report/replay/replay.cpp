#include "apps/report/replay/replay.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "apps/record/frames/vtu_blocks.hpp"
#include "apps/report/look/scripts.hpp"
#include "apps/report/replay/moving_picture.hpp"
#include "apps/report/replay/viewer.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr std::size_t replay_frames = 60;
// Debian's libjs-three: classic scripts, which a page that is opened from disk may hold (modules may not).
const std::filesystem::path three = "/usr/share/javascript/three";
constexpr const char* three_license = "/*! three.js r111, (c) 2010-2019 three.js authors, MIT License */\n";

std::string replay_caption(const MovingPicture& picture, double limit) {
  const auto colours =
      limit > 0 ? fmt::format("colours: pressure from 0 to {}", with_unit(limit, "Pa")) : std::string();
  const char* hands =
      picture.dimension == 2 ? "drag to move, wheel to zoom" : "drag to turn, right button to move, wheel to zoom";
  return fmt::format("{} frames from 0 to {}; {}{}{}", picture.frames.size(),
                     with_unit(picture.frames.back().time, "s"), colours, colours.empty() ? "" : "; ", hands);
}

}  // namespace

Replay replay_of(const std::filesystem::path& run) {
  Replay replay;
  MovingPicture picture;
  try {
    picture = moving_picture(run, replay_frames);
  } catch (const std::exception& error) {
    replay.warnings.push_back(fmt::format("no replay: {}", error.what()));
    return replay;
  }
  if (picture.frames.size() < 2) return replay;
  const auto library = library_text(three / "three.min.js"),
             controls = library_text(three / "examples/js/controls/OrbitControls.js");
  if (library.empty() || controls.empty()) {
    replay.warnings.emplace_back(
        "no replay: three.js is not there (Debian: apt-get install libjs-three), then splashdown report");
    return replay;
  }
  const auto [json, bytes, limit] = packed(picture);
  replay.html = fmt::format(
      R"(<h2>Replay</h2>
<style>#replay .bar2{{display:flex;flex-wrap:wrap;gap:8px 14px;align-items:center;margin-top:10px}}#replay input[type=range]{{flex:1 1 160px;min-width:0}}
#replay canvas{{display:block;max-width:100%;border-radius:6px}}#replay .clock{{font-variant-numeric:tabular-nums;min-width:5em}}#replay label{{font-size:14px;color:var(--soft)}}</style>
<figure id="replay"><div class="view"></div><p class="state" hidden></p><div class="bar2"><button type="button">Play</button><input type="range" min="0" value="0" aria-label="frame"><span class="clock"></span>
<label{}><input type="checkbox" class="so-far"> highest pressure so far</label><label><input type="checkbox" class="mesh"> mesh</label></div>
<figcaption>{}</figcaption></figure>
<script type="application/json" id="replay-info">{}</script>
<script type="text/plain" id="replay-bytes">{}</script>
)",
      picture.dimension == 2 ? " hidden" : "", replay_caption(picture, limit), json_in_script(json), stream_of(bytes));
  for (const auto& script : {three_license + library, controls, std::string(viewer_script)})
    replay.html += script_element(script);
  return replay;
}

}  // namespace splashdown::apps
