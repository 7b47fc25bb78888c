#include "apps/fly/KeyMap.h"

#include <algorithm>
#include <array>

#include <Qt>

namespace teren {
namespace {

enum class Where { anywhere, keypad, elsewhere };

struct Row {
  int key;
  Where where;
  Action action;
};

// The number pad sends digits with NumLock and cursor keys without; both are listed.
constexpr std::array kRows{
    Row{Qt::Key_8, Where::keypad, Action::cameraForward},
    Row{Qt::Key_Up, Where::keypad, Action::cameraForward},
    Row{Qt::Key_2, Where::keypad, Action::cameraBack},
    Row{Qt::Key_Down, Where::keypad, Action::cameraBack},
    Row{Qt::Key_4, Where::keypad, Action::cameraLeft},
    Row{Qt::Key_Left, Where::keypad, Action::cameraLeft},
    Row{Qt::Key_6, Where::keypad, Action::cameraRight},
    Row{Qt::Key_Right, Where::keypad, Action::cameraRight},
    Row{Qt::Key_5, Where::keypad, Action::cameraReset},
    Row{Qt::Key_Clear, Where::anywhere, Action::cameraReset},
    Row{Qt::Key_9, Where::keypad, Action::cameraUp},
    Row{Qt::Key_3, Where::keypad, Action::cameraDown},
    Row{Qt::Key_I, Where::anywhere, Action::cameraForward},
    Row{Qt::Key_K, Where::anywhere, Action::cameraBack},
    Row{Qt::Key_J, Where::anywhere, Action::cameraLeft},
    Row{Qt::Key_L, Where::anywhere, Action::cameraRight},
    Row{Qt::Key_PageUp, Where::anywhere, Action::cameraUp},
    Row{Qt::Key_PageDown, Where::anywhere, Action::cameraDown},
    Row{Qt::Key_Home, Where::anywhere, Action::cameraReset},
    Row{Qt::Key_C, Where::anywhere, Action::switchPerson},
    Row{Qt::Key_Tab, Where::anywhere, Action::nextObject},
    Row{Qt::Key_Plus, Where::anywhere, Action::finer},
    Row{Qt::Key_Equal, Where::anywhere, Action::finer},
    Row{Qt::Key_Minus, Where::anywhere, Action::coarser},
    Row{Qt::Key_Period, Where::elsewhere, Action::farther},
    Row{Qt::Key_Comma, Where::elsewhere, Action::nearer},
    Row{Qt::Key_F2, Where::anywhere, Action::detailPanel},
    Row{Qt::Key_F3, Where::anywhere, Action::landColours},
    Row{Qt::Key_F4, Where::anywhere, Action::freeze},
    Row{Qt::Key_F6, Where::anywhere, Action::wires},
    Row{Qt::Key_F7, Where::anywhere, Action::frameGraph},
    Row{Qt::Key_P, Where::anywhere, Action::pause},
    Row{Qt::Key_F1, Where::anywhere, Action::help},
    Row{Qt::Key_F5, Where::anywhere, Action::reload},
    Row{Qt::Key_G, Where::anywhere, Action::dig},
    Row{Qt::Key_T, Where::anywhere, Action::nextTool},
    Row{Qt::Key_V, Where::anywhere, Action::smallerTool},
    Row{Qt::Key_B, Where::anywhere, Action::largerTool},
    Row{Qt::Key_N, Where::anywhere, Action::shallowerTool},
    Row{Qt::Key_M, Where::anywhere, Action::deeperTool},
    Row{Qt::Key_Z, Where::anywhere, Action::undo},
    Row{Qt::Key_Y, Where::anywhere, Action::redo},
    Row{Qt::Key_F11, Where::anywhere, Action::fullScreen},
    Row{Qt::Key_F12, Where::anywhere, Action::screenshot},
    Row{Qt::Key_Escape, Where::anywhere, Action::quit},
};

constexpr std::array kFrozenKeys{
    std::pair{Qt::Key_Up, Qt::Key_I},     std::pair{Qt::Key_W, Qt::Key_I},
    std::pair{Qt::Key_Down, Qt::Key_K},   std::pair{Qt::Key_S, Qt::Key_K},
    std::pair{Qt::Key_Left, Qt::Key_J},   std::pair{Qt::Key_A, Qt::Key_J},
    std::pair{Qt::Key_Right, Qt::Key_L},  std::pair{Qt::Key_D, Qt::Key_L},
    std::pair{Qt::Key_R, Qt::Key_PageUp}, std::pair{Qt::Key_F, Qt::Key_PageDown}};

constexpr std::array<KeyHelp, 24> kHelp{{
    {"mouse drag", "look around"},
    {"wheel", "zoom"},
    {"Num 8 2 4 6  or  I K J L", "camera forward, back, left, right"},
    {"PageUp, PageDown", "camera up, down"},
    {"Num 5  or  Home", "camera back to its default"},
    {"C", "first or third person"},
    {"Tab", "next aircraft, or the truck"},
    {"T", "tool: dig, heap, smooth, crater, rake, shovel, pour, none"},
    {"G  or  right mouse button", "press it ahead, or where the mouse is; hold to draw it along"},
    {"V, B", "smaller tool, larger tool"},
    {"N, M", "shallower, deeper"},
    {"Z, Y  or  Ctrl+Z, Ctrl+Shift+Z", "undo, redo a stroke; of an earlier flight, one stamp"},
    {"+, -", "finer land, coarser land"},
    {". (period), , (comma)", "see farther, less far"},
    {"F2", "sliders for both"},
    {"F3", "colours: as land looks, by level, by error"},
    {"F4", "freeze what is drawn and fly off alone"},
    {"F6", "land as wires"},
    {"F7", "graph of the frames' times"},
    {"P", "pause"},
    {"F1", "this help"},
    {"F5", "make the land anew, with changed plugins"},
    {"F11, F12", "full screen, screenshot"},
    {"Escape", "quit"},
}};

constexpr std::array kNames{std::pair{Qt::Key_Up, "Up"},
                            std::pair{Qt::Key_Down, "Down"},
                            std::pair{Qt::Key_Left, "Left"},
                            std::pair{Qt::Key_Right, "Right"},
                            std::pair{Qt::Key_PageUp, "PageUp"},
                            std::pair{Qt::Key_PageDown, "PageDown"},
                            std::pair{Qt::Key_Home, "Home"},
                            std::pair{Qt::Key_End, "End"},
                            std::pair{Qt::Key_Space, "Space"},
                            std::pair{Qt::Key_Return, "Return"},
                            std::pair{Qt::Key_Shift, "Shift"},
                            std::pair{Qt::Key_Control, "Control"},
                            std::pair{Qt::Key_Insert, "Insert"},
                            std::pair{Qt::Key_Delete, "Delete"},
                            std::pair{Qt::Key_Backspace, "Backspace"}};

}  // namespace

bool isHeldAction(Action action) noexcept {
  return action < Action::cameraReset;
}

bool isRepeatedAction(Action action) noexcept {
  return action == Action::undo || action == Action::redo;
}

std::optional<Action> KeyMap::action(int key, bool keypad) noexcept {
  const auto row = std::find_if(kRows.begin(), kRows.end(), [key, keypad](const Row& candidate) {
    const bool here = candidate.where == Where::anywhere || (candidate.where == Where::keypad) == keypad;
    return candidate.key == key && here;
  });
  if (row == kRows.end()) return std::nullopt;
  return row->action;
}

int KeyMap::whileFrozen(int key) noexcept {
  const auto found = std::find_if(kFrozenKeys.begin(), kFrozenKeys.end(),
                                  [key](const auto& each) { return each.first == key; });
  return found == kFrozenKeys.end() ? key : int{found->second};
}

int KeyMap::withShift(int key) noexcept {
  return key == Qt::Key_Z ? int{Qt::Key_Y} : key;
}

std::string KeyMap::name(int key, bool keypad) {
  std::string name;
  if (key > Qt::Key_Space && key <= Qt::Key_AsciiTilde) {
    name = static_cast<char>(key);
  } else {
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [key](const auto& each) { return each.first == key; });
    if (found != kNames.end()) name = found->second;
  }
  return keypad && !name.empty() ? "Num " + name : name;
}

std::span<const KeyHelp> KeyMap::help() noexcept {
  return kHelp;
}

void HeldKeys::press(int key, bool keypad) {
  const std::optional<Action> action = KeyMap::action(key, keypad);
  if (action && isHeldAction(*action)) keys_.emplace(key, keypad);
}

void HeldKeys::release(int key, bool keypad) {
  keys_.erase({key, keypad});
}

bool HeldKeys::held(Action action) const {
  return std::any_of(keys_.begin(), keys_.end(), [action](const std::pair<int, bool>& key) {
    return KeyMap::action(key.first, key.second) == action;
  });
}

double HeldKeys::between(Action negative, Action positive) const {
  return (held(positive) ? 1.0 : 0.0) - (held(negative) ? 1.0 : 0.0);
}

CameraMoves HeldKeys::cameraMoves() const {
  return {between(Action::cameraBack, Action::cameraForward),
          between(Action::cameraLeft, Action::cameraRight), between(Action::cameraDown, Action::cameraUp)};
}

}  // namespace teren
