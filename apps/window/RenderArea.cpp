#include "apps/window/RenderArea.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/misc/SoContextHandler.h>

#include "apps/window/FramePicture.h"

namespace teren {

RenderArea::RenderArea(QWidget* parent) : SoQtRenderArea(parent, "teren", TRUE, TRUE, TRUE) {
  setAutoRedraw(FALSE);
  setTransparencyType(SoGLRenderAction::BLEND);
}

RenderArea::~RenderArea() {
  if (!hasNormalGLArea()) return;
  glLockNormal();
  SoContextHandler::destructingContext(getGLRenderAction()->getCacheContext());
  glUnlockNormal();
}

QSize RenderArea::pixels() const {
  const SbVec2s size = getViewportRegion().getViewportSizePixels();
  return {size[0], size[1]};
}

QImage RenderArea::renderAndRead() {
  picture_ = QImage();
  reading_ = true;
  render();
  reading_ = false;
  return picture_;
}

void RenderArea::actualRedraw() {
  SoQtRenderArea::actualRedraw();
  if (overlay_) overlay_(pixels());
  if (reading_) picture_ = readFrame(pixels());
}

}  // namespace teren
