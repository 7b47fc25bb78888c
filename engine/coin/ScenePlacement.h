// Where the samples of the world lie in the coordinates of a scene graph, which are floats around an origin.
#pragma once

#include <cstdint>

#include <Inventor/SbBox3f.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

namespace teren {

/// A level-0 sample of the world.
struct Sample {
  std::int64_t column = 0, row = 0;

  friend bool operator==(const Sample&, const Sample&) = default;
};

/// Scene coordinates are metres east, north and up of `origin`, a world position [m]. The origin is kept as a
/// sample and a remainder, so that what lies near it is placed exactly, however far from the world's zero it
/// is.
class ScenePlacement {
 public:
  /// `origin` is finite; what lies beyond kFarthest samples is taken for that. `spacing` [m] between level-0
  /// samples, > 0.
  ScenePlacement(const SbVec3d& origin, double spacing) noexcept;

  static constexpr std::int64_t kFarthest = std::int64_t{1} << 61;

  double spacing() const noexcept { return spacing_; }

  /// Scene coordinates of a sample at height 0; precise to a double.
  SbVec3d position(const Sample& sample) const noexcept;

  /// The multiple of kReferenceStep samples nearest to a point: what all vertices of one picture are counted
  /// from. The steps are whole periods of the ground's texture, so a change of reference is not seen.
  Sample referenceNear(const SbVec3f& point) const noexcept;
  static constexpr std::int64_t kReferenceStep = 1024;

  /// The box of a mesh on its measured heights.
  SbBox3f box(const Mesh& mesh) const noexcept;

 private:
  double spacing_;
  Sample origin_;
  SbVec3d remainder_;  // origin minus its sample
};

}  // namespace teren
