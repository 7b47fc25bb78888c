#include "apps/fly/FlyOptions.h"

#include <algorithm>
#include <thread>

#include "apps/fly/Aircraft.h"
#include "apps/options/CommandLine.h"

namespace teren {
namespace {

constexpr int kMinCap = EngineOptions::kLeastCap >> 20U, kMaxCap = 1 << 20;  // [MiB]
constexpr int kMostByDefault = 4;

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

}  // namespace

int FlyOptions::defaultWorkers() noexcept {
  const auto threads = static_cast<int>(std::min(std::thread::hardware_concurrency(), 1024U));
  return std::clamp(threads - 1, 0, kMostByDefault);
}

FlyCommandLine::FlyCommandLine(CLI::App& application)
    : viewDistance_(addViewDistance(application,
                                    "metres of land to draw in every direction at least; sets --radius, but "
                                    "with --pixel-error [2560]")),
      pixelError_(addPixelError(application)),
      viewLevel_(
          application.add_option("--view-level", "level of the land, 0 is finest [3]")->type_name("L")),
      radius_(application.add_option("--radius", "nodes to draw in every direction, 1 to 64 [5]")
                  ->type_name("R")),
      workers_(application
                   .add_option("--workers",
                               "threads that make the landscape, 0 to 64 [one less than the processor runs "
                               "at a time, at most 4]")
                   ->type_name("N")),
      cap_(application.add_option("--cap-mib", "most MiB the engine and its buffers may hold [512]")
               ->type_name("N")),
      speed_(application.add_option("--speed", "at the start, metres per second, 5 to 600 [60]")
                 ->type_name("V")),
      window_(application, "fly this long, then end") {}

Result<ViewSettings> FlyCommandLine::view(const World& world) const {
  if (pixelError_->count() > 0) {
    if (viewLevel_->count() + radius_->count() > 0) {
      return Error{"--pixel-error excludes --view-level and --radius"};
    }
    return viewWithin(*pixelError_, *viewDistance_);
  }
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
  const Result<WindowOptions> window = window_.resolve();
  if (!window) return window.error();
  options.window = *window;
  return options;
}

}  // namespace teren
