// The panel beside the sand: what is in the hand, how the sand is, what it costs, and what to do with it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <QLabel>
#include <QProgressBar>
#include <QWidget>

#include "teren/Parameter.h"

#include "apps/sandbox/SandSession.h"
#include "qt/ParameterPanel.h"

namespace teren {

/// How the sand is, as a table: repose [degree], moisture, slides, wireframe.
std::span<const Parameter> sandParameters() noexcept;

/// What the panel's fields and buttons do.
struct SandPanelActions {
  std::function<void(const Values&)> takeTool;     // of SandTool::parameters()
  std::function<void(const Values&)> setSand;      // of sandParameters()
  std::function<void(const Values&)> makeNewSand;  // of SandGround::parameters()
  std::function<void()> undo, redo, save, load, exportObj;
};

/// A QWidget like any other; all calls from the GUI thread. Fields change nothing by themselves but through
/// the actions. Its parts are found by their object names: "toolForm", "sandForm" and "groundForm" with the
/// parameters by theirs inside, the buttons "undo", "redo", "save", "load", "export" and "make".
class SandPanel : public QWidget {
 public:
  SandPanel(SandPanelActions actions, QWidget* parent);

  /// Show these values, without an action; nothing where they are shown, so that a person can go on typing.
  void showTool(const Values& values);
  void showSand(const Values& values);
  /// The frame's time [ms] beside what there is.
  void showFigures(const SandFigures& figures, double frameMilliseconds);
  /// What goes on, while something does; empty otherwise.
  void showProgress(const std::string& what);
  /// One sentence for the person.
  void say(const std::string& sentence);
  std::string sentence() const { return sentence_->text().toStdString(); }

 private:
  QWidget* makeHand();
  QWidget* makeBeginning();
  QWidget* makeButtons();
  static void show(ParameterPanel& form, const Values& values, std::vector<Values::Entry>& shown);

  SandPanelActions actions_;
  ParameterPanel* tool_ = nullptr;
  ParameterPanel* sand_ = nullptr;
  ParameterPanel* ground_ = nullptr;
  std::vector<Values::Entry> toolShown_, sandShown_;
  QLabel* figures_;
  QLabel* progressText_;
  QProgressBar* progress_;
  QLabel* sentence_;
};

/// The figures as lines, as the panel shows them.
std::string figureLines(const SandFigures& figures, double frameMilliseconds);

}  // namespace teren
