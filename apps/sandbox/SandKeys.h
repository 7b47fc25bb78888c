// Which key does what in the sandbox: one table, read for events and for the line of help.
#pragma once

#include <optional>
#include <string>

namespace teren {

enum class SandAction {
  undo,
  redo,
  wireframe,
  slides,
  nextTool,
  larger,
  smaller,
  deeper,
  flatter,
  resetCamera,
  save,
  load,
  exportObj,
  screenshot,
  quit,
};

/// What a Qt key (Qt::Key) does, with or without Control held; nothing where it has no meaning.
std::optional<SandAction> sandAction(int key, bool control) noexcept;

/// The keys and the mouse in one line.
std::string sandHelp();

}  // namespace teren
