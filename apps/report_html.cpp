#include "apps/report_html.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>

namespace splashdown::apps {

namespace {

constexpr std::string_view style = R"(
:root{--ink:#17222d;--soft:#51606e;--line:#e1e7ec;--paper:#fff;--ground:#f4f7f9;--blue:#2f7fc1}
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI","Helvetica Neue",Arial,sans-serif}
main{max-width:1180px;margin:0 auto;padding:32px 24px 64px}
h1{font-size:30px;line-height:1.2;margin:0 0 4px;letter-spacing:-.01em}
h2{font-size:20px;margin:40px 0 12px;letter-spacing:-.005em}
.where{color:var(--soft);margin:0 0 20px;font-size:14px;overflow-wrap:anywhere}
.verdict{background:var(--paper);border:1px solid var(--line);border-left:6px solid;border-radius:8px;padding:18px 22px}
.verdict.good{border-left-color:#3a9d7c}.verdict.fair{border-left-color:#d98e04}.verdict.bad{border-left-color:#d1495b}
.verdict strong{display:block;font-size:19px;margin-bottom:6px}
.verdict p{margin:3px 0}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;margin:16px 0 0}
.tile{background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:12px 16px}
.tile b{display:block;font-size:22px;line-height:1.25;font-variant-numeric:tabular-nums;white-space:nowrap}
.tile span{color:var(--soft);font-size:13px}
.bar{display:flex;height:26px;border-radius:6px;overflow:hidden;background:var(--line)}
.bar div{min-width:1px}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:10px 0 0;padding:0;list-style:none;font-size:14px;color:var(--soft)}
.legend i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:7px}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,500px),1fr));gap:16px}
figure{margin:0;background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:14px 16px 12px}
figure svg,figure img{display:block;width:100%;height:auto}
figcaption{color:var(--soft);font-size:14px;margin-top:8px}
figcaption b{color:var(--ink)}
.scroll{overflow-x:auto;background:var(--paper);border:1px solid var(--line);border-radius:8px}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:7px 14px;border-top:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left}
thead th{border-top:0;color:var(--soft);font-weight:600}
td.text{white-space:normal;text-align:left}
.note{background:#fff8e8;border:1px solid #f0dfb4;border-radius:8px;padding:12px 16px;margin:16px 0 0}
code{font:13px/1.4 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;background:#eef2f5;border-radius:4px;padding:1px 5px}
footer{color:var(--soft);font-size:13px;margin-top:40px}
@media print{body{background:#fff}figure,.verdict,.tile{break-inside:avoid}}
)";

constexpr std::array phase_colours = {"#0f2f4f", "#2f7fc1", "#3a9d7c", "#d98e04", "#d1495b",
                                      "#7b5ea7", "#8fb8d8", "#b0a990", "#5f6b76"};

const nlohmann::ordered_json& member(const nlohmann::ordered_json& json, const char* key) {
  static const nlohmann::ordered_json nothing = nlohmann::ordered_json::object();
  return json.is_object() && json.contains(key) && json[key].is_object() ? json[key] : nothing;
}

std::string title_of(const RunData& run) {
  if (run.summary.is_object()) {
    const auto scene = run.summary.value("scene", std::string());
    if (!scene.empty()) return scene;
  }
  const auto folder = std::filesystem::absolute(run.directory).lexically_normal();
  return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
}

std::string header(const ReportPage& page) {
  constexpr std::array moods = {"good", "fair", "bad"};
  std::string html = fmt::format(
      "<h1>{}</h1>\n<p class=\"where\">{}</p>\n<section class=\"verdict {}\"><strong>{}</strong>\n",
      html_escaped(title_of(page.run)),
      html_escaped(std::filesystem::absolute(page.run.directory).lexically_normal().string()),
      moods[static_cast<std::size_t>(page.verdict.mood)], html_escaped(page.verdict.headline));
  for (const auto& sentence : page.verdict.sentences) html += "<p>" + sentence + "</p>\n";
  html += "</section>\n";
  for (const auto& warning : page.warnings) html += "<div class=\"note\">" + warning + "</div>\n";
  return html;
}

std::string tiles(const RunData& run) {
  std::string html;
  const auto tile = [&](const std::string& value, const std::string& what) {
    html += fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", value, what);
  };
  const auto& bodies = member(run.summary, "bodies");
  const bool several = bodies.size() > 1;
  for (const auto& [name, body] : bodies.items()) {
    const std::string of = several ? ", " + html_escaped(name) : std::string();
    if (const double f = number_at(body, {"peak_force", "value"}); f > 0)
      tile(with_unit(f, force_unit(run.dimension())), "peak load" + of);
    if (const double g = number_at(body, {"peak_acceleration_g", "raw", "value"}); g > 0)
      tile(digits(g, 3) + " g", "peak acceleration" + of);
  }
  if (const double e = number_at(run.summary, {"ledger", "volume_error"}); std::isfinite(e))
    tile(percent(e), "change of volume");
  if (const double p = number_at(run.summary, {"coupling", "passes_mean"}); std::isfinite(p))
    tile(digits(p, 3), "coupling passes a step");
  if (const double n = number_at(run.summary, {"nodes", "max"}); n > 0) tile(count_text(n), "nodes at most");
  if (const double w = number_at(run.summary, {"wall_seconds"}); w > 0) tile(seconds_text(w), "wall time");
  return html.empty() ? html : "<div class=\"tiles\">\n" + html + "</div>\n";
}

std::string phase_bar(const RunData& run) {
  const auto& phases = member(run.summary, "phases");
  double whole = number_at(run.summary, {"wall_seconds"}), sum = 0;
  for (const auto& [name, seconds] : phases.items()) sum += seconds.is_number() ? seconds.get<double>() : 0;
  if (!(sum > 0)) return {};
  if (!(whole >= sum)) whole = sum;
  std::string bar, legend;
  std::size_t k = 0;
  const auto part = [&](const std::string& name, double seconds, const char* colour) {
    bar += fmt::format("<div style=\"width:{:.3f}%;background:{}\" title=\"{}: {}\"></div>",
                       100 * seconds / whole, colour, html_escaped(name), seconds_text(seconds));
    legend += fmt::format("<li><i style=\"background:{}\"></i>{} <b>{}</b> · {:.1f} %</li>\n", colour,
                          html_escaped(name), seconds_text(seconds), 100 * seconds / whole);
  };
  for (const auto& [name, seconds] : phases.items())
    if (seconds.is_number() && seconds.get<double>() > 0)
      part(name, seconds.get<double>(), phase_colours[k++ % phase_colours.size()]);
  if (whole - sum > 1e-3 * whole) part("not accounted for", whole - sum, "#cfd8df");
  return "<h2>Where the time went</h2>\n<div class=\"bar\">" + bar + "</div>\n<ul class=\"legend\">" +
         legend + "</ul>\n";
}

std::string figure_html(const std::string& image, const std::string& caption) {
  return "<figure>" + image + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string figures(const ReportPage& page) {
  std::string html, fields;
  for (const auto& field : page.fields)
    if (const auto image = page.images.find(field.name); image != page.images.end())
      fields += figure_html(image->second, "<b>" + html_escaped(field.title) + "</b>, " + field.caption);
  if (!fields.empty()) html += "<h2>Mesh and pressure</h2>\n<div class=\"grid\">" + fields + "</div>\n";
  for (const auto& group : page.groups) {
    std::string inside;
    for (const auto& figure : group.figures)
      if (const auto image = page.images.find(figure.name); image != page.images.end())
        inside += figure_html(image->second, figure.caption);
    if (!inside.empty())
      html += "<h2>" + html_escaped(group.title) + "</h2>\n<div class=\"grid\">" + inside + "</div>\n";
  }
  return html;
}

double last_component(const nlohmann::ordered_json& body, const char* key) {
  if (!body.contains(key) || !body[key].is_array() || body[key].empty() || !body[key].back().is_number())
    return NAN;
  return body[key].back().get<double>();
}

std::string body_table(const RunData& run) {
  const auto& bodies = member(run.summary, "bodies");
  if (bodies.empty()) return {};
  std::string html = "<h2>Bodies</h2>\n<div class=\"scroll\"><table><thead><tr><th></th>";
  for (const auto& [name, body] : bodies.items()) html += "<th>" + html_escaped(name) + "</th>";
  html += "</tr></thead><tbody>\n";
  const auto row = [&](const std::string& what, const auto& cell) {
    html += "<tr><td>" + what + "</td>";
    for (const auto& [name, body] : bodies.items()) html += "<td>" + cell(body) + "</td>";
    html += "</tr>\n";
  };
  using Body = nlohmann::ordered_json;
  const int d = run.dimension();
  row("peak load", [&](const Body& b) {
    return with_unit(number_at(b, {"peak_force", "value"}), force_unit(d));
  });
  row("at", [](const Body& b) { return seconds_text(number_at(b, {"peak_force", "time"})); });
  row("peak acceleration, raw", [](const Body& b) {
    return digits(number_at(b, {"peak_acceleration_g", "raw", "value"}), 3) + " g";
  });
  for (const int cfc : {1000, 600, 180, 60})
    row(fmt::format("peak acceleration, CFC {}", cfc), [&](const Body& b) {
      const double peak = number_at(b, {"peak_acceleration_g", fmt::format("cfc{}", cfc).c_str(), "value"});
      return std::isfinite(peak) ? digits(peak, 3) + " g" : std::string("steps too long");
    });
  row("vertical impulse of the load",
      [&](const Body& b) { return with_unit(last_component(b, "impulse"), d == 2 ? "N s/m" : "N s"); });
  row("its repair part", [](const Body& b) {
    const double impulse = last_component(b, "impulse");
    return impulse != 0 ? percent(last_component(b, "impulse_repair") / impulse) : std::string("–");
  });
  row("greatest submergence of the lowest point", [](const Body& b) {
    return with_unit(number_at(b, {"maximum_submergence", "value"}), "m", 3);
  });
  row("at", [](const Body& b) { return seconds_text(number_at(b, {"maximum_submergence", "time"})); });
  row("first contact", [](const Body& b) { return seconds_text(number_at(b, {"first_contact_time"})); });
  return html +
         "</tbody></table></div>\n<p class=\"where\">Accelerations are those of the centre of mass in "
         "multiples of "
         "9.80665 m/s², raw and filtered by the channel frequency classes of SAE J211.</p>\n";
}

std::string equipment_table(const RunData& run) {
  const auto& points = member(run.summary, "equipment");
  if (points.empty()) return {};
  std::string html =
      "<h2>Equipment</h2>\n<div class=\"scroll\"><table><thead><tr><th>point</th><th>peak g, "
      "raw</th><th>at</th>"
      "<th>CFC 1000</th><th>CFC 600</th><th>CFC 180</th><th>CFC 60</th></tr></thead><tbody>\n";
  for (const auto& [name, point] : points.items()) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", html_escaped(name),
                        digits(number_at(point, {"raw", "value"}), 3),
                        seconds_text(number_at(point, {"raw", "time"})));
    for (const char* cfc : {"cfc1000", "cfc600", "cfc180", "cfc60"})
      html += "<td>" + digits(number_at(point, {cfc, "value"}), 3) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string ledger_table(const RunData& run) {
  const auto& ledger = member(run.summary, "ledger");
  if (ledger.empty()) return {};
  const double whole = number_at(ledger, {"volume_initial"});
  const std::string volume = run.dimension() == 2 ? "m²" : "m³", energy = energy_unit(run.dimension());
  std::string html =
      "<h2>Ledger</h2>\n<div class=\"scroll\"><table><thead><tr><th>what</th><th>amount</th><th>of the "
      "water</th></tr></thead><tbody>\n";
  for (const auto& [key, name] : {std::pair{"volume_initial", "volume at the start"},
                                  {"volume_final", "volume at the end"},
                                  {"volume_time_integration", "changed by moving the nodes"},
                                  {"volume_remesh_created", "created where the surface was recognised anew"},
                                  {"volume_remesh_deleted", "deleted there"},
                                  {"volume_spray", "now carried by drops"}}) {
    const double amount = number_at(ledger, {key});
    html += fmt::format("<tr><td>{}</td><td>{} {}</td><td>{}</td></tr>\n", name, digits(amount, 5), volume,
                        whole > 0 ? digits(100 * amount / whole, 3) + " %" : "–");
  }
  for (const auto& [key, name] : {std::pair{"kinetic_energy", "kinetic energy at the end"},
                                  {"potential_energy", "potential energy at the end"},
                                  {"work_on_walls", "work done on bodies and walls"},
                                  {"energy_remesh", "kinetic energy changed by inserting and removing nodes"},
                                  {"energy_repair", "kinetic energy taken by repairs"}})
    html += fmt::format("<tr><td>{}</td><td>{}</td><td></td></tr>\n", name,
                        with_unit(number_at(ledger, {key}), energy));
  return html + "</tbody></table></div>\n";
}

std::string effects_table(const RunData& run) {
  const auto& effects = member(run.summary, "effects");
  const auto &active = member(effects, "active"), &inactive = member(effects, "inactive");
  if (active.empty() && inactive.empty()) return {};
  std::string html =
      "<h2>Effects</h2>\n<div class=\"scroll\"><table><thead><tr><th>effect</th><th>wall "
      "time</th><th>share</th>"
      "<th style=\"text-align:left\">why it is off</th></tr></thead><tbody>\n";
  for (const auto& [name, effect] : active.items())
    html += fmt::format("<tr><td><b>{}</b></td><td>{}</td><td>{}</td><td></td></tr>\n", html_escaped(name),
                        seconds_text(number_at(effect, {"seconds"})), percent(number_at(effect, {"share"})));
  for (const auto& [name, reason] : inactive.items())
    html +=
        fmt::format("<tr><td>{}</td><td>–</td><td>–</td><td class=\"text\">{}</td></tr>\n",
                    html_escaped(name), reason.is_string() ? html_escaped(reason.get<std::string>()) : "");
  return html + "</tbody></table></div>\n";
}

std::string refusals_table(const RunData& run) {
  const auto& causes = member(member(run.summary, "coupling"), "rejected_causes");
  if (causes.empty()) return {};
  std::string html =
      "<h2>Refused steps</h2>\n<div "
      "class=\"scroll\"><table><thead><tr><th>cause</th><th>times</th></tr></thead><tbody>\n";
  for (const auto& [cause, count] : causes.items())
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", html_escaped(cause),
                        count.is_number() ? count_text(count.get<double>()) : "–");
  return html + "</tbody></table></div>\n";
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

std::string inline_svg(const std::string& svg, const std::string& name) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  std::string element = svg.substr(begin);
  // The first title would show as a tooltip that reads "Gnuplot".
  if (const std::size_t title = element.find("<title>Gnuplot</title>"); title != std::string::npos)
    element.erase(title, std::string_view("<title>Gnuplot</title>").size());
  for (const char* id : {"gpDot", "gpPt", "textstrings", "gnuplot_plot_", "gnuplot_canvas"}) {
    replace_all(element, fmt::format("id=\"{}", id), fmt::format("id=\"{}_{}", name, id));
    replace_all(element, fmt::format("id='{}", id), fmt::format("id='{}_{}", name, id));
    replace_all(element, fmt::format("href='#{}", id), fmt::format("href='#{}_{}", name, id));
    replace_all(element, fmt::format("url(#{}", id), fmt::format("url(#{}_{}", name, id));
  }
  replace_all(element, "font-family=\"Helvetica\"",
              "font-family=\"system-ui,Helvetica Neue,Arial,sans-serif\"");
  return element;
}

std::string inline_png(const std::string& bytes, const std::string& alternative_text) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * bytes.size() / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k < bytes.size() + 1 ? alphabet[group >> (18 - 6 * k) & 63u] : '=';
  }
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html_escaped(alternative_text),
                     text);
}

std::string html_of(const ReportPage& page) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
         html_escaped(title_of(page.run)) + " · Splashdown</title>\n<style>" + std::string(style) +
         "</style></head>\n<body><main>\n" + header(page) + tiles(page.run) + phase_bar(page.run) +
         figures(page) + body_table(page.run) + equipment_table(page.run) + ledger_table(page.run) +
         effects_table(page.run) + refusals_table(page.run) +
         "<footer>Made by Splashdown from the files in this folder. The figures' scripts are in "
         "<code>report/</code>.</footer>\n</main></body></html>\n";
}

}  // namespace splashdown::apps
