// Which key does what: one table, read by the window for its events and by the help overlay for its text.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "apps/fly/Aircraft.h"
#include "apps/fly/CameraRig.h"

namespace teren {

enum class Action {
  // as long as the key is held
  faster,
  slower,
  turnLeft,
  turnRight,
  climb,
  descend,
  cameraForward,
  cameraBack,
  cameraLeft,
  cameraRight,
  cameraUp,
  cameraDown,
  // once per press
  cameraReset,
  switchPerson,
  nextObject,
  pause,
  help,
  fullScreen,
  screenshot,
  quit,
};

bool isHeldAction(Action action) noexcept;

/// A row of the help overlay.
struct HelpLine {
  std::string_view keys;
  std::string_view does;
};

/// The key table of the demo.
class KeyMap {
 public:
  /// What a Qt key (Qt::Key) does. `keypad` tells whether it lies on the number pad, where it means the same
  /// with and without NumLock. Empty for a key without a meaning.
  static std::optional<Action> action(int key, bool keypad) noexcept;

  /// All that the keys and the mouse do, in the order in which to show it.
  static std::span<const HelpLine> help() noexcept;
};

/// The actions whose keys are down, and what that means for the aircraft and the camera. A key counts as
/// itself, so holding W and the up arrow and letting one go still means faster.
class HeldKeys {
 public:
  void press(int key, bool keypad);
  void release(int key, bool keypad);
  void releaseAll() noexcept { keys_.clear(); }

  AircraftControls controls() const;
  CameraMoves cameraMoves() const;

 private:
  bool held(Action action) const;
  double between(Action negative, Action positive) const;

  std::set<std::pair<int, bool>> keys_;
};

}  // namespace teren
