#include "height/Surface.h"

namespace teren {

std::array<double, 3> faceNormal(const TrianglePoint& point, double side) noexcept {
  const double scale =
      1.0 / std::sqrt(point.slopeX * point.slopeX + point.slopeY * point.slopeY + side * side);
  return {0.0 - point.slopeX * scale, 0.0 - point.slopeY * scale, side * scale};
}

}  // namespace teren
