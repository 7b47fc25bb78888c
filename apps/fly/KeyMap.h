// Which key does what in the program, whatever is flown: one table, read by the window for its events and by
// the help overlay for its text. All other keys go to the active object, by name.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "teren/Input.h"

#include "apps/fly/CameraRig.h"

namespace teren {

enum class Action {
  // as long as the key is held
  cameraForward,
  cameraBack,
  cameraLeft,
  cameraRight,
  cameraUp,
  cameraDown,
  dig,
  // once per press
  cameraReset,
  switchPerson,
  nextObject,
  finer,
  coarser,
  farther,
  nearer,
  detailPanel,
  landColours,
  freeze,
  wires,
  frameGraph,
  pause,
  help,
  reload,
  nextTool,
  smallerTool,
  largerTool,
  shallowerTool,
  deeperTool,
  undo,
  redo,
  fullScreen,
  screenshot,
  quit,
};

bool isHeldAction(Action action) noexcept;
/// Whether a key that repeats does it again and again.
bool isRepeatedAction(Action action) noexcept;

/// The key table of the demo.
class KeyMap {
 public:
  /// What a Qt key (Qt::Key) does. `keypad` tells whether it lies on the number pad, where it means the same
  /// with and without NumLock. Empty for a key without a meaning.
  static std::optional<Action> action(int key, bool keypad) noexcept;

  /// The key of the camera that a key of an object stands for while objects stand still and the camera flies
  /// alone; other keys are themselves.
  static int whileFrozen(int key) noexcept;

  /// With Shift, Z means what Y means, as in programs in which Ctrl goes with both; other keys are
  /// themselves.
  static int withShift(int key) noexcept;

  /// What an object calls a Qt key (InputEvent::name); empty for keys that have no name here.
  static std::string name(int key, bool keypad);

  /// All that the keys and the mouse do, in the order in which to show it.
  static std::span<const KeyHelp> help() noexcept;
};

/// The actions whose keys are down, and what that means for the camera. A key counts as itself, so holding I
/// and Num 8 and letting one go still means forward.
class HeldKeys {
 public:
  void press(int key, bool keypad);
  void release(int key, bool keypad);
  void releaseAll() noexcept { keys_.clear(); }

  CameraMoves cameraMoves() const;
  bool dig() const { return held(Action::dig); }

 private:
  bool held(Action action) const;
  double between(Action negative, Action positive) const;

  std::set<std::pair<int, bool>> keys_;
};

}  // namespace teren
