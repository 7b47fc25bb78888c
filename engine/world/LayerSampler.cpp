#include "world/LayerSampler.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace teren {

namespace {

/// The last step of a layer's sum, shared by grid and point.
double meanAndDeviation(const Layer& layer, double deviation, double squares) {
  if (layer.preserveVariance()) deviation /= std::sqrt(squares);
  return layer.range().mean + deviation;
}

double acrossPlace(const CubicTaps& taps, bool exact, const float* row) {
  return exact ? row[taps.index[1]] : combineAlong(taps, row);
}

}  // namespace

LinePlace linePlace(const Layer& layer, int mapLevel, double t) {
  assert(t >= 0.0 && t <= 1.0 && mapLevel <= layer.layerBits());
  const int samples = layer.mapSamples(mapLevel);
  const double intervals = static_cast<double>((samples - 1) / 2);  // a pitch
  LinePlace place;
  place.weights = blendWeights(layer.kernel(), t);
  const double s = t * intervals;
  place.exact = s == std::floor(s);
  if (place.exact) {
    place.high.index[1] = static_cast<int>(s);
    place.low.index[1] = static_cast<int>(s) + (samples - 1) / 2;
  } else {
    place.low = cubicTaps(s + intervals, samples);
    place.high = cubicTaps(s, samples);
  }
  return place;
}

std::vector<CellRun> cellRuns(const Layer& layer, int mapLevel, std::int64_t first, std::int64_t step,
                              int count) {
  const int bits = layer.cellBits();
  const std::int64_t mask = (std::int64_t{1} << bits) - 1;
  const double scale = 1.0 / static_cast<double>(std::int64_t{1} << bits);
  std::vector<CellRun> runs;
  for (int line = 0; line < count; ++line) {
    const std::int64_t sample = first + line * step;
    std::int64_t cell = sample >> bits;
    std::int64_t remainder = sample & mask;
    if (remainder == 0 && line > 0 && line == count - 1) {
      --cell;
      remainder = mask + 1;
    }
    if (runs.empty() || runs.back().cell != cell) runs.push_back({cell, line, 0, {}});
    ++runs.back().count;
    runs.back().places.push_back(linePlace(layer, mapLevel, static_cast<double>(remainder) * scale));
  }
  return runs;
}

CellBlock::CellBlock(const Layer& layer, const CellRun& columns, const CellRun& rows, CellMaps maps)
    : layer_(layer), columns_(columns), rows_(rows), maps_(std::move(maps)) {
  const auto count = static_cast<std::size_t>(columns.count);
  deviations_.resize(count);
  for (KeptRows& kept : kept_) {
    for (std::vector<double>& values : kept.values) values.resize(count);
  }
}

const std::vector<double>& CellBlock::acrossRow(int map, int mapRow) {
  KeptRows& kept = kept_[static_cast<std::size_t>(map)];
  const auto slot = static_cast<std::size_t>(mapRow & 3);
  std::vector<double>& values = kept.values[slot];
  if (kept.index[slot] == mapRow) return values;
  kept.index[slot] = mapRow;
  const bool east = (map & 1) != 0;
  const float* row = maps_[static_cast<std::size_t>(map)]->view().row(mapRow);
  for (std::size_t c = 0; c < values.size(); ++c) {
    const LinePlace& place = columns_.places[c];
    values[c] = acrossPlace(east ? place.high : place.low, place.exact, row);
  }
  return values;
}

void CellBlock::addRow(int row, std::span<double> sums) {
  assert(sums.size() == deviations_.size());
  const LinePlace& place = rows_.places[static_cast<std::size_t>(row)];
  const double mean = layer_.range().mean;
  for (double& deviation : deviations_) deviation = 0.0;
  for (int map = 0; map < 4; ++map) {
    const bool east = (map & 1) != 0;
    const bool north = (map & 2) != 0;
    const double rowWeight = north ? place.weights.high : place.weights.low;
    if (rowWeight == 0.0) continue;  // adds +-0 to sums that are never -0
    const CubicTaps& taps = north ? place.high : place.low;
    const auto weightOf = [&](std::size_t c) {
      const AxisWeights& weights = columns_.places[c].weights;
      return (east ? weights.high : weights.low) * rowWeight;
    };
    if (place.exact) {
      const std::vector<double>& values = acrossRow(map, taps.index[1]);
      for (std::size_t c = 0; c < deviations_.size(); ++c) deviations_[c] += weightOf(c) * (values[c] - mean);
      continue;
    }
    const std::vector<double>& r1 = acrossRow(map, taps.index[1]);
    const std::vector<double>& r2 = acrossRow(map, taps.index[2]);
    // A folded outer tap repeats an inner row with weight 0: its slot is already in use for that row.
    const std::vector<double>& r0 = acrossRow(map, taps.index[0]);
    const std::vector<double>& r3 = acrossRow(map, taps.index[3]);
    for (std::size_t c = 0; c < deviations_.size(); ++c) {
      const double value = combine(taps.weight, r0[c], r1[c], r2[c], r3[c]);
      deviations_[c] += weightOf(c) * (value - mean);
    }
  }
  const double rowSquares = place.weights.squares();
  for (std::size_t c = 0; c < deviations_.size(); ++c) {
    sums[c] += meanAndDeviation(layer_, deviations_[c], columns_.places[c].weights.squares() * rowSquares);
  }
}

double layerHeight(const Layer& layer, const LinePlace& column, const LinePlace& row, const CellMaps& maps) {
  const double mean = layer.range().mean;
  double deviation = 0.0;
  for (int map = 0; map < 4; ++map) {
    const bool east = (map & 1) != 0;
    const bool north = (map & 2) != 0;
    const double rowWeight = north ? row.weights.high : row.weights.low;
    if (rowWeight == 0.0) continue;
    const CubicTaps& columnTaps = east ? column.high : column.low;
    const CubicTaps& rowTaps = north ? row.high : row.low;
    const ConstHeightView heights = std::as_const(*maps[static_cast<std::size_t>(map)]).view();
    const auto across = [&](int tap) {
      return acrossPlace(columnTaps, column.exact, heights.row(rowTaps.index[static_cast<std::size_t>(tap)]));
    };
    const double value =
        row.exact ? across(1) : combine(rowTaps.weight, across(0), across(1), across(2), across(3));
    deviation += (east ? column.weights.high : column.weights.low) * rowWeight * (value - mean);
  }
  return meanAndDeviation(layer, deviation, column.weights.squares() * row.weights.squares());
}

}  // namespace teren
