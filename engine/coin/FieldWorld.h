// The world and the view that a SoTerrain's fields describe, checked as strictly as the command line's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "teren/Engine.h"
#include "teren/Result.h"

namespace teren {

/// What a person wrote into the fields; see SoTerrain for their meaning.
struct TerrainFields {
  std::string seed, world, generator;
  std::vector<std::string> parameters;
  float viewDistance = 0.0F;
  float pixelError = 0.0F;
  int viewLevel = 0;
};

/// An engine for the fields, with no object yet. Errors name the field and its value. Plugins are looked for
/// with PluginRegistry::standard(), whose first call loads them.
Result<std::unique_ptr<Engine>> makeEngine(const TerrainFields& fields);

}  // namespace teren
