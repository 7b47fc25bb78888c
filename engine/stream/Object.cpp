#include "teren/Object.h"

#include <cmath>

namespace teren {

void Object::collided(const Contact& contact) {
  Motion stopped = contact.motion;
  stopped.east = stopped.north = stopped.up = 0.0;
  place(stopped);
}

const Model& Object::model() const {
  static const Model unseen;
  return unseen;
}

Attitude Object::attitude() const {
  const Motion now = motion();
  const double overGround = std::sqrt(now.east * now.east + now.north * now.north);
  if (!(overGround > 0.0) || !std::isfinite(overGround) || !std::isfinite(now.up)) return {};
  return {std::atan2(now.east, now.north), std::atan2(now.up, overGround), 0.0};
}

}  // namespace teren
