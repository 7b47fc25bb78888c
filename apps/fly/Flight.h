// The flight itself, without a window: an engine with aircraft in it, moved on frame by frame.
#pragma once

#include <chrono>
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

  /// Flies on over the present land until the next engine has made as much of its own around the same
  /// objects, then goes over to it with all of them: nobody sees land that is not there. Takes the place of a
  /// next engine given before. It must be without objects, its world of the same pitch. Meanwhile both
  /// engines hold memory, each under its own cap.
  void goOverTo(std::unique_ptr<Engine> next);
  /// Whether a next land is being made.
  bool isLeaving() const noexcept { return next_ != nullptr; }
  /// How often it has gone over to another engine.
  int changes() const noexcept { return changes_; }

  /// Engine::setDetail, of the next engine too. Nothing where the view is of one level.
  Result<void> setDetail(const DetailSettings& detail);

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
  void workAtNext(std::chrono::nanoseconds budget);

  std::unique_ptr<Engine> engine_, next_;  // next_ has a scout for each object, so it goes first
  int changes_ = 0;
  std::vector<Aircraft*> aircraft_;
  FrameStatistics engineTimes_;
  FrameBudget budget_{kFramesPerSecond};
  std::chrono::nanoseconds updated_{0};  // processor time when the engine was done
};

}  // namespace teren
