// Where on the drawn ground something points.
#pragma once

#include <optional>

#include "teren/Position.h"

#include "apps/fly/CameraRig.h"
#include "apps/fly/Flight.h"

namespace teren {

/// A place in a picture: -1 ... 1 from its left edge to its right one and from its lower to its upper one.
struct PicturePoint {
  double right = 0.0, up = 0.0;
};

/// The ground that is seen there, as it is drawn now; nothing where the sky is. `aspect`: the picture's width
/// by its height.
std::optional<Position> groundAt(const Flight& flight, const Viewpoint& view, const PicturePoint& point,
                                 double aspect);

/// [rad] How far below the horizon.
inline constexpr double kLookDown = 0.33;
/// The ground in front of an object: where it looks, but kLookDown below the horizon however it is turned; at
/// least `least` [m] away. Nothing where no ground is drawn.
std::optional<Position> groundAhead(const Flight& flight, const Pose& object, double least);

}  // namespace teren
