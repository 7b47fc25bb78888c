// How long a frame of the standard world takes at 1280 x 720, with shaders and without, to the end of
// drawing; what logarithmic depth costs; and what a frame of a 20 km view costs at a pixel error, and its
// parts. On a busy machine processor time tells more than the clock.
//   xvfb-run -a build/release/bin/bench-coin --benchmark_repetitions=9
//   --benchmark_enable_random_interleaving=true
#include <array>
#include <cstdlib>
#include <map>
#include <memory>

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

/// The land of a 20 km view, settled; kept, because making it takes seconds.
const Stage& farLand(double pixelError) {
  static std::map<double, std::unique_ptr<const Stage>> lands;
  std::unique_ptr<const Stage>& stage = lands[pixelError];
  if (stage) return *stage;
  stage = std::make_unique<const Stage>();
  stage->terrain->viewDistance = 20e3F;
  stage->terrain->pixelError = static_cast<float>(pixelError);
  stage->camera->nearDistance = 0.5F;
  stage->camera->farDistance = 100e3F;
  stage->terrain->settle();
  const double ground = *stage->terrain->engine()->drawnHeight(Position{});
  stage->look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground + 160.0)), 0.0, -8.0);
  OffscreenView(1280, 720).draw(stage->root, kMagenta);  // tells the engine of the picture
  stage->terrain->settle();
  return *stage;
}

/// How a frame of the 20 km view is drawn: the differences tell what its parts cost.
struct Part {
  const char* name;
  int width = 1280, height = 720;
  bool logarithmic = true, wet = true, tinted = false;
};
constexpr std::array kParts{Part{"all"},
                            Part{.name = "ordinary depth", .logarithmic = false},
                            Part{.name = "dry", .wet = false},
                            Part{.name = "one colour", .tinted = true},
                            Part{.name = "a quarter of the pixels", .width = 640, .height = 360},
                            Part{.name = "hardly a pixel", .width = 32, .height = 18}};
constexpr int kHeadings = 6;

/// Each frame looks in another direction.
void farView(benchmark::State& state) {
  const Stage& stage = farLand(static_cast<double>(state.range(0)));
  const Part& part = kParts[static_cast<std::size_t>(state.range(1))];
  state.SetLabel(part.name);
  stage.terrain->logarithmicDepth = part.logarithmic;
  stage.terrain->waterLevel = part.wet ? -150.0F : -1e6F;
  if (part.tinted) stage.terrain->setTint([](const Mesh&) { return SbColor(0.5F, 0.6F, 0.4F); });
  OffscreenView view(part.width, part.height);
  const SbVec3f eye = stage.camera->position.getValue();
  int frame = 0;
  std::size_t triangles = 0;
  const auto draw = [&] {
    stage.look(eye, 360.0 / kHeadings * (frame++ % kHeadings), -8.0);
    view.draw(stage.root, kMagenta);
    triangles += stage.terrain->drawnTriangles();
  };
  while (frame < 4 * kHeadings) draw();  // uploads
  triangles = 0;
  for (auto _ : state) draw();
  if (part.tinted) stage.terrain->setTint({});
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(state.iterations());
  state.counters["disc"] = static_cast<double>(stage.terrain->scene()->triangles());
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
BENCHMARK(farView)
    ->ArgNames({"pixelError", "part"})
    ->ArgsProduct({{4, 8, 16, 32}, {0, 1, 2, 3, 4, 5}})
    ->Iterations(4 * kHeadings)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

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
