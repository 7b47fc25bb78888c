// Does not take the greatest deviation its table allows.
#include <stdexcept>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  explicit Broken(const teren::Values& values) : Noise(values) {
    if (deviation() == 2.0) throw std::runtime_error("two are too many");
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-parameters")
