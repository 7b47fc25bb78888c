#include "apps/report/DetailTable.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "teren/Engine.h"
#include "teren/PixelError.h"

#include "apps/report/GroundSample.h"
#include "apps/report/Statistics.h"
#include "apps/report/Stopwatch.h"
#include "apps/report/Walker.h"

namespace teren {
namespace {

using namespace std::chrono_literals;

constexpr Position kPlace{.i = 0, .j = 0, .u = 0.5, .v = 0.5};
constexpr double kClearance = 100.0;  // [m]
constexpr double kSame = 1.0 + 1e-6;

Result<std::unique_ptr<Engine>> engineOf(const std::shared_ptr<const World>& world, double pixelError,
                                         double distance, std::size_t cap) {
  DetailSettings detail;
  detail.pixelError = pixelError;
  detail.distance = distance;
  EngineOptions options;
  options.view.detail = detail;
  options.capBytes = cap;
  Result<std::unique_ptr<Engine>> engine = Engine::create(world, options);
  if (engine) (*engine)->add(std::make_unique<Walker>(kPlace, world->query(kPlace).drawn, kClearance));
  return engine;
}

/// A view that is there, and what it has cost.
struct FilledView {
  std::unique_ptr<Engine> engine;
  double distance = 0.0;  // [m]
  double seconds = 0.0;   // of processor time until it was there
};

/// Nothing where the cap does not hold the view.
Result<std::optional<FilledView>> fill(const std::shared_ptr<const World>& world, double pixelError,
                                       double distance, std::size_t cap, const GoOn& goOn) {
  Result<std::unique_ptr<Engine>> engine = engineOf(world, pixelError, distance, cap);
  if (!engine) return std::optional<FilledView>();  // not even the coarsest land fits
  FilledView view{*std::move(engine), distance, 0.0};
  bool goesOn = true;
  const auto holds = [&] { return view.engine->figures().pixelError <= kSame * pixelError; };
  view.seconds = processorSecondsOf([&] {
    // What is aimed at is known once all has been chosen, long before it is there.
    for (int update = 0; update < 20 && holds(); ++update) view.engine->update(0.0, 1ms);
    if (!holds()) return;
    view.engine->settle([&](std::size_t, std::size_t) { return (goesOn = goOn()) && holds(); });
  });
  if (!goesOn) return Error{"interrupted"};
  if (!holds()) return std::optional<FilledView>();
  return std::optional<FilledView>(std::move(view));
}

Result<FilledView> fillFarthest(const std::shared_ptr<const World>& world, double pixelError,
                                const Effort& effort, const GoOn& goOn) {
  for (const double distance : effort.detailDistances) {
    if (!goOn()) return Error{"interrupted"};
    Result<std::optional<FilledView>> view = fill(world, pixelError, distance, effort.detailCap, goOn);
    if (!view) return view.error();
    if (*view) return *std::move(*view);
  }
  return Error{"no view of a pixel error of " + rounded(pixelError, 3) + " fits into " +
               std::to_string(effort.detailCap >> 20U) + " MiB"};
}

/// [ms] Updates in which the same view is chosen all anew, and nothing has to be made.
Result<std::vector<double>> choosingTimes(Engine& engine, std::size_t repetitions) {
  const DetailSettings detail = *engine.options().view.detail;
  std::vector<double> times;
  for (std::size_t k = 0; k <= repetitions; ++k) {
    DetailSettings next = detail;
    next.pixelError *= k % 2 == 0 ? 1.0 + 1e-9 : 1.0 + 2e-9;
    if (const Result<void> set = engine.setDetail(next); !set) return set.error();
    const double seconds = processorSecondsOf([&] { engine.update(0.0, 1s); });
    if (k > 0) times.push_back(1e3 * seconds);  // the first fetches memory
  }
  return times;
}

std::vector<Column> columns() {
  return {
      {"pixel error", "px",
       "DetailSettings::pixelError, in a picture of 720 lines and a field of view of 45 degrees"},
      {"view distance", "m",
       "the largest of those tried at which the byte cap holds the view, and the default one"},
      {"nodes", "", "in the scene"},
      {"triangles", "", "in the scene"},
      {"memory", "MiB", "of the engine, without the renderer's copy"},
      {"choosing median", "ms",
       "processor time of an update that chooses the whole view anew and has nothing to make"},
      {"choosing p99", "ms", "the same"},
      {"choosing spread", "", "interquartile range over median of the same"},
      {"time to fill", "s", "processor time from nothing until all of the view is there, without workers"},
      {"promised max", "px", "pixelError() of the scene, with what is drawn beyond the view distance"},
      {"promised p99", "px", "the same"},
      {"true max", "px",
       "largest error at all places, as seen from the eye, of the ground as it is drawn for that eye: "
       "vertices "
       "moved with distance (Morph.h)"},
      {"true p99", "px", "at places by distance"},
      {"true RMS", "px", "at places by distance"},
      {"true max m", "m", "largest vertical distance from the level-0 surface at all places"},
      {"true p99 m", "m", "at places by area"},
      {"true RMS m", "m", "at places by area"},
      {"finest places", "%", "places where level 0 is drawn, or lies on its way to level 1"},
      {"beyond promise", "%", "places whose error is larger than their mesh says; 0.1 % of nodes may be"},
      {"places", "", "with ground, half of them by distance and half by area"},
      {"repetitions", "", "of choosing"}};
}

Eye eyeOf(Engine& engine) {
  const Motion motion = engine.object(0).motion();
  const DetailSettings& detail = *engine.options().view.detail;
  return {motion.position, motion.height, lensPixels(detail.lines, detail.fieldOfView)};
}

Result<void> addRow(Table& table, double wanted, FilledView& view, const GroundSample& sample,
                    const Effort& effort) {
  Engine& engine = *view.engine;
  const World& world = engine.world();
  const EngineFigures figures = engine.figures();
  const Eye eye = eyeOf(engine);
  const PixelError promised = pixelError(world, *engine.scene(), eye);
  const SurfaceErrors errors = errorsOf(*engine.sceneQuery(), sample, eye, world.pitch());
  const Result<std::vector<double>> times = choosingTimes(engine, effort.repetitions);
  if (!times) return times.error();
  const Summary choosing = summaryOf(*times);
  const double places = static_cast<double>(errors.places);
  const auto share = [places](std::size_t some) {
    return places > 0.0 ? 100.0 * static_cast<double>(some) / places : 0.0;
  };
  table.add({wanted,
             view.distance,
             static_cast<double>(figures.nodes),
             static_cast<double>(figures.triangles),
             static_cast<double>(figures.bytes) / 0x1p20,
             choosing.median,
             choosing.p99,
             choosing.spread,
             view.seconds,
             promised.max,
             promised.p99,
             errors.maxPixels,
             quantile(errors.pixels, 0.99),
             rootMeanSquare(errors.pixels),
             errors.maxMetres,
             quantile(errors.metres, 0.99),
             rootMeanSquare(errors.metres),
             share(errors.finest),
             share(errors.beyondPromise),
             places,
             static_cast<double>(choosing.count)});
  return {};
}

}  // namespace

Result<void> calibrate(const std::shared_ptr<const World>& world, const GoOn& goOn) {
  Result<std::unique_ptr<Engine>> engine = engineOf(world, 16.0, 1000.0, std::size_t{256} << 20U);
  if (!engine) return engine.error();
  // Measuring is done by the updates when nothing else is to be done; then they return at once.
  constexpr auto kBudget = 20ms;
  constexpr double kIdle = 1e-3;  // [s]
  for (int idle = 0, updates = 0; idle < 5 && updates < 20'000; ++updates) {
    if (!goOn()) return Error{"interrupted"};
    const double seconds = processorSecondsOf([&] { (*engine)->update(0.0, kBudget); });
    idle = (*engine)->figures().pending == 0 && seconds < kIdle ? idle + 1 : 0;
  }
  return {};
}

Result<Table> measureDetail(const std::shared_ptr<const World>& world, std::span<const double> pixelErrors,
                            const Effort& effort, const GoOn& goOn) {
  Table table(
      "detail", "Level of detail",
      "One view, from 100 m above the ground, at pixel errors from fine to coarse, under a byte cap of " +
          std::to_string(effort.detailCap >> 20U) +
          " MiB: what is drawn, what it costs to choose and to make, and how far it is from the "
          "level-0 surface. Where all of a small view is level 0, nothing is wrong but what lies on its way "
          "to level 1.",
      columns());
  std::map<double, GroundSample> samples;  // by distance
  const auto add = [&](double wanted, FilledView& view) -> Result<void> {
    auto sample = samples.find(view.distance);
    if (sample == samples.end()) {
      Result<GroundSample> taken =
          sampleGround(*world, kPlace, view.distance, effort.detailPlaces, effort.placesAround, goOn);
      if (!taken) return taken.error();
      sample = samples.emplace(view.distance, *std::move(taken)).first;
    }
    return addRow(table, wanted, view, sample->second, effort);
  };
  for (const double wanted : pixelErrors) {
    Result<FilledView> view = fillFarthest(world, wanted, effort, goOn);
    if (!view) return view.error();
    const double farthest = view->distance;
    if (const Result<void> added = add(wanted, *view); !added) return added.error();
    if (farthest <= effort.usualDistance) continue;
    view->engine.reset();
    Result<std::optional<FilledView>> usual =
        fill(world, wanted, effort.usualDistance, effort.detailCap, goOn);
    if (!usual) return usual.error();
    if (!*usual) continue;
    if (const Result<void> added = add(wanted, **usual); !added) return added.error();
  }
  return table;
}

std::vector<Plot> plotsOfDetail(const Table& table) {
  Plot cost{"detail-triangles",
            "Triangles by pixel error (view distances: see the table)",
            "pixel error wanted [px]",
            "triangles",
            true,
            true,
            {{"triangles", {}}}};
  Plot error{"detail-error",
             "Pixel error wanted, promised and true",
             "pixel error wanted [px]",
             "error [px]",
             true,
             true,
             {{"wanted", {}}, {"promised max", {}}, {"true max", {}}, {"true p99", {}}, {"true RMS", {}}}};
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const double wanted = table.number(row, "pixel error");
    // of the views of one pixel error the first is the farthest
    if (row > 0 && table.number(row - 1, "pixel error") == wanted) continue;
    cost.curves[0].points.emplace_back(wanted, table.number(row, "triangles"));
    error.curves[0].points.emplace_back(wanted, wanted);
    for (std::size_t k = 1; k < error.curves.size(); ++k) {
      error.curves[k].points.emplace_back(wanted, table.number(row, error.curves[k].title));
    }
  }
  return {cost, error};
}

}  // namespace teren
