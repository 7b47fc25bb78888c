// What it costs to choose the view of a flight: processor time of Selection alone, and of whole updates of an
// engine that follows, at several pixel errors. Percentiles over all choices or updates, after a second of
// warming up.
//
//   bench-selection [SECONDS [DISTANCE]]     of flight at 60 updates a second; [m] seen. 20 and 20000
//   without.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/PluginRegistry.h"
#include "teren/World.h"

#include "patch/ErrorCalibration.h"
#include "stream/Selection.h"
#include "tests/bench/Timing.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

constexpr double kStep = 1.0 / 60.0;  // [s]
constexpr double kSpeed = 300.0;      // [m/s]
constexpr double kHeight = 400.0;     // [m]
constexpr std::size_t kWarm = 60;     // updates

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Position placeAt(std::size_t step, double pitch) {
  return *Position::fromMetres(123.0, kSpeed * kStep * static_cast<double>(step), pitch);
}

class Flyer final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

void timeSelection(const World& world, const DetailSettings& detail, std::size_t steps) {
  Selection::Ground ground{world.pitch(), -1500.0, 1500.0, {}};
  for (int level = 0; level <= world.topLevel(); ++level) {
    ground.errors.push_back(world.nodeErrors().estimate(level));
  }
  Selection selection(std::move(ground));
  std::vector<double> micros;
  for (std::size_t step = 0; step < steps; ++step) {
    const Viewer viewer{placeAt(step, world.pitch()), kHeight, detail};
    const double start = processorSeconds();
    if (!selection.choose({&viewer, 1}, 1.0)) std::abort();
    selection.keep();
    if (step >= kWarm) micros.push_back(1e6 * (processorSeconds() - start));
  }
  std::printf("%10.1f %8zu %8zu %10.1f %10.1f", detail.pixelError, selection.kept().size(),
              selection.kept().leaves(), percentile(micros, 0.5), percentile(micros, 0.99));
}

void timeUpdates(const std::shared_ptr<const World>& world, const DetailSettings& detail, std::size_t steps) {
  auto engine = Engine::create(world, {.view = {.detail = detail}});
  if (!engine) std::abort();
  auto& flyer = static_cast<Flyer&>((*engine)->add(std::make_unique<Flyer>()));
  std::vector<double> micros;
  for (std::size_t step = 0; step < steps; ++step) {
    flyer.place = {placeAt(step, world->pitch()), kHeight, 0.0, kSpeed};
    const double start = processorSeconds();
    (*engine)->update(kStep, std::chrono::microseconds(2000));
    if (step >= kWarm) micros.push_back(1e6 * (processorSeconds() - start));
  }
  const EngineFigures figures = (*engine)->figures();
  std::printf(" %10.1f %10.1f %10.1f %8zu %8zu\n", percentile(micros, 0.5), percentile(micros, 0.99),
              percentile(micros, 0.999), figures.nodes, figures.pending);
}

int run(std::size_t steps, double distance) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) {
    std::fprintf(stderr, "%s\n", world.error().message.c_str());
    return 1;
  }
  ErrorCalibration calibration(**world);
  while (!calibration.step(Slice::unlimited())) {
  }
  std::printf("%10s %8s %8s %10s %10s %10s %10s %10s %8s %8s\n", "pixels", "chosen", "leaves", "choose p50",
              "p99 [us]", "update p50", "p99", "p999 [us]", "drawn", "pending");
  for (const double pixelError : {2.0, 4.0, 8.0, 16.0, 32.0}) {
    const DetailSettings detail{.pixelError = pixelError, .distance = distance};
    timeSelection(**world, detail, steps);
    timeUpdates(*world, detail, steps);
  }
  return 0;
}

}  // namespace
}  // namespace teren

int main(int count, char** words) {
  const double seconds = count > 1 ? std::atof(words[1]) : 20.0;
  const double distance = count > 2 ? std::atof(words[2]) : 20'000.0;
  return teren::run(static_cast<std::size_t>(60.0 * seconds), distance);
}
