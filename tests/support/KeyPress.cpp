#include "tests/support/KeyPress.h"

#include <X11/Xlib.h>

namespace teren::test {

int pressKey(const std::string& display, const std::string& key) {
  Display* const server = XOpenDisplay(display.c_str());
  if (server == nullptr) return 0;
  Window root = DefaultRootWindow(server), parent = 0, *windows = nullptr;
  unsigned count = 0;
  int shown = 0;
  XQueryTree(server, root, &root, &parent, &windows, &count);
  for (unsigned n = 0; n < count; ++n) {
    XWindowAttributes attributes{};
    if (XGetWindowAttributes(server, windows[n], &attributes) == 0 || attributes.map_state != IsViewable) {
      continue;
    }
    ++shown;
    XEvent event{};
    event.xkey.window = windows[n];
    event.xkey.root = root;
    event.xkey.keycode = XKeysymToKeycode(server, XStringToKeysym(key.c_str()));
    event.xkey.same_screen = True;
    for (const int type : {KeyPress, KeyRelease}) {
      event.type = type;
      XSendEvent(server, windows[n], False, type == KeyPress ? KeyPressMask : KeyReleaseMask, &event);
    }
  }
  if (windows != nullptr) XFree(windows);
  XCloseDisplay(server);
  return shown;
}

}  // namespace teren::test
