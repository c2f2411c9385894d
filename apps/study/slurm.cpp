#include "apps/study/slurm.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "apps/files/csv.hpp"
#include "apps/process/child_process.hpp"
#include "apps/study/run.hpp"
#include "apps/text/plain_text.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

/// The number of the job that sbatch makes of these arguments.
std::string sbatch(std::vector<std::string> arguments, const fs::path& folder) {
  const auto log = folder / "sbatch.log";
  fs::remove(log);
  const auto program = find_program("sbatch");
  if (!program) throw std::runtime_error("there is no sbatch on this machine");
  arguments.insert(arguments.begin(), {program->string(), "--parsable"});
  const auto end = ChildProcess(arguments, log).wait();
  std::ifstream in(log);
  std::string said(std::istreambuf_iterator<char>(in), {});
  while (said.ends_with('\n')) said.pop_back();
  if (end.code != 0) throw std::runtime_error(fmt::format("sbatch refuses: {}", said));
  fs::remove(log);
  said.erase(0, said.rfind('\n') + 1);    // warnings may stand above
  return said.substr(0, said.find(';'));  // NUMBER;CLUSTER
}

}  // namespace

std::vector<std::string> slurm_scripts(const Study& study, const std::vector<StudyRun>& runs,
                                       const std::vector<Outcome>& outcomes, const fs::path& folder,
                                       const ArrayLimits& limits) {
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!outcomes[i].finished()) waiting.push_back(i);
  std::vector<std::string> scripts;
  for (std::size_t first = 0; first < waiting.size(); first += limits.longest) {
    const auto count = std::min(limits.longest, waiting.size() - first);
    std::string commands;
    for (std::size_t k = 0; k < count; ++k) {
      const auto& run = runs[waiting[first + k]];
      commands += fmt::format("  {}) exec {} ;;\n", k, shell_line(command_of(study, run, folder / run.name)));
    }
    scripts.push_back(
        fmt::format("#!/bin/bash\n"
                    "# Runs of {}: one task each. A task that is submitted again continues from its checkpoint.\n"
                    "#SBATCH --job-name=splashdown\n"
                    "#SBATCH --array=0-{}%{}\n"
                    "#SBATCH --ntasks=1 --cpus-per-task=1\n"
                    "#SBATCH --signal=B:TERM@60\n"
                    "#SBATCH --requeue\n"
                    "cd {} || exit 2\n"
                    "case $SLURM_ARRAY_TASK_ID in\n{}esac\n",
                    one_line(study.file.string()), count - 1, limits.at_a_time,
                    shell_quoted(fs::current_path().string()), commands));
  }
  return scripts;
}

std::size_t longest_array(const fs::path& folder) {
  constexpr std::size_t usual = 1001;  // slurm.conf(5)
  const auto program = find_program("scontrol");
  if (!program) return usual;
  const auto log = folder / "scontrol.log";
  fs::remove(log);
  ChildProcess({program->string(), "show", "config"}, log).wait();
  std::ifstream in(log);
  std::size_t longest = 0;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("MaxArraySize")) std::istringstream(line.substr(line.find('=') + 1)) >> longest;
  fs::remove(log);
  return longest > 0 ? longest : usual;
}

std::string submit(const Study& study, const std::vector<std::string>& scripts, const fs::path& folder) {
  std::vector<std::string> arrays;  // their numbers
  for (std::size_t k = 0; k < scripts.size(); ++k) {
    const auto part = scripts.size() == 1 ? std::string() : fmt::format("-{}", k + 1);
    const auto file = folder / fmt::format("study{}.sbatch", part);
    write_file_atomically(file, scripts[k]);
    std::vector<std::string> words{fmt::format("--output={}", (folder / fmt::format("task{}-%a.log", part)).string())};
    // One array after the other, or more tasks than --jobs would be at work.
    if (k > 0) words.push_back(fmt::format("--dependency=afterany:{}", arrays.back()));
    words.push_back(file.string());
    arrays.push_back(sbatch(words, folder));
  }
  const auto gather = shell_line({own_program().string(), "study", fs::absolute(study.file).string(), "--out",
                                  folder.string(), "--collect", "--quiet"});
  const auto last =
      sbatch({"--job-name=splashdown-collect", fmt::format("--dependency=afterany:{}", fmt::join(arrays, ":")),
              "--output=" + (folder / "collect.log").string(), "--wrap",
              "cd " + shell_quoted(fs::current_path().string()) + " && " + gather},
             folder);
  if (arrays.size() == 1) return fmt::format("job array {} is submitted, job {} gathers its results", arrays[0], last);
  return fmt::format("job arrays {} are submitted, one after the other; job {} gathers their results",
                     fmt::join(arrays, ", "), last);
}

}  // namespace splashdown::apps
