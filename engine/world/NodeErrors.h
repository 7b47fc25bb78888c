// How far a node's triangles may lie from the level-0 surface: what is known of it for each level of a world,
// from the plugins' promises at first, from measured sample nodes as soon as there are enough.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "world/Layer.h"

namespace teren {

/// What sample nodes of one level have shown. A node's error is the largest vertical distance [m] between its
/// triangles and the level-0 triangles below and above them.
struct LevelErrors {
  /// The error to be expected of a node whose bend (NodeGap.h) is b: expected + perBend b. Both >= 0.
  double expected = 0.0, perBend = 0.0;
  double spread = 0.0;                 ///< standard deviation of error over expected error
  double mean = 0.0, deviation = 0.0;  ///< [m] of the samples' errors, whatever their bend
  friend bool operator==(const LevelErrors&, const LevelErrors&) = default;
};

/// How many standard deviations above the mean the estimates lie. Errors are maxima over many places, so they
/// scatter about as Gumbel's law says: one in a thousand lies more than 4.94 deviations above the mean. The
/// rest is for mean and deviation being those of finitely many samples.
inline constexpr double kErrorTail = 6.0;

/// And a factor for what the samples' errors themselves are off by where they are put together from two
/// measurements (ErrorCalibration.h).
inline constexpr double kErrorMargin = 1.05;

/// What plugins promise is a root mean square; a node's largest error is about 5 times that (4 to 5 for
/// heights distributed normally at 10^4 to 10^6 independent places), and an upper estimate somewhat more.
inline constexpr double kPromisedPeak = 8.0;

/// Estimates for all nodes of a world. There at once, from promises: within a factor of 2 where those are
/// good, several times too large where filters only promise an upper bound. Once a level is calibrated
/// (ErrorCalibration.h) at least 99.9 % of its nodes have at most the estimated error, and in the median it
/// is less than twice the true one; doc/accuracy.md has the figures. A calibrated estimate is a pure function
/// of the world's description, the level and the bend: the same bits everywhere. Thread-safe; asking
/// allocates nothing.
class NodeErrors {
 public:
  /// For levels 0 ... `topLevel` of a world with samples `spacing` [m] apart at level 0. Asks each generator
  /// and filter of each layer for its residuals, once a level; what they throw and what makes no sense is
  /// taken for twice the layer's deviation.
  NodeErrors(std::span<const Layer> layers, double spacing, int topLevel);

  int topLevel() const noexcept { return static_cast<int>(promised_.size()) - 1; }

  /// [m] Upper estimate of the error of any node of a level; 0 at level 0.
  double estimate(int level) const;
  /// [m] Of a node whose bend [m] is known: closer where nodes differ.
  double estimate(int level, double bend) const;

  /// Levels below this are calibrated; topLevel() + 1 when all are.
  int nextToCalibrate() const;
  /// Of a calibrated level.
  LevelErrors calibration(int level) const;
  /// What the samples of level nextToCalibrate() have shown. Others are ignored: two calibrations of one
  /// world come to the same.
  void setCalibration(int level, const LevelErrors& errors);

 private:
  std::vector<double> promised_;  // [m] by level
  mutable std::mutex mutex_;
  std::vector<LevelErrors> calibrated_;  // level 0 first; room for all is reserved
};

}  // namespace teren
