#include "apps/sandbox/SandKeys.h"

#include <algorithm>
#include <array>

#include <Qt>

namespace teren {
namespace {

enum class Control { held, free, either };

struct Row {
  int key;
  Control control;
  SandAction action;
};

constexpr std::array kRows = {
    Row{Qt::Key_Z, Control::either, SandAction::undo},
    Row{Qt::Key_Y, Control::either, SandAction::redo},
    Row{Qt::Key_W, Control::free, SandAction::wireframe},
    Row{Qt::Key_S, Control::free, SandAction::slides},
    Row{Qt::Key_T, Control::free, SandAction::nextTool},
    Row{Qt::Key_Plus, Control::free, SandAction::larger},
    Row{Qt::Key_Equal, Control::free, SandAction::larger},  // where '+' needs Shift
    Row{Qt::Key_Minus, Control::free, SandAction::smaller},
    Row{Qt::Key_PageDown, Control::free, SandAction::deeper},
    Row{Qt::Key_PageUp, Control::free, SandAction::flatter},
    Row{Qt::Key_Home, Control::free, SandAction::resetCamera},
    Row{Qt::Key_S, Control::held, SandAction::save},
    Row{Qt::Key_O, Control::held, SandAction::load},
    Row{Qt::Key_E, Control::held, SandAction::exportObj},
    Row{Qt::Key_F12, Control::either, SandAction::screenshot},
    Row{Qt::Key_Q, Control::either, SandAction::quit},
    Row{Qt::Key_Escape, Control::either, SandAction::quit},
};

}  // namespace

std::optional<SandAction> sandAction(int key, bool control) noexcept {
  const auto* row = std::find_if(kRows.begin(), kRows.end(), [key, control](const Row& candidate) {
    return candidate.key == key &&
           (candidate.control == Control::either || (candidate.control == Control::held) == control);
  });
  if (row == kRows.end()) return std::nullopt;
  return row->action;
}

std::string sandHelp() {
  return "left mouse: dig   right, or Shift and left: turn   middle, or Ctrl and left: move   wheel: nearer  "
         " "
         "Z, Y: undo, redo   W: wire   S: slides   T: tool   + -: size   PageUp PageDown: depth   Home: view "
         "  "
         "Ctrl+S, O, E: save, load, export   F12: screenshot   Q: quit";
}

}  // namespace teren
