// Gives the tests of engine/qt a display of their own and Qt; linked to their program, it does so by itself.
#include <cstdlib>

#include <QApplication>
#include <gtest/gtest.h>

#include "tests/support/PrivateDisplay.h"

// No leak check at the end of these tests, under the address sanitizer: about once in a hundred runs its
// tracer itself crashes while it looks at the threads of the software GL driver.
extern "C" [[gnu::visibility("default")]] int __lsan_is_turned_off() {
  return 1;
}

namespace teren {
namespace {

/// Set up before the first test and not for listing them, which happens while building.
class Desk : public ::testing::Environment {
 public:
  void SetUp() override {
    display_ = new PrivateDisplay;
    ASSERT_FALSE(display_->name().empty()) << "Xvfb did not start";
    setenv("DISPLAY", display_->name().c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("QT_QPA_PLATFORM", "xcb", 1);
    static int count = 1;
    static char name[] = "qt-tests";
    static char* arguments[] = {name, nullptr};
    // Never deleted: that would unload the GL driver, and the leak sanitizer could not tell whose its leaks
    // are.
    static auto* const application = new QApplication(count, arguments);
    QApplication::setQuitOnLastWindowClosed(false);
    static_cast<void>(application);
  }
  void TearDown() override { delete display_; }

 private:
  PrivateDisplay* display_ = nullptr;
};
[[maybe_unused]] const auto* const kDesk = ::testing::AddGlobalTestEnvironment(new Desk);

}  // namespace
}  // namespace teren
