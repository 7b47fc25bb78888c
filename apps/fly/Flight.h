// The flight itself, without a window: an engine with aircraft in it, moved on frame by frame.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "teren/Engine.h"
#include "teren/FrameBudget.h"

#include "apps/fly/Aircraft.h"
#include "apps/fly/LandEdits.h"
#include "apps/fly/Truck.h"
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

  /// `start` is the first aircraft's; a truck waits where it is told to. Its ruts are edits.
  Flight(std::unique_ptr<Engine> engine, const AircraftStart& start,
         const std::optional<TruckStart>& truck = std::nullopt);

  /// The land is the engine's with these from now on. Their world is the engine's.
  void setEdits(std::unique_ptr<LandEdits> edits) { edits_ = std::move(edits); }
  /// nullptr where nobody digs.
  LandEdits* edits() noexcept { return edits_.get(); }
  /// Refuses where nobody digs, and while the land to come, whose edits those are then, is another than the
  /// one that is seen.
  Result<void> canDig() const;

  /// Engine::settle, edits included, with all objects put on or above the ground as it becomes known.
  void settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress);

  /// Flies on over the present land until the next engine has made as much of its own around the same
  /// objects, then goes over to it with all of them: nobody sees land that is not there. Takes the place of a
  /// next engine given before. It must be without objects, its world of the same pitch. Meanwhile both
  /// engines hold memory, each under its own cap. `world` is the next engine's: edits go over to it at once,
  /// and it is shown once it has them; what is pressed meanwhile shows then.
  void goOverTo(std::unique_ptr<Engine> next, std::shared_ptr<const World> world = nullptr);
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
  Truck* truck() noexcept { return truck_; }  // owned by the engine; nullptr: there is none
  Object& activeObject() noexcept { return engine_->object(active()); }
  /// The eye that detail is chosen for and vertices move with: the active object, wherever the camera is.
  DetailEye detailEye() const {
    const Motion motion = engine_->object(active()).motion();
    return {motion.position, motion.height};
  }

  /// [us] wall time of every update so far.
  const FrameStatistics& engineTimes() const noexcept { return engineTimes_; }

 private:
  void workAtNext(std::chrono::nanoseconds budget);
  bool settleOnce(const std::function<bool(std::size_t done, std::size_t wanted)>& progress);
  /// What edits have made of the ground, to the engine whose land it is. True: it is new.
  bool handEditsOver();
  void pressRuts();

  std::unique_ptr<LandEdits> edits_;
  bool hasNextEdits_ = false;              // the next engine has all those that were there when it came
  std::unique_ptr<Engine> engine_, next_;  // next_ has a scout for each object, so it goes first
  int changes_ = 0;
  std::vector<Aircraft*> aircraft_;
  Truck* truck_ = nullptr;
  FrameStatistics engineTimes_;
  FrameBudget budget_{kFramesPerSecond};
  std::chrono::nanoseconds updated_{0};  // processor time when the engine was done
};

}  // namespace teren
