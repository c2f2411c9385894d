#include "apps/recorder_files.hpp"

#include <string>
#include <vector>

namespace splashdown::apps {

void clear_earlier_run(const std::filesystem::path& directory) {
  for (const char* name : {"bodies.csv", "fluid.csv", "probes.csv", "surface_pressure.csv", "added_mass.csv",
                           "frames.pvd", "summary.json", "report.html"})
    std::filesystem::remove(directory / name);
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
