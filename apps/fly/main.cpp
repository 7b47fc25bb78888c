// teren-fly: fly around the landscape.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <unistd.h>
#include <utility>

#include <CLI/CLI.hpp>
#include <QApplication>

#include "apps/fly/Daylight.h"
#include "apps/fly/Flight.h"
#include "apps/fly/FlyWindow.h"
#include "apps/fly/LandSource.h"
#include "apps/options/CommandLine.h"
#include "apps/options/EditOptions.h"
#include "apps/options/LargeBlocks.h"
#include "apps/options/WorldOptions.h"
#include "apps/window/FrameReport.h"
#include "apps/window/SavedFiles.h"
#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

// Where the flight begins, heading north; the second aircraft then begins at (0, -60).
constexpr double kStartEast = 60.0, kStartNorth = 0.0;  // [m]

/// On a terminal: how much of the land is there.
bool settle(FlyWindow& window) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (terminal) std::fputs("teren-fly: making the land ...", stderr);
  const bool settled = window.settle();
  if (terminal) std::fputs(settled ? " done\n" : " stopped\n", stderr);
  return settled;
}

Result<void> saveResults(const FlyOptions& options, const FlyWindow& window, Flight& flight) {
  if (!options.window.screenshot.empty()) {
    const Result<void> saved = savePicture(window.lastPicture(), options.window.screenshot);
    if (!saved) return saved;
  }
  if (options.window.stats.empty()) return {};
  return saveText(
      frameReport(window.frameTimes(), flight.engineTimes(), flight.engine().figures(), window.bytes(),
                  window.pixelError(), flight.engine().options().view.detail, flight.edits()->edits()),
      options.window.stats);
}

Result<void> fly(NewLand land, std::unique_ptr<LandEdits> edits, const FlyWindow::Remake& remake) {
  const FlyOptions& options = land.options;
  const Daylight daylight;
  AircraftStart start;
  start.speed = options.speed;
  start.waterLevel = static_cast<double>(daylight.waterLevel);
  const Result<Position> position =
      Position::fromMetres(kStartEast, kStartNorth, land.engine->world().pitch());
  if (position) start.position = *position;
  std::optional<TruckStart> truck;
  if (const auto place = placeForTruck(*land.world, start.position, start.waterLevel)) {
    const Offset away = offset(start.position, *place, land.world->pitch());
    truck = TruckStart{
        .position = *place, .heading = std::atan2(away.east, away.north), .waterLevel = start.waterLevel};
  }
  Flight flight(std::move(land.engine), start, truck);
  flight.setEdits(std::move(edits));
  flight.aircraft().front()->setAutopilot(options.autopilot);
  FlyWindow window(flight, daylight, options.window.size, remake);
  if (!settle(window)) return {};
  using Duration = FlyWindow::Clock::duration;
  std::optional<Duration> duration;
  if (options.window.seconds) {
    duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*options.window.seconds));
  }
  window.fly(duration);
  QApplication::exec();
  return saveResults(options, window, flight);
}

int run(int argc, char** argv) {
  CLI::App application("Flies around an endless landscape; F1 shows the keys.", "teren-fly");
  const WorldOptions worldOptions(application);
  const EditOptions editOptions(application, "[beside the world's file, else in the user's data folder]");
  const FlyCommandLine commandLine(application);
  if (const std::optional<ExitCode> end = parseCommandLine(application, argc, argv)) return *end;
  LandSource source(worldOptions, commandLine);
  Result<NewLand> land = source.make();
  if (!land) return fail(application, kWrongInput, land.error().message);
  if (editOptions.given()) {
    if (const auto named = editOptions.named(); !named) {
      return fail(application, kWrongInput, named.error().message);
    }
  }
  const Result<void> flown = runWithWindows("teren-fly", argv, [&] {
    auto edits = std::make_unique<LandEdits>(land->world, source.deformers(), [&](const World& world) {
      return editOptions.file(worldOptions, world);
    });
    return fly(std::move(*land), std::move(edits), [&source] { return source.make(); });
  });
  return flown ? kSuccess : fail(application, kWorkFailed, flown.error().message);
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  teren::keepLargeBlocksApart();
  return teren::run(argc, argv);
}
