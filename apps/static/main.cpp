// teren-static: nine patches and all their seams in an examiner viewer, to be taken apart.
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <QApplication>

#include "teren/Engine.h"

#include "apps/options/CommandLine.h"
#include "apps/options/WorldOptions.h"
#include "apps/static/StaticWindow.h"
#include "apps/window/FrameReport.h"
#include "apps/window/SavedFiles.h"
#include "apps/window/WindowOptions.h"
#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

constexpr const char* kName = "teren-static";

/// Stands in the middle of patch (0, 0), so that the patches around it are drawn.
class Standpoint final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override {
    Motion motion;
    motion.position.u = motion.position.v = 0.5;
    return motion;
  }
};

Result<void> showPatches(Engine& engine, const WindowOptions& options, const StaticLook& look) {
  StaticWindow window(engine, options.size, look);
  if (!window.settle()) return {};
  using Duration = StaticWindow::Clock::duration;
  std::optional<Duration> duration;
  if (options.seconds) {
    duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*options.seconds));
  }
  window.begin(duration);
  QApplication::exec();
  for (const std::string& message : engine.world().takeMessages()) {
    std::fprintf(stderr, "%s: %s\n", kName, message.c_str());
  }
  if (!options.screenshot.empty()) {
    const Result<void> saved = savePicture(window.lastPicture(), options.screenshot);
    if (!saved) return saved;
  }
  if (options.stats.empty()) return {};
  const EngineFigures figures = engine.figures();
  return saveText(frameReport(window.frameTimes(), window.engineTimes(), figures, figures.bytes),
                  options.stats);
}

Result<std::unique_ptr<Engine>> ninePatches(const std::shared_ptr<const World>& world) {
  if (world->intervals() < 4) {
    return Error{"samples of the world is 5, expected at least 9: smaller patches are nothing but seams"};
  }
  EngineOptions options;
  options.view = {.level = 0, .radius = 1};
  Result<std::unique_ptr<Engine>> engine = Engine::create(world, options);
  if (engine) (*engine)->add(std::make_unique<Standpoint>());
  return engine;
}

int run(int argc, char** argv) {
  CLI::App application(
      "Shows nine patches and their seams; E takes them apart, W shows them as wire, Q quits.", kName);
  const WorldOptions worldOptions(application);
  const WindowCommandLine windowOptions(application, "show them this long, then end");
  StaticLook look;
  application.add_flag("--explode", look.apart, "begin with the pieces apart")->disable_flag_override();
  application.add_flag("--wireframe", look.wireframe, "begin with wire")->disable_flag_override();
  if (const std::optional<ExitCode> end = parseCommandLine(application, argc, argv)) return *end;
  const Result<std::shared_ptr<const World>> world = worldOptions.create(*PluginRegistry::standard());
  if (!world) return fail(application, kWrongInput, world.error().message);
  const Result<WindowOptions> options = windowOptions.resolve();
  if (!options) return fail(application, kWrongInput, options.error().message);
  const Result<std::unique_ptr<Engine>> engine = ninePatches(*world);
  if (!engine) return fail(application, kWrongInput, engine.error().message);
  const Result<void> shown =
      runWithWindows(kName, argv, [&] { return showPatches(**engine, *options, look); });
  return shown ? kSuccess : fail(application, kWorkFailed, shown.error().message);
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::run(argc, argv);
}
