// The flight itself, without a window: an engine with aircraft in it, moved on frame by frame.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "teren/Engine.h"
#include "teren/FrameBudget.h"

#include "apps/fly/Aircraft.h"
#include "apps/window/FrameStatistics.h"

namespace teren {

/// Flies an aircraft, and a second one that comes from behind, kLeft to the left and kBehind it, faster,
/// follows a script straight on and so passes on the left. One of them, the active one, is steered.
class Flight {
 public:
  static constexpr double kFramesPerSecond = 60.0;       // wanted: the engine gets what they leave
  static constexpr double kLongestStep = 0.1;            // [s]
  static constexpr double kLeft = 60.0, kBehind = 60.0;  // [m]
  static constexpr double kLower = 45.0;                 // [m] so that it stays in the picture
  static constexpr double kFaster = 40.0;                // [m/s]

  /// `start` is the first aircraft's.
  Flight(std::unique_ptr<Engine> engine, const AircraftStart& start);

  /// Engine::settle, with the aircraft put above the ground as it becomes known.
  void settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress);

  /// Begins a frame: moves all by dt [s], brought between 0 and kLongestStep, and lets the engine work for as
  /// long as the frames before have left it.
  void advance(double dt);
  /// Ends the frame, on the same thread.
  void frameDone();
  void nextObject();

  Engine& engine() noexcept { return *engine_; }
  const Engine& engine() const noexcept { return *engine_; }
  std::size_t active() const noexcept { return engine_->active(); }
  const std::vector<Aircraft*>& aircraft() const noexcept { return aircraft_; }  // owned by the engine
  Object& activeObject() noexcept { return engine_->object(active()); }

  /// [us] wall time of every update so far.
  const FrameStatistics& engineTimes() const noexcept { return engineTimes_; }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<Aircraft*> aircraft_;
  FrameStatistics engineTimes_;
  FrameBudget budget_{kFramesPerSecond};
  std::chrono::nanoseconds updated_{0};  // processor time when the engine was done
};

}  // namespace teren
