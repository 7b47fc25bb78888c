// An aircraft that flies by itself along the ground and lets a pilot steer: it looks ahead and climbs in time
// before rising ground, and it is never below the ground.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Object.h"
#include "teren/Script.h"

namespace teren {

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
  std::string name = "aircraft";
  std::array<float, 3> paint{0.80F, 0.12F, 0.08F};
  /// Flies this way, at its own height, until the pilot touches the controls or it hits something.
  std::shared_ptr<const Script> script = {};
};

/// Follows the ground at a clearance the pilot chooses. What it hits throws it back: it loses speed, bounces,
/// and says so on its display. Deterministic: the same start, ground, controls and sequence of dt give the
/// same flight on one machine.
class Aircraft : public Object {
 public:
  static constexpr double kMinSpeed = 5.0, kMaxSpeed = 600.0;         // [m/s]
  static constexpr double kMinClearance = 15.0, kMaxClearance = 3e3;  // [m] where the pilot may set it
  static constexpr double kSafeClearance = 150.0;                     // [m] of the autopilot
  static constexpr double kCoursePull = 6.0;     // [m/s^2] sideways, in its sharpest turn
  static constexpr double kHardClearance = 4.0;  // [m] it is never lower than this
  static constexpr double kRadius = 3.0;         // [m] of its collision sphere
  static constexpr double kBounce = 0.4;  // share of the speed into what it hits that it is thrown back with
  static constexpr double kTouchShown = 3.0;      // [s] for which the display says what it hit
  static constexpr double kTurnRate = 0.5;        // [rad/s] at full turn
  static constexpr double kMaxRoll = 0.8;         // [rad] at full turn
  static constexpr double kMaxStep = 1.0 / 30.0;  // [s] longer updates are divided

  /// Values outside their ranges are brought inside. Until it first moves on over known ground, every
  /// update puts it at the height it should have there, as far as the ground is known; without any, that is
  /// the water's level or 0, plus the clearance.
  explicit Aircraft(const AircraftStart& start);

  std::string name() const override { return name_; }
  void setControls(const AircraftControls& controls) noexcept;
  /// The autopilot flies a gentle course by itself, to the left and to the right, kSafeClearance above the
  /// ground, until the pilot touches the controls. Ends a script.
  void setAutopilot(bool on) noexcept;
  bool hasAutopilot() const noexcept { return autopilot_; }
  /// Arrows or W A S D, R and F; Space for the autopilot.
  bool handle(const InputEvent& event) override;
  void letGo() override;
  std::vector<KeyHelp> keys() const override;

  /// Moves on by dt [s]; a dt that is not positive and finite only looks at the ground. Where no ground is
  /// known, ahead or below, it keeps its height; at the world's end it stands still. Costs about 25 questions
  /// to the ground per kMaxStep of dt.
  void update(double dt, const Ground& ground) override;
  Motion motion() const override;
  /// Of the velocity, its speed and direction are brought inside what an aircraft can do.
  void place(const Motion& motion) override;

  std::optional<CollisionSphere> collisionSphere() const override { return CollisionSphere{kRadius}; }
  void collided(const Contact& contact) override;

  std::vector<DisplayLine> headUpDisplay() const override;
  const Model& model() const override { return model_; }
  Attitude attitude() const override;

  /// How often it has hit something, and what it says about the last time.
  int touches() const noexcept { return touches_; }
  const std::string& touched() const noexcept { return touched_; }
  bool followsScript() const noexcept { return script_ != nullptr; }
  double speed() const noexcept { return speed_; }          ///< [m/s] over ground
  double heading() const noexcept { return heading_; }      ///< [rad] [0, 2 pi)
  double clearance() const noexcept { return clearance_; }  ///< [m] as chosen
  /// [m] above ground or water at the last update; empty where the ground was unknown.
  std::optional<double> heightAboveGround() const noexcept { return heightAboveGround_; }

 private:
  void step(double dt, const Ground& ground);
  void steer(double dt);
  AircraftControls course(double dt);
  void move(double dt, const Ground& ground);
  bool followScript(double dt);
  void follow(double dt, const Ground& ground);
  void stayAbove(const Ground& ground);
  void turnTo(double east, double north);
  void say(const std::string& what, double speed);
  bool isHeld(std::string_view one, std::string_view other) const;
  std::optional<double> floor(const Position& position, const Ground& ground) const;
  std::optional<double> heightToAimAt(const Ground& ground) const;

  std::string name_;
  Model model_;
  std::shared_ptr<const Script> script_;
  double scriptSeconds_ = 0.0;
  bool autopilot_ = false;
  double autopilotSeconds_ = 0.0;  // since it was switched on
  AircraftControls controls_;
  std::set<std::string, std::less<>> heldKeys_;
  Position position_;
  double pitch_ = 64.0;  // [m] of the world it flies in, as it learnt at its last update
  double waterLevel_;
  double clearance_;
  double height_;
  double heading_, roll_ = 0.0;
  double speed_, climbRate_ = 0.0;
  bool flying_ = false;  // whether it ever moved over known ground
  std::optional<double> heightAboveGround_;
  int touches_ = 0;
  std::string touched_;
  double touchedSeconds_ = kTouchShown;  // since then
};

}  // namespace teren
