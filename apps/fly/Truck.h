// A truck that a person drives over the land: it lies on the ground as that is, edited or not, and leaves
// ruts where it goes.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Edit.h"
#include "teren/Object.h"

#include "apps/fly/ToolBelt.h"

namespace teren {

class World;

struct TruckStart {
  Position position = {};
  double heading = 0.0;  ///< [rad] clockwise from north
  /// [m] On water it swims. Minus infinity where there is none.
  double waterLevel = -std::numeric_limits<double>::infinity();
};

/// Stands until somebody drives it. Its engine climbs slopes of about kClimb; down a steep one it rolls, and
/// over an edge it falls. Deterministic, as an aircraft is.
class Truck : public Object {
 public:
  static constexpr double kWheelbase = 4.4, kTrack = 3.0;  // [m]
  static constexpr double kTopSpeed = 40.0;                // [m/s] on level ground
  static constexpr double kClimb = 0.9;                    // [rad]
  static constexpr double kRadius = 1.3, kBallUp = 2.8;    // [m] of its collision ball
  static constexpr double kRutDepth = 0.12;                // [radii] of one stamp; stamps overlap
  static constexpr double kMaxStep = 1.0 / 30.0;           // [s] longer updates are divided

  explicit Truck(const TruckStart& start);

  std::string name() const override { return "the truck"; }
  /// Arrows or W A S D; U for the ruts.
  bool handle(const InputEvent& event) override;
  void letGo() override { heldKeys_.clear(); }
  std::vector<KeyHelp> keys() const override;

  /// Moves on by dt [s]. Where no ground is known it waits.
  void update(double dt, const Ground& ground) override;
  Motion motion() const override;
  void place(const Motion& motion) override;
  std::optional<CollisionSphere> collisionSphere() const override {
    return CollisionSphere{.radius = kRadius, .up = kBallUp};
  }
  void collided(const Contact& contact) override;

  std::vector<DisplayLine> headUpDisplay() const override;
  const Model& model() const override { return model_; }
  Attitude attitude() const override { return {heading_, pitch_, roll_}; }

  bool leavesRuts() const noexcept { return leavesRuts_; }
  double speed() const noexcept { return speed_; }  ///< [m/s] backwards below 0
  /// The stamps of the way it has gone on dry ground since the last call: under each row of wheels where the
  /// ground's samples are close enough to tell them apart, else one under its middle.
  std::vector<Edit> takeRuts(const ToolGround& ground);

 private:
  void step(double dt, const Ground& ground);
  void drive(double dt);
  void lieOn(double dt, const Ground& ground);
  std::optional<double> floor(double ahead, double right, const Ground& ground) const;
  double between(std::string_view one, std::string_view two, std::string_view three,
                 std::string_view four) const;

  struct Print {
    Position position;
    double heading;
  };

  Model model_;
  Position position_;
  double worldPitch_ = 64.0;  // [m]
  double waterLevel_;
  double height_ = 0.0, heading_, pitch_ = 0.0, roll_ = 0.0;
  double speed_ = 0.0, steer_ = 0.0, climbRate_ = 0.0;
  bool stands_ = true;    // on ground or water
  bool isKnown_ = false;  // whether it ever was on known ground
  bool swims_ = false;
  bool leavesRuts_ = true;
  std::vector<Print> prints_;  // of the way since ruts were taken
  std::optional<Print> lastRut_;
  std::set<std::string, std::less<>> heldKeys_;
};

/// A dry and fairly level place for a truck within 2 km of `near`, whose ground is asked for there and then;
/// nothing where there is none.
std::optional<Position> placeForTruck(const World& world, const Position& near, double waterLevel);

}  // namespace teren
