#include "apps/fly/FlyOptions.h"

#include <algorithm>
#include <string>
#include <thread>

#include "teren/Parameter.h"

#include "apps/fly/Aircraft.h"
#include "apps/options/CommandLine.h"

namespace teren {
namespace {

constexpr int kMinCap = EngineOptions::kLeastCap >> 20U, kMaxCap = 1 << 20;  // [MiB]
constexpr int kMostByDefault = 4;
const std::string kAutopilotDoc = "the aircraft flies by itself, until you steer";

Result<double> readNumber(const CLI::Option& option, double otherwise, double min, double max) {
  if (option.count() == 0) return otherwise;
  return numberArgument(option.get_name(), argument(option), min, max);
}

Result<int> readWhole(const CLI::Option& option, int otherwise, int min, int max) {
  if (option.count() == 0) return otherwise;
  const Result<std::int64_t> value = wholeArgument(option.get_name(), argument(option), min, max);
  if (!value) return value.error();
  return static_cast<int>(*value);
}

/// An option of a view of one level, and what goes where only the other one is given.
const CLI::Option* addUniform(CLI::App& application, const char* name, const char* type, const char* does,
                              int otherwise) {
  const std::string doc = std::string(does) + " [" + std::to_string(otherwise) + "]";
  return application.add_option(name, doc)->type_name(type);
}

}  // namespace

int FlyOptions::defaultWorkers() noexcept {
  const auto threads = static_cast<int>(std::min(std::thread::hardware_concurrency(), 1024U));
  return std::clamp(threads - 1, 0, kMostByDefault);
}

FlyCommandLine::FlyCommandLine(CLI::App& application)
    : viewDistance_(addViewDistance(
          application,
          "metres of land to draw in every direction [" + numberText(kFlyingDetail.distance) +
              ", less in a world without coarse layers]; with --view-level, at least, in place of "
              "--radius")),
      pixelError_(addPixelError(application, "[" + numberText(kFlyingDetail.pixelError) + "]")),
      viewLevel_(addUniform(application, "--view-level", "L",
                            "draws the land in one level, whatever its error; 0 is finest",
                            kFlyingView.level)),
      radius_(addUniform(application, "--radius", "R",
                         "draws so many nodes of one level in every direction, 1 to 64", kFlyingView.radius)),
      workers_(application
                   .add_option("--workers",
                               "threads that make the landscape, 0 to 64 [one less than the processor runs "
                               "at a time, at most 4]")
                   ->type_name("N")),
      cap_(application.add_option("--cap-mib", "most MiB the engine and its buffers may hold [512]")
               ->type_name("N")),
      speed_(application.add_option("--speed", "at the start, metres per second, 5 to 600 [60]")
                 ->type_name("V")),
      autopilot_(application.add_flag("--autopilot", kAutopilotDoc)->disable_flag_override()),
      window_(application, "fly this long, then end") {}

Result<ViewSettings> FlyCommandLine::view(const World& world) const {
  const bool isUniform = viewLevel_->count() + radius_->count() > 0;
  if (!isUniform) return viewWithin(*pixelError_, *viewDistance_, flyingDetail(world));
  if (pixelError_->count() > 0) return Error{"--pixel-error excludes --view-level and --radius"};
  ViewSettings view = kFlyingView;
  const Result<int> level =
      readWhole(*viewLevel_, std::min(view.level, world.topLevel()), 0, world.topLevel());
  if (!level) return level.error();
  view.level = *level;
  const Result<int> radius = readWhole(*radius_, view.radius, 1, ViewSettings::kMostRadius);
  if (!radius) return radius.error();
  view.radius = *radius;
  if (viewDistance_->count() > 0 && radius_->count() > 0) {
    return Error{"--view-distance and --radius exclude each other"};
  }
  return viewReaching(*viewDistance_, view, world);
}

Result<FlyOptions> FlyCommandLine::resolve(const World& world) const {
  FlyOptions options;
  const Result<ViewSettings> view = this->view(world);
  if (!view) return view.error();
  options.engine.view = *view;
  const Result<int> workers = readWhole(*workers_, options.engine.workers, 0, EngineOptions::kMostWorkers);
  if (!workers) return workers.error();
  options.engine.workers = *workers;
  const Result<int> cap =
      readWhole(*cap_, static_cast<int>(options.engine.capBytes >> 20U), kMinCap, kMaxCap);
  if (!cap) return cap.error();
  options.engine.capBytes = static_cast<std::size_t>(*cap) << 20U;
  const Result<double> speed = readNumber(*speed_, options.speed, Aircraft::kMinSpeed, Aircraft::kMaxSpeed);
  if (!speed) return speed.error();
  options.speed = *speed;
  options.autopilot = autopilot_->count() > 0;
  const Result<WindowOptions> window = window_.resolve();
  if (!window) return window.error();
  options.window = *window;
  return options;
}

}  // namespace teren
