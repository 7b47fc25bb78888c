#include <string>
#include <utility>

#include "teren/Parameter.h"

#include "apps/fly/FlyWindow.h"
#include "apps/fly/GroundAim.h"

// The tools: where they point, when they press, what is said of them.

namespace teren {
namespace {

constexpr double kLeastAhead = 6.0;  // [m] beyond the tool's own size, where the ground is close

}  // namespace

std::optional<Position> FlyWindow::aim() const {
  if (!aimsByMouse_ || !mouse_) {
    return groundAhead(flight_, poseOf(flight_.activeObject()), kLeastAhead + tools_.size());
  }
  const QWidget& canvas = *area_->getGLWidget();
  if (canvas.width() < 1 || canvas.height() < 1) return std::nullopt;
  const double width = canvas.width(), height = canvas.height();
  const PicturePoint point{2.0 * (mouse_->x() + 0.5) / width - 1.0, 1.0 - 2.0 * (mouse_->y() + 0.5) / height};
  return groundAt(flight_, viewpoint(), point, width / height);
}

void FlyWindow::dig() {
  const bool digs = std::exchange(digsOnce_, false) || keys_.dig() || digsByMouse_;
  if (!tools_.inHand()) return scene_.setRing(std::nullopt, 0.0);
  fitTools();
  const std::optional<Position> place = aim();
  scene_.setRing(place, tools_.size());
  if (!digs || !place || !flight_.canDig()) return tools_.lift();
  for (const Edit& edit : tools_.press(*place)) flight_.edits()->press(edit, tools_.stroke());
}

void FlyWindow::fitTools() {
  const World& world = flight_.engine().world();
  tools_.standOn({world.pitch(), world.pitch() / world.intervals()});
}

bool FlyWindow::canDig() {
  if (const Result<void> can = flight_.canDig(); !can) {
    say(can.error().message);
  } else if (!tools_.inHand()) {
    say("no tool is in hand; T takes one");
  } else {
    return true;
  }
  return false;
}

void FlyWindow::actOnTools(Action action) {
  switch (action) {
    case Action::nextTool:
      return takeTool();
    case Action::smallerTool:
    case Action::largerTool:
      tools_.resize(action == Action::largerTool ? 1 : -1);
      return sayTool();
    case Action::shallowerTool:
    case Action::deeperTool:
      tools_.deepen(action == Action::deeperTool ? 1 : -1);
      return sayTool();
    case Action::undo:
    case Action::redo:
      return undo(action == Action::redo);
    default:
      return;  // held keys are read every frame
  }
}

void FlyWindow::undo(bool back) {
  if (const Result<void> can = flight_.canDig(); !can) return say(can.error().message);
  if (back) {
    say(flight_.edits()->redo() ? "done again" : "there is nothing to redo");
  } else {
    say(flight_.edits()->undo() ? "undone" : "there is nothing to undo");
  }
}

void FlyWindow::takeTool() {
  if (!flight_.edits()) return say("nobody keeps edits of this land");
  fitTools();
  std::string passed;
  for (const ToolBelt::Tool tool : tools_.takeNext(
           [this](std::string_view kind) { return !flight_.edits()->missing(kind).has_value(); })) {
    passed += "; " + std::string(ToolBelt::nameOf(tool)) + " is left out, there is no deformer " +
              std::string(ToolBelt::kindOf(tool));
  }
  say((tools_.inHand() ? toolText() : "no tool in hand") + passed);
}

void FlyWindow::sayTool() {
  say(tools_.inHand() ? toolText() : "no tool is in hand; T takes one");
}

std::string FlyWindow::toolText() const {
  using Tool = ToolBelt::Tool;
  const Tool tool = *tools_.inHand();
  const char* const deep = tool == Tool::smooth                       ? " m evened out"
                           : tool == Tool::heap || tool == Tool::pour ? " m high"
                                                                      : " m deep";
  return std::string(ToolBelt::nameOf(tool)) + ", " + numberText(2.0 * tools_.size()) + " m wide, " +
         numberText(tools_.depth()) + deep;
}

void FlyWindow::addToolLines(std::vector<DisplayLine>& lines) {
  if (!flight_.edits()) return;
  const std::size_t edits = flight_.edits()->edits(), unfinished = flight_.edits()->unfinished();
  if (tools_.inHand()) lines.push_back({"tool", toolText()});
  if (!tools_.inHand() && edits == 0) return;
  lines.push_back({"edits", std::to_string(edits) +
                                (unfinished > 0 ? "  (" + std::to_string(unfinished) + " to come)" : "")});
}

}  // namespace teren
