// The aircraft as one sees it from outside: a small low-wing propeller aircraft of a few hundred triangles.
#pragma once

#include <array>

#include "teren/Model.h"

namespace teren {

/// 9 m long, 11 m across, its own zero at the wings. `paint`: red, green and blue of its stripes.
Model aircraftShape(const std::array<float, 3>& paint);

}  // namespace teren
