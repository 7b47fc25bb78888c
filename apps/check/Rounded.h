// Measured numbers for a person.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace teren::check {

/// Four digits.
inline std::string rounded(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", number);
  return text.data();
}

}  // namespace teren::check
