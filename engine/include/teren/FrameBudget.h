// How long the engine may work in a frame, so that a wanted frame rate is kept on the machine at hand.
#pragma once

#include <chrono>

namespace teren {

/// Leaves the engine what the rest of a frame - drawing, above all - does not need of the frame's time.
///
/// The rest is measured: its estimate follows a longer one at once and a shorter one by 1/16 a frame, so a
/// single quick frame does not lure the engine into making the next one late. The engine always gets at least
/// 1/32 of a frame, so that work goes on where drawing alone takes longer than a frame, and at most half of
/// one, so that a frame that turns out longer than the estimate is not late at once. A tenth of a frame is
/// left to everybody else. O(1); one thread.
class FrameBudget {
 public:
  /// 1 ... 1000 frames a second (others are brought there).
  explicit FrameBudget(double framesPerSecond = 60.0) noexcept;

  std::chrono::nanoseconds frame() const noexcept { return frame_; }
  /// What Engine::update may have in the frame that begins. Before the first measurement: a quarter of it.
  std::chrono::nanoseconds next() const noexcept;
  /// After a frame: the time its thread was at work besides Engine::update, waiting for the screen not
  /// included (threadProcessorTime measures that). Negative counts as 0.
  void measured(std::chrono::nanoseconds rest) noexcept;

 private:
  std::chrono::nanoseconds frame_;
  std::chrono::nanoseconds rest_;
};

}  // namespace teren
