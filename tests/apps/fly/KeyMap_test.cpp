#include "apps/fly/KeyMap.h"

#include <set>
#include <string>
#include <utility>

#include <Qt>
#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(KeyMap, LeavesTheKeysOfObjectsToThemAndKnowsTheirNames) {
  const std::pair<int, const char*> names[] = {
      {Qt::Key_Up, "Up"}, {Qt::Key_Down, "Down"}, {Qt::Key_Left, "Left"}, {Qt::Key_Right, "Right"},
      {Qt::Key_W, "W"},   {Qt::Key_S, "S"},       {Qt::Key_A, "A"},       {Qt::Key_D, "D"},
      {Qt::Key_R, "R"},   {Qt::Key_F, "F"},       {Qt::Key_1, "1"},       {Qt::Key_Space, "Space"}};
  for (const auto& [key, name] : names) {
    EXPECT_FALSE(KeyMap::action(key, false)) << name;
    EXPECT_EQ(KeyMap::name(key, false), name);
  }
  EXPECT_EQ(KeyMap::name(Qt::Key_7, true), "Num 7");
  EXPECT_EQ(KeyMap::name(Qt::Key_F35, false), "");
  EXPECT_EQ(KeyMap::name(Qt::Key_Eacute, false), "");
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
  EXPECT_EQ(KeyMap::action(Qt::Key_Plus, false), Action::finer);
  EXPECT_EQ(KeyMap::action(Qt::Key_Equal, false), Action::finer);  // plus without shift on some keyboards
  EXPECT_EQ(KeyMap::action(Qt::Key_Minus, false), Action::coarser);
  EXPECT_EQ(KeyMap::action(Qt::Key_Plus, true), Action::finer);
  EXPECT_EQ(KeyMap::action(Qt::Key_Period, false), Action::farther);
  EXPECT_EQ(KeyMap::action(Qt::Key_Comma, false), Action::nearer);
  EXPECT_EQ(KeyMap::action(Qt::Key_F2, false), Action::detailPanel);
  EXPECT_EQ(KeyMap::action(Qt::Key_F3, false), Action::landColours);
  EXPECT_EQ(KeyMap::action(Qt::Key_F4, false), Action::freeze);
  EXPECT_EQ(KeyMap::action(Qt::Key_F6, false), Action::wires);
  EXPECT_EQ(KeyMap::action(Qt::Key_F7, false), Action::frameGraph);
  EXPECT_EQ(KeyMap::action(Qt::Key_P, false), Action::pause);
  EXPECT_EQ(KeyMap::action(Qt::Key_F1, false), Action::help);
  EXPECT_EQ(KeyMap::action(Qt::Key_F5, false), Action::reload);
  EXPECT_EQ(KeyMap::action(Qt::Key_G, false), Action::dig);
  EXPECT_EQ(KeyMap::action(Qt::Key_T, false), Action::nextTool);
  EXPECT_EQ(KeyMap::action(Qt::Key_V, false), Action::smallerTool);
  EXPECT_EQ(KeyMap::action(Qt::Key_B, false), Action::largerTool);
  EXPECT_EQ(KeyMap::action(Qt::Key_N, false), Action::shallowerTool);
  EXPECT_EQ(KeyMap::action(Qt::Key_M, false), Action::deeperTool);
  EXPECT_EQ(KeyMap::action(Qt::Key_Z, false), Action::undo);
  EXPECT_EQ(KeyMap::action(Qt::Key_Y, false), Action::redo);
  EXPECT_EQ(KeyMap::action(Qt::Key_F11, false), Action::fullScreen);
  EXPECT_EQ(KeyMap::action(Qt::Key_F12, false), Action::screenshot);
  EXPECT_EQ(KeyMap::action(Qt::Key_Escape, false), Action::quit);
}

TEST(KeyMap, ExplainsInItsHelpEveryKeyThatDoesSomething) {
  std::string keys;
  for (const KeyHelp& line : KeyMap::help()) {
    EXPECT_FALSE(line.does.empty());
    keys.append(line.keys).append(", ");
  }
  for (const char* key :
       {"mouse", "wheel", "Num 8 2 4 6", "I K J L", "PageUp", "PageDown", "Num 5",      "Home",
        "C,",    "Tab",   "P,",          "F1,",     "F5,",    "+, -",     ". (period)", "(comma)",
        "F2,",   "F3,",   "F4,",         "F6,",     "F7,",    "F11",      "F12",        "Escape",
        "T,",    "G ",    "right mouse", "V, B",    "N, M",   "Z, Y"}) {
    EXPECT_NE(keys.find(key), std::string::npos) << key;
  }
}

TEST(KeyMap, TakesShiftWithZForRedoAndLeavesOtherKeysAsTheyAre) {
  EXPECT_EQ(KeyMap::action(KeyMap::withShift(Qt::Key_Z), false), Action::redo);
  EXPECT_EQ(KeyMap::withShift(Qt::Key_Y), Qt::Key_Y);
  EXPECT_EQ(KeyMap::withShift(Qt::Key_W), Qt::Key_W);
  EXPECT_TRUE(isRepeatedAction(Action::undo));
  EXPECT_TRUE(isRepeatedAction(Action::redo));
  EXPECT_FALSE(isRepeatedAction(Action::nextTool));
}

TEST(KeyMap, LetsTheKeysThatSteerMoveACameraThatFliesAlone) {
  const std::pair<int, Action> keys[] = {
      {Qt::Key_Up, Action::cameraForward},  {Qt::Key_W, Action::cameraForward},
      {Qt::Key_Down, Action::cameraBack},   {Qt::Key_S, Action::cameraBack},
      {Qt::Key_Left, Action::cameraLeft},   {Qt::Key_A, Action::cameraLeft},
      {Qt::Key_Right, Action::cameraRight}, {Qt::Key_D, Action::cameraRight},
      {Qt::Key_R, Action::cameraUp},        {Qt::Key_F, Action::cameraDown},
      {Qt::Key_I, Action::cameraForward},   {Qt::Key_F4, Action::freeze}};
  for (const auto& [key, action] : keys) EXPECT_EQ(KeyMap::action(KeyMap::whileFrozen(key), false), action);
}

TEST(HeldKeys, MoveTheCameraWhileHeld) {
  HeldKeys keys;
  keys.press(Qt::Key_I, false);
  keys.press(Qt::Key_J, false);
  keys.press(Qt::Key_PageDown, false);
  EXPECT_EQ(keys.cameraMoves().forward, 1.0);
  EXPECT_EQ(keys.cameraMoves().right, -1.0);
  EXPECT_EQ(keys.cameraMoves().up, -1.0);
  keys.release(Qt::Key_J, false);
  EXPECT_EQ(keys.cameraMoves().right, 0.0);
  keys.releaseAll();
  EXPECT_EQ(keys.cameraMoves().forward, 0.0);
}

TEST(HeldKeys, DigWhileTheToolsKeyIsDown) {
  HeldKeys keys;
  EXPECT_FALSE(keys.dig());
  keys.press(Qt::Key_G, false);
  EXPECT_TRUE(keys.dig());
  EXPECT_EQ(keys.cameraMoves().forward, 0.0);
  keys.release(Qt::Key_G, false);
  EXPECT_FALSE(keys.dig());
}

TEST(HeldKeys, CancelOutWhenTheyContradict) {
  HeldKeys keys;
  keys.press(Qt::Key_J, false);
  keys.press(Qt::Key_L, false);
  EXPECT_EQ(keys.cameraMoves().right, 0.0);
}

TEST(HeldKeys, KeepAnActionUntilTheLastOfItsKeysIsReleased) {
  HeldKeys keys;
  keys.press(Qt::Key_I, false);
  keys.press(Qt::Key_8, true);
  keys.release(Qt::Key_I, false);
  EXPECT_EQ(keys.cameraMoves().forward, 1.0);
  keys.release(Qt::Key_8, true);
  EXPECT_EQ(keys.cameraMoves().forward, 0.0);
}

TEST(HeldKeys, TellTheNumberPadFromTheArrows) {
  HeldKeys keys;
  keys.press(Qt::Key_Up, false);
  EXPECT_EQ(keys.cameraMoves().forward, 0.0);
  keys.press(Qt::Key_Up, true);
  EXPECT_EQ(keys.cameraMoves().forward, 1.0);
  keys.press(Qt::Key_PageDown, false);
  EXPECT_EQ(keys.cameraMoves().up, -1.0);
}

TEST(HeldKeys, LeaveOutKeysThatActOncePerPress) {
  HeldKeys keys;
  keys.press(Qt::Key_P, false);
  keys.press(Qt::Key_Q, false);
  EXPECT_EQ(keys.cameraMoves().forward, 0.0);
  EXPECT_FALSE(isHeldAction(Action::pause));
  EXPECT_FALSE(isHeldAction(Action::nextTool));
  EXPECT_TRUE(isHeldAction(Action::cameraDown));
}

}  // namespace
}  // namespace teren
