// The part of the window that Coin draws into, with something drawn over it and pictures taken of it.
#pragma once

#include <functional>

#include <Inventor/Qt/SoQtRenderArea.h>
#include <QImage>
#include <QSize>

namespace teren {

/// A SoQt render area that draws only when told to by render().
class RenderArea : public SoQtRenderArea {
 public:
  explicit RenderArea(QWidget* parent);
  /// Tells Coin that the GL context goes, so that nodes give back what they hold in it: delete it before
  /// them.
  ~RenderArea() override;

  /// Called after every drawing of the scene, in the same GL context and before the frame is presented.
  void setOverlay(std::function<void(QSize pixels)> overlay) { overlay_ = std::move(overlay); }

  /// Draws one frame and reads the finished picture back, overlay included; null where nothing was drawn
  /// because the window is hidden.
  QImage renderAndRead();

  QSize pixels() const;

 protected:
  void actualRedraw() override;

 private:
  std::function<void(QSize pixels)> overlay_;
  bool reading_ = false;
  QImage picture_;
};

}  // namespace teren
