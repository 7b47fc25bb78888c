// Short ways to describe worlds of noise and faults.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "teren/World.h"

namespace teren {

inline LayerDescription noise(double pitch, double deviation, int samples = 65,
                              const std::string& name = "") {
  LayerDescription layer;
  layer.name = name;
  layer.generator = "hash-noise";
  layer.parameters = {{"deviation", deviation}};
  layer.pitch = pitch;
  layer.samples = samples;
  return layer;
}

inline LayerDescription fault(double pitch, double deviation, int samples = 65) {
  LayerDescription layer = noise(pitch, deviation, samples);
  layer.generator = "fault";
  return layer;
}

inline WorldDescription worldOf(std::vector<LayerDescription> layers, std::uint64_t seed = 1) {
  WorldDescription world;
  world.seed = seed;
  world.layers = std::move(layers);
  return world;
}

}  // namespace teren
