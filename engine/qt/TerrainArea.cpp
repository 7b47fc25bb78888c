#include "qt/TerrainArea.h"

#include <utility>

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/misc/SoContextHandler.h>
#include <QWidget>
#include <QWindow>

namespace teren {

TerrainArea::TerrainArea(QWidget* parent, std::function<void()> drawn)
    : SoQtRenderArea(parent, "teren", TRUE, FALSE, FALSE), drawn_(std::move(drawn)) {
  setBorder(FALSE);
  setStealFocus(FALSE);
  setTransparencyType(SoGLRenderAction::BLEND);
}

TerrainArea::~TerrainArea() {
  if (context_ == 0) return;
  glLockNormal();
  SoContextHandler::destructingContext(context_);
  glUnlockNormal();
}

void TerrainArea::initGraphic() {
  SoQtRenderArea::initGraphic();
  if (context_ == 0) context_ = SoGLCacheContextElement::getUniqueCacheContext();
  getGLRenderAction()->setCacheContext(context_);
}

void TerrainArea::redraw() {
  const QWindow* canvas = getGLWidget()->windowHandle();
  if (canvas != nullptr && canvas->isExposed()) SoQtRenderArea::redraw();  // else it is drawn when it is
}

void TerrainArea::actualRedraw() {
  SoQtRenderArea::actualRedraw();
  drawn_();
}

}  // namespace teren
