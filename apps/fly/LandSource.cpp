#include "apps/fly/LandSource.h"

#include <mutex>
#include <utility>

#include "teren/Parameter.h"

namespace teren {

struct LandSource::Deformers {
  std::mutex mutex;
  DeformerSource source;
};

LandSource::LandSource(const WorldOptions& world, const FlyCommandLine& fly)
    : world_(world),
      fly_(fly),
      registry_(PluginRegistry::load(PluginRegistry::searchPath(), ModuleLoading::copied)),
      latest_(registry_),
      deformers_(std::make_shared<Deformers>()) {
  deformers_->source = deformersOf(registry_);
}

DeformerSource LandSource::deformers() const {
  return [shared = deformers_](std::string_view id) {
    const std::lock_guard lock(shared->mutex);
    return shared->source(id);
  };
}

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
  NewLand land{*world, std::move(*engine), *options, latest_->changedSince(*registry_)};
  registry_ = latest_;
  {
    const std::lock_guard lock(deformers_->mutex);
    deformers_->source = deformersOf(registry_);
  }
  pitch_ = pitch;
  return land;
}

}  // namespace teren
