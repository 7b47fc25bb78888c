// How Teren's benchmarks repeat, and what they conclude: ratios of medians.
#pragma once

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace teren {

/// Reads the command line: 15 repetitions, interleaved at random, unless it says otherwise. False where it is
/// wrong.
inline bool initializeRepeated(int argc, char** argv) {
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repeat = "--benchmark_repetitions=15";
  std::string brief = "--benchmark_report_aggregates_only=true";
  std::vector<char*> arguments{argv[0], interleave.data(), repeat.data(), brief.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);  // the last of two equal options wins
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  return !benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

/// Prints as usual and keeps the medians.
class MedianReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name != "median") continue;
      const std::string& arguments = run.run_name.args;
      medians_[run.run_name.function_name + (arguments.empty() ? "" : "/" + arguments)] =
          run.GetAdjustedCPUTime();
    }
  }

  /// `arguments`: of both, as "/257".
  void printRatio(const char* slow, const char* fast, double wanted, const char* arguments = "") const {
    const auto rival = medians_.find(std::string(slow) + arguments);
    const auto own = medians_.find(std::string(fast) + arguments);
    if (rival == medians_.end() || own == medians_.end()) return;
    std::printf("%s / %s%s = %.1f", slow, fast, arguments, rival->second / own->second);
    if (wanted > 0.0) std::printf(" (wanted: at least %.0f)", wanted);
    std::printf("\n");
  }

  /// In the unit of the benchmark; 0 where it did not run.
  double median(const std::string& name) const { return medians_.contains(name) ? medians_.at(name) : 0.0; }

 private:
  std::map<std::string, double> medians_;
};

}  // namespace teren
