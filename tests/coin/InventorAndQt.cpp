// Sets up what every test of engine/coin stands on; linked to their program, it does so by itself.
#include <Inventor/SoDB.h>
#include <QGuiApplication>
#include <gtest/gtest.h>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

/// Set up before the first test and not for listing them, which happens while building, without a display.
class InventorAndQt : public ::testing::Environment {
 public:
  void SetUp() override {
    static int count = 1;
    static char name[] = "coin-tests";
    static char* arguments[] = {name, nullptr};
    // Never deleted: that would unload the GL driver, and the leak sanitizer could not tell whose its leaks
    // are.
    static auto* const application = new QGuiApplication(count, arguments);
    static_cast<void>(application);
    SoDB::init();
    SoTerrain::initClass();
  }
};
[[maybe_unused]] const auto* const kEnvironment = ::testing::AddGlobalTestEnvironment(new InventorAndQt);

}  // namespace
}  // namespace teren
