// A world's description as one number, so that what belongs to a world can be told from what belongs to
// another.
#pragma once

#include <cstdint>
#include <span>

#include "teren/PluginRegistry.h"
#include "teren/World.h"

namespace teren {

/// Of everything a checked description says, defaults filled in: two that describe the same world differently
/// (a default named or left out, 2 or 2.0, -0 or 0) have one hash. `layers` are the description's, each with
/// its name, and have passed World::create's checks (assert). Versions of plugins do not count.
std::uint64_t descriptionHash(const WorldDescription& world, std::span<const LayerDescription> layers,
                              const PluginRegistry& registry);

}  // namespace teren
