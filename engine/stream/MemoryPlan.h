// How the byte cap is shared out (law 6): how far the view may reach and how many base maps may be kept.
#pragma once

#include <cstddef>

namespace teren {

/// What there is to hold. Bytes.
struct MemoryNeeds {
  std::size_t cap = 0;
  std::size_t fixed = 0;    ///< whatever the view: ground under objects, tasks in flight, shared index lists
  std::size_t perNode = 0;  ///< of a drawn node, the renderer's share included
  std::size_t leastMaps = 0;  ///< base maps below which every node would have to make its own again
  std::size_t mostMaps = 0;   ///< base maps beyond which more are of no use; >= leastMaps
  int radius = 0;             ///< of the view asked for, >= 0

  friend bool operator==(const MemoryNeeds&, const MemoryNeeds&) = default;
};

struct MemoryPlan {
  int radius = 0;            ///< of the view, at most what was asked for
  int margin = 0;            ///< 0 or 1: rings of nodes around it that stay once drawn, though unseen
  std::size_t mapBytes = 0;  ///< capacity for base maps
  bool fits = true;          ///< false: not even radius 0 with the least maps does

  friend bool operator==(const MemoryPlan&, const MemoryPlan&) = default;
};

/// Gives up, in this order and only as far as needed: the margin of unseen nodes, base maps, the view's rim.
/// Everything that is planned fits under the cap, so nothing has to be taken back by trial and error, and
/// the same needs always give the same plan. O(log radius).
MemoryPlan planMemory(const MemoryNeeds& needs) noexcept;

}  // namespace teren
