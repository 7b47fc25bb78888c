// The examiner viewer of SoQt, with its frames timed and pictures taken of them.
#pragma once

#include <Inventor/Qt/viewers/SoQtExaminerViewer.h>
#include <QImage>

#include "apps/window/FrameStatistics.h"

namespace teren {

/// Turn with the left button, move with the middle one, come nearer with both or the wheel. Draws when
/// something changes.
class ExaminerView : public SoQtExaminerViewer {
 public:
  explicit ExaminerView(QWidget* parent) : SoQtExaminerViewer(parent) {}

  /// Draws one frame and reads it back; null where nothing was drawn because the window is hidden.
  QImage renderAndRead();

  /// [ms] that drawing took, each frame.
  const FrameStatistics& frameTimes() const noexcept { return frameTimes_; }

 protected:
  void actualRedraw() override;

 private:
  FrameStatistics frameTimes_;
  bool reading_ = false;
  QImage picture_;
};

}  // namespace teren
