// The times of the last few seconds' frames: what the graph on the display shows.
#pragma once

#include <array>
#include <cstddef>

namespace teren {

/// A ring of fixed size, so that nothing is allocated however long one flies. All times [ms].
class FrameGraph {
 public:
  static constexpr std::size_t kFrames = 240;  ///< 8 s at 30 frames a second

  struct Frame {
    float whole = 0.0F;   ///< from one frame's presentation to the next one's
    float engine = 0.0F;  ///< of it, what the engine took
  };
  struct Figures {
    double p50 = 0.0, p99 = 0.0;  ///< of the frames held, by nearest rank
    double engineShare = 0.0;     ///< [0, 1] of all their time
  };

  /// What is not finite, or negative, counts as 0; the engine never takes more than the whole.
  void add(double whole, double engine) noexcept;

  std::size_t count() const noexcept { return count_; }
  /// The frame `index` of those held, 0 the oldest.
  const Frame& at(std::size_t index) const noexcept;
  /// Zeros without a frame. O(kFrames).
  Figures figures() const noexcept;
  /// The upper end of a scale for these frames: the first of 20, 50, 100, 200, 500 ... that p99 is below.
  static double scale(double p99) noexcept;

 private:
  std::array<Frame, kFrames> frames_{};
  std::size_t count_ = 0, next_ = 0;
};

}  // namespace teren
