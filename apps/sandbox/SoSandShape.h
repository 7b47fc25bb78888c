// Sand as a shape of Open Inventor: draws, picks and measures a published snapshot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

#include <Inventor/fields/SoSFBool.h>
#include <Inventor/fields/SoSFFloat.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoSubNode.h>

#include "apps/sandbox/SandPainter.h"
#include "generators/sand/SandSnapshot.h"

/// A block of sand; its walls are not picked. Coordinates are metres from the south-west corner of the sand's
/// box to the east and north, and absolute height. Lit by the first directional light before it. Up to some
/// million vertices: what is outside the view is not drawn, what did not change is not uploaded. Draws with
/// OpenGL 2.1; without shaders, or with TEREN_NO_SHADERS=1 in the environment, without grain. Made by
/// programs; the snapshot is not written to files.
class SoSandShape : public SoShape {
  typedef SoShape inherited;  // NOLINT: the name SO_NODE_HEADER expects

  SO_NODE_HEADER(SoSandShape);  // NOLINT

 public:
  SoSFFloat moisture;  ///< 0 (default) ... 1; wetter is darker; NaN counts as 0
  SoSFBool wireframe;  ///< default FALSE; edges over the sand, constrained ones red

  static void initClass();
  SoSandShape();

  /// From now on draws this; nullptr: nothing.
  void show(std::shared_ptr<const teren::SandSnapshot> sand);
  const std::shared_ptr<const teren::SandSnapshot>& sand() const noexcept { return sand_; }

  /// [bytes] in GL's buffers, of all contexts, and uploaded to them so far, of those that still live.
  std::size_t bufferBytes() const noexcept;
  std::size_t uploadedBytes() const noexcept;

  void GLRender(SoGLRenderAction* action) override;
  /// SandSnapshot::hit().
  void rayPick(SoRayPickAction* action) override;
  void getPrimitiveCount(SoGetPrimitiveCountAction* action) override;

 protected:
  ~SoSandShape() override;
  void computeBBox(SoAction* action, SbBox3f& box, SbVec3f& center) override;
  void generatePrimitives(SoAction* action) override;

 private:
  static void contextDies(std::uint32_t context, void* shape);
  SbVec3f point(const teren::SandVertex& vertex) const;

  std::shared_ptr<const teren::SandSnapshot> sand_;
  std::map<std::uint32_t, std::unique_ptr<teren::SandPainter>> painters_;  // one per GL context
};
