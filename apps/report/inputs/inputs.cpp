#include "apps/report/inputs/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/record/frames/frames.hpp"
#include "apps/report/inputs/hull_views.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_hulls = 4;

/// From the world to the frame of a body's shape, about its centre of mass, by the first row of bodies.csv.
struct BodyFrame {
  Point3 centre;
  double w, x, y, z;  ///< unit quaternion, frame of the shape to world

  Point3 operator()(const Point3& world) const {
    const Point3 r{world[0] - centre[0], world[1] - centre[1], world[2] - centre[2]};
    // R^T r by rows of R.
    return {(1 - 2 * (y * y + z * z)) * r[0] + 2 * (x * y + w * z) * r[1] + 2 * (x * z - w * y) * r[2],
            2 * (x * y - w * z) * r[0] + (1 - 2 * (x * x + z * z)) * r[1] + 2 * (y * z + w * x) * r[2],
            2 * (x * z + w * y) * r[0] + 2 * (y * z - w * x) * r[1] + (1 - 2 * (x * x + y * y)) * r[2]};
  }
};

BodyFrame frame_of(const Table& rows) {
  const auto first = [&](const char* column) { return rows[column].empty() ? 0 : rows[column].front(); };
  return {{first("x"), first("y"), first("z")}, first("qw"), first("qx"), first("qy"), first("qz")};
}

/// Up at rest in the frame of the shape: the last row of Ry(-pitch) Rx(roll), in the plane of R(pitch) (attitude.hpp).
Point3 up_at_rest(const Json& rest, bool plane) {
  const double radians = std::numbers::pi / 180, trim = number_at(rest, {"trim_deg"}) * radians;
  const double heel = plane ? 0 : number_at(rest, {"heel_deg"}) * radians;
  if (!std::isfinite(trim) || !std::isfinite(heel)) return {0, 0, 0};
  if (plane) return {std::sin(trim), std::cos(trim), 0};
  return {std::sin(trim), std::cos(trim) * std::sin(heel), std::cos(trim) * std::cos(heel)};
}

DrawnHull hull_of(const RunData& run, const std::string& body, const Table& rows) {
  const auto grid = read_grid(run.directory / "snapshots" / ("start_" + file_name_of(body) + ".vtu"));
  DrawnHull hull;
  hull.plane = run.dimension() == 2;
  const auto frame = frame_of(rows);
  for (const auto& x : grid.points) hull.points.push_back(frame(x));
  hull.cells = grid.cells;
  const auto& rest = member(member(member(run.summary, "bodies"), body.c_str()), "at_rest");
  const double draft = number_at(rest, {"draft"});
  const auto up = up_at_rest(rest, hull.plane);
  if (!(draft > 0) || up == Point3{0, 0, 0} || hull.points.empty()) return hull;
  double lowest = INFINITY;
  for (const auto& x : hull.points) lowest = std::min(lowest, x[0] * up[0] + x[1] * up[1] + x[2] * up[2]);
  hull.water_normal = up;
  hull.water_offset = lowest + draft;
  return hull;
}

std::string hull_section(const RunData& run, const std::string& body, const Table& rows) {
  DrawnHull hull;
  try {
    hull = hull_of(run, body, rows);
  } catch (const std::exception&) {  // a picture that is not there: the page stands without it
    return {};
  }
  std::string html;
  for (const auto& [svg, caption] : views_of(hull))
    html += "<div>" + svg + "<figcaption>" + caption + "</figcaption></div>\n";
  if (html.empty()) return html;
  std::string words = "<b>" + html_escaped(body) + "</b>";
  const auto& summary = member(member(run.summary, "bodies"), body.c_str());
  if (const double mass = number_at(summary, {"mass"}); std::isfinite(mass))
    words += ", " + digits_with_unit(mass * 1000, hull.plane ? "g/m" : "g");
  words += ". Cross: centre of mass";
  if (hull.water_normal != Point3{0, 0, 0})
    words += "; blue: water at rest, draft " + digits_with_unit(number_at(summary, {"at_rest", "draft"}), "m", 3);
  return "<figure class=\"views\"><div class=\"row\">" + html + "</div><figcaption>" + words +
         ".</figcaption></figure>\n";
}

std::string hulls(const RunData& run) {
  std::string html;
  std::size_t number = 0;
  for (const auto& [name, rows] : run.bodies)
    if (!rows.empty() && number++ < most_hulls) html += hull_section(run, name, rows);
  if (number > most_hulls)
    html += fmt::format("<p class=\"where\">The first {} of {} bodies.</p>\n", most_hulls, number);
  return html.empty() ? html : "<h2>Inputs</h2>\n" + html;
}

std::string effects_table(const RunData& run) {
  const auto& effects = member(run.summary, "effects");
  const auto &active = member(effects, "active"), &inactive = member(effects, "inactive");
  if (active.empty() && inactive.empty()) return {};
  std::string html =
      "<h2>Effects</h2>\n<div class=\"scroll\"><table><thead><tr><th>effect</th><th></th><th class=\"text\">the number "
      "that says whether it matters</th><th>wall time</th><th>share</th></tr></thead><tbody>\n";
  for (const auto& [name, effect] : active.items())
    html += fmt::format("<tr><td><b>{}</b></td><td>on</td><td class=\"text\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(name), html_escaped(text_at(effect, "reason")),
                        seconds_text(number_at(effect, {"seconds"})), percent(number_at(effect, {"share"})));
  for (const auto& [name, reason] : inactive.items())
    html += fmt::format("<tr><td>{}</td><td>off</td><td class=\"text\">{}</td><td>–</td><td>–</td></tr>\n",
                        html_escaped(name), reason.is_string() ? html_escaped(reason.get<std::string>()) : "");
  return html + "</tbody></table></div>\n";
}

/// Text that a button copies.
std::string to_copy(const std::string& text) {
  return "<div class=\"copy\"><pre>" + html_escaped(text) +
         "</pre><button type=\"button\" hidden onclick=\"navigator.clipboard.writeText("
         "this.previousElementSibling.textContent).then(()=>{this.textContent='copied'})\">copy</button></div>";
}

/// The command that made the run, and the scene with all values in force.
std::string command_and_scene(const RunData& run) {
  const auto text = read_text(run.directory / "scene.resolved.toml"), command = text_at(run.summary, "command");
  std::string html;
  if (!command.empty())
    html += "<h2>Command</h2>\n" + to_copy(command) +
            "<p class=\"where\">Makes this run, with the scene file as it was.</p>\n";
  if (!text.empty())
    html +=
        "<h2>Scene</h2>\n<details class=\"scene\"><summary>all values in force, as a scene to copy: <code>splashdown "
        "run "
        "scene.resolved.toml</code> repeats this run, whatever became of the scene file</summary>" +
        to_copy(text) + "</details>\n";
  if (html.empty()) return html;
  return html +
         "<script>if(navigator.clipboard)for(const b of document.querySelectorAll('.copy "
         "button'))b.hidden=false</script>\n";
}

}  // namespace

std::string inputs_of(const RunData& run) { return hulls(run) + effects_table(run) + command_and_scene(run); }

}  // namespace splashdown::apps
