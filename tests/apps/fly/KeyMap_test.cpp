#include "apps/fly/KeyMap.h"

#include <set>
#include <string>

#include <Qt>
#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(KeyMap, FliesWithArrowsAndTheSameWithWasd) {
  EXPECT_EQ(KeyMap::action(Qt::Key_Up, false), Action::faster);
  EXPECT_EQ(KeyMap::action(Qt::Key_W, false), Action::faster);
  EXPECT_EQ(KeyMap::action(Qt::Key_Down, false), Action::slower);
  EXPECT_EQ(KeyMap::action(Qt::Key_S, false), Action::slower);
  EXPECT_EQ(KeyMap::action(Qt::Key_Left, false), Action::turnLeft);
  EXPECT_EQ(KeyMap::action(Qt::Key_A, false), Action::turnLeft);
  EXPECT_EQ(KeyMap::action(Qt::Key_Right, false), Action::turnRight);
  EXPECT_EQ(KeyMap::action(Qt::Key_D, false), Action::turnRight);
  EXPECT_EQ(KeyMap::action(Qt::Key_R, false), Action::climb);
  EXPECT_EQ(KeyMap::action(Qt::Key_F, false), Action::descend);
}

TEST(KeyMap, MovesTheCameraFromTheNumberPadWithAndWithoutNumLockAndFromTheLetters) {
  for (const int key : {Qt::Key_8, Qt::Key_Up}) EXPECT_EQ(KeyMap::action(key, true), Action::cameraForward);
  for (const int key : {Qt::Key_2, Qt::Key_Down}) EXPECT_EQ(KeyMap::action(key, true), Action::cameraBack);
  for (const int key : {Qt::Key_4, Qt::Key_Left}) EXPECT_EQ(KeyMap::action(key, true), Action::cameraLeft);
  for (const int key : {Qt::Key_6, Qt::Key_Right}) EXPECT_EQ(KeyMap::action(key, true), Action::cameraRight);
  for (const int key : {Qt::Key_5, Qt::Key_Clear}) EXPECT_EQ(KeyMap::action(key, true), Action::cameraReset);
  EXPECT_EQ(KeyMap::action(Qt::Key_I, false), Action::cameraForward);
  EXPECT_EQ(KeyMap::action(Qt::Key_K, false), Action::cameraBack);
  EXPECT_EQ(KeyMap::action(Qt::Key_J, false), Action::cameraLeft);
  EXPECT_EQ(KeyMap::action(Qt::Key_L, false), Action::cameraRight);
  EXPECT_EQ(KeyMap::action(Qt::Key_PageUp, false), Action::cameraUp);
  EXPECT_EQ(KeyMap::action(Qt::Key_PageDown, false), Action::cameraDown);
  EXPECT_EQ(KeyMap::action(Qt::Key_Home, false), Action::cameraReset);
}

TEST(KeyMap, ReadsDigitsOnlyFromTheNumberPad) {
  for (const int key : {Qt::Key_8, Qt::Key_2, Qt::Key_4, Qt::Key_6, Qt::Key_5}) {
    EXPECT_FALSE(KeyMap::action(key, false));
  }
  EXPECT_FALSE(KeyMap::action(Qt::Key_Q, false));
}

TEST(KeyMap, HasAKeyForEveryOtherThing) {
  EXPECT_EQ(KeyMap::action(Qt::Key_C, false), Action::switchPerson);
  EXPECT_EQ(KeyMap::action(Qt::Key_Tab, false), Action::nextObject);
  EXPECT_EQ(KeyMap::action(Qt::Key_P, false), Action::pause);
  EXPECT_EQ(KeyMap::action(Qt::Key_F1, false), Action::help);
  EXPECT_EQ(KeyMap::action(Qt::Key_F11, false), Action::fullScreen);
  EXPECT_EQ(KeyMap::action(Qt::Key_F12, false), Action::screenshot);
  EXPECT_EQ(KeyMap::action(Qt::Key_Escape, false), Action::quit);
}

TEST(KeyMap, ExplainsInItsHelpEveryKeyThatDoesSomething) {
  std::string keys;
  for (const HelpLine& line : KeyMap::help()) {
    EXPECT_FALSE(line.does.empty());
    keys.append(line.keys).append(", ");
  }
  for (const char* key :
       {"Up", "Down",  "Left",  "Right",       "W,",      "S,",     "A,",       "D,",    "R,",
        "F,", "mouse", "wheel", "Num 8 2 4 6", "I K J L", "PageUp", "PageDown", "Num 5", "Home",
        "C,", "Tab",   "P,",    "F1,",         "F11",     "F12",    "Escape"}) {
    EXPECT_NE(keys.find(key), std::string::npos) << key;
  }
}

TEST(HeldKeys, BecomeControlsWhileHeld) {
  HeldKeys keys;
  keys.press(Qt::Key_Up, false);
  keys.press(Qt::Key_A, false);
  keys.press(Qt::Key_F, false);
  EXPECT_EQ(keys.controls().throttle, 1.0);
  EXPECT_EQ(keys.controls().turn, -1.0);
  EXPECT_EQ(keys.controls().climb, -1.0);
  keys.release(Qt::Key_A, false);
  EXPECT_EQ(keys.controls().turn, 0.0);
  keys.releaseAll();
  EXPECT_EQ(keys.controls().throttle, 0.0);
}

TEST(HeldKeys, CancelOutWhenTheyContradict) {
  HeldKeys keys;
  keys.press(Qt::Key_Left, false);
  keys.press(Qt::Key_Right, false);
  EXPECT_EQ(keys.controls().turn, 0.0);
}

TEST(HeldKeys, KeepAnActionUntilTheLastOfItsKeysIsReleased) {
  HeldKeys keys;
  keys.press(Qt::Key_W, false);
  keys.press(Qt::Key_Up, false);
  keys.release(Qt::Key_W, false);
  EXPECT_EQ(keys.controls().throttle, 1.0);
  keys.release(Qt::Key_Up, false);
  EXPECT_EQ(keys.controls().throttle, 0.0);
}

TEST(HeldKeys, TellTheNumberPadFromTheArrows) {
  HeldKeys keys;
  keys.press(Qt::Key_Up, true);
  EXPECT_EQ(keys.controls().throttle, 0.0);
  EXPECT_EQ(keys.cameraMoves().forward, 1.0);
  keys.press(Qt::Key_PageDown, false);
  EXPECT_EQ(keys.cameraMoves().up, -1.0);
}

TEST(HeldKeys, LeaveOutKeysThatActOncePerPress) {
  HeldKeys keys;
  keys.press(Qt::Key_P, false);
  keys.press(Qt::Key_Q, false);
  EXPECT_EQ(keys.controls().throttle, 0.0);
  EXPECT_FALSE(isHeldAction(Action::pause));
  EXPECT_TRUE(isHeldAction(Action::cameraDown));
}

}  // namespace
}  // namespace teren
