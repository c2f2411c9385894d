#include "apps/files/run_files.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace splashdown::apps {

namespace {

constexpr const char* tables[] = {"bodies.csv",           "fluid.csv",         "forces.csv", "probes.csv",
                                  "surface_pressure.csv", "added_mass.csv",    "passes.csv", "section_loads.csv",
                                  "elastic.csv",          "velocity_lines.csv"};

}  // namespace

std::span<const char* const> run_tables() { return tables; }

bool holds_tables(const std::filesystem::path& directory) {
  return std::ranges::any_of(tables, [&](const char* name) { return std::filesystem::exists(directory / name); });
}

bool is_table(const std::string& file_name) { return std::ranges::find(tables, file_name) != std::end(tables); }

void clear_earlier_run(const std::filesystem::path& directory) {
  for (const char* name : tables) std::filesystem::remove(directory / name);
  for (const char* name : {"frames.pvd", "summary.json", "report.html"}) std::filesystem::remove(directory / name);
  const auto remove_pictures = [](const std::filesystem::path& folder, const std::string& prefix) {
    if (!std::filesystem::is_directory(folder)) return;
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".vtu" && entry.path().filename().string().starts_with(prefix))
        pictures.push_back(entry.path());
    for (const auto& picture : pictures) std::filesystem::remove(picture);
  };
  for (const char* folder : {"frames", "snapshots"}) remove_pictures(directory / folder, "");
  remove_pictures(directory, "hull_");
}

}  // namespace splashdown::apps
