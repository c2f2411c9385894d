#include "apps/study_slurm.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/child_process.hpp"
#include "apps/csv.hpp"
#include "apps/plain_text.hpp"
#include "apps/study_run.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

/// A word that the shell takes as it is.
std::string quoted(const std::string& word) {
  std::string result(1, '\'');
  for (const char c : word) {
    if (c == '\'')
      result += "'\\''";
    else
      result += c;
  }
  return result + '\'';
}

std::string line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += quoted(word) + ' ';
  if (!line.empty()) line.pop_back();
  return line;
}

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

std::string slurm_script(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                         const fs::path& folder, int jobs) {
  std::string commands;
  std::size_t count = 0;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!outcomes[i].finished())
      commands +=
          fmt::format("  {}) exec {} ;;\n", count++, line_of(command_of(study, runs[i], folder / runs[i].name)));
  return fmt::format(
      "#!/bin/bash\n"
      "# Runs of {}: one task each. A task that is submitted again continues from its checkpoint.\n"
      "#SBATCH --job-name=splashdown\n"
      "#SBATCH --array=0-{}%{}\n"
      "#SBATCH --ntasks=1 --cpus-per-task=1\n"
      "#SBATCH --signal=B:TERM@60\n"
      "#SBATCH --requeue\n"
      "cd {} || exit 2\n"
      "case $SLURM_ARRAY_TASK_ID in\n{}esac\n",
      one_line(study.file.string()), count - 1, jobs, quoted(fs::current_path().string()), commands);
}

std::string submit(const Study& study, const std::string& script, const fs::path& folder) {
  const auto file = folder / "study.sbatch";
  write_file_atomically(file, script);
  const auto array = sbatch({"--output=" + (folder / "task-%a.log").string(), file.string()}, folder);
  const auto gather = line_of({own_program().string(), "study", fs::absolute(study.file).string(), "--out",
                               folder.string(), "--collect", "--quiet"});
  const auto last = sbatch({"--job-name=splashdown-collect", "--dependency=afterany:" + array,
                            "--output=" + (folder / "collect.log").string(), "--wrap",
                            "cd " + quoted(fs::current_path().string()) + " && " + gather},
                           folder);
  return fmt::format("job array {} is submitted, job {} gathers its results", array, last);
}

}  // namespace splashdown::apps
