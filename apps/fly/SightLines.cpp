#include "apps/fly/SightLines.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoIndexedLineSet.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoTranslation.h>

namespace teren {
namespace {

constexpr std::array kFrames{0.02, 0.1, 0.3, 0.6, 1.0};  // of the length

}  // namespace

SightLines::SightLines() : root_(new SoSwitch), place_(new SoTranslation), points_(new SoCoordinate3) {
  root_->ref();
  auto* drawn = new SoSeparator;
  drawn->renderCaching = SoSeparator::OFF;
  drawn->renderCulling = SoSeparator::OFF;
  auto* light = new SoLightModel;
  light->model = SoLightModel::BASE_COLOR;
  auto* colour = new SoBaseColor;
  colour->rgb = SbColor(1.0F, 0.85F, 0.1F);
  auto* style = new SoDrawStyle;
  style->lineWidth = 2.0F;
  auto* lines = new SoIndexedLineSet;
  int count = 0;
  const auto strip = [&](std::initializer_list<std::int32_t> indices) {
    for (const std::int32_t index : indices) lines->coordIndex.set1Value(count++, index);
    lines->coordIndex.set1Value(count++, -1);
  };
  const auto farthest = static_cast<std::int32_t>(4 * kFrames.size() - 3);
  for (std::int32_t corner = 0; corner < 4; ++corner) strip({0, farthest + corner});
  for (std::int32_t first = 1; first <= farthest; first += 4) {
    strip({first, first + 1, first + 2, first + 3, first});
  }
  for (SoNode* node : std::initializer_list<SoNode*>{place_, light, colour, style, points_, lines}) {
    drawn->addChild(node);
  }
  root_->addChild(drawn);
  hide();
}

SightLines::~SightLines() {
  root_->unref();
}

void SightLines::hide() {
  root_->whichChild = SO_SWITCH_NONE;
}

void SightLines::show(const SbRotation& turn, double fieldOfView, double aspect, double length) {
  const double up = std::tan(0.5 * fieldOfView), right = up * aspect;
  int count = 0;
  const auto add = [&](double x, double y, double z) {
    SbVec3f point(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    turn.multVec(point, point);
    points_->point.set1Value(count++, point);
  };
  add(0.0, 0.0, 0.0);
  for (const double share : kFrames) {
    const double far = share * length;
    add(-right * far, -up * far, -far);
    add(right * far, -up * far, -far);
    add(right * far, up * far, -far);
    add(-right * far, up * far, -far);
  }
  root_->whichChild = 0;
}

void SightLines::moveTo(const SbVec3f& eye) {
  place_->translation = eye;
}

}  // namespace teren
