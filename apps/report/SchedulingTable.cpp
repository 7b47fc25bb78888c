#include "apps/report/SchedulingTable.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "teren/Engine.h"
#include "teren/PixelError.h"

#include "apps/report/Statistics.h"
#include "apps/report/Stopwatch.h"
#include "apps/report/Walker.h"

namespace teren {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kUpdatesPerSecond = 60.0;
constexpr double kSpeed = 300.0, kClearance = 100.0;  // [m/s], [m]
constexpr std::int64_t kMostFillUpdates = 60'000;
constexpr std::int64_t kFirstUpdates = 60;  // of a flight, which nobody looks at: it begins all at once
constexpr double kReachedMargin = 1.05;     // an eye goes some metres until all is chosen anew

/// An engine with one walker, moved on update by update.
class Run {
 public:
  Run(std::unique_ptr<Engine> engine, double ground, double budget)
      : engine_(std::move(engine)),
        budget_(std::chrono::duration_cast<std::chrono::nanoseconds>(
            std::chrono::duration<double, std::milli>(budget))),
        walker_(
            static_cast<Walker*>(&engine_->add(std::make_unique<Walker>(Position{}, ground, kClearance)))) {}

  /// Until all of the view is there.
  Result<void> fill(const GoOn& goOn) {
    do {
      if (!goOn()) return Error{"interrupted"};
      update();
    } while ((updates_ < 3 || engine_->figures().pending > 0) && updates_ < kMostFillUpdates);
    fillUpdates_ = updates_;
    for (const double time : times_) fillWork_ += 1e-6 * time;
    nodes_ = engine_->figures().nodes;
    return {};
  }

  Result<void> fly(double seconds, const GoOn& goOn) {
    walker_->setSpeed(kSpeed);
    times_.clear();
    const EngineFigures before = engine_->figures();
    const std::int64_t updates = std::llround(seconds * kUpdatesPerSecond);
    for (std::int64_t k = 0; k < updates; ++k) {
      if (!goOn()) return Error{"interrupted"};
      update();
      if (k < kFirstUpdates) continue;
      if (!engine_->finestHeight(walker_->motion().position)) ++missing_;
      look();
    }
    slices_ = engine_->figures().slices - before.slices;
    late_ = engine_->figures().lateSlices - before.lateSlices;
    return {};
  }

  std::vector<Cell> row() const;

 private:
  /// As many updates as there would be in a paced flight: workers get what is left of 1/60 s.
  void update() {
    const Clock::time_point next = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                      std::chrono::duration<double>(1.0 / kUpdatesPerSecond));
    times_.push_back(1e6 * processorSecondsOf([&] { engine_->update(1.0 / kUpdatesPerSecond, budget_); }));
    ++updates_;
    while (engine_->options().workers > 0 && engine_->figures().unfinishedTasks > 0 && Clock::now() < next) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  void look() {
    const DetailSettings& detail = *engine_->options().view.detail;
    const Motion motion = walker_->motion();
    const Eye eye{motion.position, motion.height, lensPixels(detail.lines, detail.fieldOfView)};
    errors_.push_back(pixelError(engine_->world(), *engine_->scene(), eye).max);
  }

  std::unique_ptr<Engine> engine_;
  std::chrono::nanoseconds budget_;
  Walker* walker_;              // the engine's
  std::vector<double> times_;   // [us] of updates
  std::vector<double> errors_;  // [px] largest promised, of looks
  std::int64_t updates_ = 0, fillUpdates_ = 0, missing_ = 0;
  std::size_t nodes_ = 0;  // when the view was filled
  double fillWork_ = 0.0;  // [s] of processor time
  std::uint64_t slices_ = 0, late_ = 0;
};

std::vector<Cell> Run::row() const {
  const double wanted = engine_->options().view.detail->pixelError;
  const auto reached = std::count_if(errors_.begin(), errors_.end(),
                                     [wanted](double error) { return error <= wanted * kReachedMargin; });
  const Summary time = summaryOf(times_), error = summaryOf(errors_);
  const double fillSeconds = static_cast<double>(fillUpdates_) / kUpdatesPerSecond;
  return {
      static_cast<double>(engine_->options().workers),
      1e-6 * static_cast<double>(budget_.count()),
      static_cast<double>(nodes_) / fillSeconds,
      fillSeconds,
      fillWork_,
      time.median,
      time.p99,
      time.max,
      time.spread,
      static_cast<double>(late_),
      slices_ == 0 ? 0.0 : 100.0 * static_cast<double>(late_) / static_cast<double>(slices_),
      static_cast<double>(missing_),
      error.median,
      error.p99,
      100.0 * static_cast<double>(reached) / static_cast<double>(std::max<std::size_t>(1, errors_.size())),
      static_cast<double>(errors_.size()),
      static_cast<double>(times_.size())};
}

std::vector<Column> columns(const Effort& effort) {
  return {
      {"workers", "", "EngineOptions::workers"},
      {"budget", "ms", "of each update, by the wall's clock: what others do on the machine counts"},
      {"nodes a second", "1/s", "nodes of the view over the time to fill it: what 60 updates get done"},
      {"time to fill", "s", "updates until all of the view is there, at 60 a second"},
      {"work to fill", "s", "processor time of those updates, without the workers'"},
      {"update median", "us", "processor time of an update in flight at 300 m/s, on its own thread"},
      {"update p99", "us", "the same"},
      {"update max", "us", "the same"},
      {"update spread", "", "interquartile range over median of the same"},
      {"late slices", "", "that ended beyond the budget by the wall's clock, in flight"},
      {"late share", "%", "of all slices"},
      {"missing", "", "updates, after the first second of flight, without level-0 ground under the eye"},
      {"error median", "px",
       "largest pixel error promised of the scene, " + rounded(effort.schedulingPixelError, 3) +
           " px wanted, in flight"},
      {"error p99", "px", "the same"},
      {"error reached", "%",
       "looks, one after each update but those of the first second, at which all of the scene had the error "
       "wanted or 5 % more"},
      {"looks", "", "that the errors are taken at"},
      {"updates", "", "in flight"}};
}

}  // namespace

Result<Table> measureScheduling(const std::shared_ptr<const World>& world, std::span<const double> budgets,
                                const Effort& effort, const GoOn& goOn) {
  Table table("scheduling", "Scheduling",
              "A view of " + rounded(effort.schedulingDistance, 6) + " m at " +
                  rounded(effort.schedulingPixelError, 3) +
                  " px, filled from nothing and then flown over at 300 m/s for " +
                  rounded(effort.schedulingSeconds, 3) + " s, for each budget and number of workers.",
              columns(effort));
  const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const double ground = world->query({}).drawn;
  for (int workers = 0; workers <= std::min(effort.mostWorkers, processors); ++workers) {
    for (const double budget : budgets) {
      if (!goOn()) return Error{"interrupted"};
      DetailSettings detail;
      detail.pixelError = effort.schedulingPixelError;
      detail.distance = effort.schedulingDistance;
      EngineOptions options;
      options.view.detail = detail;
      options.workers = workers;
      Result<std::unique_ptr<Engine>> engine = Engine::create(world, options);
      if (!engine) return engine.error();
      Run run(*std::move(engine), ground, budget);
      if (const Result<void> filled = run.fill(goOn); !filled) return filled.error();
      if (const Result<void> flown = run.fly(effort.schedulingSeconds, goOn); !flown) return flown.error();
      table.add(run.row());
    }
  }
  return table;
}

std::vector<Plot> plotsOfScheduling(const Table& table) {
  Plot nodes{"scheduling-nodes",
             "Nodes a second by budget",
             "budget of an update [ms]",
             "nodes a second",
             true,
             true};
  Plot error{"scheduling-error",
             "Error in flight at 300 m/s",
             "budget of an update [ms]",
             "largest error promised, p99 [px]",
             true,
             true};
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const std::string count = table.text(row, "workers"),
                      name = count + (count == "1" ? " worker" : " workers");
    if (nodes.curves.empty() || nodes.curves.back().title != name) {
      nodes.curves.push_back({name, {}});
      error.curves.push_back({name, {}});
    }
    const double budget = table.number(row, "budget");
    nodes.curves.back().points.emplace_back(budget, table.number(row, "nodes a second"));
    error.curves.back().points.emplace_back(budget, table.number(row, "error p99"));
  }
  return {nodes, error};
}

}  // namespace teren
