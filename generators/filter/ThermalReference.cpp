#include "generators/filter/ThermalReference.h"

#include <algorithm>

namespace teren {

void thermalReference(const ThermalFilter& filter, double spacing, HeightView inOut) {
  const ThermalLimits limits = filter.limits(spacing);
  HeightMap before(inOut.columns(), inOut.rows());
  for (int pass = 0; pass < filter.passes(); ++pass) {
    for (int y = 0; y < inOut.rows(); ++y) std::copy_n(inOut.row(y), inOut.columns(), before.view().row(y));
    for (int y = 0; y < inOut.rows(); ++y) {
      for (int x = 0; x < inOut.columns(); ++x) {
        float excess[3][3] = {};
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int column = x + dx, row = y + dy;
            if (column < 0 || row < 0 || column >= inOut.columns() || row >= inOut.rows()) continue;
            const float most = dx == 0 || dy == 0 ? limits.straight : limits.diagonal;
            excess[dy + 1][dx + 1] = thermalExcess(before(column, row) - before(x, y), most);
          }
        }
        inOut(x, y) = thermalHeight(before(x, y), excess[1][0], excess[1][2], excess[0][1], excess[2][1],
                                    excess[0][0], excess[2][2], excess[0][2], excess[2][0]);
      }
    }
  }
}

}  // namespace teren
