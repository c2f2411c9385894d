#include "apps/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/files/csv.hpp"
#include "apps/report/ablation.hpp"
#include "apps/report/data.hpp"
#include "apps/report/figures.hpp"
#include "apps/report/gnuplot.hpp"
#include "apps/report/html.hpp"
#include "apps/report/page.hpp"
#include "apps/report/pictures/field.hpp"
#include "apps/report/pictures/hull.hpp"
#include "apps/report/pictures/picture.hpp"
#include "apps/report/price.hpp"
#include "apps/report/replay/replay.hpp"
#include "apps/report/study/study.hpp"

namespace splashdown::apps {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out) throw std::runtime_error(path.string() + ": cannot write");
}

/// A figure that gnuplot did not draw must not show its predecessor.
void remove_old_images(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".svg" || entry.path().extension() == ".png") images.push_back(entry.path());
  for (const auto& image : images) std::filesystem::remove(image);
}

void draw(const std::filesystem::path& folder, const std::vector<Figure>& curves, const FieldFigures& fields,
          std::vector<std::string>& warnings) {
  std::vector<std::string> scripts;
  const auto add = [&](const std::string& name, const std::string& script) {
    write_text(folder / name, script);
    scripts.push_back(name);
  };
  std::string axes;
  for (const auto& field : fields.figures) axes += field.script;
  if (!axes.empty()) add("fields.gp", axes);
  if (!curves.empty()) add("curves.gp", script_of(folder, curves));
  const auto results = run_gnuplot(folder, scripts);
  if (std::ranges::count(results, GnuplotResult::missing) > 0) warnings.emplace_back(no_gnuplot);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i] == GnuplotResult::failed)
      warnings.push_back(fmt::format("gnuplot could not draw all figures: see {}.log", (folder / scripts[i]).string()));
}

}  // namespace

ReportResult write_report(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) throw std::runtime_error(directory.string() + ": is not a folder");
  if (holds_price(directory)) return write_price_report(directory);
  if (holds_ablation(directory)) return write_ablation_report(directory);
  if (holds_study(directory)) return write_study_report(directory);
  const RunData data = read_run(directory);
  const auto folder = directory / "report";
  std::filesystem::create_directories(folder);
  remove_old_images(folder);

  ReportResult result{directory / "report.html", {}};
  ReportPage page{data, banner_of(data), {}, {}, figures_of(data), {}, {}, {}, {}};
  if (auto hulls = hull_curves(directory); !hulls.figures.empty())
    page.groups.insert(page.groups.end() - (page.groups.empty() ? 0 : 1), std::move(hulls));  // before the numerics
  std::vector<Figure> curves;
  for (const auto& group : page.groups) curves.insert(curves.end(), group.figures.begin(), group.figures.end());
  FieldFigures fields = prepare_field_figures(directory, data.summary), hulls = prepare_hull_figures(directory);
  result.warnings = fields.warnings;
  result.warnings.insert(result.warnings.end(), hulls.warnings.begin(), hulls.warnings.end());
  const auto of_plane = static_cast<std::ptrdiff_t>(fields.figures.size());
  std::ranges::move(hulls.figures, std::back_inserter(fields.figures));
  draw(folder, curves, fields, result.warnings);

  for (const auto& figure : curves)
    if (const auto file = folder / (figure.name + ".svg"); std::filesystem::exists(file))
      page.images[figure.name] = inline_svg(read_text(file), figure.name);
  for (const auto& field : fields.figures)
    if (const auto file = folder / (field.name + ".svg"); std::filesystem::exists(file)) {
      const auto picture = with_content(read_text(file), field);
      write_text(file, picture);
      page.images[field.name] = inline_svg(picture, field.name);
    }
  page.hulls.assign(fields.figures.begin() + of_plane, fields.figures.end());
  fields.figures.resize(static_cast<std::size_t>(of_plane));
  page.fields = std::move(fields.figures);
  page.charts = charts_of(curves, 1 / time_unit(data.end_time()).scale);
  std::ranges::move(page.charts.warnings, std::back_inserter(result.warnings));
  auto replay = replay_of(directory);
  page.replay = std::move(replay.html);
  std::ranges::move(replay.warnings, std::back_inserter(result.warnings));
  if (data.summary.is_object() && data.summary.contains("not_foreseen"))
    for (const auto& text : data.summary["not_foreseen"])
      if (text.is_string()) page.warnings.push_back("Not known: " + html_escaped(text.get<std::string>()) + ".");
  for (const auto& warning : result.warnings) page.warnings.push_back(html_escaped(warning));
  write_file_atomically(result.page, html_of(page));
  return result;
}

}  // namespace splashdown::apps
