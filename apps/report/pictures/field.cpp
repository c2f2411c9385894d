#include "apps/report/pictures/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

#include "apps/record/frames/frames.hpp"
#include "apps/report/pictures/picture.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {

namespace {

constexpr std::size_t frames_between = 3;  // besides start, peak and end

struct Instant {
  std::string title;
  PlanePicture picture;
};

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// (time, stem) of the frames that there are.
std::vector<std::pair<double, std::string>> stems_of_frames(const std::filesystem::path& run) {
  std::vector<std::pair<double, std::string>> frames;
  for (const auto& [time, pieces] : listed_frames(run))
    if (const std::filesystem::path fluid = pieces.front().second; pieces.front().first == "fluid")
      frames.emplace_back(time, fluid.stem().string());
  return frames;
}

std::vector<Instant> choose_instants(const std::filesystem::path& run, std::vector<std::string>& warnings) {
  std::vector<Instant> instants;
  const auto add = [&](const std::string& folder, const std::string& stem, const std::string& title) {
    try {
      auto picture = read_picture(run / folder, stem);
      if (!instants.empty() && instants.back().picture.time == picture.time)
        instants.back().title += ", " + lower_first(title);
      else
        instants.push_back({title, std::move(picture)});
    } catch (const std::exception& error) {
      warnings.push_back(error.what());
    }
  };
  for (const auto& [stem, title] :
       {std::pair{"start", "Start"}, {"peak", "Largest load"}, {"end", "End"}, {"failed", "Last good state"}})
    if (std::filesystem::exists(run / "snapshots" / (std::string(stem) + ".vtu"))) add("snapshots", stem, title);

  const auto frames = stems_of_frames(run);
  double last = frames.empty() ? 0 : frames.back().first;
  for (const auto& instant : instants) last = std::max(last, instant.picture.time);
  for (std::size_t k = 1; k <= frames_between && !frames.empty(); ++k) {
    const double wanted = last * static_cast<double>(k) / (frames_between + 1);
    const auto nearest =
        std::ranges::min_element(frames, {}, [&](const auto& frame) { return std::abs(frame.first - wanted); });
    const bool shown = std::ranges::any_of(instants, [&](const Instant& instant) {
      return std::abs(instant.picture.time - nearest->first) < 0.04 * last;
    });
    if (!shown) add("frames", nearest->second, "On the way");
  }
  std::ranges::stable_sort(instants, {}, [](const Instant& instant) { return instant.picture.time; });
  return instants;
}

/// What all these pictures show: the bodies with room around them, or all the water if there is no body.
Box view_of(std::span<const Instant> instants) {
  Box water, bodies;
  double body_size = 0;
  for (const auto& [title, picture] : instants) {
    for (const auto& x : picture.points) water.add(x);
    for (const auto& outline : picture.outlines) {
      if (!outline.encloses_solid) continue;
      Box body;
      for (const auto& segment : outline.segments) body.add(segment[0]);
      if (!body.valid()) continue;
      bodies.add(body.low);
      bodies.add(body.high);
      body_size = std::max({body_size, body.width(), body.height()});
    }
  }
  Box view = bodies.valid() ? bodies : water;
  if (!view.valid()) return view;
  // Less above and below: the weight of deep water would fill the colours.
  const double rim_of_water = 0.04 * std::max(view.width(), view.height());
  const PlanePoint margin =
      bodies.valid() ? PlanePoint{0.7 * body_size, 0.35 * body_size} : PlanePoint{rim_of_water, rim_of_water};
  for (std::size_t k = 0; k < 2; ++k) view.low[k] -= margin[k], view.high[k] += margin[k];
  if (bodies.valid() && water.valid()) {
    // No empty margins beyond the tank.
    const double rim = 0.05 * body_size;
    view.low[0] = std::max(view.low[0], std::min(water.low[0], bodies.low[0]) - rim);
    view.high[0] = std::min(view.high[0], std::max(water.high[0], bodies.high[0]) + rim);
    view.low[1] = std::max(view.low[1], std::min(water.low[1], bodies.low[1]) - rim);
  }
  // Between 0.4 and 0.85 as high as wide, growing the short side.
  const double low_aspect = 0.4, high_aspect = 0.85;
  if (const double lack = low_aspect * view.width() - view.height(); lack > 0)
    view.low[1] -= 0.5 * lack, view.high[1] += 0.5 * lack;
  if (const double lack = view.height() / high_aspect - view.width(); lack > 0)
    view.low[0] -= 0.5 * lack, view.high[0] += 0.5 * lack;
  return view;
}

/// Where bodies travel far, one view of all would leave them small.
constexpr double far_travel = 1.3;  // widths of a view of one picture

std::vector<Box> views_of(const std::vector<Instant>& instants) {
  const Box whole = view_of(instants);
  std::vector<Box> own;
  double widest = 0;
  for (const auto& instant : instants) {
    own.push_back(view_of({&instant, 1}));
    widest = std::max(widest, own.back().width());
  }
  if (whole.width() > far_travel * widest) return own;
  return std::vector<Box>(instants.size(), whole);
}

/// Of the pressure at rest over the height of a picture: less is round-off of water that rests.
constexpr double worth_a_colour = 0.01;

/// Of the water at rest [Pa]; of the depth it would have in still water, none above.
struct Hydrostatic {
  double density, gravity, level;
  bool known() const { return density > 0 && gravity > 0 && std::isfinite(level); }
  double at(double height) const { return density * gravity * std::max(0., level - height); }
};

/// The weight of deep water would fill the colours, and an impact would be a speck.
void take_off(const Hydrostatic& rest, PlanePicture& picture) {
  for (std::size_t i = 0; i < picture.points.size(); ++i) picture.pressure[i] -= rest.at(picture.points[i][1]);
}

std::string caption_of(const PlanePicture& picture, const std::string& highest) {
  std::string caption = fmt::format("t = {}", seconds_text(picture.time));
  if (!highest.empty()) caption += "; " + highest;
  if (picture.nodes > 0)
    caption += fmt::format("; {} nodes, {} elements in the whole mesh", picture.nodes, picture.cells);
  return caption + ".";
}

}  // namespace

FieldFigures prepare_field_figures(const std::filesystem::path& run, const nlohmann::ordered_json& summary) {
  FieldFigures result;
  auto instants = choose_instants(run, result.warnings);
  const auto number = [&](const char* key) { return number_at(summary, {"still_water", key}); };
  const Hydrostatic rest{number("density"), number("gravity"), number("level")};
  if (rest.known())
    for (auto& instant : instants) take_off(rest, instant.picture);
  const auto views = views_of(instants);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const auto& [title, picture] = instants[i];
    const Box& view = views[i];
    if (!view.valid() || !(view.width() > 0) || !(view.height() > 0)) continue;
    ColourScale scale;
    if (rest.known()) scale = {"p − ρ g depth", true, worth_a_colour * rest.at(rest.level - view.height())};
    auto figure = figure_of("field_" + std::to_string(result.figures.size()), picture, view, scale);
    figure.title = title;
    figure.caption = caption_of(picture, figure.caption);
    result.figures.push_back(std::move(figure));
  }
  return result;
}

}  // namespace splashdown::apps
