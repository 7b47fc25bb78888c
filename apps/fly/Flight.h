// The flight itself, without a window: an engine with aircraft in it, moved on frame by frame.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "teren/Engine.h"

#include "apps/fly/Aircraft.h"
#include "apps/window/FrameStatistics.h"

namespace teren {

/// Flies a leader and a wingman; one of them, the active one, is steered.
class Flight {
 public:
  /// How long each update may work.
  static constexpr std::chrono::milliseconds kBudget{4};
  static constexpr double kLongestStep = 0.1;  // [s]

  /// `start` is the leader's.
  Flight(std::unique_ptr<Engine> engine, const AircraftStart& start);

  /// Engine::settle, with the aircraft put above the ground as it becomes known.
  void settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress);

  /// Moves all by dt [s], brought between 0 and kLongestStep, and lets the engine work within its budget.
  void advance(double dt, const AircraftControls& controls);
  void nextObject();

  Engine& engine() noexcept { return *engine_; }
  const Engine& engine() const noexcept { return *engine_; }
  std::size_t active() const noexcept { return engine_->active(); }
  const std::vector<Aircraft*>& aircraft() const noexcept { return aircraft_; }  // owned by the engine
  Aircraft& activeAircraft() noexcept { return *aircraft_[active()]; }

  /// [us] wall time of every update so far.
  const FrameStatistics& engineTimes() const noexcept { return engineTimes_; }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<Aircraft*> aircraft_;
  FrameStatistics engineTimes_;
};

}  // namespace teren
