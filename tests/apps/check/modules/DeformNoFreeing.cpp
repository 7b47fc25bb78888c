// Keeps something of every surface for ever.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  Broken(const teren::DeformRegion& region, teren::ConstHeightView ground) : Pressing(region, ground) {
    static std::vector<std::unique_ptr<char[]>> kept;
    kept.push_back(std::make_unique<char[]>(100));
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-freeing")
