// What the two ways of drawing sand, with shaders and without, have in common: what is to be drawn, and what
// sand looks like.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include <Inventor/SbColor.h>
#include <Inventor/SbMatrix.h>
#include <Inventor/SbVec3f.h>

#include "generators/sand/SandSnapshot.h"

namespace teren {

/// One look at sand, in metres from the south-west corner of its box.
struct SandPicture {
  std::shared_ptr<const SandSnapshot> sand;
  SbMatrix toClip;                     // from there to clip coordinates (row vectors)
  SbVec3f sun{0.0F, 0.0F, 1.0F};       // unit vector towards it
  SbColor sunlight{1.0F, 1.0F, 1.0F};  // its colour times its intensity
  float moisture = 0.0F;               // 0 ... 1
  bool wireframe = false;
};

/// What sand looks like. Light is a number from 0 to 1, of sun and sky; its contrast is stretched by cutting
/// 0.3 off both ends (thesis of Pilsen 2009, which does so to the bumped picture). Different from it: the
/// ends are those of what light can be, not of one picture's histogram, so that a picture's brightness does
/// not change with what else is in it, and the cut is rounded, so that shapes remain visible in deep shade.
struct SandLook {
  static constexpr float kCut = 0.3F;
  static constexpr float kSky = 0.3F;  // of all light on level ground; the sun has the rest
  inline static const SbVec3f kLoose{0.87F, 0.72F, 0.50F};
  inline static const SbVec3f kSolid{0.55F, 0.44F, 0.34F};
  inline static const SbVec3f kShade{0.30F, 0.28F, 0.30F};  // how much of the colour is left without light
  inline static const SbVec3f kLight{1.06F, 1.03F, 0.98F};  // and in full light
  static constexpr float kWet = 0.45F;                      // of its brightness remains in soaked sand
  /// Loose material as thick as this share of the box's side hides the ground.
  static constexpr float kHiding = 0.004F;
  static constexpr float kWire[4] = {0.12F, 0.10F, 0.08F, 0.35F};
  static constexpr float kConstrained[4] = {0.90F, 0.05F, 0.05F, 1.0F};
  static constexpr float kConstrainedWidth = 2.0F;  // [pixels]
};

/// Consecutive pages of triangles.
struct PageRun {
  std::size_t first = 0, count = 0;  // [pages]
};
/// The pages of triangles that are not outside the view, in runs as long as possible.
std::vector<PageRun> visibleRuns(const SandSnapshot& sand, const SbMatrix& toClip);

/// Longer side of the box [m].
inline float sideOf(const SandSnapshot& sand) {
  return static_cast<float>(sand.frame().step * std::max(sand.frame().width, sand.frame().height));
}

/// Draws sand in one GL context and keeps what that takes. All members but bytes() and uploaded() need the
/// context to be current, with the matrices as the scene has them. GL state is left as it was found.
class SandPainter {
 public:
  virtual ~SandPainter() = default;

  virtual void draw(const SandPicture& picture) = 0;
  /// Deletes all GL objects.
  virtual void release() = 0;
  /// [bytes] in GL's buffers.
  virtual std::size_t bytes() const noexcept = 0;
  /// [bytes] uploaded to them since construction.
  virtual std::size_t uploaded() const noexcept = 0;
};

}  // namespace teren
