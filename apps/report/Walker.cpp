#include "apps/report/Walker.h"

#include <optional>

namespace teren {

void Walker::update(double dt, const Ground& ground) {
  if (motion_.north != 0.0) {
    const Result<Position> next = motion_.position.movedBy(0.0, motion_.north * dt, ground.pitch());
    if (next) motion_.position = *next;
  }
  if (const std::optional<double> height = ground.height(motion_.position)) {
    motion_.height = *height + clearance_;
  }
}

}  // namespace teren
