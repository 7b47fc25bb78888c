// What a person does with sand, without a window: tools, drags, settings, undo, files; all computed in beats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Result.h"

#include "apps/sandbox/SandGround.h"
#include "generators/sand/SandHistory.h"
#include "generators/sand/SandPublisher.h"
#include "generators/sand/Sandbox.h"

namespace teren {

/// [m] Tools go as high and as low.
inline constexpr double kHighestTool = 16'000.0;

/// A place for a tool [m]; without a height the tool is pressed in from the ground there.
struct ToolPlace {
  double x = 0.0, y = 0.0;
  std::optional<double> height;
};

/// What there is, and what the parts of the last beats cost [s]: a stamp's those of the last one, slides and
/// clean-up those of the last beat.
struct SandFigures {
  std::size_t vertices = 0, triangles = 0, constraints = 0;
  std::size_t bytes = 0;  // of the sandbox and of what is published
  std::uint64_t beat = 0;
  std::size_t waiting = 0;  // stamps
  bool atRest = true;
  StampTimes stamp;
  double slide = 0.0, cleanUp = 0.0;
};

/// A sandbox under a person's hands. Everything is computed in numbered beats, one after another: at most one
/// stamp, then at most kStepsPerBeat steps of slides (none while slides are off), then a clean-up. Beats go
/// on until no stamp waits and all is at rest; so sand slides while a tool is dragged, a beat a stamp, and
/// afterwards until it lies. What a person does takes effect between two beats: whoever does it within one
/// waits for its end (some milliseconds). So what is computed depends on what was done and on the numbers of
/// the beats it was done at, never on how beats were sliced, nor on the machine. A script gives both.
///
/// Undo takes back whole actions: a drag with all that slid after it, or a change of the angle at which sand
/// lies. One thread, but for sand that is made or loaded, which comes from another one.
class SandSession {
 public:
  static constexpr std::uint64_t kStepsPerBeat = 20'000;
  static constexpr std::size_t kMostStampsOfADrag = std::size_t{1}
                                                    << 16;           // from place to place: stampsAlong()'s
  static constexpr std::size_t kMostWaiting = std::size_t{1} << 18;  // stamps
  using Over = std::function<bool()>;

  /// Begins with sand of these settings at once.
  explicit SandSession(const SandGround& ground);

  const Sandbox& sandbox() const noexcept { return *sandbox_; }
  /// Sides of the box [m], its corner at (0, 0).
  double width() const noexcept;
  double depth() const noexcept;
  double groundHeight(double x, double y) const noexcept;  // of the nearest place inside

  /// Values of SandTool::parameters(). A tool that cannot be is refused, and the old one stays in the hand.
  Result<void> setTool(const Values& values);
  const Values& toolValues() const noexcept { return toolValues_; }
  const ToolShape& tool() const noexcept { return *tool_; }

  /// Another angle of repose [degree] 1 ... 60, and moisture 0 ... 1: an action, or part of the drag that
  /// goes on. Nothing where they are so.
  void setRepose(double angle, double moisture);
  double repose() const noexcept { return sandbox_->settings().dryAngle; }
  double moisture() const noexcept { return sandbox_->settings().moisture; }
  void setSlides(bool on);
  bool slides() const noexcept { return slides_; }

  /// The nearest place of the box. What of the tool reaches beyond it is cut off (Stamper).
  ToolPlace inside(const ToolPlace& place) const noexcept;
  /// Begins an action: the tool is pressed straight in, and held at that height. Refused where its middle
  /// would lie beyond the box, it is as wide as the box, a number is not finite, or kMostWaiting stamps wait.
  Result<void> press(const ToolPlace& place);
  /// Drags the tool on, at `speed` >= 0 [m/s] that the spacing of stamps follows. Nothing where no tool is
  /// pressed in, or the place is nearer than the spacing. Refused as press() is, and where it takes more than
  /// kMostStampsOfADrag stamps; the tool is then still where it was.
  Result<void> dragTo(const ToolPlace& place, double speed);
  void release() noexcept { held_.reset(); }

  /// False where there is nothing to take back, or to do again.
  bool undo();
  bool redo();

  /// Sand made or loaded by `maker` on another thread takes the place of what is here when it is there, and
  /// nothing can be taken back then; what fails is a message. Until then nothing is computed. Asked for again
  /// meanwhile, it begins with the last maker asked for when the running one is done.
  void bring(std::function<Result<Sandbox>()> maker);
  bool arriving() const noexcept { return arriving_.valid(); }
  /// How many have come; other sand, other size.
  std::uint64_t sands() const noexcept { return sands_; }
  /// Waits for all of it. The error that the last message would have told.
  Result<void> await();

  /// Nothing is left to compute, and no sand is on its way.
  bool idle() const noexcept { return resting() && !arriving(); }
  /// Computes until all is idle or `over` says so, which is asked after each stamp, clean-up and 1000 steps
  /// of slides; where sand is on its way, waits for it as long.
  void work(const Over& over);
  /// To the end of the beat that has been begun, if any.
  void finishBeat();
  bool withinBeat() const noexcept { return phase_ != Phase::begin; }

  /// What is to be drawn, with all that has changed.
  std::shared_ptr<const SandSnapshot> publish();
  SandFigures figures() const;
  /// One sentence each about what failed since the last call.
  std::vector<std::string> takeMessages();

 private:
  enum class Phase { begin, sliding, cleaning };
  /// A stamp that waits for its beat.
  struct Waiting {
    std::shared_ptr<const ToolShape> tool;
    StampPlace place;
    bool hasHeight = false;  // otherwise the held one
    bool begins = false;     // an action
  };

  Result<void> check(const ToolPlace& place) const;
  Result<void> checkRoom(double stamps) const;
  StampPlace stampAt(const ToolPlace& place) const noexcept;
  bool resting() const noexcept;
  void receive();
  Result<void> takeArrived();
  void step();
  void beginBeat();
  void stampNext();
  void adopt(Result<Sandbox> sand);
  void note();

  std::unique_ptr<Sandbox> sandbox_;
  SandPublisher publisher_;
  bool replaced_ = false;  // the sandbox, since the last publication
  SandHistory history_;
  Values toolValues_;
  std::shared_ptr<const ToolShape> tool_;
  bool slides_ = true;

  std::deque<Waiting> waiting_;
  std::optional<ToolPlace> held_;  // where the last stamp of the drag is or will be
  double heldHeight_ = 0.0;
  bool settingNoted_ = false;  // the last action is a change of settings, which another one joins

  Phase phase_ = Phase::begin;
  std::uint64_t beat_ = 0, stepsLeft_ = 0;
  SandFigures costs_;
  double slideTime_ = 0.0;

  std::future<Result<Sandbox>> arriving_;
  std::function<Result<Sandbox>()> next_;  // to be begun after that
  std::uint64_t sands_ = 0;
  std::vector<std::string> messages_;
};

/// FNV-1a over all vertices (slot, place, height, loose thickness), all triangles (corners) in the order of
/// their slots, and the constraints: equal for equal surfaces with equal histories. O(n).
std::uint64_t hashOf(const SandSurface& surface);

}  // namespace teren
