#include "apps/fly/LandSource.h"

#include <utility>

#include "teren/Parameter.h"

namespace teren {

LandSource::LandSource(const WorldOptions& world, const FlyCommandLine& fly)
    : world_(world),
      fly_(fly),
      registry_(PluginRegistry::load(PluginRegistry::searchPath(), ModuleLoading::copied)),
      latest_(registry_) {}

Result<NewLand> LandSource::make() {
  if (pitch_ > 0.0) {
    Result<std::shared_ptr<const PluginRegistry>> reloaded = latest_->reloaded();
    if (!reloaded) return reloaded.error();
    latest_ = std::move(*reloaded);
  }
  const Result<std::shared_ptr<const World>> world = world_.create(*latest_);
  if (!world) return world.error();
  const double pitch = (*world)->pitch();
  if (pitch_ > 0.0 && pitch != pitch_) {
    return Error{"the world's pitch is now " + numberText(pitch) + " m, expected " + numberText(pitch_) +
                 " m as before; for another one, start anew"};
  }
  const Result<FlyOptions> options = fly_.resolve(**world);
  if (!options) return options.error();
  Result<std::unique_ptr<Engine>> engine = Engine::create(*world, options->engine);
  if (!engine) return engine.error();
  NewLand land{std::move(*engine), *options, latest_->changedSince(*registry_)};
  registry_ = latest_;
  pitch_ = pitch;
  return land;
}

}  // namespace teren
