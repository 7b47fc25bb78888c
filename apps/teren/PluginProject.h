// A small complete project for a plugin of one's own: what `teren new-plugin` writes.
#pragma once

#include <string>
#include <vector>

#include "teren/PluginRegistry.h"

namespace teren {

struct ProjectFile {
  std::string name;
  std::string text;
};

/// Source, CMakeLists.txt with a test, README.md and, but for a deformer, a world to fly over. `id` is a
/// plugin's: lower-case letters, digits and '-'.
std::vector<ProjectFile> pluginProject(PluginKind kind, const std::string& id);

}  // namespace teren
