#include "apps/study/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "apps/study/table.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark = ".splashdown-study";
constexpr std::size_t longest = 100;  // of 255 (NAME_MAX on Linux), with room for endings
constexpr std::array<std::string_view, 9> endings = {".csv", ".json", ".svg", ".png",   ".gnuplot",
                                                     ".log", ".html", ".tmp", ".sbatch"};

/// FNV-1a (Fowler, Noll, Vo): tells names apart that are cut at the same place.
std::uint32_t digest(const std::string& text) {
  std::uint32_t hash = 2166136261u;
  for (const unsigned char byte : text) hash = (hash ^ byte) * 16777619u;
  return hash;
}

bool is_there(const fs::path& path) { return fs::symlink_status(path).type() != fs::file_type::not_found; }
bool is_folder(const fs::path& path) { return fs::symlink_status(path).type() == fs::file_type::directory; }
bool is_own(const fs::path& folder) { return is_folder(folder) && is_there(folder / mark); }

/// There from the moment it is opened: a kill leaves an empty folder or a marked one.
void set_mark(const fs::path& folder) {
  std::ofstream file(folder / mark);
  file << "Made by splashdown study, which empties marked folders when their scene has changed.\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + (folder / mark).string());
}

/// The mark stays: a kill leaves a folder that still may be emptied.
void empty(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != mark) entries.push_back(entry.path());
  for (const auto& entry : entries) fs::remove_all(entry);
}

bool may_be_used(const StudyRun& run, const fs::path& folder) {
  return !is_there(folder) || is_own(folder) || begun_with(run, folder) || (is_folder(folder) && fs::is_empty(folder));
}

std::string refusal(const fs::path& folder) {
  return fmt::format(
      "{}: is there already, and no study made it. Rename the case, use another --out, or remove it yourself.",
      folder.string());
}

}  // namespace

std::string safe_component(const std::string& text) {
  std::string name = text;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') c = '_';
  if (name.size() > longest) name = fmt::format("{}-{:08x}", name.substr(0, longest - 9), digest(text));
  if (name.empty() || name.front() == '.' || name.front() == '-') name.insert(name.begin(), '_');
  if (std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); })) name += '_';
  return name;
}

std::vector<std::string> foreign_places(const std::vector<StudyRun>& runs, const fs::path& folder) {
  std::vector<std::string> messages;
  // Studies of earlier versions left no mark, but their table.
  const bool own = is_own(folder) || fs::exists(folder / "study.json");
  std::vector<std::string> files = {
      "statistics.csv", "convergence.csv", "probabilities.csv", "effects.csv",   "sobol_indices.csv", "envelope.csv",
      "study.csv",      "study.svg",       "study.png",         "study.gnuplot", "report.html",       "study.parallel",
      "study.joblog",   "parallel.log",    "study.sbatch",      "sbatch.log",    "collect.log",       "summary.json"};
  for (const auto& run : runs) files.push_back(run.name + ".log");
  for (const auto& name : files)
    if (!own && is_there(folder / name))
      messages.push_back(
          fmt::format("{}: is there already, and no study wrote it. Use another --out.", (folder / name).string()));
  for (const auto& run : runs)
    if (!may_be_used(run, folder / run.name)) messages.push_back(refusal(folder / run.name));
  return messages;
}

void make_study_folder(const fs::path& folder) {
  fs::create_directories(folder);
  if (!is_there(folder / mark)) set_mark(folder);
}

void prepare(const StudyRun& run, const fs::path& folder) {
  if (begun_with(run, folder)) return;
  if (!may_be_used(run, folder)) throw std::runtime_error(refusal(folder));
  fs::create_directories(folder);
  if (!is_own(folder)) set_mark(folder);
  empty(folder);
}

}  // namespace splashdown::apps
