#include "apps/fly/ToolRing.h"

#include <algorithm>
#include <cassert>
#include <initializer_list>

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoTranslation.h>

namespace teren {

ToolRing::ToolRing() : root_(new SoSwitch), place_(new SoTranslation), points_(new SoCoordinate3) {
  root_->ref();
  auto* drawn = new SoSeparator;
  drawn->renderCaching = SoSeparator::OFF;
  drawn->renderCulling = SoSeparator::OFF;
  auto* depth = new SoDepthBuffer;
  depth->test = FALSE;
  depth->write = FALSE;
  auto* light = new SoLightModel;
  light->model = SoLightModel::BASE_COLOR;
  for (SoNode* node : std::initializer_list<SoNode*>{place_, depth, light, points_}) drawn->addChild(node);
  // A dark line under a bright one is seen on snow and on rock.
  for (const bool isDark : {true, false}) {
    auto* colour = new SoBaseColor;
    colour->rgb = isDark ? SbColor(0.10F, 0.08F, 0.02F) : SbColor(1.0F, 0.86F, 0.22F);
    auto* style = new SoDrawStyle;
    style->lineWidth = isDark ? 4.0F : 2.0F;
    auto* lines = new SoLineSet;
    lines->numVertices.set1Value(0, kPoints + 1);
    lines->numVertices.set1Value(1, 2);
    lines->numVertices.set1Value(2, 2);
    for (SoNode* node : std::initializer_list<SoNode*>{colour, style, lines}) drawn->addChild(node);
  }
  root_->addChild(drawn);
  hide();
}

ToolRing::~ToolRing() {
  root_->unref();
}

void ToolRing::hide() {
  root_->whichChild = SO_SWITCH_NONE;
}

void ToolRing::show(const SbVec3f& place, std::span<const SbVec3f> around,
                    std::span<const SbVec3f, 4> cross) {
  assert(around.size() == kPoints);
  place_->translation = place;
  points_->point.setNum(kPoints + 5);
  SbVec3f* points = points_->point.startEditing();
  points = std::copy(around.begin(), around.end(), points);
  *points++ = around.front();
  std::copy(cross.begin(), cross.end(), points);
  points_->point.finishEditing();
  root_->whichChild = 0;
}

}  // namespace teren
