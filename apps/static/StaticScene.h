// The scene graph of nine patches: light, and every piece under a place and a colour of its own.
#pragma once

#include <vector>

#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

#include "apps/static/Pieces.h"

class SoMaterial;
class SoSeparator;
class SoTranslation;

namespace teren {

/// Make it after SoQt::init and SoTerrain::initClass; it must go before Coin does. Its zero is the middle of
/// the pieces at their mean height; x east, y north, z up, in metres.
class StaticScene {
 public:
  /// `side` [m] of a patch, `intervals` World::intervals() >= 4.
  StaticScene(const Scene& scene, int intervals, double side);
  ~StaticScene();
  StaticScene(const StaticScene&) = delete;
  StaticScene& operator=(const StaticScene&) = delete;

  SoSeparator* node() const noexcept { return root_; }

  /// Moves the pieces: 0 together, 1 apart (see shiftOf). Together they have one colour, apart each kind its
  /// own.
  void setApart(double amount);

  static constexpr float kGround[3] = {0.42F, 0.52F, 0.30F}, kSeam[3] = {0.85F, 0.55F, 0.15F},
                         kCorner[3] = {0.20F, 0.40F, 0.85F};

 private:
  struct Part {
    Piece piece;
    SbVec3f place;  // together
    SoTranslation* translation;
    SoMaterial* material;
  };
  void addPart(const Piece& piece, const SbVec3f& place, double spacing);

  SoSeparator* root_;  // referenced
  std::vector<Part> parts_;
  int columns_ = 1, rows_ = 1;
  double side_;
};

}  // namespace teren
