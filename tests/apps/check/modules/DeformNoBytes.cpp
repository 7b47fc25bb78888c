// Does not count its grid.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  std::size_t bytes() const noexcept override { return sizeof(*this); }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-bytes")
