#include "tests/coin/OffscreenView.h"

#include <cstdint>
#include <stdexcept>

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoSceneManager.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/misc/SoContextHandler.h>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>

namespace teren {

struct OffscreenView::State {
  QOffscreenSurface surface;
  QOpenGLContext context;
  std::unique_ptr<QOpenGLFramebufferObject> frame;
  std::unique_ptr<SoSceneManager> manager;
  std::uint32_t contextNumber = 0;
};

OffscreenView::OffscreenView(int width, int height) : state_(std::make_unique<State>()) {
  QSurfaceFormat format;
  format.setVersion(2, 1);
  format.setProfile(QSurfaceFormat::CompatibilityProfile);
  state_->surface.setFormat(format);
  state_->surface.create();
  state_->context.setFormat(format);
  if (!state_->context.create() || !state_->context.makeCurrent(&state_->surface)) {
    throw std::runtime_error("no OpenGL context; run the test under xvfb-run");
  }
  QOpenGLFramebufferObjectFormat kind;
  kind.setAttachment(QOpenGLFramebufferObject::Depth);
  kind.setInternalTextureFormat(GL_RGB8);  // with an alpha channel, reading would multiply the colours by it
  state_->frame = std::make_unique<QOpenGLFramebufferObject>(width, height, kind);
  state_->contextNumber = SoGLCacheContextElement::getUniqueCacheContext();
  const SbViewportRegion region(static_cast<short>(width), static_cast<short>(height));
  state_->manager = std::make_unique<SoSceneManager>();
  state_->manager->setViewportRegion(region);
  state_->manager->getGLRenderAction()->setCacheContext(state_->contextNumber);
}

OffscreenView::~OffscreenView() {
  if (state_->frame) destroyContext();
}

void OffscreenView::destroyContext() {
  state_->context.makeCurrent(&state_->surface);
  state_->manager.reset();
  SoContextHandler::destructingContext(state_->contextNumber);
  state_->frame.reset();
  state_->context.doneCurrent();
}

void OffscreenView::draw(SoNode* root, const SbColor& background) {
  state_->context.makeCurrent(&state_->surface);
  state_->frame->bind();
  state_->context.functions()->glEnable(GL_DEPTH_TEST);
  if (state_->manager->getSceneGraph() != root) state_->manager->setSceneGraph(root);
  state_->manager->setBackgroundColor(background);
  state_->manager->render();
  state_->context.functions()->glFinish();
}

QImage OffscreenView::picture(SoNode* root, const SbColor& background) {
  draw(root, background);
  return state_->frame->toImage().convertToFormat(QImage::Format_RGB888);
}

}  // namespace teren
