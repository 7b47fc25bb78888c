#include "generators/fault/FaultReference.h"

#include <cstdint>
#include <vector>

#include "teren/Hash.h"

#include "generators/fault/FaultLine.h"

namespace teren {

void faultReference(const FaultFormation& formation, const MapRequest& request, HeightView out) {
  const int side = request.samples;
  const std::int64_t step = side == 1 ? 0 : kFaultUnits / (side - 1);
  const std::int64_t origin = side == 1 ? kFaultUnits / 2 : 0;
  std::vector<std::int64_t> sums(static_cast<std::size_t>(side));
  std::vector<FaultLine> lines;
  RandomSequence random(request.seed);
  for (int size = formation.faults(); size > 0; --size) lines.push_back(drawFaultLine(random, size));

  // Row by row rather than sample by sample, and with FaultLine::move written out, because compilers then
  // vectorise the innermost loop.
  for (int row = 0; row < side; ++row) {
    sums.assign(sums.size(), 0);
    for (const FaultLine line : lines) {
      const std::int64_t limit = (line.bx - line.ax) * (origin + row * step - line.ay);
      const auto dy = static_cast<std::int32_t>(line.by - line.ay);
      const auto west = static_cast<std::int32_t>(origin - line.ax);
      const std::int64_t left = line.left;
      std::int64_t* const sum = sums.data();
      for (int column = 0; column < side; ++column) {
        sum[column] +=
            static_cast<std::int64_t>(dy) * (west + column * static_cast<std::int32_t>(step)) < limit ? left
                                                                                                      : -left;
      }
    }
    for (int column = 0; column < side; ++column) {
      out(column, row) = static_cast<float>(formation.metresPerStep() * static_cast<double>(sums[column]));
    }
  }
}

}  // namespace teren
