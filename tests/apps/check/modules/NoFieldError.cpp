// Promises to be four times as near to its triangles as it is.
#include "tests/apps/check/modules/SoundField.h"

namespace {

class Broken final : public sound::Field {
 public:
  using Field::Field;
  double fieldError(double spacing) const override { return 0.25 * Field::fieldError(spacing); }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-field-error")
