// What the measures of the report's tests are tried on.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"
#include "teren/World.h"

namespace teren::test {

/// Nobody interrupts.
inline bool always() {
  return true;
}

/// Of faults alone, with their defaults.
inline std::shared_ptr<const World> faultWorld() {
  WorldDescription description;
  description.layers.resize(1);
  description.layers[0].generator = "fault";
  const auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world);
  return *world;
}

}  // namespace teren::test
