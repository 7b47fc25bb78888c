// The last column of a rectangle is a little flatter than it would be inside a larger one.
#include "tests/apps/check/modules/SoundField.h"

namespace {

class Broken final : public sound::Field {
 public:
  using Field::Field;
  std::unique_ptr<teren::GenerationTask> beginField(const teren::FieldRequest& request,
                                                    teren::HeightView out) const override {
    return teren::makeRowTask(out, [this, request, out](int row) {
      for (int column = 0; column < out.columns(); ++column)
        out(column, row) = height(request, column, row) * (column == out.columns() - 1 ? 0.999999f : 1.0f);
    });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-field")
