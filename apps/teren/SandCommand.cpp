// teren sand: the published experiments with sand, without a window.
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/files/OutputFile.h"
#include "apps/report/Gnuplot.h"
#include "apps/teren/Command.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/ProgressLine.h"
#include "apps/teren/SandExperiment.h"
#include "apps/teren/SandPlots.h"

namespace teren {
namespace {

constexpr int kMostLines = 64;

class SandCommand final : public Command {
 public:
  explicit SandCommand(CLI::App& parent)
      : Command(parent, "sand", "dig a groove along the diagonal of sand on a triangulation, and time it") {
    vertices_ = several("--vertices", "of the mesh, 4 to 4000000; repeat for more [1000 10000 100000]");
    trace_ = several("--trace", "percent of the diagonal, 5 to 100; repeat for more [80]");
    radius_ = add("--radius", "of the tool, 0.005 to 0.2 m [0.04]");
    depth_ = add("--depth", "of the tool, 0.001 to 1 m [0.1]");
    points_ = add("--points", "of the tool's outline, 3 to 256 [12]");
    repose_ = add("--repose", "angle at which sand lies, 1 to 60 degrees [30]");
    steps_ = add("--steps", "of slides after each stamp, 0 to 1000000000 [20000]");
    const std::string doc = "leave out the regular grid";
    noGrid_ = application().add_flag("--no-grid", doc)->disable_flag_override();
    output_ = add("-o", "FILE: write the table there, comma-separated");
    plots_ = add("--plots", "FOLDER: draw time and memory there with gnuplot; of two or more grooves");
  }

  ExitCode run() override {
    const Result<std::vector<SandExperiment>> experiments = read();
    if (!experiments) return fail(kWrongInput, experiments.error().message);
    if (plots_->count() > 0) {
      if (const Result<void> ready = prepareToPlot(*experiments); !ready) {
        return fail(kWrongInput, ready.error().message);
      }
    }
    std::optional<OutputFile> file;
    if (output_->count() > 0) {
      Result<OutputFile> created = OutputFile::create(argument(*output_));
      if (!created) return fail(kWrongInput, created.error().message);
      file.emplace(*std::move(created));
    }
    const Interruption interruption;
    const Result<std::vector<SandRun>> runs = runAll(*experiments, interruption);
    if (!runs) return fail(kWorkFailed, runs.error().message);
    if (const Result<void> kept = write(sandTable(*runs), file); !kept) {
      return fail(kWorkFailed, kept.error().message);
    }
    if (plots_->count() == 0) return kSuccess;
    const Result<void> drawn = plotSand(argument(*plots_), *runs);
    if (drawn) return kSuccess;
    return fail(kWorkFailed, interruption.came() ? "interrupted" : drawn.error().message);
  }

 private:
  static Result<std::vector<SandRun>> runAll(const std::vector<SandExperiment>& experiments,
                                             const Interruption& interruption) {
    ProgressLine progress("grooves");
    std::vector<SandRun> runs;
    for (const SandExperiment& experiment : experiments) {
      progress.show(runs.size(), experiments.size());
      const Result<SandResult> result = runSandExperiment(experiment, [&] { return interruption.came(); });
      if (!result) return result.error();
      runs.push_back({experiment, *result});
    }
    return runs;
  }

  /// What would be known too late after the experiments.
  Result<void> prepareToPlot(const std::vector<SandExperiment>& experiments) const {
    if (experiments.size() < 2) {
      return Error{"--plots needs two or more --vertices or --trace to draw a line"};
    }
    const std::filesystem::path folder = argument(*plots_);
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
      return Error{"no folder " + inQuotes(folder.string()) + " can be made: " + problem.message()};
    }
    return findGnuplot();
  }

  Result<void> write(const std::string& table, std::optional<OutputFile>& file) const {
    if (!file) {
      std::cout << table;
      return {};
    }
    if (std::fwrite(table.data(), 1, table.size(), file->stream()) != table.size()) {
      return Error{inQuotes(argument(*output_)) + " cannot be written"};
    }
    return file->commit();
  }

  const CLI::Option* add(const std::string& name, const std::string& doc) {
    return application().add_option(name, doc);
  }
  const CLI::Option* several(const std::string& name, const std::string& doc) {
    return application().add_option(name, doc)->take_all()->allow_extra_args(false);
  }

  /// The value given for an option, or nothing where it was not given.
  static Result<void> number(const CLI::Option& option, double min, double max, double& value) {
    if (option.count() == 0) return {};
    const Result<double> read = numberArgument(option.get_name(), argument(option), min, max);
    if (!read) return read.error();
    value = *read;
    return {};
  }
  template <class Whole>
  static Result<void> whole(const CLI::Option& option, std::int64_t min, std::int64_t max, Whole& value) {
    if (option.count() == 0) return {};
    const Result<std::int64_t> read = wholeArgument(option.get_name(), argument(option), min, max);
    if (!read) return read.error();
    value = static_cast<Whole>(*read);
    return {};
  }

  /// What all experiments have in common.
  Result<SandExperiment> readTool() const {
    SandExperiment experiment;
    experiment.grid = noGrid_->count() == 0;
    for (const Result<void>& read :
         {number(*radius_, 0.005, 0.2, experiment.radius), number(*depth_, 0.001, 1.0, experiment.depth),
          number(*repose_, 1.0, 60.0, experiment.repose), whole(*points_, 3, 256, experiment.points),
          whole(*steps_, 0, 1'000'000'000, experiment.steps)}) {
      if (!read) return read.error();
    }
    return experiment;
  }

  Result<std::vector<SandExperiment>> read() const {
    const Result<SandExperiment> tool = readTool();
    if (!tool) return tool.error();
    std::vector<std::string> counts = vertices_->results(), traces = trace_->results();
    if (counts.empty()) counts = {"1000", "10000", "100000"};
    if (traces.empty()) traces = {"80"};
    if (counts.size() * traces.size() > kMostLines) {
      return Error{"--vertices and --trace make " + std::to_string(counts.size() * traces.size()) +
                   " grooves, expected at most " + std::to_string(kMostLines)};
    }
    std::vector<SandExperiment> experiments;
    for (const std::string& count : counts) {
      const Result<std::int64_t> vertices = wholeArgument("--vertices", count, 4, 4'000'000);
      if (!vertices) return vertices.error();
      for (const std::string& text : traces) {
        const Result<double> trace = numberArgument("--trace", text, 5.0, 100.0);
        if (!trace) return trace.error();
        experiments.push_back(*tool);
        experiments.back().vertices = static_cast<int>(*vertices);
        experiments.back().trace = *trace;
      }
    }
    return experiments;
  }

  const CLI::Option* vertices_;
  const CLI::Option* trace_;
  const CLI::Option* radius_;
  const CLI::Option* depth_;
  const CLI::Option* points_;
  const CLI::Option* repose_;
  const CLI::Option* steps_;
  const CLI::Option* noGrid_;
  const CLI::Option* output_;
  const CLI::Option* plots_;
};

}  // namespace

std::unique_ptr<Command> makeSandCommand(CLI::App& parent) {
  return std::make_unique<SandCommand>(parent);
}

}  // namespace teren
