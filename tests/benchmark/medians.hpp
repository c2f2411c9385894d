// What the benchmarks share: medians over interleaved repetitions, of processor time on one thread or of wall time on
// several, and a bar that the nightly tests hold.
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

extern "C" void openblas_set_num_threads(int);

namespace splashdown::measured {

class Medians : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const auto& run : runs)
      if (run.aggregate_name == "median")
        seconds_[run.run_name.function_name] =
            run.run_name.time_type.empty() ? run.GetAdjustedCPUTime() : run.GetAdjustedRealTime();
  }
  double of(const std::string& name, int nodes) const {
    const auto found = seconds_.find(name + "/" + std::to_string(nodes));
    return found == seconds_.end() ? std::nan("") : found->second;
  }

 private:
  std::map<std::string, double> seconds_;  // in the benchmarks' unit
};

inline double take_max_ratio(int& argc, char** argv) {
  const std::string key = "--max_ratio=";
  double value = INFINITY;
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    if (std::string(argv[i]).starts_with(key))
      value = std::atof(argv[i] + key.size());
    else
      argv[kept++] = argv[i];
  }
  argc = kept;
  return value;
}

/// False: an argument is unknown. Takes --max_ratio=R out of them; without it nothing is held against a bar.
inline bool begin(int argc, char** argv, double& max_ratio) {
  openblas_set_num_threads(1);
  max_ratio = take_max_ratio(argc, argv);
  std::vector<char*> arguments(argv, argv + argc);
  static char interleave[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  return !benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

template <class Run>
benchmark::internal::Benchmark* add(const std::string& name, int nodes, Run run) {
  return benchmark::RegisterBenchmark((name + "/" + std::to_string(nodes)).c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->Repetitions(9)
      ->ReportAggregatesOnly();
}

}  // namespace splashdown::measured
