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

/// What the vertices of a picture are counted from: numbers near the eye are small, and floats fine.
struct Anchor {
  Sample sample;
  float height = 0.0F;  ///< [m] absolute

  friend bool operator==(const Anchor&, const Anchor&) = default;
};

/// Scene coordinates are metres east, north and up of `origin`, a world position [m]. The origin is kept as a
/// sample and a remainder, so that what lies near it is placed exactly, however far from the world's zero it
/// is. An origin that is the double nearest to a sample's place means that sample: where doubles are too
/// coarse for the world's samples, corners of its lattice are exact all the same.
class ScenePlacement {
 public:
  /// `origin` is finite; what lies beyond kFarthest samples is taken for that. `spacing` [m] between level-0
  /// samples, > 0.
  ScenePlacement(const SbVec3d& origin, double spacing) noexcept;

  static constexpr std::int64_t kFarthest = std::int64_t{1} << 61;

  double spacing() const noexcept { return spacing_; }

  /// Scene coordinates of a sample at height 0; precise to a double.
  SbVec3d position(const Sample& sample) const noexcept;

  /// Scene coordinates of an anchor; precise to a double.
  SbVec3d position(const Anchor& anchor) const noexcept;

  /// The anchor nearest to a point, from a grid: whole multiples of `step` metres [> 0] in height, and of the
  /// largest power of two of samples within `step` metres (at least one sample) on the plane. It lies within
  /// half a cell of that grid, as far as the world reaches.
  Anchor anchorNear(const SbVec3d& point, double step) const noexcept;

  /// The box of a mesh on its measured heights.
  SbBox3f box(const Mesh& mesh) const noexcept;

 private:
  double spacing_;
  Sample origin_;
  SbVec3d remainder_;  // origin minus its sample
};

}  // namespace teren
