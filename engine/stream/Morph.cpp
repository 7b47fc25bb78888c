#include "teren/Morph.h"

namespace teren {

Morph::Morph(double tolerance, std::span<const double> errors) noexcept
    : tolerance_(static_cast<float>(tolerance)) {
  constexpr double kLeastGap = 1e-6;  // [m]
  constexpr double kBeyond = 0.25;    // of a node's error: until then its children may not have merged
  for (std::size_t level = 0; level + 1 < std::min(errors.size(), kLevels); ++level) {
    const double own = errors[level], gap = std::max(errors[level + 1] - own, kLeastGap);
    const double from = std::min(kBeyond * own, 0.5 * gap);
    ranges_[level] = {static_cast<float>(own + from), static_cast<float>(1.0 / (gap - from))};
  }
}

}  // namespace teren
