// The scene graph of the demo: camera, sky, sun, land and objects, kept in step with a flight.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "apps/fly/CameraRig.h"
#include "apps/fly/Daylight.h"
#include "apps/fly/DepthShader.h"
#include "apps/fly/Flight.h"
#include "apps/fly/ObjectModel.h"
#include "apps/fly/SightLines.h"
#include "apps/fly/SkyDome.h"
#include "apps/fly/ToolRing.h"
#include "coin/SceneZero.h"

class SoAction;
class SoDrawStyle;
class SoPerspectiveCamera;
class SoSeparator;
class SoTerrain;

namespace teren {

/// Make it after SoQt::init and SoTerrain::initClass; it must go before Coin does. Its depth is logarithmic,
/// from half a metre to a hundred kilometres; where SoTerrain has no shaders it is the ordinary one, with
/// clipping planes closer together: there, what lies less apart than 1e-7 of the square of its
/// distance from the eye [m] may flicker.
class FlyScene {
 public:
  /// Shows the engine's objects of this moment. The haze hides the land where its view ends.
  FlyScene(const Daylight& light, Engine& engine);
  ~FlyScene();
  FlyScene(const FlyScene&) = delete;
  FlyScene& operator=(const FlyScene&) = delete;

  SoSeparator* node() const noexcept { return root_; }

  /// How the land looks from the next picture on: each mesh in a colour of its own (empty: as land looks),
  /// and as the edges of its triangles, without its water.
  void setTint(std::function<SbColor(const Mesh&)> tint);
  void setWires(bool wires);

  /// Until thawed, draws an eye and what it sees in a picture of this aspect (width by height) as lines, all
  /// objects, and the land as far as it can be seen through the haze from there.
  void freeze(const Viewpoint& eye, double aspect);
  void thaw();

  /// From the next picture on a ring of this radius [m] lies on the ground there; without a place none does.
  void setRing(const std::optional<Position>& middle, double radius);

  /// Shows the flight as it is now, seen from `view`; in first person the object one sits in is left out.
  void show(Flight& flight, const Viewpoint& view, CameraRig::Person person, double dt);

  std::size_t bufferBytes() const;  ///< held on the graphics card for the land

 private:
  SbVec3f place(const Position& position, double height, double pitch) const;
  /// [m] The end of the land, seen from there.
  double viewDistance(const Engine& engine, const Pose& eye) const;
  void moveZero(double pitch);
  void setViewDistance(double distance);
  void setPlanes();
  void showRing(const Engine& engine);
  static void landIsDrawn(void* scene, SoAction* action);
  void showOtherLand();

  SoSeparator* root_;  // referenced
  SoPerspectiveCamera* camera_;
  SoTerrain* terrain_;
  SoDrawStyle* style_;  // of the land
  float waterLevel_;    // [m]
  SkyDome sky_;
  DepthShader depth_;
  std::vector<std::unique_ptr<ObjectModel>> models_;
  ToolRing ring_;
  std::optional<Position> ringMiddle_;
  double ringRadius_ = 0.0;  // [m]
  SightLines sight_;
  struct Frozen {
    Viewpoint eye;
    double aspect = 1.0;
  };
  std::optional<Frozen> frozen_;
  SceneZero zero_;
  int changes_ = 0;  // of the flight's engine, seen so far
};

}  // namespace teren
