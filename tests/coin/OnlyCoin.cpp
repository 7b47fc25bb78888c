// A program linked to Open Inventor alone, which knows nothing of Teren: it reads a file with land in it,
// draws it, picks a point of it, asks for its box and writes it back. Inventor has to find libSoTerrain.so by
// itself.
//   coin-only READ.iv WRITTEN.iv
// Inventor needs somebody to open a GL context for it (a viewer does). This program asks libX11 and libGLX
// for one, both loaded at run time: libGLX because Inventor itself brings it, libX11 because GLX needs a
// display.
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <set>
#include <vector>

#include <GL/glx.h>
#include <Inventor/SbColor.h>
#include <Inventor/SbTime.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoOutput.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/SoSceneManager.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/actions/SoWriteAction.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/sensors/SoSensorManager.h>

namespace {

constexpr short kWidth = 160, kHeight = 120;

[[noreturn]] void giveUp(const char* why) {
  std::fprintf(stderr, "coin-only: %s\n", why);
  std::exit(1);
}

template <class Function>
Function* find(const char* library, const char* name) {
  void* handle = dlopen(library, RTLD_NOW);
  void* symbol = handle == nullptr ? nullptr : dlsym(handle, name);
  if (symbol == nullptr) giveUp(name);
  return reinterpret_cast<Function*>(symbol);
}
#define TEREN_FIND(library, function) find<decltype(function)>(library, #function)

/// Makes a GL context without a window the current one; it lasts as long as the program.
void openContext() {
  Display* display = TEREN_FIND("libX11.so.6", XOpenDisplay)(nullptr);
  if (display == nullptr) giveUp("there is no X display");
  const int wanted[] = {GLX_DRAWABLE_TYPE,
                        GLX_PBUFFER_BIT,
                        GLX_RED_SIZE,
                        8,
                        GLX_GREEN_SIZE,
                        8,
                        GLX_BLUE_SIZE,
                        8,
                        GLX_DEPTH_SIZE,
                        16,
                        None};
  int count = 0;
  GLXFBConfig* kinds = TEREN_FIND("libGLX.so.0", glXChooseFBConfig)(display, 0, wanted, &count);
  if (kinds == nullptr || count == 0) giveUp("GLX offers no framebuffer");
  const int size[] = {GLX_PBUFFER_WIDTH, kWidth, GLX_PBUFFER_HEIGHT, kHeight, None};
  const GLXPbuffer buffer = TEREN_FIND("libGLX.so.0", glXCreatePbuffer)(display, kinds[0], size);
  const GLXContext context =
      TEREN_FIND("libGLX.so.0", glXCreateNewContext)(display, kinds[0], GLX_RGBA_TYPE, nullptr, True);
  if (TEREN_FIND("libGLX.so.0", glXMakeContextCurrent)(display, buffer, buffer, context) == False) {
    giveUp("GLX makes no context");
  }
}

/// What a viewer's main loop does, until nobody waits for a timer any more: the land is there then.
void runSensors() {
  SoDB::setRealTimeInterval(SbTime::zero());  // Inventor's clock is nobody's concern here
  SbTime next;
  do {
    SoDB::getSensorManager()->processTimerQueue();
    SoDB::getSensorManager()->processDelayQueue(TRUE);
  } while (SoDB::getSensorManager()->isTimerSensorPending(next));
}

/// Prints how much of the picture's lower half is not background, and how many colors it has.
void draw(SoNode* root) {
  SoSceneManager manager;
  manager.setViewportRegion(SbViewportRegion(kWidth, kHeight));
  manager.setBackgroundColor(SbColor(1.0F, 0.0F, 1.0F));
  manager.setSceneGraph(root);
  manager.render();
  runSensors();
  manager.render();
  std::vector<unsigned char> pixels(std::size_t{3} * kWidth * kHeight);
  TEREN_FIND("libOpenGL.so.0", glPixelStorei)(GL_PACK_ALIGNMENT, 1);
  TEREN_FIND("libOpenGL.so.0", glReadPixels)
  (0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  const std::size_t lowerHalf = pixels.size() / 2;  // GL begins at the bottom
  std::size_t drawn = 0;
  std::set<std::array<unsigned char, 3>> colors;
  for (std::size_t at = 0; at < lowerHalf; at += 3) {
    const std::array<unsigned char, 3> color{pixels[at], pixels[at + 1], pixels[at + 2]};
    if (color == std::array<unsigned char, 3>{255, 0, 255}) continue;
    ++drawn;
    colors.insert(color);
  }
  std::printf("drawn %zu of %zu pixels in %zu colors\n", drawn, lowerHalf / 3, colors.size());
}

void pick(SoNode* root, float x, float y) {
  SoRayPickAction action(SbViewportRegion(kWidth, kHeight));
  action.setRay(SbVec3f(x, y, 5000.0F), SbVec3f(0.0F, 0.0F, -1.0F));
  action.apply(root);
  const SoPickedPoint* picked = action.getPickedPoint();
  if (picked == nullptr) giveUp("no point is picked");
  const SbVec3f point = picked->getPoint();
  std::printf("picked %.3f %.3f %.3f\n", point[0], point[1], point[2]);
}

void askForBox(SoNode* root) {
  SoGetBoundingBoxAction action(SbViewportRegion(kWidth, kHeight));
  action.apply(root);
  const SbVec3f low = action.getBoundingBox().getMin(), high = action.getBoundingBox().getMax();
  std::printf("box %.3f %.3f %.3f to %.3f %.3f %.3f\n", low[0], low[1], low[2], high[0], high[1], high[2]);
}

void write(SoNode* root, const char* file) {
  SoOutput output;
  if (output.openFile(file) == FALSE) giveUp("the file to write cannot be opened");
  SoWriteAction action(&output);
  action.apply(root);
}

bool isLoaded(const char* library) {
  return dlopen(library, RTLD_NOW | RTLD_NOLOAD) != nullptr;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) giveUp("expected the file to read and the file to write");
  SoDB::init();
  if (isLoaded("libSoTerrain.so") || isLoaded("libteren-core.so.0"))
    giveUp("Teren is linked to this program");
  SoInput input;
  if (input.openFile(arguments[1]) == FALSE) giveUp("the file to read cannot be opened");
  SoSeparator* land = SoDB::readAll(&input);
  if (land == nullptr) giveUp("the file to read is not understood");

  auto* root = new SoSeparator;
  root->ref();
  auto* camera = new SoPerspectiveCamera;  // looks north and 20 degrees down
  camera->position = SbVec3f(0.0F, 0.0F, 400.0F);
  camera->orientation = SbRotation(SbVec3f(1.0F, 0.0F, 0.0F), 1.22F);
  camera->nearDistance = 1.0F;
  camera->farDistance = 10000.0F;
  root->addChild(camera);
  root->addChild(land);
  openContext();
  draw(root);
  pick(root, 10.0F, 20.0F);
  askForBox(root);
  write(land, arguments[2]);
  std::printf("loaded %s\n", isLoaded("libSoTerrain.so") ? "libSoTerrain.so" : "nothing");
  root->unref();
}
