// Worlds for tests: the project's own plugins, and the modules of this room ("hash-noise", "value-noise",
// "hostile", ...).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/World.h"

namespace teren {

inline const PluginRegistry& testRegistry() {
  static const std::shared_ptr<const PluginRegistry> registry = [] {
    std::vector<std::filesystem::path> folders = PluginRegistry::searchPath();
    folders.emplace_back(TEREN_TEST_WORLD_MODULES);
    return PluginRegistry::load(folders);
  }();
  return *registry;
}

/// How many maps the generator "hash-noise" has begun so far.
inline int noiseMapsBegun() {
  const std::string file = TEREN_TEST_WORLD_MODULES "/teren-hash-noise.so";
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (module == nullptr) return -1;
  const auto count = reinterpret_cast<int (*)()>(dlsym(module, "terenTestMapsBegun"));
  const int begun = count();
  dlclose(module);
  return begun;
}

inline std::shared_ptr<const World> makeTestWorld(const WorldDescription& description) {
  Result<std::shared_ptr<const World>> world = World::create(description, testRegistry());
  if (!world) {
    ADD_FAILURE() << world.error().message;
    std::abort();
  }
  return *world;
}

}  // namespace teren
