// What a node costs of a layer that is a continuous field, beside layers whose maps are blended, and beside
// the field's samples without an engine around them; what its error costs, and calibrating a world's errors.
#include <cstdint>
#include <memory>

#include <benchmark/benchmark.h>

#include "teren/ContinuousGenerator.h"
#include "teren/World.h"

#include "patch/ErrorCalibration.h"
#include "patch/MeshTask.h"
#include "patch/NodeGap.h"
#include "patch/NodeTask.h"
#include "tests/bench/MedianReporter.h"
#include "world/Layer.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

constexpr int kBlock = 8;

struct Subject {
  const char* generator;
  bool keepMaps = false;  ///< all maps were made before
  bool alone = false;     ///< a field's samples only
};

/// Makes 8 x 8 level-0 nodes of 33 x 33 samples of one layer. Each needs four maps; without `keepMaps`, about
/// one of them is new.
void makeNodes(benchmark::State& state, const Subject& subject) {
  WorldDescription description;
  description.layers.resize(1);
  description.layers[0].generator = subject.generator;
  const auto world = World::create(description, *PluginRegistry::standard());
  if (!world) return state.SkipWithError(world.error().message.c_str());
  const Layer& layer = (*world)->layers()[0];
  BaseMapStore maps(std::size_t{64} << 20);
  HeightMap samples(33, 33);
  const auto make = [&](std::int64_t i, std::int64_t j) {
    if (subject.alone) {
      const FieldRequest request = layer.fieldRequest({.i = i, .j = j}, 0, 33, 33);
      benchmark::DoNotOptimize(layer.field()->beginField(request, samples.view())->step(Slice::unlimited()));
    } else {
      NodeTask task(**world, {0, i, j}, maps);
      benchmark::DoNotOptimize(task.step(Slice::unlimited()));
    }
  };
  std::int64_t east = 0;
  const auto makeBlock = [&] {
    for (int node = 0; node < kBlock * kBlock; ++node) make(east + node % kBlock, node / kBlock);
  };
  if (subject.keepMaps) makeBlock();
  for (auto _ : state) {
    makeBlock();
    if (!subject.keepMaps) east += kBlock;
  }
  state.SetItemsProcessed(state.iterations() * kBlock * kBlock);
}

/// The share of a node that its error costs: looking through its samples, and asking for the estimate.
void nodeErrors(benchmark::State& state) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return state.SkipWithError(world.error().message.c_str());
  BaseMapStore maps(std::size_t{64} << 20);
  NodeTask task(**world, {1, 0, 0}, maps);
  benchmark::DoNotOptimize(task.step(Slice::unlimited()));
  const HeightMap heights = task.takeHeights();
  for (auto _ : state) {
    benchmark::DoNotOptimize((*world)->nodeErrors().estimate(1, largestBend(heights.view())));
  }
}

/// The world shipped, with maps that are kept: what a node costs beside its error.
void standardNodes(benchmark::State& state, bool withCoarser) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return state.SkipWithError(world.error().message.c_str());
  BaseMapStore maps(std::size_t{64} << 20);
  for (auto _ : state) {
    NodeTask task(**world, {1, 0, 0}, maps, withCoarser);
    benchmark::DoNotOptimize(task.step(Slice::unlimited()));
  }
}

/// The mesh of such a node's interior, whose vertices draw near to the next coarser level or do not.
void standardMeshes(benchmark::State& state, bool withCoarser) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return state.SkipWithError(world.error().message.c_str());
  BaseMapStore maps(std::size_t{64} << 20);
  NodeTask task(**world, {1, 0, 0}, maps, withCoarser);
  benchmark::DoNotOptimize(task.step(Slice::unlimited()));
  const NodeHeights heights(std::make_shared<const HeightMap>(task.takeHeights()),
                            withCoarser ? std::make_shared<const HeightMap>(task.takeCoarser()) : nullptr);
  GridIndices indices;
  std::int64_t vertices = 0;
  for (auto _ : state) {
    MeshTask mesh({{1, 0, 0}, {heights}}, Piece::interior, (*world)->spacing(1), indices);
    benchmark::DoNotOptimize(mesh.step(Slice::unlimited()));
    vertices += static_cast<std::int64_t>(mesh.takeResult()->vertices.size());
  }
  state.SetItemsProcessed(vertices);
}

/// All levels of the world shipped.
void calibrateWorld(benchmark::State& state) {
  for (auto _ : state) {
    const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
    if (!world) return state.SkipWithError(world.error().message.c_str());
    ErrorCalibration calibration(**world);
    benchmark::DoNotOptimize(calibration.step(Slice::unlimited()));
  }
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  const auto add = [](const char* name, const Subject& subject) {
    benchmark::RegisterBenchmark(name, makeNodes, subject)->Unit(benchmark::kMicrosecond);
  };
  add("fault/maps-kept", {.generator = "fault", .keepMaps = true});
  add("fault/maps", {.generator = "fault"});
  add("spectral/maps", {.generator = "spectral"});
  add("noise/field", {.generator = "noise"});
  add("noise/alone", {.generator = "noise", .alone = true});
  benchmark::RegisterBenchmark("standard/maps-kept", standardNodes, false)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("standard/coarser-too", standardNodes, true)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("standard/mesh", standardMeshes, false)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("standard/moving-mesh", standardMeshes, true)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("standard/error", nodeErrors)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("standard/calibration", calibrateWorld)->Unit(benchmark::kMillisecond);
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const char* blended : {"fault/maps-kept", "fault/maps", "spectral/maps"})
    reporter.printRatio(blended, "noise/field", 0.0);
  reporter.printRatio("noise/field", "noise/alone", 0.0);
  reporter.printRatio("standard/coarser-too", "standard/maps-kept", 0.0);
  reporter.printRatio("standard/moving-mesh", "standard/mesh", 0.0);
  reporter.printRatio("standard/error", "standard/maps-kept", 0.0);
  reporter.printRatio("standard/calibration", "standard/maps-kept", 0.0);
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
