// The eye on the sand: it turns around a place it looks at, always upright.
#pragma once

#include "teren/Parameter.h"

class SoPerspectiveCamera;

namespace teren {

/// Sets a camera of a scene in metres, z up, with a box of sand in it.
class SandCamera {
 public:
  /// The camera must outlive it.
  explicit SandCamera(SoPerspectiveCamera& camera);

  /// Another box, its middle and its longest side [m]: looks there from where all is in view.
  void setBox(double middleX, double middleY, double middleZ, double side);
  /// Values of cameraParameters().
  void set(const Values& values);
  /// As it was at the beginning, or by the last set().
  void reset();

  /// By so many pixels of the mouse: half a turn is 360 of them.
  void turn(double right, double down);
  /// The place looked at follows the mouse; `height` [pixels] of the picture.
  void move(double right, double down, double height);
  /// Nearer, by notches of the wheel; each is an eighth of the way.
  void approach(double notches);

 private:
  struct View {
    double turn = 0.0, tilt = 0.0;     // [degree]
    double distance = 0.0;             // [m]
    double x = 0.0, y = 0.0, z = 0.0;  // [m] from the middle
  };
  void apply();

  SoPerspectiveCamera& camera_;
  double middleX_ = 0.0, middleY_ = 0.0, middleZ_ = 0.0, side_ = 1.0;
  View home_, view_;
};

}  // namespace teren
