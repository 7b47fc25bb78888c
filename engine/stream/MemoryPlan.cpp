#include "stream/MemoryPlan.h"

#include <algorithm>
#include <cassert>

namespace teren {

namespace {

std::size_t viewBytes(const MemoryNeeds& needs, int rings) noexcept {
  const std::size_t side = 2 * static_cast<std::size_t>(rings) + 1;
  return side * side * needs.perNode;
}

/// Whether a view of so many rings fits beside so many bytes of maps.
bool fits(const MemoryNeeds& needs, int rings, std::size_t maps) noexcept {
  return needs.fixed + maps + viewBytes(needs, rings) <= needs.cap;
}

/// The largest view that fits beside the least maps; -1: none.
int largestRadius(const MemoryNeeds& needs) noexcept {
  int least = -1, most = needs.radius;  // least fits, or is -1; what is beyond most does not
  while (least < most) {
    const int middle = least + (most - least + 1) / 2;
    if (fits(needs, middle, needs.leastMaps)) {
      least = middle;
    } else {
      most = middle - 1;
    }
  }
  return least;
}

}  // namespace

MemoryPlan planMemory(const MemoryNeeds& needs) noexcept {
  assert(needs.radius >= 0 && needs.leastMaps <= needs.mostMaps);
  if (fits(needs, needs.radius + 1, needs.mostMaps)) return {needs.radius, 1, needs.mostMaps, true};
  const int radius = largestRadius(needs);
  if (radius < 0) return {0, 0, needs.leastMaps, false};
  const std::size_t left = needs.cap - needs.fixed - viewBytes(needs, radius);
  return {radius, 0, std::clamp(left, needs.leastMaps, needs.mostMaps), true};
}

}  // namespace teren
