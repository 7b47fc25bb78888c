// How long a frame of the standard world takes at 1280 x 720, with shaders and without, to the end of
// drawing; and what logarithmic depth costs, which keeps OpenGL from sorting out hidden fragments early.
//   xvfb-run -a build/release/bin/bench-coin --benchmark_repetitions=9
//   --benchmark_enable_random_interleaving=true
#include <cstdlib>

#include <Inventor/SoDB.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QGuiApplication>
#include <benchmark/benchmark.h>

#include "teren/Engine.h"

#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

/// 120 m above the ground, in the default view; heading [degree] chooses what is seen.
void drawFrames(benchmark::State& state, double heading, double pitch, bool logarithmic = false) {
  const Stage stage;
  stage.terrain->logarithmicDepth = logarithmic;
  stage.terrain->settle();
  const double ground = *stage.terrain->engine()->drawnHeight(Position{});
  stage.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground + 120.0)), heading, pitch);
  OffscreenView view(1280, 720);
  for (int frame = 0; frame < 5; ++frame) view.draw(stage.root, kMagenta);
  for (auto _ : state) view.draw(stage.root, kMagenta);
  state.counters["triangles"] = static_cast<double>(stage.terrain->drawnTriangles());
  state.counters["bufferBytes"] = static_cast<double>(stage.terrain->bufferBytes());
}

void withShaders(benchmark::State& state) {
  drawFrames(state, static_cast<double>(state.range(0)), -8.0);
}

void withLogarithmicDepth(benchmark::State& state) {
  drawFrames(state, static_cast<double>(state.range(0)), -8.0, true);
}

void withoutShaders(benchmark::State& state) {
  setenv("TEREN_NO_SHADERS", "1", 1);
  drawFrames(state, static_cast<double>(state.range(0)), -8.0);
  unsetenv("TEREN_NO_SHADERS");
}

BENCHMARK(withShaders)
    ->Arg(90)
    ->Arg(30)
    ->Arg(270)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(withLogarithmicDepth)
    ->Arg(90)
    ->Arg(30)
    ->Arg(270)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(withoutShaders)->Arg(90)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const QGuiApplication application(argc, argv);
  SoDB::init();
  SoTerrain::initClass();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
