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
#include "apps/teren/Command.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/ProgressLine.h"
#include "apps/teren/SandExperiment.h"

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
  }

  ExitCode run() override {
    const Result<std::vector<SandExperiment>> experiments = read();
    if (!experiments) return fail(kWrongInput, experiments.error().message);
    std::optional<OutputFile> file;
    if (output_->count() > 0) {
      Result<OutputFile> created = OutputFile::create(argument(*output_));
      if (!created) return fail(kWrongInput, created.error().message);
      file.emplace(*std::move(created));
    }
    const Interruption interruption;
    ProgressLine progress("grooves");
    std::string table = sandTableHead() + "\n";
    for (std::size_t n = 0; n < experiments->size(); ++n) {
      progress.show(n, experiments->size());
      const SandExperiment& experiment = experiments.value()[n];
      const Result<SandResult> result = runSandExperiment(experiment, [&] { return interruption.came(); });
      if (!result) return fail(kWorkFailed, result.error().message);
      table += sandTableLine(experiment, *result) + "\n";
    }
    if (!file) {
      std::cout << table;
      return kSuccess;
    }
    if (std::fwrite(table.data(), 1, table.size(), file->stream()) != table.size()) {
      return fail(kWorkFailed, inQuotes(argument(*output_)) + " cannot be written");
    }
    const Result<void> kept = file->commit();
    return kept ? kSuccess : fail(kWorkFailed, kept.error().message);
  }

 private:
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
};

}  // namespace

std::unique_ptr<Command> makeSandCommand(CLI::App& parent) {
  return std::make_unique<SandCommand>(parent);
}

}  // namespace teren
