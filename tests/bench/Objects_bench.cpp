// What a step of moving objects costs: balls high in the air, balls that skim the ground, and the pairs among
// them.
#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>

#include "stream/ObjectSet.h"
#include "tests/engine/stream/PatchGround.h"

namespace teren {
namespace {

constexpr double kPitch = 64.0;
constexpr int kIntervals = 32;

class NoAnswer final : public Ground {
 public:
  std::optional<double> height(const Position&) const override { return std::nullopt; }
  double pitch() const noexcept override { return kPitch; }
};

/// Goes to and fro at 100 m/s.
class Shuttle final : public Object {
 public:
  Shuttle(const Position& position, double height) { motion_ = {position, height, 100.0}; }
  void update(double dt, const Ground&) override {
    motion_.east = -motion_.east;
    motion_.position = *motion_.position.movedBy(motion_.east * dt, 0.0, kPitch);
  }
  Motion motion() const override { return motion_; }
  void place(const Motion& motion) override { motion_ = motion; }
  std::optional<CollisionSphere> collisionSphere() const override { return CollisionSphere{3.0}; }

 private:
  Motion motion_;
};

PatchGround hills() {
  PatchGround ground(kPitch, kIntervals, [](std::int64_t column, std::int64_t row) {
    return 5.0 * std::sin(0.1 * static_cast<double>(column)) * std::cos(0.13 * static_cast<double>(row));
  });
  ground.addAround(16);
  return ground;
}

/// `state.range(0)` objects on a lattice of 50 m in the air.
void advance(benchmark::State& state) {
  const PatchGround ground = hills();
  const NoAnswer unasked;
  ObjectSet set(kPitch);
  const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(state.range(0)))));
  for (std::int64_t k = 0; k < state.range(0); ++k) {
    const double east = 50.0 * static_cast<double>(k % side), north = 50.0 * static_cast<double>(k / side);
    set.add(std::make_unique<Shuttle>(*Position::fromMetres(east - 400.0, north - 400.0, kPitch), 100.0));
  }
  for (auto _ : state) set.advance(1.0 / 60.0, unasked, ground);
}
BENCHMARK(advance)->Arg(1)->Arg(2)->Arg(16)->Arg(128)->Unit(benchmark::kMicrosecond);

/// A ball of `state.range(0)` m.
void dive(benchmark::State& state) {
  const PatchGround ground = hills();
  const GroundSweep sweep(ground, kPitch);
  const MovingBall ball{{10.0, 10.0, 50.0}, {20.0, 30.0, -50.0}, static_cast<double>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(sweep.sweep({}, ball));
}
BENCHMARK(dive)->Arg(1)->Arg(3)->Arg(10)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace teren

BENCHMARK_MAIN();
