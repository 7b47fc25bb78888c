// Runs the tests of a program with windows on a display of its own.
#include <cstdlib>

#include <gtest/gtest.h>

#include "apps/window/WindowProgram.h"
#include "tests/support/PrivateDisplay.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const teren::PrivateDisplay display;
  setenv("DISPLAY", display.name().c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  unsetenv("WAYLAND_DISPLAY");
  int failed = 1;
  const teren::Result<void> ran = teren::runWithWindows("test-fly", argv, [&failed] {
    failed = RUN_ALL_TESTS();
    return teren::Result<void>();
  });
  return ran ? failed : 1;
}
