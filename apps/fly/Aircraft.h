// An aircraft that flies by itself along the ground and lets a pilot steer: it looks ahead and climbs in time
// before rising ground, and it is never below the ground.
#pragma once

#include <limits>
#include <optional>

#include "teren/Object.h"

namespace teren {

/// Where an object is and how it is turned. Angles in radians: heading clockwise from north, [0, 2 pi);
/// pitch and roll positive for nose up and right wing down.
struct Pose {
  Position position = {};
  double height = 0.0;  ///< [m]
  double heading = 0.0, pitch = 0.0, roll = 0.0;
};

/// What the pilot's hands do, each from -1 to 1; 0 lets go.
struct AircraftControls {
  double turn = 0.0;      ///< to the left ... to the right
  double throttle = 0.0;  ///< slower ... faster
  double climb = 0.0;     ///< lower ... higher above the ground
};

struct AircraftStart {
  Position position = {};
  double heading = 0.0;      ///< [rad] clockwise from north
  double speed = 60.0;       ///< [m/s] kMinSpeed ... kMaxSpeed
  double clearance = 130.0;  ///< [m] kMinClearance ... kMaxClearance; how high above the ground it flies
  /// [m] Water counts as ground. Minus infinity where there is none.
  double waterLevel = -std::numeric_limits<double>::infinity();
};

/// Follows the ground at a clearance the pilot chooses. Deterministic: the same start, ground, controls and
/// sequence of dt give the same flight on one machine.
class Aircraft : public Object {
 public:
  static constexpr double kMinSpeed = 5.0, kMaxSpeed = 600.0;         // [m/s]
  static constexpr double kMinClearance = 15.0, kMaxClearance = 3e3;  // [m] where the pilot may set it
  static constexpr double kHardClearance = 4.0;                       // [m] it is never lower than this
  static constexpr double kTurnRate = 0.5;                            // [rad/s] at full turn
  static constexpr double kMaxRoll = 0.8;                             // [rad] at full turn
  static constexpr double kMaxStep = 1.0 / 30.0;                      // [s] longer updates are divided

  /// Values outside their ranges are brought inside. Until it first moves on over known ground, every
  /// update puts it at the height it should have there, as far as the ground is known; without any, that is
  /// the water's level or 0, plus the clearance.
  explicit Aircraft(const AircraftStart& start);

  void setControls(const AircraftControls& controls) noexcept;

  /// Moves on by dt [s]; a dt that is not positive and finite only looks at the ground. Where no ground is
  /// known, ahead or below, it keeps its height; at the world's end it stands still. Costs about 25 questions
  /// to the ground per kMaxStep of dt.
  void update(double dt, const Ground& ground) override;
  Motion motion() const override;

  Pose pose() const noexcept;
  double speed() const noexcept { return speed_; }          ///< [m/s] over ground
  double heading() const noexcept { return heading_; }      ///< [rad] [0, 2 pi)
  double clearance() const noexcept { return clearance_; }  ///< [m] as chosen
  /// [m] above ground or water at the last update; empty where the ground was unknown.
  std::optional<double> heightAboveGround() const noexcept { return heightAboveGround_; }

 private:
  void step(double dt, const Ground& ground);
  void steer(double dt);
  void move(double dt, const Ground& ground);
  void follow(double dt, const Ground& ground);
  void stayAbove(const Ground& ground);
  std::optional<double> floor(const Position& position, const Ground& ground) const;
  std::optional<double> heightToAimAt(const Ground& ground) const;

  AircraftControls controls_;
  Position position_;
  double waterLevel_;
  double clearance_;
  double height_;
  double heading_, roll_ = 0.0;
  double speed_, climbRate_ = 0.0;
  bool flying_ = false;  // whether it ever moved over known ground
  std::optional<double> heightAboveGround_;
};

}  // namespace teren
