// A flight without a window: objects over ground that is made as they come, timed update by update.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "teren/EditedGround.h"
#include "teren/Engine.h"
#include "teren/Hash.h"
#include "teren/Result.h"
#include "teren/Script.h"
#include "teren/World.h"

#include "apps/teren/DurationLog.h"

namespace teren {

enum class FlightPath { straight, turns };

struct FlightPlan {
  EngineOptions engine;
  Position start;
  FlightPath path = FlightPath::straight;
  double speed = 100.0;                    ///< [m/s]
  int objects = 1;                         ///< the first is active and flies from the start
  std::chrono::microseconds budget{2000};  ///< of an update, > 0
  std::int64_t updates = 1800;             ///< >= 1, 1/60 s each
  bool paced = true;                       ///< 60 updates a second; else one after the other
};

inline constexpr std::int64_t kUpdatesPerSecond = 60;
inline constexpr double kFlightClearance = 100.0;  ///< [m] above ground
/// [m] The other objects begin this far apart from one another, on a square spiral around the first.
inline constexpr double kObjectDistance = 250.0;

/// [byte] What was held at one moment of a flight.
struct HeldMemory {
  std::int64_t seconds = 0;  ///< flown
  std::size_t resident = 0;  ///< of the whole program, in memory
  std::size_t engine = 0;    ///< EngineFigures::bytes
  std::size_t queries = 0;   ///< World::queryBytes: maps for ground that the engine did not have in time
  std::size_t used = 0;      ///< what the program has allocated and not freed, and its allocator's headers
  std::size_t unused = 0;    ///< what the allocator keeps beside that
};

/// [px] How wrong the pictures were after the first ten seconds: PixelError::max after each update of what
/// the active object may see where it flies (PictureAhead).
struct FlownPixelError {
  double wanted = 0.0;
  std::int64_t frames = 0;
  std::int64_t reached = 0;  ///< frames with ground under the object and no more than the wanted error
  Percentiles seen;          ///< where there was ground under the object
};

/// What came of a flight. The hash is of the ground's height (level-0 triangles; 8 bytes a height, little-
/// endian, -0 as 0) under each object after each update; where the engine had none there, of the height that
/// World::query, or EditedGround::query, gives for the place. So it depends on the world, its edits, the
/// start, path, speed, objects and number of updates alone; what the engine failed to have in time is counted
/// by `missing`.
struct FlightResult {
  std::int64_t updates = 0;
  Percentiles cpu;         ///< CPU time of the updating thread
  Percentiles wall;        ///< wall time of the same updates
  Percentiles spinner;     ///< wall time of empty loops as long as the budget, between the updates
  Percentiles spinnerCpu;  ///< CPU time of the same loops: what the machine adds to the updates' too
  EngineFigures engine;
  std::int64_t missing = 0;  ///< updates after the first second with no level-0 ground under some object
  std::uint64_t hash = 0;
  std::optional<std::uint64_t> hashAt30Seconds;    ///< of a flight that lasts as long
  std::size_t residentBytes = 0;                   ///< of the whole program, at the end
  std::optional<std::size_t> residentAt60Seconds;  ///< and after the first minute, if there is one
  std::vector<HeldMemory> memory;                  ///< after every whole minute
  std::optional<FlownPixelError> pixelError;       ///< of a view of detail by error
};

/// Flies once.
class MeasuredFlight {
 public:
  /// Refuses what Engine::create refuses, and objects that would begin beyond the world. With `edits`, which
  /// are of this world and at rest, all of them are there before the first update.
  static Result<std::unique_ptr<MeasuredFlight>> create(std::shared_ptr<const World> world,
                                                        const FlightPlan& plan,
                                                        std::unique_ptr<EditedGround> edits = nullptr);

  /// Flies to the end, or until `progress(done, updates)`, asked before each update, returns false.
  ///
  /// After an update an empty loop lasts as long as the budget. Paced, it is left out where it would delay
  /// the next update, but for one a second. Not paced, the next update waits until workers have done what
  /// they were given, at most as long as a paced one would: so they are never asked for more than in a paced
  /// flight, however busy the machine is.
  FlightResult fly(const std::function<bool(std::int64_t done, std::int64_t updates)>& progress);

 private:
  MeasuredFlight(std::shared_ptr<const World> world, const FlightPlan& plan,
                 std::unique_ptr<EditedGround> edits);
  /// [m] The level-0 triangles there, whatever the engine has.
  double drawnHeight(const Position& position) const;
  Result<std::unique_ptr<Object>> makeObject(int index) const;
  void update();
  void lookAtGround(std::int64_t update);
  void lookAtPicture(std::int64_t update);
  void lookAtMemory(std::int64_t seconds);
  void spin();
  void waitForWorkers(std::chrono::steady_clock::time_point most) const;

  std::shared_ptr<const World> world_;
  FlightPlan plan_;
  std::unique_ptr<EditedGround> edits_;  // may be nullptr
  std::unique_ptr<Engine> engine_;
  DurationLog cpu_, wall_, spinner_, spinnerCpu_;
  std::vector<float> pixelErrors_;  // of frames; room for all is reserved and touched
  Fnv1a hash_;
  FlightResult result_;
};

}  // namespace teren
