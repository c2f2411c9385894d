#include "apps/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "apps/report/answers/answers.hpp"
#include "apps/report/inputs/inputs.hpp"
#include "apps/report/page.hpp"
#include "apps/statistics/attitude.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"

namespace splashdown::apps {

namespace {

constexpr std::array phase_colours = {"#0f2f4f", "#2f7fc1", "#3a9d7c", "#d98e04", "#d1495b",
                                      "#7b5ea7", "#8fb8d8", "#b0a990", "#5f6b76"};

std::string title_of(const RunData& run) {
  if (run.summary.is_object()) {
    const auto scene = run.summary.value("scene", std::string());
    if (!scene.empty()) return scene;
  }
  return folder_name(run.directory);
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
    bar += fmt::format("<div style=\"width:{:.3f}%;background:{}\" title=\"{}: {}\"></div>", 100 * seconds / whole,
                       colour, html_escaped(name), seconds_text(seconds));
    legend += fmt::format("<li><i style=\"background:{}\"></i>{} <b>{}</b> · {:.1f} %</li>\n", colour,
                          html_escaped(name), seconds_text(seconds), 100 * seconds / whole);
  };
  for (const auto& [name, seconds] : phases.items())
    if (seconds.is_number() && seconds.get<double>() > 0)
      part(name, seconds.get<double>(), phase_colours[k++ % phase_colours.size()]);
  if (whole - sum > 1e-3 * whole) part("not accounted for", whole - sum, "#cfd8df");
  return "<h2>Where the time went</h2>\n<div class=\"bar\">" + bar + "</div>\n<ul class=\"legend\">" + legend +
         "</ul>\n";
}

/// As a chart, as a picture, or not at all.
std::string curves_figure(const ReportPage& page, const Figure& figure) {
  const auto image = page.images.find(figure.name);
  if (page.charts.drawn.contains(figure.name))
    return html_chart(figure.name, image == page.images.end() ? "" : image->second, figure.caption);
  return image == page.images.end() ? "" : html_figure(image->second, figure.caption);
}

std::string figures(const ReportPage& page) {
  std::string html;
  for (const auto& [heading, pictures] :
       {std::pair{"Mesh and pressure", &page.fields}, {"Highest pressure on the hulls", &page.hulls}}) {
    std::string inside;
    for (const auto& field : *pictures)
      if (const auto image = page.images.find(field.name); image != page.images.end())
        inside += html_figure(image->second, "<b>" + html_escaped(field.title) + "</b>, " + field.caption);
    const bool less_rest = pictures == &page.fields && !member(page.run.summary, "still_water").empty();
    if (!inside.empty())
      html += fmt::format("<h2>{}</h2>\n{}<div class=\"grid\">{}</div>\n", heading,
                          less_rest ? "<p class=\"where\">Colours: pressure less that of still water, ρ g depth, so "
                                      "that the impact shows.</p>\n"
                                    : "",
                          inside);
  }
  for (const auto& group : page.groups) {
    std::string inside;
    for (const auto& figure : group.figures) inside += curves_figure(page, figure);
    if (!inside.empty())
      html += "<h2>" + html_escaped(group.title) + "</h2>\n<div class=\"grid\">" + inside + "</div>\n";
  }
  return html;
}

double last_component(const nlohmann::ordered_json& body, const char* key) {
  if (!body.contains(key) || !body[key].is_array() || body[key].empty() || !body[key].back().is_number()) return NAN;
  return body[key].back().get<double>();
}

std::string angle_text(const nlohmann::ordered_json& angle) {
  const auto degrees = [](double value) { return std::isfinite(value) ? fmt::format("{:.1f}°", value) : "–"; };
  return fmt::format("{} ({} to {})", degrees(number_at(angle, {"end"})),
                     degrees(number_at(angle, {"minimum", "value"})), degrees(number_at(angle, {"maximum", "value"})));
}

std::string since_text(const nlohmann::ordered_json& body, const char* key, const char* otherwise) {
  const double since = number_at(body, {key});
  return std::isfinite(since) ? "since " + seconds_text(since) : std::string(otherwise);
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
  row("verdict", [](const Body& b) {
    const auto& verdict = member(b, "verdict");
    return verdict.contains("grade") && verdict["grade"].is_string() ? html_escaped(verdict["grade"].get<std::string>())
                                                                     : std::string("–");
  });
  row("peak load, resultant", [&](const Body& b) {
    return digits_with_unit(number_at(b, {"peak_force", "value"}), force_unit(d));
  });
  row("at", [](const Body& b) { return seconds_text(number_at(b, {"peak_force", "time"})); });
  row("its band", [](const Body& b) { return grade_text(b, {"peak_force"}); });
  row("peak acceleration, raw", [](const Body& b) {
    return digits(number_at(b, {"peak_acceleration_g", "raw", "value"}), 3) + " g";
  });
  row("its band", [](const Body& b) { return grade_text(b, {"peak_acceleration_g", "raw"}); });
  for (const int cfc : {1000, 600, 180, 60})
    row(fmt::format("peak acceleration, CFC {}", cfc), [&](const Body& b) {
      const double peak = number_at(b, {"peak_acceleration_g", fmt::format("cfc{}", cfc).c_str(), "value"});
      return std::isfinite(peak) ? digits(peak, 3) + " g" : std::string("steps too long");
    });
  row("its band", [](const Body& b) { return grade_text(b, {"peak_acceleration_g", "cfc60"}); });
  row("the pulse: rise time, duration", [](const Body& b) {
    const auto& pulse = shown_pulse(member(b, "peak_acceleration_g"));
    return seconds_text(number_at(pulse, {"rise_time"})) + ", " + seconds_text(number_at(pulse, {"duration"}));
  });
  row("its change of velocity", [](const Body& b) {
    return digits_with_unit(number_at(shown_pulse(member(b, "peak_acceleration_g")), {"delta_v"}), "m/s", 3);
  });
  for (const int cfc : {600, 60})
    row(fmt::format("peak load, CFC {}", cfc), [&](const Body& b) {
      const double peak = number_at(b, {"peak_force_filtered", fmt::format("cfc{}", cfc).c_str(), "value"});
      return std::isfinite(peak) ? digits_with_unit(peak, force_unit(d)) : std::string("steps too long");
    });
  row("vertical impulse of the load",
      [&](const Body& b) { return digits_with_unit(last_component(b, "impulse"), d == 2 ? "N s/m" : "N s"); });
  row("repair part of the impulse", [](const Body& b) {
    const double share = number_at(b, {"repair_share"});
    if (!b.contains("repair_share")) return std::string("–");  // of an earlier version
    return std::isfinite(share) ? percent(share) : std::string("no meaningful share");
  });
  row("greatest submergence of the lowest point", [](const Body& b) {
    return digits_with_unit(number_at(b, {"maximum_submergence", "value"}), "m", 3);
  });
  row("at", [](const Body& b) { return seconds_text(number_at(b, {"maximum_submergence", "time"})); });
  row("first contact", [](const Body& b) { return seconds_text(number_at(b, {"first_contact_time"})); });
  if (std::ranges::any_of(bodies, [](const Body& b) { return std::isfinite(number_at(b, {"first_contact_time"})); })) {
    for (const char* angle : attitude_names)
      if (std::ranges::any_of(bodies, [&](const Body& b) { return member(b, "attitude_deg").contains(angle); }))
        row(std::string(angle) + " at the end (lowest to highest since contact)",
            [&](const Body& b) { return angle_text(member(member(b, "attitude_deg"), angle)); });
    row("capsized", [](const Body& b) { return since_text(b, "capsized_time", "no"); });
    row("left the water again", [](const Body& b) {
      const double skips = number_at(b, {"skips"});
      return skips > 0 ? count_text(skips) + (skips > 1 ? " times" : " time") : std::string("no");
    });
    row("settled", [](const Body& b) { return since_text(b, "settled_time", "not within the run"); });
  }
  return html +
         "</tbody></table></div>\n<p class=\"where\">Accelerations are those of the centre of mass in "
         "multiples of "
         "9.80665 m/s², raw and filtered by the channel frequency classes of SAE J211. The pulse is that of CFC 180, "
         "or of the "
         "lowest class there is: rise time from 10 to 90 % of its peak, duration above 10 %.</p>\n";
}

std::string equipment_table(const RunData& run) {
  const auto& points = member(run.summary, "equipment");
  if (points.empty()) return {};
  std::string html =
      "<h2>Equipment</h2>\n<div class=\"scroll\"><table><thead><tr><th>point</th><th>peak g, "
      "raw</th><th>at</th>"
      "<th>CFC 1000</th><th>CFC 600</th><th>CFC 180</th><th>CFC 60</th><th>its band</th><th>rise "
      "time</th><th>duration</th><th>change "
      "of "
      "velocity</th></tr></thead><tbody>\n";
  for (const auto& [name, point] : points.items()) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", html_escaped(name),
                        digits(number_at(point, {"raw", "value"}), 3), seconds_text(number_at(point, {"raw", "time"})));
    for (const char* cfc : {"cfc1000", "cfc600", "cfc180", "cfc60"})
      html += "<td>" + digits(number_at(point, {cfc, "value"}), 3) + "</td>";
    html += "<td>" + grade_text(point, {"cfc60"}) + "</td>";
    const auto& pulse = shown_pulse(point);
    html += fmt::format("<td>{}</td><td>{}</td><td>{}</td></tr>\n", seconds_text(number_at(pulse, {"rise_time"})),
                        seconds_text(number_at(pulse, {"duration"})),
                        digits_with_unit(number_at(pulse, {"delta_v"}), "m/s", 3));
  }
  return html + "</tbody></table></div>\n";
}

/// What counts, of several runs on meshes of one size (price/mean_run.hpp).
std::string mean_table(const RunData& run) {
  const auto& mean = member(run.summary, "mean_of_runs");
  if (mean.empty()) return {};
  std::string rows;
  for (const auto& [name, quantity] : member(mean, "quantities").items()) {
    if (!quantity.value("counts", false)) continue;
    const double value = number_at(quantity, {"value"}), band = number_at(quantity, {"band"});
    const auto ratio = ratio_of(band, value);
    rows += fmt::format("<tr><td><b>{}</b></td><td>{}</td><td>{}</td><td>± {}</td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(name), digits(value, 4), html_escaped(text_at(quantity, "unit")), digits(band, 2),
                        ratio ? band_mark(*ratio, "") : "–", digits(number_at(quantity, {"deviation"}), 2));
  }
  return fmt::format(
      "<h2>Mean of {} runs</h2>\n<p>Meshes of one size, refine {}, differ in these numbers by chance. The mean of {} "
      "runs "
      "is better known than that of this run alone, whose curves stand above. The band holds the limit of finer "
      "meshes.</p>\n<div class=\"scroll\"><table><thead><tr><th>quantity</th><th>mean</th><th>unit</th><th>band</th>"
      "<th>of the mean</th><th>scatter of one run</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      count_text(number_at(mean, {"runs"})), digits(number_at(mean, {"refine"}), 3),
      count_text(number_at(mean, {"runs"})), rows);
}

/// Patches, and points where pressure was recorded.
std::string pressure_table(const RunData& run) {
  std::string rows;
  for (const auto& [list, kind] : {std::pair{"patches", "mean over the patch"}, {"probes", "at the point"}})
    for (const auto& [name, place] : member(run.summary, list).items()) {
      const auto& peak = member(place, "peak_pressure");
      if (peak.empty()) continue;
      rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                          html_escaped(name), digits_with_unit(number_at(peak, {"value"}), "Pa", 3),
                          seconds_text(number_at(peak, {"time"})), grade_text(place, {"peak_pressure"}), kind,
                          digits_with_unit(number_at(place, {"impulse"}), "Pa s", 3));
    }
  if (rows.empty()) return rows;
  return "<h2>Pressures</h2>\n<div class=\"scroll\"><table><thead><tr><th>place</th><th>peak</th><th>at</th>"
         "<th>its band</th><th>what</th><th>impulse</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

/// Largest loads between the parts of bodies.
std::string section_table(const RunData& run) {
  const auto& sections = member(run.summary, "section_loads");
  if (sections.empty()) return {};
  std::string html =
      "<h2>Largest section loads</h2>\n<div "
      "class=\"scroll\"><table><thead><tr><th>record</th><th>what</th><th>value</th>"
      "<th>station</th><th>at</th></tr></thead><tbody>\n";
  const int d = run.dimension();
  for (const auto& [name, section] : sections.items())
    for (const auto& [key, what, unit] : {std::tuple{"shear", "shear force", force_unit(d)},
                                          {"hogging", "hogging moment", moment_unit(d)},
                                          {"sagging", "sagging moment", moment_unit(d)}}) {
      const auto& peak = member(section, key);
      if (const double value = number_at(peak, {"value"}); std::isfinite(value) && value != 0)
        html +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", html_escaped(name), what,
                        digits_with_unit(value, unit, 3), digits_with_unit(number_at(peak, {"station"}), "m", 3),
                        seconds_text(number_at(peak, {"time"})));
    }
  return html +
         "</tbody></table></div>\n<p class=\"where\">Of all steps, raw; positive shear pushes the part ahead up.</p>\n";
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
                                  {"volume_returned", "returned at the free surface for these three"},
                                  {"volume_spray", "now carried by drops"}}) {
    const double amount = number_at(ledger, {key});
    html += fmt::format("<tr><td>{}</td><td>{} {}</td><td>{}</td></tr>\n", name, digits(amount, 5), volume,
                        whole > 0 ? digits(100 * amount / whole, 3) + " %" : "–");
  }
  for (const auto& [key, name] : {std::pair{"kinetic_energy", "kinetic energy at the end"},
                                  {"potential_energy", "potential energy at the end"},
                                  {"work_on_walls", "work done on bodies and walls"},
                                  {"energy_remesh", "kinetic energy changed by inserting and removing nodes"},
                                  {"energy_repair", "kinetic energy taken by repairs"},
                                  {"energy_gain_joule", "largest gain that nothing explains"},
                                  {"energy_scale", "what there was to give or to take"}})
    html += fmt::format("<tr><td>{}</td><td>{}</td><td></td></tr>\n", name,
                        digits_with_unit(number_at(ledger, {key}), energy));
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

}  // namespace

std::string html_of(const ReportPage& page) {
  const auto title = title_of(page.run);
  const auto& run = page.run;
  return html_page(title, html_header(title, run.directory, page.banner, page.warnings) + answer_card(run) +
                              quiet_line(run) + page.replay + figures(page) + mean_table(run) + body_table(run) +
                              equipment_table(run) + pressure_table(run) + section_table(run) + inputs_of(run) +
                              ledger_table(run) + refusals_table(run) + phase_bar(run) +
                              "<footer>Made by Splashdown from the files in this folder. The figures' scripts are "
                              "in <code>report/</code>.</footer>\n" +
                              page.charts.html);
}

}  // namespace splashdown::apps
