#include "apps/static/ExaminerView.h"

#include <chrono>

#include <GL/gl.h>

#include "apps/window/FramePicture.h"

namespace teren {

QImage ExaminerView::renderAndRead() {
  picture_ = QImage();
  reading_ = true;
  render();
  reading_ = false;
  return picture_;
}

void ExaminerView::actualRedraw() {
  const auto begin = std::chrono::steady_clock::now();
  SoQtExaminerViewer::actualRedraw();
  if (reading_) {
    const SbVec2s size = getViewportRegion().getViewportSizePixels();
    picture_ = readFrame({size[0], size[1]});
  } else {
    glFinish();  // else only the giving of orders would be timed
  }
  frameTimes_.add(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
}

}  // namespace teren
