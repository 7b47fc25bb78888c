// Where the eye is and where it looks, relative to the object it rides with: in the cockpit or behind it,
// moved and turned by the person who watches.
#pragma once

#include "teren/Object.h"

namespace teren {

/// Where an object is and how it is turned.
struct Pose {
  Position position = {};
  double height = 0.0;                            ///< [m]
  double heading = 0.0, pitch = 0.0, roll = 0.0;  ///< [rad] as in Attitude
};
Pose poseOf(const Object& object);

/// The camera: where it is in the world and how it is turned. Angles as in Attitude.
struct Viewpoint {
  Pose pose;
  double fieldOfView = 0.0;  ///< [rad] of the picture's height
};

/// How the camera is being moved relative to the object, each from -1 to 1.
struct CameraMoves {
  double forward = 0.0, right = 0.0, up = 0.0;
};

/// First person sits in the aircraft and rolls with it; third person flies behind, keeps the horizon level
/// and swings round the aircraft when one looks around. Each has its own offset, kept when switching.
class CameraRig {
 public:
  enum class Person { first, third };

  static constexpr double kDefaultFieldOfView = 0.87;                    // [rad] 50 degrees
  static constexpr double kMinFieldOfView = 0.1, kMaxFieldOfView = 1.6;  // [rad]
  static constexpr double kMaxPitch = 1.4;                               // [rad] that one can look up or down
  static constexpr double kMaxOffset = 2000.0;                           // [m] in each direction
  static constexpr double kEyeClearance = 2.0;                           // [m] between the eye and the ground

  /// Moves the offset for dt [s] (>= 0); the farther out, the faster. The view follows the object's turns
  /// with a small lag in third person.
  void update(double dt, const CameraMoves& moves, const Pose& object);

  /// Turns the view by angles [rad], right and up positive.
  void look(double right, double up);
  /// Narrows the field of view by a tenth per step; negative steps widen it.
  void zoom(double steps);
  /// What that makes of a field of view.
  static double zoomed(double fieldOfView, double steps);
  /// Offset, look and zoom as they were at the beginning; first or third person stays.
  void reset();
  void togglePerson() noexcept;
  Person person() const noexcept { return person_; }

  /// The camera for an object at `object`, never lower than kEyeClearance above known ground or water.
  Viewpoint viewpoint(const Pose& object, const Ground& ground, double waterLevel) const;

 private:
  struct Offset3 {
    double forward = 0.0, right = 0.0, up = 0.0;  // [m]
  };
  Offset3& offset() noexcept { return person_ == Person::first ? first_ : third_; }
  const Offset3& offset() const noexcept { return person_ == Person::first ? first_ : third_; }

  static constexpr Offset3 kFirst{1.0, 0.0, 0.8};
  static constexpr Offset3 kThird{-27.0, 0.0, 6.5};

  Person person_ = Person::third;
  Offset3 first_ = kFirst, third_ = kThird;
  double lookRight_ = 0.0, lookUp_ = 0.0;
  double lag_ = 0.0;          // [rad] by which the third person's view is behind the object's heading
  double lastHeading_ = 0.0;  // [rad] of the object at the last update
  bool followed_ = false;     // whether lastHeading_ is known
  double fieldOfView_ = kDefaultFieldOfView;
};

}  // namespace teren
