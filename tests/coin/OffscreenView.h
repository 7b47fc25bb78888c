// Renders a scene graph into an image without a window: what the picture tests look at.
#pragma once

#include <memory>

#include <Inventor/SbColor.h>
#include <QImage>

class SoNode;

namespace teren {

/// A GL context of its own with a framebuffer of a fixed size. Needs a QGuiApplication on an X display
/// (xvfb-run is enough) and SoDB::init(). One thread.
class OffscreenView {
 public:
  OffscreenView(int width, int height);
  ~OffscreenView();
  OffscreenView(const OffscreenView&) = delete;
  OffscreenView& operator=(const OffscreenView&) = delete;

  /// Draws the scene, camera included, over `background`; waits until GL has finished.
  void draw(SoNode* root, const SbColor& background);
  /// Draws, and reads the picture (RGB).
  QImage picture(SoNode* root, const SbColor& background);

  /// Tells Inventor that the context dies, as a viewer does, and destroys it; nothing may be drawn after it.
  void destroyContext();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace teren
