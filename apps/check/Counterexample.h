// How a check says at once, from however deep inside, that a property does not hold.
#pragma once

#include <string>

namespace teren::check {

/// Thrown by checks, caught by Property::check. The text is a Finding's.
struct Counterexample {
  std::string text;
};

}  // namespace teren::check
