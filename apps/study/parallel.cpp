#include "apps/study/parallel.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "apps/files/csv.hpp"
#include "apps/process/child_process.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/study/run.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {

namespace fs = std::filesystem;

std::string parallel_commands(const Study& study, const std::vector<StudyRun>& runs,
                              const std::vector<Outcome>& outcomes, const fs::path& folder) {
  std::string lines;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!outcomes[i].finished())
      lines += "cd " + shell_quoted(fs::current_path().string()) + " && " +
               shell_line(command_of(study, runs[i], folder / runs[i].name)) + "\n";
  return lines;
}

void run_in_parallel(const std::string& commands, const fs::path& folder, int jobs) {
  const auto program = find_program("parallel");
  if (!program) throw std::runtime_error("there is no GNU Parallel on this machine");
  const auto list = folder / "study.parallel";
  write_file_atomically(list, commands);
  // --termseq: one SIGTERM, at which a run saves its checkpoint, and a minute for that.
  ChildProcess process(
      {program->string(), "--will-cite", "--jobs", std::to_string(jobs), "--joblog", (folder / "study.joblog").string(),
       "--termseq", "TERM,60000,KILL,25", "--arg-file", list.string()},
      folder / "parallel.log");
  bool asked = false;
  while (!process.end()) {
    if (interrupt_received() && !asked) {
      asked = true;
      process.ask_to_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      process.ask_to_stop();  // the first one lets its jobs end, the second one stops them
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace splashdown::apps
