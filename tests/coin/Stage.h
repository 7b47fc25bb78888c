// What the tests of engine/coin stand on: Inventor and Qt set up, a scene graph with a camera and a terrain,
// and hand-made snapshots.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <Inventor/SbColor.h>
#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

class QImage;
class SoNode;
class SoPerspectiveCamera;
class SoSeparator;
class SoTerrain;

namespace teren {

/// No part of a landscape has this colour.
inline const SbColor kMagenta(1.0F, 0.0F, 1.0F);

/// A camera and a terrain under one root. Sun: the terrain's own.
class Stage {
 public:
  Stage();
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  SoSeparator* root;
  SoPerspectiveCamera* camera;
  SoTerrain* terrain;

  /// Looks from a point of the scene; angles in degrees, heading clockwise from north, pitch upwards.
  void look(const SbVec3f& from, double heading, double pitch) const;
};

/// Small and fine, so that it is there at once.
void makeSmall(SoTerrain& terrain);

/// The graph of an .iv text, with a reference for the caller; throws where it cannot be read.
SoNode* readScene(const std::string& text);
/// What SoWriteAction makes of a graph.
std::string writeScene(SoNode* root);

/// Pixels of exactly kMagenta.
int backgroundPixels(const QImage& picture);
/// Those below the first pixel of another colour in their column. Where the camera looks level, each column
/// is a plumb plane, in which nothing of the sky lies below ground: then these are seen through cracks.
int backgroundBelowTheHorizon(const QImage& picture);

/// A snapshot made by hand: `side` x `side` meshes of `intervals` intervals a side at one level, which share
/// their border vertices, the south-west one at level-0 sample (column, row). `height` [m] is asked at
/// level-0 samples counted from there. Ids begin with `firstId`.
struct HandMade {
  int side = 4;
  int intervals = 16;
  int level = 0;
  std::int64_t column = 0, row = 0;
  double spacing = 2.0;
  std::uint64_t firstId = 1;
  std::function<double(double, double)> height = [](double, double) { return 0.0; };
};
std::shared_ptr<const Scene> makeScene(const HandMade& plan, std::uint64_t serial = 1);

}  // namespace teren
