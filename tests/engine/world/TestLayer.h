// Layers built directly, without a registry: for tests that bring their own generators.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "world/BaseMap.h"
#include "world/Layer.h"
#include "world/LayerSampler.h"

namespace teren {

struct LayerShape {
  std::uint64_t seed = 1;
  int worldBits = 5;   ///< 2^worldBits intervals a patch
  int pitchShift = 0;  ///< layer pitch = 64 m times 2^pitchShift
  int layerBits = 5;   ///< 2^layerBits intervals a layer pitch
  BlendKernel kernel = BlendKernel::smooth;
  bool preserveVariance = true;
};

inline Layer makeTestLayer(const LayerShape& shape, std::shared_ptr<const Generator> generator,
                           std::vector<std::shared_ptr<const Filter>> filters = {},
                           std::shared_ptr<MessageBox> messages = std::make_shared<MessageBox>()) {
  HeightRange range = generator->range();
  for (const auto& filter : filters) range = filter->range(range);
  std::vector<std::string> ids = {"generator"};
  for (std::size_t k = 0; k < filters.size(); ++k) ids.push_back("filter-" + std::to_string(k));
  LayerPlugins plugins{std::move(generator), std::move(filters), std::move(ids), {}};
  if (plugins.filters.empty()) plugins.field = asContinuous(*plugins.generator);
  return Layer("test", shape.seed, 64.0, shape.worldBits, shape.pitchShift, shape.layerBits, shape.kernel,
               shape.preserveVariance, std::move(plugins), range, std::move(messages));
}

inline BaseMap makeMap(const Layer& layer, std::int64_t i, std::int64_t j, int mapLevel = 0) {
  BaseMapTask task(layer, {0, mapLevel, i, j});
  while (!task.step(Slice::unlimited())) {
  }
  return task.result();
}

/// The four maps of the cell north-east of lattice point (i, j).
inline CellMaps makeCellMaps(const Layer& layer, std::int64_t i, std::int64_t j, int mapLevel = 0) {
  return {makeMap(layer, i, j, mapLevel), makeMap(layer, i + 1, j, mapLevel),
          makeMap(layer, i, j + 1, mapLevel), makeMap(layer, i + 1, j + 1, mapLevel)};
}

}  // namespace teren
