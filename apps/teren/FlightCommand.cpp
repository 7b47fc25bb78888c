// teren flight WORLD [--speed M_PER_S] [--seconds S] ...: flies without a window and tells what it cost.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/options/EditOptions.h"
#include "apps/options/LargeBlocks.h"
#include "apps/options/ViewOptions.h"
#include "apps/options/WorldOptions.h"
#include "apps/teren/Command.h"
#include "apps/teren/EditedWorld.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/JsonOutput.h"
#include "apps/teren/MeasuredFlight.h"
#include "apps/teren/ProgressLine.h"

namespace teren {
namespace {

constexpr double kFastest = 1e5;       // [m/s]
constexpr double kLongest = 86'400.0;  // [s]
constexpr std::int64_t kMostObjects = 1000;
constexpr std::int64_t kLongestBudget = 1'000'000;                                          // [us]
constexpr std::int64_t kLeastCap = EngineOptions::kLeastCap >> 20U, kLargestCap = 1 << 20;  // [MiB]

Result<double> number(const CLI::Option& option, double otherwise, double min, double max) {
  if (option.count() == 0) return otherwise;
  return numberArgument(option.get_name(), argument(option), min, max);
}

Result<std::int64_t> whole(const CLI::Option& option, std::int64_t otherwise, std::int64_t min,
                           std::int64_t max) {
  if (option.count() == 0) return otherwise;
  return wholeArgument(option.get_name(), argument(option), min, max);
}

double rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

OrderedJson asJson(const Percentiles& percentiles) {
  return {{"p50", rounded(percentiles.p50)},
          {"p99", rounded(percentiles.p99)},
          {"p999", rounded(percentiles.p999)},
          {"max", rounded(percentiles.max)}};
}

OrderedJson asJson(const FlownPixelError& error) {
  OrderedJson answer = {{"wanted", error.wanted}, {"frames", error.frames}, {"reached", error.reached}};
  answer["seen"] = asJson(error.seen);
  return answer;
}

OrderedJson asJson(const HeldMemory& held) {
  return {{"seconds", held.seconds},     {"rss_bytes", held.resident}, {"engine_bytes", held.engine},
          {"query_bytes", held.queries}, {"used_bytes", held.used},    {"unused_bytes", held.unused}};
}

OrderedJson asJson(const FlightResult& result) {
  OrderedJson answer = {{"updates", result.updates},
                        {"cpu_us", asJson(result.cpu)},
                        {"wall_us", asJson(result.wall)},
                        {"spinner_us", asJson(result.spinner)},
                        {"spinner_cpu_us", asJson(result.spinnerCpu)},
                        {"late_slices", result.engine.lateSlices},
                        {"missing", result.missing},
                        {"nodes", result.engine.nodes},
                        {"peak_bytes", result.engine.peakBytes},
                        {"rss_bytes", result.residentBytes},
                        {"hash", hashDigits(result.hash)}};
  if (result.pixelError) answer["pixel_error"] = asJson(*result.pixelError);
  if (result.residentAt60Seconds) answer["rss_bytes_at_60_s"] = *result.residentAt60Seconds;
  for (const HeldMemory& held : result.memory) answer["memory"].push_back(asJson(held));
  if (result.hashAt30Seconds) answer["hash_at_30_s"] = hashDigits(*result.hashAt30Seconds);
  return answer;
}

std::string microseconds(const char* name, const Percentiles& percentiles) {
  const auto rounded = [](double value) { return numberText(std::round(value * 10.0) / 10.0); };
  return std::string(name) + ": p50 " + rounded(percentiles.p50) + ", p99 " + rounded(percentiles.p99) +
         ", p99.9 " + rounded(percentiles.p999) + ", max " + rounded(percentiles.max) + " us\n";
}

std::string mebibytes(std::size_t bytes) {
  return numberText(std::round(static_cast<double>(bytes) / 0x1p20 * 10.0) / 10.0) + " MiB";
}

std::string asText(const FlownPixelError& error) {
  return "pixel error of at most " + numberText(error.wanted) + " in " + std::to_string(error.reached) +
         " of " + std::to_string(error.frames) + " frames after the first ten seconds: p50 " +
         numberText(rounded(error.seen.p50)) + ", p99 " + numberText(rounded(error.seen.p99)) + ", max " +
         numberText(rounded(error.seen.max)) + "\n";
}

std::string asText(const HeldMemory& held) {
  return "after " + std::to_string(held.seconds) + " s: " + mebibytes(held.engine) + " held by the engine, " +
         mebibytes(held.resident) + " by the program, " + mebibytes(held.used) + " of them allocated, " +
         mebibytes(held.unused) + " kept by the allocator\n";
}

std::string asText(const FlightResult& result) {
  std::string more;
  if (result.pixelError) more += asText(*result.pixelError);
  for (const HeldMemory& held : result.memory) more += asText(held);
  return std::to_string(result.updates) + " updates, " + std::to_string(result.missing) +
         " of them without finest ground under an object, " + std::to_string(result.engine.lateSlices) +
         " late slices\n" + microseconds("CPU time of an update", result.cpu) +
         microseconds("wall time of an update", result.wall) +
         microseconds("wall time of an empty loop", result.spinner) + std::to_string(result.engine.nodes) +
         " nodes, at most " + mebibytes(result.engine.peakBytes) + " held by the engine, " +
         mebibytes(result.residentBytes) + " by the program, hash " + hashDigits(result.hash) + "\n" + more;
}

class FlightCommand final : public Command {
 public:
  explicit FlightCommand(CLI::App& parent)
      : Command(parent, "flight", "fly without a window; tell what the updates cost and what was missing"),
        world_(application()),
        speed_(add("--speed", "M_PER_S", "metres per second over ground [100]")),
        seconds_(add("--seconds", "S", "how long, in steps of 1/60 s [30]")),
        objects_(add("--objects", "K", "how many fly, 250 m apart; the first carries the view [1]")),
        start_(add("--start", "X Y", "where the first begins, metres east and north [0 0]")->expected(2)),
        path_(add("--path", "PATH", "straight (north) or turns [straight]")),
        viewDistance_(addViewDistance(application(), "metres of land to keep in every direction [2560]")),
        pixelError_(addPixelError(application())),
        workers_(add("--workers", "N", "threads that make the landscape; 0: the update itself does [0]")),
        budget_(add("--budget-us", "N", "microseconds an update may take [2000]")),
        cap_(add("--cap-mib", "N", "most MiB the engine may hold [512]")),
        edits_(application(), "that the land is flown with [none]"),
        fast_(addFlag("--fast", "one update after the other instead of 60 a second")),
        json_(addJson()) {}

  ExitCode run() override {
    keepLargeBlocksApart();
    Result<FlightPlan> plan = readPlan();
    if (!plan) return fail(kWrongInput, plan.error().message);
    const Result<std::shared_ptr<const World>> world = world_.create(*PluginRegistry::standard());
    if (!world) return fail(kWrongInput, world.error().message);
    if (const Result<void> placed = placeIn(**world, *plan); !placed) {
      return fail(kWrongInput, placed.error().message);
    }
    const Interruption interruption;
    Result<std::unique_ptr<EditedGround>> edits =
        groundOfOptions(edits_, *world, PluginRegistry::standard(), interruption);
    if (interruption.came()) return fail(kWorkFailed, "interrupted before the first update");
    if (!edits) return fail(kWrongInput, edits.error().message);
    const Result<std::unique_ptr<MeasuredFlight>> flight =
        MeasuredFlight::create(*world, *plan, std::move(*edits));
    if (!flight) return fail(kWrongInput, flight.error().message);
    return carryOut(**flight, *plan, **world, interruption);
  }

 private:
  CLI::Option* add(const std::string& name, const std::string& value, const std::string& doc) {
    return application().add_option(name, doc)->type_name(value);
  }

  const CLI::Option* addFlag(const std::string& name, const std::string& doc) {
    return application().add_flag(name, doc)->disable_flag_override();
  }

  /// What can be checked without the world.
  Result<FlightPlan> readPlan() const {
    FlightPlan plan;
    const Result<double> speed = number(*speed_, plan.speed, 0.0, kFastest);
    if (!speed) return speed.error();
    const Result<double> seconds = number(*seconds_, 30.0, 1.0 / kUpdatesPerSecond, kLongest);
    if (!seconds) return seconds.error();
    const Result<std::int64_t> objects = whole(*objects_, plan.objects, 1, kMostObjects);
    if (!objects) return objects.error();
    const Result<std::int64_t> workers = whole(*workers_, 0, 0, EngineOptions::kMostWorkers);
    if (!workers) return workers.error();
    const Result<std::int64_t> budget = whole(*budget_, plan.budget.count(), 1, kLongestBudget);
    if (!budget) return budget.error();
    const Result<std::int64_t> cap = whole(*cap_, 512, kLeastCap, kLargestCap);
    if (!cap) return cap.error();
    const Result<FlightPath> path = readPath();
    if (!path) return path.error();
    plan.speed = *speed;
    plan.updates = std::llround(*seconds * kUpdatesPerSecond);
    plan.objects = static_cast<int>(*objects);
    plan.engine.workers = static_cast<int>(*workers);
    plan.engine.capBytes = static_cast<std::size_t>(*cap) << 20U;
    plan.budget = std::chrono::microseconds(*budget);
    plan.path = *path;
    plan.paced = fast_->count() == 0;
    return plan;
  }

  Result<FlightPath> readPath() const {
    const std::string text = argument(*path_);
    if (path_->count() == 0 || text == "straight") return FlightPath::straight;
    if (text == "turns") return FlightPath::turns;
    return Error{"--path is " + inQuotes(text) + " but must be straight or turns"};
  }

  /// The rest.
  Result<void> placeIn(const World& world, FlightPlan& plan) const {
    std::array<double, 2> start{};
    for (std::size_t k = 0; k < 2 && start_->count() > 0; ++k) {
      const Result<double> metres = parseNumber(start_->results().at(k));
      if (!metres) return Error{std::string(k == 0 ? "X" : "Y") + " of --start: " + metres.error().message};
      start[k] = *metres;
    }
    const Result<Position> position = Position::fromMetres(start[0], start[1], world.pitch());
    if (!position) return Error{"--start: " + position.error().message};
    plan.start = *position;
    const ViewSettings usual{std::min(kFlyingView.level, world.topLevel()), kFlyingView.radius};
    const Result<ViewSettings> view = pixelError_->count() > 0 ? viewWithin(*pixelError_, *viewDistance_)
                                                               : viewReaching(*viewDistance_, usual, world);
    if (!view) return view.error();
    plan.engine.view = *view;
    return {};
  }

  ExitCode carryOut(MeasuredFlight& flight, const FlightPlan& plan, const World& world,
                    const Interruption& interruption) {
    const FlightResult result = flyShowingProgress(flight, interruption);
    if (json_->count() > 0) {
      printJson(asJson(result));
    } else {
      std::cout << asText(result);
    }
    complainAbout(world);
    if (result.updates == plan.updates) return kSuccess;
    return fail(kWorkFailed, "interrupted after " + std::to_string(result.updates) + " of " +
                                 std::to_string(plan.updates) + " updates, which is what the figures are of");
  }

  static FlightResult flyShowingProgress(MeasuredFlight& flight, const Interruption& interruption) {
    ProgressLine line("seconds");
    return flight.fly([&](std::int64_t done, std::int64_t updates) {
      line.show(static_cast<std::size_t>(done / kUpdatesPerSecond),
                static_cast<std::size_t>(updates / kUpdatesPerSecond));
      return !interruption.came();
    });
  }

  WorldOptions world_;
  const CLI::Option* speed_;
  const CLI::Option* seconds_;
  const CLI::Option* objects_;
  const CLI::Option* start_;
  const CLI::Option* path_;
  const CLI::Option* viewDistance_;
  const CLI::Option* pixelError_;
  const CLI::Option* workers_;
  const CLI::Option* budget_;
  const CLI::Option* cap_;
  EditOptions edits_;
  const CLI::Option* fast_;
  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makeFlightCommand(CLI::App& parent) {
  return std::make_unique<FlightCommand>(parent);
}

}  // namespace teren
