// Balls against the ground: the level-0 triangles, as far as they are held.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "teren/Position.h"

#include "patch/MeshTask.h"
#include "patch/NodeKey.h"
#include "stream/Sweep.h"

namespace teren {

class NodeStore;

/// What there is of the finest ground. Patches that are not held are holes: nothing is touched there.
class FinestGround {
 public:
  virtual ~FinestGround() = default;
  /// (n + 1)^2 heights of the level-0 node at patch (i, j), nullptr where it is not held.
  virtual NodeHeights patch(std::int64_t i, std::int64_t j) const = 0;
  /// All level-0 nodes held, in any order, at the price of one pass over them.
  virtual std::vector<NodeKey> patches() const = 0;
};

/// The level-0 nodes of a store, which must outlive it.
class StoredGround final : public FinestGround {
 public:
  explicit StoredGround(const NodeStore& nodes) : nodes_(nodes) {}
  NodeHeights patch(std::int64_t i, std::int64_t j) const override;
  std::vector<NodeKey> patches() const override;

 private:
  const NodeStore& nodes_;
};

/// Sweeps balls over a FinestGround. Coordinates of balls are metres from the south-west corner of a patch,
/// the origin. Radii below sweepError(length of the way) count as that, so that no way, however long, slips
/// between two triangles.
class GroundSweep {
 public:
  /// `pitch` [m] of the world; `ground` must outlive it.
  GroundSweep(const FinestGround& ground, double pitch) : ground_(ground), pitch_(pitch) {}

  /// The first touch of a ball with the ground, coming from above. Costs about 4 us for a ball of 3 m that
  /// dives 100 m onto squares of 2 m (bench-objects), more in proportion to the squares its way comes near; a
  /// way of more patches than are held costs as many as are held.
  std::optional<Touch> sweep(const Position& origin, const MovingBall& ball) const;

  struct Rest {
    double height = 0.0;  ///< [m] of the centre
    Vector3 normal;       ///< at the touch
  };
  /// The lowest place above (x, y) where a ball lies free of the ground: it is in or under the ground exactly
  /// if its centre is lower. Empty where no ground near it is held.
  std::optional<Rest> rest(const Position& origin, double x, double y, double radius) const;

 private:
  const FinestGround& ground_;
  double pitch_;
};

}  // namespace teren
