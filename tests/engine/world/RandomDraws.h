// Random draws for the world's tests, the same on every machine.
#pragma once

#include <cmath>

#include "teren/Hash.h"

namespace teren {

/// Uniform in [0, 1).
inline double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}

/// A whole number in [0, end).
inline int below(RandomSequence& random, int end) {
  return static_cast<int>(random.next() % static_cast<unsigned>(end));
}

}  // namespace teren
