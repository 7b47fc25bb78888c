#include "qt/Viewer.h"

#include <cmath>
#include <numbers>
#include <string>

#include "teren/Parameter.h"

namespace teren {
namespace {

Error outside(const char* member, const std::string& value, const std::string& expected) {
  return Error{std::string("the viewer's ") + member + " is " + value + ", expected " + expected};
}

bool isInWorld(std::int64_t patch) {
  return -kMaxPatch <= patch && patch <= kMaxPatch;
}
bool isInPatch(double offset) {
  return 0.0 <= offset && offset < 1.0;
}

}  // namespace

Result<void> check(const Viewer& viewer) {
  const Position& at = viewer.position;
  if (!isInWorld(at.i) || !isInWorld(at.j)) {
    return outside("patch", std::to_string(at.i) + ", " + std::to_string(at.j),
                   "numbers from " + std::to_string(-kMaxPatch) + " to " + std::to_string(kMaxPatch));
  }
  if (!isInPatch(at.u) || !isInPatch(at.v)) {
    return outside("place in its patch", numberText(at.u) + ", " + numberText(at.v),
                   "numbers from 0 to less than 1");
  }
  if (!(Viewer::kLowest <= viewer.heightAboveGround && viewer.heightAboveGround <= Viewer::kHighest)) {
    return outside("heightAboveGround", numberText(viewer.heightAboveGround) + " m",
                   numberText(Viewer::kLowest) + " to " + numberText(Viewer::kHighest) + " m");
  }
  if (!std::isfinite(viewer.heading)) {
    return outside("heading", numberText(viewer.heading), "a finite angle in radians");
  }
  if (!(std::abs(viewer.pitch) <= std::numbers::pi / 2.0)) {
    return outside("pitch", numberText(viewer.pitch), "-pi/2 to pi/2 radians");
  }
  return {};
}

}  // namespace teren
