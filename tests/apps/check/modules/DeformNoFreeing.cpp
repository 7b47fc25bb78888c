// Keeps something of every surface for ever.
#include <list>
#include <mutex>

#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

std::mutex mutex;
std::list<std::unique_ptr<char[]>> kept;

class Broken final : public sound::Pressing {
 public:
  Broken(const teren::DeformRegion& region, teren::ConstHeightView ground) : Pressing(region, ground) {
    const std::lock_guard lock(mutex);
    kept.push_back(std::make_unique<char[]>(100));
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-freeing")
