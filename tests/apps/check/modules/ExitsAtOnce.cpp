// Ends its process while it is loaded, with success.
#include <cstdlib>

#include "tests/apps/check/modules/Sound.h"

namespace {

[[maybe_unused]] const int ended = (std::exit(0), 0);

class Exits final : public sound::Noise {
 public:
  using Noise::Noise;
};

}  // namespace

SOUND_PLUGIN(Exits, "exits-at-once")
