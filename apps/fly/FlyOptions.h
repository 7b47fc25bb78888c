// The command line of teren-fly.
#pragma once

#include <CLI/CLI.hpp>

#include "teren/Engine.h"
#include "teren/Result.h"

#include "apps/options/ViewOptions.h"
#include "apps/window/WindowOptions.h"

namespace teren {

/// What remains once the world is known (see options/WorldOptions.h).
struct FlyOptions {
  EngineOptions engine{.view = {.detail = kFlyingDetail}, .workers = defaultWorkers()};
  double speed = 60.0;     ///< [m/s]
  bool autopilot = false;  ///< whether it flies the first aircraft from the start
  WindowOptions window;

  /// One less than the processor runs at a time, 0 ... 4: the picture needs the other one.
  static int defaultWorkers() noexcept;
};

/// Declares the options on an application, which must live as long as this.
class FlyCommandLine {
 public:
  explicit FlyCommandLine(CLI::App& application);

  /// After parsing. Errors are of the kind kWrongInput.
  Result<FlyOptions> resolve(const World& world) const;

 private:
  Result<ViewSettings> view(const World& world) const;

  const CLI::Option* viewDistance_;
  const CLI::Option* pixelError_;
  const CLI::Option* viewLevel_;
  const CLI::Option* radius_;
  const CLI::Option* workers_;
  const CLI::Option* cap_;
  const CLI::Option* speed_;
  const CLI::Option* autopilot_;
  WindowCommandLine window_;
};

}  // namespace teren
