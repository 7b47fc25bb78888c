// Small worlds of faults for the engine's tests.
#pragma once

#include <initializer_list>
#include <memory>

#include <gtest/gtest.h>

#include "teren/World.h"

namespace teren::test {

/// A layer of so many faults for each pitch [m], a sixteenth of it high; all with the same samples.
inline std::shared_ptr<const World> faultWorld(std::uint64_t seed, int samples,
                                               std::initializer_list<double> pitches, std::int64_t faults) {
  WorldDescription description;
  description.seed = seed;
  description.samples = samples;
  for (const double pitch : pitches) {
    LayerDescription layer;
    layer.generator = "fault";
    layer.parameters = {{"faults", faults}, {"deviation", pitch / 16.0}};
    layer.pitch = pitch;
    layer.samples = samples;
    description.layers.push_back(layer);
  }
  auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().message);
  return *world;
}

}  // namespace teren::test
