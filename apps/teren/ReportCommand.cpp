// teren report [--quick] -o DIR: speed beside error, as tables, plots and one page.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/Quote.h"

#include "apps/files/OutputFile.h"
#include "apps/options/ViewOptions.h"
#include "apps/report/FrameTable.h"
#include "apps/report/Report.h"
#include "apps/teren/Command.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/MeasuredFlight.h"
#include "apps/teren/ProgressLine.h"

namespace teren {
namespace {

DefaultsInCode defaultsInCode() {
  return {.kernel = LayerDescription{}.blend,
          .preserveVariance = LayerDescription{}.preserveVariance,
          .pixelError = DetailSettings{}.pixelError,
          .distance = DetailSettings{}.distance,
          .flyingPixelError = kFlyingDetail.pixelError,
          .flyingDistance = kFlyingDetail.distance,
          .budget = 1e-3 * static_cast<double>(FlightPlan{}.budget.count())};
}

/// A folder for the report. What was made for it goes again unless it is kept, the folders above included.
class ReportFolder {
 public:
  explicit ReportFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;
  ~ReportFolder() {
    std::error_code problem;
    for (std::size_t k = kept_ ? 0 : made_.size(); k > 0; --k) {
      std::filesystem::remove(made_[k - 1], problem);  // only where it is empty
    }
  }

  Result<void> make() {
    if (folder_.native().find('\0') != std::string::npos || folder_.empty()) {
      return Error{"no folder " + inQuotes(folder_.string()) + " can be made"};
    }
    std::error_code problem;
    std::filesystem::path part;
    for (const std::filesystem::path& name : folder_) {
      part /= name;
      if (!std::filesystem::exists(part, problem) && !problem) made_.push_back(part);
    }
    std::filesystem::create_directories(folder_, problem);
    if (problem) {
      return Error{"no folder " + inQuotes(folder_.string()) + " can be made: " + problem.message()};
    }
    // What could not be written is known before the work, not after it.
    if (Result<OutputFile> page = OutputFile::create(folder_ / "index.html"); !page) return page.error();
    return {};
  }

  /// All of them or, but for a disk that fails while names are given, none.
  Result<void> keep(const std::vector<ReportFile>& files) {
    std::vector<OutputFile> outputs;
    for (const ReportFile& file : files) {
      Result<OutputFile> output = OutputFile::create(folder_ / file.name);
      if (!output) return output.error();
      outputs.push_back(*std::move(output));
      std::FILE* stream = outputs.back().stream();
      if (std::fwrite(file.bytes.data(), 1, file.bytes.size(), stream) != file.bytes.size() ||
          std::fflush(stream) != 0) {
        return Error{inQuotes((folder_ / file.name).string()) + " cannot be written"};
      }
    }
    for (OutputFile& output : outputs) {
      if (Result<void> committed = output.commit(); !committed) return committed;
      kept_ = true;
    }
    return {};
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  // from the uppermost down
  bool kept_ = false;
};

class ReportCommand final : public Command {
 public:
  explicit ReportCommand(CLI::App& parent)
      : Command(parent, "report", "measure speed beside error: tables, plots and one page") {
    const std::string doc = "fewer samples: a minute or two instead of up to five";
    quick_ = application().add_flag("--quick", doc)->disable_flag_override();
    frames_ = application()
                  .add_option("--frames", "FILE that teren-fly --stats wrote, for the page; repeat for more")
                  ->take_all()
                  ->allow_extra_args(false);
    output_ = application().add_option("-o", "DIR: write the report there");
  }

  ExitCode run() override {
    if (output_->count() == 0) return fail(kWrongInput, "-o DIR is missing: where to write the report");
    const Result<Table> frames = readFrames(frames_->results());
    if (!frames) return fail(kWrongInput, frames.error().message);
    ReportFolder folder(argument(*output_));
    if (const Result<void> made = folder.make(); !made) return fail(kWrongInput, made.error().message);
    const Effort effort = quick_->count() > 0 ? Effort::ofAMinute() : Effort::full();
    const Interruption interruption;
    const Result<MeasuredReport> report = measureShowingProgress(*frames, effort, interruption);
    if (!report) return fail(kWorkFailed, report.error().message);
    const std::vector<ReportFile> files = filesOf(*report, *frames, effort);
    if (interruption.came()) return fail(kWorkFailed, "interrupted");
    if (const Result<void> kept = folder.keep(files); !kept) return fail(kWorkFailed, kept.error().message);
    return kSuccess;
  }

 private:
  static Result<MeasuredReport> measureShowingProgress(const Table& frames, const Effort& effort,
                                                       const Interruption& interruption) {
    constexpr std::size_t kParts = 6;
    std::optional<ProgressLine> line;
    std::size_t part = 0;
    const auto begin = [&](const std::string& name) {
      line.emplace("parts, now " + name);
      ++part;
    };
    return measureReport(*PluginRegistry::standard(), defaultsInCode(), frames, effort, begin, [&] {
      if (line) line->show(part - 1, kParts);
      return !interruption.came();
    });
  }

  const CLI::Option* quick_;
  const CLI::Option* frames_;
  const CLI::Option* output_;
};

}  // namespace

std::unique_ptr<Command> makeReportCommand(CLI::App& parent) {
  return std::make_unique<ReportCommand>(parent);
}

}  // namespace teren
