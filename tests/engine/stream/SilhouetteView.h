// The same eye over the same ground in two ways: what tests of the skyline compare.
#pragma once

#include <memory>

#include "teren/Engine.h"
#include "teren/PixelError.h"
#include "teren/PluginRegistry.h"

namespace teren::test {

/// A view from wherever it is told, and what it promises for a picture.
class SilhouetteView {
 public:
  SilhouetteView(std::shared_ptr<const World> world, const ViewSettings& view, const DetailSettings& picture)
      : lens_(lensPixels(static_cast<int>(picture.lines), picture.fieldOfView)) {
    auto made = Engine::create(std::move(world), {.view = view});
    engine_ = std::move(made).value();
    puppet_ = static_cast<Puppet*>(&engine_->add(std::make_unique<Puppet>()));
  }

  /// All that is wanted from there is there.
  void settleAt(const Position& position, double height) {
    puppet_->place.position = position;
    puppet_->place.height = height;
    engine_->settle();
  }

  Engine& engine() noexcept { return *engine_; }
  double lens() const noexcept { return lens_; }
  Eye eye() const { return {puppet_->place.position, puppet_->place.height, lens_}; }
  /// [px] What the scene promises, in the middle of a picture.
  double promised() const { return pixelError(engine_->world(), *engine_->scene(), eye()).max; }

 private:
  class Puppet final : public Object {
   public:
    void update(double, const Ground&) override {}
    Motion motion() const override { return place; }
    Motion place;
  };

  double lens_;
  std::unique_ptr<Engine> engine_;
  Puppet* puppet_ = nullptr;
};

inline std::shared_ptr<const World> shippedWorld() {
  return World::create(WorldDescription::standard(), *PluginRegistry::standard()).value();
}

}  // namespace teren::test
