#include "apps/fly/RenderArea.h"

#include <GL/gl.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/misc/SoContextHandler.h>

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
  if (!reading_) return;
  QImage upsideDown(pixels(), QImage::Format_RGBX8888);
  glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, upsideDown.bytesPerLine() / 4);
  glReadPixels(0, 0, upsideDown.width(), upsideDown.height(), GL_RGBA, GL_UNSIGNED_BYTE, upsideDown.bits());
  glPopClientAttrib();
  picture_ = upsideDown.mirrored().convertToFormat(QImage::Format_RGB888);
}

}  // namespace teren
