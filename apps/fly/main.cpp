// teren-fly: fly around the landscape.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>

#include <CLI/CLI.hpp>
#include <Inventor/Qt/SoQt.h>
#include <QApplication>

#include "teren/Engine.h"

#include "apps/fly/Daylight.h"
#include "apps/fly/Flight.h"
#include "apps/fly/FlightReport.h"
#include "apps/fly/FlyOptions.h"
#include "apps/fly/FlyWindow.h"
#include "apps/fly/SavedFiles.h"
#include "apps/options/CommandLine.h"
#include "apps/options/WorldOptions.h"
#include "coin/SoTerrain.h"

namespace teren {
namespace {

// Where the flight begins: in the default world over a lake's shore, towards a range with snow.
constexpr double kStartEast = 3040.0, kStartNorth = 11700.0;        // [m]
constexpr double kStartHeading = 335.0 * std::numbers::pi / 180.0;  // [rad]

/// Qt ends a program without a usable display by abort(); this ends it with a sentence.
void exitWhenQtGivesUp(QtMsgType type, const QMessageLogContext&, const QString& message) {
  if (type == QtFatalMsg) {
    std::fputs("teren-fly: cannot open a window; is DISPLAY set to a running X server?\n", stderr);
    std::_Exit(kWorkFailed);
  }
  if (type == QtDebugMsg || type == QtInfoMsg) return;
  if (message.contains(QLatin1String("could not connect to display"))) return;  // the sentence above says it
  std::fprintf(stderr, "teren-fly: %s\n", message.toUtf8().constData());
}

/// Qt wants a folder of the person's own for its sockets and warns without one.
void ensureRuntimeFolder() {
  if (std::getenv("XDG_RUNTIME_DIR") != nullptr) return;
  static std::string folder = "/tmp/teren-runtime-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return;
  setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  std::atexit([] { rmdir(folder.c_str()); });
}

/// On a terminal: how much of the land is there.
bool settle(FlyWindow& window) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (terminal) std::fputs("teren-fly: making the land ...", stderr);
  const bool settled = window.settle();
  if (terminal) std::fputs(settled ? " done\n" : " stopped\n", stderr);
  return settled;
}

Result<void> saveResults(const FlyOptions& options, const FlyWindow& window, const Flight& flight) {
  if (!options.screenshot.empty()) {
    const Result<void> saved = savePicture(window.lastPicture(), options.screenshot);
    if (!saved) return saved;
  }
  if (options.stats.empty()) return {};
  return saveText(flightReport(window.frameTimes(), flight, window.bytes()), options.stats);
}

Result<void> fly(const FlyOptions& options, std::unique_ptr<Engine> engine) {
  const Daylight daylight;
  AircraftStart start;
  start.heading = kStartHeading;
  start.speed = options.speed;
  start.waterLevel = static_cast<double>(daylight.waterLevel);
  const Result<Position> position = Position::fromMetres(kStartEast, kStartNorth, engine->world().pitch());
  if (position) start.position = *position;
  Flight flight(std::move(engine), start);
  FlyWindow window(flight, daylight, options.size);
  if (!settle(window)) return {};
  using Duration = FlyWindow::Clock::duration;
  std::optional<Duration> duration;
  if (options.seconds) {
    duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*options.seconds));
  }
  window.fly(duration);
  QApplication::exec();
  for (const std::string& message : flight.engine().world().takeMessages()) {
    std::fprintf(stderr, "teren-fly: %s\n", message.c_str());
  }
  return saveResults(options, window, flight);
}

/// Qt and Coin live only as long as the flight.
Result<void> flyInWindow(int argc, char** argv, const FlyOptions& options, std::unique_ptr<Engine> engine) {
  ensureRuntimeFolder();
  qInstallMessageHandler(exitWhenQtGivesUp);
  QApplication application(argc, argv);
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int) { FlyWindow::quitSoon(); });
  }
  QWidget shell;  // SoQt asks for a top-level widget; it is never shown
  SoQt::init(&shell);
  SoTerrain::initClass();
  const Result<void> flown = fly(options, std::move(engine));
  SoQt::done();
  return flown;
}

int run(int argc, char** argv) {
  CLI::App application("Flies around an endless landscape; F1 shows the keys.", "teren-fly");
  const WorldOptions worldOptions(application);
  const FlyCommandLine commandLine(application);
  if (const std::optional<ExitCode> end = parseCommandLine(application, argc, argv)) return *end;
  const Result<std::shared_ptr<const World>> world = worldOptions.create(*PluginRegistry::standard());
  if (!world) return fail(application, kWrongInput, world.error().message);
  const Result<FlyOptions> options = commandLine.resolve(**world);
  if (!options) return fail(application, kWrongInput, options.error().message);
  Result<std::unique_ptr<Engine>> engine = Engine::create(*world, {.view = options->view});
  if (!engine) return fail(application, kWrongInput, engine.error().message);
  int quietCount = 1;  // Qt's own options are not ours
  const Result<void> flown = flyInWindow(quietCount, argv, *options, std::move(engine).value());
  return flown ? kSuccess : fail(application, kWorkFailed, flown.error().message);
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::run(argc, argv);
}
