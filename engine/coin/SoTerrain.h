// The landscape as an Open Inventor node: put a SoTerrain into a scene graph and fly over it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include <Inventor/SbColor.h>
#include <Inventor/fields/SoMFString.h>
#include <Inventor/fields/SoSFBool.h>
#include <Inventor/fields/SoSFColor.h>
#include <Inventor/fields/SoSFFloat.h>
#include <Inventor/fields/SoSFInt32.h>
#include <Inventor/fields/SoSFString.h>
#include <Inventor/fields/SoSFTime.h>
#include <Inventor/fields/SoSFVec3d.h>
#include <Inventor/nodes/SoSubNode.h>

#include "teren/Morph.h"

namespace teren {
class Engine;
class Scene;
struct Mesh;
}  // namespace teren

/// Draws a Teren landscape, x east, y north, z up, in metres, with its water and its haze.
///
/// It can be fed in two ways:
/// * by its fields alone, as in an .iv file. The node then owns a teren::Engine whose viewpoint is the eye of
/// the
///   last GL traversal, and works at what is missing from a timer of its own, for at most `frameBudget` at a
///   time, never inside a traversal. The timer rests while nothing is missing or still to be
///   measured and the eye stands still. With
///   several viewers the landscape follows whichever drew last.
/// * by a program that drives an engine of its own and calls setScene() after every Engine::update().
///
/// Meshes are hidden children: they can be picked and searched for, and are not written. The ground is drawn
/// from above only. Drawing needs OpenGL 2.1; without shaders, or with TEREN_NO_SHADERS=1 in the environment,
/// a plainer fixed-function drawing takes their place. The first directional light of the scene is the sun;
/// without one the sun stands in the south-west, 35 degrees high. All calls from the thread that owns the
/// scene graph.
///
/// FILE FORMAT/DEFAULTS:
/// \code
///   SoTerrain {
///     seed          ""                # whole number 0 ... 2^64 - 1; empty: the world's own
///     world         ""                # a world file (JSON); empty: the world shipped with Teren, or
///     generator     ""                # a world of one layer made by this generator plugin
///     parameters    []                # of the generator, "name=value"
///     viewDistance  1500              # [m]
///     pixelError    0                 # [px] 0: one level, which is
///     viewLevel     2                 # 0: finest
///     frameBudget   0.004             # [s]
///     waterLevel    -150              # [m]
///     origin        0 0 0             # [m]
///     hazeColor     0.76 0.84 0.92
///     logarithmicDepth FALSE
///   }
/// \endcode
class SoTerrain : public SoNode {
  typedef SoNode inherited;  // NOLINT: the name SO_NODE_HEADER expects

  SO_NODE_HEADER(SoTerrain);  // NOLINT

 public:
  /// Registers the node; SoDB::init() first. May be called more than once. Reading an .iv file calls it by
  /// itself where the dynamic linker finds libSoTerrain.so.
  static void initClass();
  SoTerrain();

  /// The world. A change makes a new engine, once for all changes made together; what it refuses, like a bad
  /// value of any other field, is reported through SoDebugError and errorText(), and the landscape, or the
  /// value, before stays. A relative `world` read from a
  /// file is looked for in the folder of that file too.
  SoSFString seed, world, generator;
  SoMFString parameters;

  /// [m] The haze is total there; > 0, at most 64 nodes of `viewLevel`: triangles grow with its square. With
  /// a `pixelError` at most 1e6 m: they grow far slower.
  SoSFFloat viewDistance;
  /// [px] How far the ground drawn may be from the level-0 surface, as the last GL traversal's camera sees
  /// it: 0.1
  /// ... 100. Half of it draws about four times the triangles. 0: `viewLevel` everywhere.
  SoSFFloat pixelError;
  /// Where `pixelError` is 0: the uniform level of the ground, 0 (finest) ... World::topLevel(); each step
  /// draws a quarter of the triangles per area.
  SoSFInt32 viewLevel;
  /// [s] How long each update may work, 0 ... 1. More fills the view sooner and costs frame rate meanwhile.
  SoSFTime frameBudget;

  /// [m] The water's surface. -1e6 or less (and anything not finite) means a dry world: no water is drawn.
  /// Water is never picked.
  SoSFFloat waterLevel;
  /// [m] World position of the scene's zero. Move it along with the camera: scene coordinates are floats.
  /// Within 64 m of the zero, of a camera 10^12 m from the world's, vertices half a metre away stray less
  /// than 0.01 px at 1280 x 720; 2 km away, 0.2 px. Best is a sample's place: rounded to double it
  /// means that sample exactly, also where doubles are coarser than the samples. Costs nothing to change;
  /// -1e30 ... 1e30.
  SoSFVec3d origin;
  /// What the ground fades into, each part 0 ... 1; give the background the same colour.
  SoSFColor hazeColor;
  /// Whether depths are written as LogarithmicDepth.h has them, the same share of every distance, instead of
  /// as clipping planes far apart make them, all of them near the eye: without flicker from 0.5 m to 100 km.
  /// For a scene in which everything drawn with a depth does so; shapes that do not would hide, or be hidden,
  /// at wrong distances. Hidden ground is then computed too: on software OpenGL a frame takes 16 to 33 % more
  /// of the processor (tests/coin/Frame_bench.cpp). Without shaders, and under a camera without perspective,
  /// it does nothing: ask drewLogarithmicDepth().
  SoSFBool logarithmicDepth;

  /// Shows this snapshot; from now on the node has no engine, and the fields that describe the world, the
  /// view level and the budget are ignored (viewDistance is the haze's). Cheap when the snapshot is the one
  /// shown. Snapshots must come from one engine, or be empty in between. nullptr: back to the fields.
  void setScene(std::shared_ptr<const teren::Scene> scene);
  /// From the next traversal on each mesh in sight is drawn in the colour that the function has for it, lit,
  /// instead of with what grows there; without a function, as land looks. Asked at every GL traversal.
  void setTint(std::function<SbColor(const teren::Mesh&)> tint);
  /// The snapshot shown, never null.
  std::shared_ptr<const teren::Scene> scene() const;
  /// In scene coordinates, the eye whose distance says how far the ground's vertices have moved to the next
  /// coarser level (Morph.h), where it is not the camera: to look from aside at what another eye sees. And
  /// how they move, where it is not the snapshot's own way: in the picture of another view of its engine
  /// (Engine::morph).
  void setDetailEye(const std::optional<SbVec3d>& eye, const std::optional<teren::Morph>& morph = {});
  /// In scene coordinates, the eye that vertices moved with in the last GL traversal that drew ground: so
  /// they are picked. Empty where they lay still: before the first, without perspective, and without shaders.
  std::optional<SbVec3d> movedWith() const;

  /// The node's own engine, made now if a field has changed; nullptr after setScene() or where the fields
  /// have never been good. It dies with the next good change of a field.
  teren::Engine* engine();
  /// Works without drawing until everything the view wants is there, and shows it. For pictures and tests:
  /// takes seconds. Without an engine it does nothing.
  void settle();
  /// One sentence about what is wrong with the fields; empty where nothing is.
  const SbString& errorText();

  /// Bytes of all vertex and index buffers the node holds in all GL contexts. The node's own engine hears of
  /// them by itself; a program with an engine of its own passes them on to Engine::setRendererBytes().
  std::size_t bufferBytes() const;
  /// Triangles of ground drawn by the last GL traversal, after culling.
  std::size_t drawnTriangles() const;
  /// Whether the last GL traversal that drew anything wrote logarithmic depths.
  SbBool drewLogarithmicDepth() const;

  SbBool affectsState() const override;
  void notify(SoNotList* list) override;
  SoChildList* getChildren() const override;
  void doAction(SoAction* action) override;
  void callback(SoCallbackAction* action) override;
  void GLRender(SoGLRenderAction* action) override;
  void getBoundingBox(SoGetBoundingBoxAction* action) override;
  void getMatrix(SoGetMatrixAction* action) override;
  void getPrimitiveCount(SoGetPrimitiveCountAction* action) override;
  void rayPick(SoRayPickAction* action) override;
  void search(SoSearchAction* action) override;

 protected:
  ~SoTerrain() override;
  SbBool readInstance(SoInput* input, unsigned short flags) override;

 private:
  class Private;
  std::unique_ptr<Private> private_;
};
