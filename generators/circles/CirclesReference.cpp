#include "generators/circles/CirclesReference.h"

#include <algorithm>

#include "teren/Hash.h"

namespace teren {

void circlesReference(const Circles& circles, const MapRequest& request, HeightView out) {
  const int side = request.samples;
  const std::int32_t step = side == 1 ? 0 : kCircleUnits / (side - 1);
  const std::int32_t origin = side == 1 ? kCircleUnits / 2 : 0;
  RandomSequence random(request.seed);
  for (int row = 0; row < side; ++row) std::fill_n(out.row(row), side, 0.0f);
  for (int n = 0; n < circles.discs(); ++n) {
    const Disc disc = circles.draw(random);
    for (int row = 0; row < side; ++row) {
      const float common = disc.atRow(static_cast<float>(origin + row * step - disc.y));
      float* const heights = out.row(row);
      for (int column = 0; column < side; ++column)
        heights[column] += disc.alongRow(static_cast<float>(origin + column * step - disc.x), common);
    }
  }
}

}  // namespace teren
