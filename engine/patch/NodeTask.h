// The making of a node's heights: the base maps and fields it needs, summed over the layers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "teren/HeightMap.h"
#include "teren/Slice.h"
#include "teren/World.h"

#include "patch/NodeKey.h"
#include "world/BaseMap.h"
#include "world/FieldTask.h"
#include "world/LayerSampler.h"

namespace teren {

/// Heights of a node at its (n + 1)^2 samples, borders included, in slices of plugins' steps and of rows.
/// Needs exactly the base maps whose weights do not vanish inside the node; of a layer that is a field, the
/// node's samples. Heights are summed in double, layer by layer in the world's order, and rounded to float
/// once. `world` and `store` must outlive it.
///
/// For nodes that draw nearer to the next coarser level with distance (Morph.h), then, if asked to, the
/// samples of that level around them, a quarter as many: as a node of that level has them, bit for bit.
class NodeTask final : public SlicedTask {
 public:
  NodeTask(const World& world, const NodeKey& key, BaseMapStore& store, bool withCoarser = false);
  bool step(const Slice& slice) override;

  /// About the most bytes such a task holds at once, the base maps of the layer it is at included (they are
  /// mostly the store's too); a plugin's own scratch is taken to be as large as one map, or as a field's
  /// samples.
  static std::size_t mostBytes(const World& world, int level, bool withCoarser = false) noexcept;

  const NodeKey& key() const noexcept { return key_; }
  /// Complete once step has returned true.
  const HeightMap& heights() const noexcept { return heights_; }
  HeightMap takeHeights() noexcept { return std::move(heights_); }
  /// Likewise: as CoarserSurface takes them. Empty where they were not asked for, at the top level, and where
  /// n is odd.
  const HeightMap& coarser() const noexcept { return coarser_; }
  HeightMap takeCoarser() noexcept { return std::move(coarser_); }

 private:
  /// Samples 2^level level-0 samples apart.
  struct Grid {
    int level = 0;
    std::int64_t west = 0, south = 0;  // [level-0 samples]
    int side = 0;
  };
  /// One layer over the node: its runs of columns and rows, and the base maps at all their corners.
  struct LayerPlan {
    int layer = 0;
    int mapLevel = 0;
    std::vector<CellRun> columns, rows;
    std::vector<BaseMap> maps;  // rows of (columns.size() + 1), south to north
  };
  static bool hasCoarser(const World& world, int level) noexcept;
  static std::size_t mostMapBytes(const World& world, const Grid& grid, std::size_t extraCells) noexcept;
  void begin(const Grid& grid, HeightMap& out);
  bool stepGrid(const Slice& slice);
  bool stepField(const Slice& slice);
  bool stepMaps(const Slice& slice);
  bool stepRows(const Slice& slice);
  void beginLayer();
  CellMaps cornerMaps(std::size_t column, std::size_t row) const;

  const World& world_;
  NodeKey key_;
  BaseMapStore& store_;
  HeightMap heights_, coarser_;
  bool coarserWanted_;

  Grid grid_;                 // that is being made
  HeightMap* out_ = nullptr;  // its heights
  std::vector<double> sums_;
  std::size_t layer_ = 0;
  bool planned_ = false;
  std::unique_ptr<FieldTask> field_;  // writes into *out_, which nobody reads before all layers are summed
  bool sampled_ = false;              // the field is
  LayerPlan plan_;
  std::unique_ptr<BaseMapTask> mapTask_;
  std::size_t columnRun_ = 0, rowRun_ = 0;
  int row_ = 0;  // of the run, or of the grid's samples of a field
  std::unique_ptr<CellBlock> block_;
};

}  // namespace teren
