// Text over the picture: the figures of the flight, the help, and passing messages.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <QImage>
#include <QPoint>
#include <QSize>

#include "teren/Object.h"

#include "apps/fly/FrameGraph.h"
#include "apps/fly/LandColours.h"

namespace teren {

/// Shaded panels with text, painted once when their content changes and drawn every frame as textures, pixel
/// on pixel. Makes its textures in the GL context of the first draw() and leaves them to die with it.
class HeadUpDisplay {
 public:
  using Clock = std::chrono::steady_clock;

  /// Shows these from top to bottom; warnings in a colour of their own.
  void setLines(std::vector<DisplayLine> lines);
  /// While the help is there, nothing else is; in a small picture its letters are smaller.
  void toggleHelp() noexcept { help_.visible = !help_.visible && !helpLines_.empty(); }
  void setHelp(const std::vector<KeyHelp>& lines);
  bool helpVisible() const noexcept { return help_.visible; }
  /// What the colours of the land mean; hidden without lines.
  void setLegend(const std::vector<LegendLine>& lines);
  /// Shows the frames as a graph from now on, each drawing as they are then, its figures as they are at this
  /// call; nullptr hides it. The graph must live until then.
  void setGraph(const FrameGraph* graph);
  bool graphVisible() const noexcept { return graph_.visible; }
  /// Shows a sentence at the bottom for `duration`, in place of the one before.
  void say(const std::string& sentence, Clock::duration duration);
  /// A word that stays in the middle until it is changed; empty: none.
  void setBanner(const std::string& word);

  /// Draws into the current GL context, over what is there; `pixels` is the size of the picture. Leaves the
  /// GL state as it was.
  void draw(QSize pixels);

 private:
  struct Panel {
    QImage image;   // premultiplied
    QPoint corner;  // the upper left one, in pixels from the picture's upper left
    unsigned texture = 0;
    bool visible = false;
    bool changed = false;
  };
  void show(Panel& panel, QImage image);
  void fitHelp(QSize pixels);
  void place(QSize pixels);
  static void draw(Panel& panel);
  void drawFrames() const;

  Panel figures_, help_, sentence_, banner_, hint_, legend_, graph_;
  std::vector<DisplayLine> lines_;
  std::vector<LegendLine> legendLines_;
  std::vector<KeyHelp> helpLines_;
  int figureLetters_ = 0, helpLetters_ = 0;  // [px] of the images there are
  const FrameGraph* frames_ = nullptr;
  double framesScale_ = 0.0;  // [ms] upper end of the graph
  QSize pixels_{1280, 720};   // of the last picture
  std::string bannerWord_;
  Clock::time_point sentenceEnd_{};
};

}  // namespace teren
