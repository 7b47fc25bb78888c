// Has one snapshot, which follows the surface.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Ground final : public sound::Behind {
 public:
  using Behind::Behind;
  void follow(std::shared_ptr<const teren::DeformedGround> ground) { ground_ = std::move(ground); }
};

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  std::shared_ptr<const teren::DeformedGround> snapshot() override {
    if (ground_ == nullptr) ground_ = std::make_shared<Ground>(nullptr);
    ground_->follow(Pressing::snapshot());
    return ground_;
  }

 private:
  std::shared_ptr<Ground> ground_;
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-snapshots")
