// Law 0 on a grid and at a point: a layer's four base maps over a lattice cell, interpolated and weighted.
// Both ways share every arithmetic step, so a grid's sample equals the function there bit for bit.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "teren/HeightMap.h"

#include "height/BlendWeights.h"
#include "height/CubicInterpolation.h"
#include "world/BaseMap.h"
#include "world/Layer.h"

namespace teren {

/// Where one grid line (a column or a row) lies in a layer's lattice cell.
struct LinePlace {
  AxisWeights weights;
  CubicTaps low, high;  ///< into the maps of the lower and the upper lattice point
  bool exact =
      false;  ///< the line passes through samples of the maps: index[1] of the taps, no interpolation
};

/// The place of t in [0, 1] across a cell, for maps of a level.
LinePlace linePlace(const Layer& layer, int mapLevel, double t);

/// Consecutive grid lines of one axis that lie in the same lattice cell.
struct CellRun {
  std::int64_t cell = 0;  ///< index of the lower lattice point
  int first = 0, count = 0;
  std::vector<LinePlace> places;
};

/// Splits `count` lines at level-0 samples first, first + step, ... into runs by lattice cell. The last line,
/// if on a lattice line (and not the only one), belongs to the cell before it: nothing beyond is needed,
/// because the weights of what lies beyond vanish there.
std::vector<CellRun> cellRuns(const Layer& layer, int mapLevel, std::int64_t first, std::int64_t step,
                              int count);

/// The four maps of a cell: south-west, south-east, north-west, north-east; the order of every sum.
using CellMaps = std::array<BaseMap, 4>;

/// A layer over the rectangle of grid points that two runs span.
class CellBlock {
 public:
  CellBlock(const Layer& layer, const CellRun& columns, const CellRun& rows, CellMaps maps);

  /// Adds mean and deviation of the layer to `sums` (columns.count of them) along row `row` of the run. Rows
  /// are best asked in order: up to four interpolated rows per map are kept. Arithmetic bound: about 30 flops
  /// a sample and map when both axes interpolate between new rows, 10 when the rows are kept.
  void addRow(int row, std::span<double> sums);

 private:
  struct KeptRows {
    std::array<int, 4> index{-1, -1, -1, -1};
    std::array<std::vector<double>, 4> values;
  };
  const std::vector<double>& acrossRow(int map, int mapRow);

  const Layer& layer_;
  const CellRun& columns_;
  const CellRun& rows_;
  CellMaps maps_;
  std::array<KeptRows, 4> kept_;
  std::vector<double> deviations_;
};

/// mean + deviation of a layer at one point, given the places across its cell; equal bits to CellBlock.
double layerHeight(const Layer& layer, const LinePlace& column, const LinePlace& row, const CellMaps& maps);

}  // namespace teren
