#include "generators/sand/Repose.h"

#include "generators/numbers/Tangent.h"

namespace teren {
namespace {

double within(double value, double least, double most, double otherwise) noexcept {
  if (value != value) return otherwise;
  return value < least ? least : value > most ? most : value;
}

}  // namespace

Repose reposeOf(double dryAngle, double moisture) noexcept {
  const double angle =
      within(dryAngle, 1.0, 60.0, kDryRepose) + kMoistureGain * within(moisture, 0.0, 1.0, 0.0);
  return {tangentOfDegrees(angle - kRestBelow), tangentOfDegrees(angle + kSlideThreshold),
          tangentOfDegrees(angle + kDivideThreshold)};
}

}  // namespace teren
