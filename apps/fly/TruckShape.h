// The truck as one sees it from outside: a body, a cabin and four thick wheels.
#pragma once

#include "teren/Model.h"

namespace teren {

/// 7 m long, 3.6 m wide, 3.4 m high; its own zero on the ground in its middle.
Model truckShape();

}  // namespace teren
