// What a person's hands do, in words free of any window system: programs translate their events into these,
// and the engine's active object hears them.
#pragma once

#include <string_view>

namespace teren {

/// A key that went down or up, or an axis that moved.
struct InputEvent {
  /// A key as a person calls it: one character ("A", "1"), a word ("Left", "Up", "PageUp", "Space", "Tab"),
  /// on the number pad "Num 8"; an axis by what moves it ("stick x", "throttle"). Lives as long as the call.
  std::string_view name;
  /// A key: 1 pressed, 0 released; keys that repeat are pressed once. An axis: -1 ... 1.
  double value = 0.0;
};

/// A line of help: which keys, and what they do.
struct KeyHelp {
  std::string_view keys;
  std::string_view does;
};

}  // namespace teren
