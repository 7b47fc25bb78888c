#include "apps/sandbox/SandScene.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoPickStyle.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include "apps/sandbox/SoSandShape.h"

namespace teren {
namespace {

constexpr int kPiecesOfSide = 8;  // of an outline's side between two corners, each draped by itself

/// The outline's corners and what lies between them, on the sand; as many lists as it is cut into by the
/// sand's border.
std::vector<std::vector<SbVec3f>> draped(const SandSnapshot& sand, const ToolOutline& outline,
                                         const StampPlace& place) {
  const bool turns = place.directionX != 0.0 || place.directionY != 0.0;
  const double east = turns ? place.directionX : 1.0, north = turns ? place.directionY : 0.0;
  const double above = static_cast<double>(sand.bounds().high) + 1.0;
  std::vector<std::vector<SbVec3f>> lines(1);
  for (std::size_t i = 0; i <= outline.size() * kPiecesOfSide; ++i) {
    const ToolPoint& a = outline[i / kPiecesOfSide % outline.size()];
    const ToolPoint& b = outline[(i / kPiecesOfSide + 1) % outline.size()];
    const double part = static_cast<double>(i % kPiecesOfSide) / kPiecesOfSide;
    const double u = a.x + part * (b.x - a.x), v = a.y + part * (b.y - a.y);
    const double x = place.x + east * u - north * v, y = place.y + north * u + east * v;
    const std::optional<SandHit> ground = sand.hit({{x, y, above}, {0.0, 0.0, -1.0}});
    if (ground) {
      lines.back().emplace_back(static_cast<float>(x - sand.frame().x),
                                static_cast<float>(y - sand.frame().y), static_cast<float>(ground->height));
    } else if (!lines.back().empty()) {
      lines.emplace_back();
    }
  }
  return lines;
}

}  // namespace

SandScene::SandScene() : root_(new SoSeparator) {
  SoSandShape::initClass();
  root_->ref();
  addLight();
  sand_ = new SoSandShape;
  root_->addChild(sand_);
  addTool();
}

SandScene::~SandScene() {
  root_->unref();
}

void SandScene::addLight() {
  auto* sun = new SoDirectionalLight;  // low, so that ripples have a light and a dark side
  sun->direction = SbVec3f(0.75F, 0.40F, -0.43F);
  sun->color = SbColor(1.0F, 0.97F, 0.90F);
  root_->addChild(sun);
}

void SandScene::addTool() {
  tool_ = new SoSwitch;
  auto* separator = new SoSeparator;
  auto* picking = new SoPickStyle;
  picking->style = SoPickStyle::UNPICKABLE;
  separator->addChild(picking);
  auto* depth = new SoDepthBuffer;
  depth->test = FALSE;
  separator->addChild(depth);
  auto* model = new SoLightModel;
  model->model = SoLightModel::BASE_COLOR;
  separator->addChild(model);
  auto* style = new SoDrawStyle;
  style->lineWidth = 2.0F;
  separator->addChild(style);
  auto* colour = new SoBaseColor;
  colour->rgb = SbColor(0.10F, 0.35F, 0.75F);
  separator->addChild(colour);
  outline_ = new SoCoordinate3;
  separator->addChild(outline_);
  lines_ = new SoLineSet;
  separator->addChild(lines_);
  tool_->addChild(separator);
  root_->addChild(tool_);
  hideTool();
}

void SandScene::show(std::shared_ptr<const SandSnapshot> sand) {
  sand_->show(std::move(sand));
}

void SandScene::setWireframe(bool wireframe) {
  if ((sand_->wireframe.getValue() == TRUE) != wireframe) sand_->wireframe = wireframe ? TRUE : FALSE;
}

void SandScene::setMoisture(double moisture) {
  const auto value = static_cast<float>(moisture);
  if (sand_->moisture.getValue() != value) sand_->moisture = value;
}

void SandScene::setTool(const ToolShape& tool, const StampPlace& place) {
  std::vector<SbVec3f> points;
  std::vector<std::int32_t> counts;
  if (sand_->sand()) {
    for (const ToolPart& part : tool.parts()) {
      for (const std::vector<SbVec3f>& line : draped(*sand_->sand(), part.outer, place)) {
        if (line.size() < 2) continue;
        points.insert(points.end(), line.begin(), line.end());
        counts.push_back(static_cast<std::int32_t>(line.size()));
      }
    }
  }
  if (points.empty()) {
    hideTool();
    return;
  }
  outline_->point.setNum(0);
  outline_->point.setValues(0, static_cast<int>(points.size()), points.data());
  lines_->numVertices.setNum(0);
  lines_->numVertices.setValues(0, static_cast<int>(counts.size()), counts.data());
  tool_->whichChild = SO_SWITCH_ALL;
}

void SandScene::hideTool() {
  tool_->whichChild = SO_SWITCH_NONE;
}

std::size_t SandScene::bufferBytes() const {
  return sand_->bufferBytes();
}

std::size_t SandScene::uploadedBytes() const {
  return sand_->uploadedBytes();
}

}  // namespace teren
