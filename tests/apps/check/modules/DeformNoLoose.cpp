// Forgets half of the loose material that was laid.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  void layLoose(teren::ConstHeightView depths) override {
    const teren::DeformRegion& region = grid_.region();
    depths_ = teren::HeightMap(region.sampleColumns(), region.sampleRows());
    forEachSample([&](int x, int y) { depths_(x, y) = 0.5F * depths(x, y); });
  }
  bool loose(teren::HeightView depths) const override {
    forEachSample([&](int x, int y) { depths(x, y) = depths_.samples().empty() ? 0.0F : depths_(x, y); });
    return true;
  }
  std::size_t bytes() const noexcept override {
    return Pressing::bytes() + sizeof(*this) - sizeof(Pressing) + depths_.bytes();
  }

 private:
  template <class Visitor>
  void forEachSample(Visitor&& visit) const {
    for (int y = 0; y < grid_.region().sampleRows(); ++y) {
      for (int x = 0; x < grid_.region().sampleColumns(); ++x) visit(x, y);
    }
  }

  teren::HeightMap depths_;
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-loose")
