// Ways through the world as functions of time, and an object that follows one. They are computed with
// + - * / sqrt fma and floor only, so a script leads to the same bits on every machine (law 1), and from the
// time alone, so nothing drifts.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "teren/Object.h"
#include "teren/Result.h"

namespace teren {

/// Immutable, so any thread may ask.
class Script {
 public:
  virtual ~Script() = default;
  /// The motion `seconds` (finite, >= 0; less, and NaN, count as 0) after the beginning. Refuses what lies
  /// beyond the world. Positions are within kScriptError of the exact path times the distance gone, plus 1e-9
  /// m.
  virtual Result<Motion> at(double seconds) const = 0;
};
inline constexpr double kScriptError = 1e-14;  ///< [m per m]

/// Where a script begins and how fast it goes.
struct Course {
  Position start = {};
  double height = 0.0;             ///< [m] kept all the way
  double east = 0.0, north = 1.0;  ///< the direction at the start; any length but 0
  double speed = 100.0;            ///< [m/s] over ground, >= 0
  double pitch = 64.0;             ///< [m] the world's
};

/// Straight on. Refuses, like all of these, what is not finite, with one sentence.
Result<std::shared_ptr<const Script>> straightScript(const Course& course);

/// Round and round: `radius` > 0 [m]; the centre lies to the right of the start (to the left with
/// `clockwise` false).
Result<std::shared_ptr<const Script>> circleScript(const Course& course, double radius,
                                                   bool clockwise = true);

/// A winding way that gets on: eight legs of kTurnLegSeconds each, again and again; on leg k the heading
/// changes evenly by kTurnLegEighths[k] eighths of a full turn, to the right if positive, and after the last
/// it is what it was at first.
Result<std::shared_ptr<const Script>> turnsScript(const Course& course);
inline constexpr double kTurnLegSeconds = 15.0;
inline constexpr std::array<int, 8> kTurnLegEighths{0, 2, -2, -3, 3, -1, 2, -1};

struct Waypoint {
  Position position = {};
  double height = 0.0;  ///< [m]
};

/// In straight lines from one point to the next at `speed` [m/s] > 0 through the air, with corners at the
/// points; at the last one it stands (velocity 0), or with `loop` it goes on to the first. At least one
/// point.
Result<std::shared_ptr<const Script>> waypointScript(const std::vector<Waypoint>& points, double speed,
                                                     double pitch, bool loop = false);

/// How a ScriptedObject follows its script and what else it is.
struct ScriptedObjectOptions {
  std::string name = "scripted object";
  /// [m] Set: this high above the ground, as last known, in place of the script's height.
  std::optional<double> clearance = {};
  std::optional<CollisionSphere> sphere = {};
  Model model = {};
};

/// Follows a script, from its beginning; where the script leaves the world, it stands still. What stops it
/// (a collision) ends the script.
class ScriptedObject : public Object {
 public:
  explicit ScriptedObject(std::shared_ptr<const Script> script, ScriptedObjectOptions options = {});

  std::string name() const override { return options_.name; }
  void update(double dt, const Ground& ground) override;
  Motion motion() const override { return motion_; }
  void place(const Motion& motion) override;
  std::optional<CollisionSphere> collisionSphere() const override { return options_.sphere; }
  const Model& model() const override { return options_.model; }

  /// [s] since the beginning: the sum of all dt, rounded as if once.
  double seconds() const noexcept { return seconds_ + lostSeconds_; }
  bool ended() const noexcept { return ended_; }

 private:
  void follow();

  std::shared_ptr<const Script> script_;
  ScriptedObjectOptions options_;
  Motion motion_;
  double seconds_ = 0.0, lostSeconds_ = 0.0;
  bool ended_ = false;
};

}  // namespace teren
