#include "apps/static/StaticScene.h"

#include <algorithm>

#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoTranslation.h>

#include "coin/SoTerrainMesh.h"

namespace teren {
namespace {

constexpr float kAmbient = 0.35F;

SbColor colourOf(PieceKind kind) {
  switch (kind) {
    case PieceKind::patch:
      break;
    case PieceKind::seam:
      return SbColor(StaticScene::kSeam);
    case PieceKind::corner:
      return SbColor(StaticScene::kCorner);
  }
  return SbColor(StaticScene::kGround);
}

/// South-west and north-east ends of a mesh, in level-0 samples.
struct Extent {
  std::int64_t west, south, east, north;
};
Extent extentOf(const Mesh& mesh) {
  const std::int64_t stride = std::int64_t{1} << mesh.level;
  return {mesh.originColumn, mesh.originRow, mesh.originColumn + mesh.columns * stride,
          mesh.originRow + mesh.rows * stride};
}

}  // namespace

StaticScene::StaticScene(const Scene& scene, int intervals, double side)
    : root_(new SoSeparator), side_(side) {
  root_->ref();
  auto* environment = new SoEnvironment;
  environment->ambientIntensity = 1.0F;
  root_->addChild(environment);
  auto* sun = new SoDirectionalLight;
  sun->direction = SbVec3f(0.7F, 0.45F, -0.55F);
  root_->addChild(sun);
  auto* hints = new SoShapeHints;  // both sides are to be seen
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->shapeType = SoShapeHints::UNKNOWN_SHAPE_TYPE;
  root_->addChild(hints);

  const std::vector<Piece> pieces = piecesOf(scene, intervals);
  if (pieces.empty()) return;
  Extent all = extentOf(*pieces.front().mesh);
  float low = pieces.front().mesh->minHeight, high = pieces.front().mesh->maxHeight;
  for (const Piece& piece : pieces) {
    const Extent extent = extentOf(*piece.mesh);
    all = {std::min(all.west, extent.west), std::min(all.south, extent.south),
           std::max(all.east, extent.east), std::max(all.north, extent.north)};
    low = std::min(low, piece.mesh->minHeight);
    high = std::max(high, piece.mesh->maxHeight);
    columns_ = std::max(columns_, piece.column + 1);
    rows_ = std::max(rows_, piece.row + 1);
  }
  for (const Piece& piece : pieces) {
    // Whole samples from the middle, so that the pieces of one landscape meet wherever in the world it is.
    const auto metres = [&](std::int64_t sample, std::int64_t from, std::int64_t to) {
      return static_cast<float>((static_cast<double>(sample - from) - 0.5 * static_cast<double>(to - from)) *
                                scene.spacing());
    };
    addPart(piece,
            {metres(piece.mesh->originColumn, all.west, all.east),
             metres(piece.mesh->originRow, all.south, all.north), -0.5F * (low + high)},
            scene.spacing());
  }
  setApart(0.0);
}

StaticScene::~StaticScene() {
  root_->unref();
}

void StaticScene::addPart(const Piece& piece, const SbVec3f& place, double spacing) {
  auto* separator = new SoSeparator;
  Part part{piece, place, new SoTranslation, new SoMaterial};
  part.material->specularColor = SbColor(0.0F, 0.0F, 0.0F);
  separator->addChild(part.material);
  separator->addChild(part.translation);
  auto* shape = new SoSeparator;  // what is below does not change: Coin keeps it in the graphics card
  shape->renderCaching = SoSeparator::ON;
  shape->addChild(new SoTerrainMesh(piece.mesh, spacing));
  separator->addChild(shape);
  root_->addChild(separator);
  parts_.push_back(part);
}

void StaticScene::setApart(double amount) {
  const auto share = static_cast<float>(amount);
  for (const Part& part : parts_) {
    const Shift shift = shiftOf(part.piece, columns_, rows_, side_, amount);
    part.translation->translation =
        part.place + SbVec3f(static_cast<float>(shift.east), static_cast<float>(shift.north),
                             static_cast<float>(shift.up));
    const SbColor own = colourOf(part.piece.kind());
    const SbColor colour = SbColor(kGround) * (1.0F - share) + own * share;
    part.material->diffuseColor = colour;
    part.material->ambientColor = colour * kAmbient;
  }
}

}  // namespace teren
