// Measures the errors of sample nodes, once per world, so that the errors of all others can be estimated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "teren/Slice.h"
#include "teren/World.h"

#include "patch/NodeTask.h"
#include "world/BaseMap.h"
#include "world/NodeErrors.h"

namespace teren {

/// Level by level from 1 to the top, kSamples nodes at places that are fixed once and for all are compared
/// with the nodes kDepth levels finer below them (or of level 0, if that is nearer): their gap is measured
/// exactly, over all triangles. To the squared gap is added the square of what those finer nodes' own errors
/// are expected to reach at most, from the calibration of their level: differences at different scales are
/// all but independent, so their largest values add up like deviations; against brute force the sum is 0.93
/// to 1.16 times the truth in the median (doc/accuracy.md). From the samples' errors and bends follow the two
/// numbers of LevelErrors by least squares of the relative error, and how far samples scatter around them.
///
/// Whatever the plugins promise, this is what they do. Cut layers, filters on coarse maps, coarse fields and
/// blending need no formulas: they are in the nodes compared. A pure function of the world, in whatever
/// slices it is made. Costs kSamples (4^kDepth + 1) nodes a level, about 2 s of one core in all for
/// the world shipped; a step is one node's.
class ErrorCalibration final : public SlicedTask {
 public:
  static constexpr int kSamples = 64, kDepth = 2;

  /// Goes on with the first level of `world`, which must outlive it, that is not calibrated yet.
  explicit ErrorCalibration(const World& world);
  bool step(const Slice& slice) override;

  /// About the most bytes it holds at once.
  static std::size_t mostBytes(const World& world) noexcept;

  /// The `sample`-th node of a level that is looked at.
  static NodeKey sampleNode(int level, int sample) noexcept;

 private:
  struct Sample {
    double bend = 0.0, gap = 0.0;
    double rest = 0.0;  ///< [m] largest expected error of the finer nodes
  };
  bool stepNode(const Slice& slice);
  void beginNode();
  void compare(const HeightMap& finer);
  void finishLevel();

  const World& world_;
  NodeErrors& errors_;
  BaseMapStore maps_;
  int level_, down_ = 0;
  LevelErrors finerErrors_;  // of the level of the finer nodes
  std::vector<Sample> samples_;
  int part_ = -1;  // of the sample's finer nodes; -1: the node itself
  HeightMap coarse_;
  std::unique_ptr<NodeTask> task_;
};

}  // namespace teren
