#include "apps/window/FramePicture.h"

#include <GL/gl.h>

namespace teren {

QImage readFrame(QSize pixels) {
  QImage upsideDown(pixels, QImage::Format_RGBX8888);
  glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, upsideDown.bytesPerLine() / 4);
  glReadPixels(0, 0, upsideDown.width(), upsideDown.height(), GL_RGBA, GL_UNSIGNED_BYTE, upsideDown.bits());
  glPopClientAttrib();
  return upsideDown.mirrored().convertToFormat(QImage::Format_RGB888);
}

}  // namespace teren
