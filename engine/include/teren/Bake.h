// Pieces of landscape as plain height maps: what `teren bake` writes, made by the same nodes that are drawn.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "teren/HeightMap.h"
#include "teren/Result.h"
#include "teren/World.h"

namespace teren {

class EditedGround;

/// Level-0 patches (i ... i + columns, j ... j + rows) at a level. With n intervals a patch, i n, j n,
/// columns n and rows n must be multiples of 2^level; columns and rows >= 1.
struct BakeRegion {
  std::int64_t i = 0, j = 0;
  std::int64_t columns = 1, rows = 1;
  int level = 0;
};

struct BakeOptions {
  /// How long a slice of work may be; zero: unlimited. Workers slice as they like. The heights do not depend
  /// on it.
  std::chrono::microseconds slice{0};
  /// Threads that make the nodes, 0 ... kMostWorkers; 0: the caller's own. The heights do not depend on it.
  int workers = 0;
  static constexpr int kMostWorkers = 64;
  /// 0: nodes are visited row by row; otherwise in an order shuffled with this seed. The heights do not
  /// depend on it.
  std::uint64_t visitSeed = 0;
  /// Of the same world, and at rest (assert); null: the world's own ground.
  const EditedGround* edits = nullptr;
  /// Called by the calling thread between slices, or ten times a second while workers work; returning false
  /// cancels.
  std::function<bool(std::size_t nodesDone, std::size_t nodesWanted)> progress;
};

/// (columns n / 2^level + 1) x (rows n / 2^level + 1) heights [m] as drawn at that level, rows from south to
/// north, edits included. Refuses regions that break the rule above, lie beyond kMaxPatch or have more than
/// 2^28 samples, and workers out of range; "cancelled" where progress returned false.
Result<HeightMap> bake(const World& world, const BakeRegion& region, const BakeOptions& options = {});

}  // namespace teren
