#include "patch/NodeTask.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "patch/CoarserSurface.h"

namespace teren {

NodeTask::NodeTask(const World& world, const NodeKey& key, BaseMapStore& store, bool withCoarser)
    : world_(world),
      key_(key),
      store_(store),
      heights_(world.intervals() + 1, world.intervals() + 1),
      coarserWanted_(withCoarser && hasCoarser(world, key.level)) {
  assert(key.level >= 0 && key.level <= world.topLevel());
  const std::int64_t n = world.intervals(), stride = std::int64_t{1} << key.level;
  begin({key.level, key.i * n * stride, key.j * n * stride, world.intervals() + 1}, heights_);
}

bool NodeTask::hasCoarser(const World& world, int level) noexcept {
  return level < world.topLevel() && world.intervals() % 2 == 0;
}

std::size_t NodeTask::mostMapBytes(const World& world, const Grid& grid, std::size_t extraCells) noexcept {
  const auto side = static_cast<std::size_t>(grid.side);
  std::size_t most = 0;
  for (const Layer& layer : world.layers()) {
    if (grid.level > layer.cutLevel()) continue;
    if (layer.field() != nullptr) {
      most = std::max(most, side * side * sizeof(float) + sizeof(FieldTask));
      continue;
    }
    const std::size_t cells = (std::size_t{1} << std::max(0, grid.level - layer.pitchShift())) + extraCells;
    const auto mapSide = static_cast<std::size_t>(layer.mapSamples(layer.mapLevel(grid.level)));
    const std::size_t bytes = mapSide * mapSide * sizeof(float) + sizeof(HeightMap);
    most = std::max(most, ((cells + 1) * (cells + 1) + 1) * bytes);
  }
  return most;
}

std::size_t NodeTask::mostBytes(const World& world, int level, bool withCoarser) noexcept {
  const Grid own{level, 0, 0, world.intervals() + 1};
  const auto samples = [](const Grid& grid) {
    return static_cast<std::size_t>(grid.side) * static_cast<std::size_t>(grid.side);
  };
  const std::size_t bytes = samples(own) * (sizeof(float) + sizeof(double)) + sizeof(NodeTask);
  const std::size_t maps = mostMapBytes(world, own, 0);
  if (!withCoarser || !hasCoarser(world, level)) return maps + bytes;
  const Grid coarser{level + 1, 0, 0, CoarserSurface::side(world.intervals())};
  // Half as many cells of the coarser level's, and one more on each side.
  return std::max(maps, mostMapBytes(world, coarser, 2)) + bytes + samples(coarser) * sizeof(float);
}

void NodeTask::begin(const Grid& grid, HeightMap& out) {
  grid_ = grid;
  out_ = &out;
  layer_ = 0;
  planned_ = false;
  sums_.assign(out.samples().size(), 0.0);
}

bool NodeTask::step(const Slice& slice) {
  if (!stepGrid(slice)) return false;
  if (!coarserWanted_) return true;
  coarserWanted_ = false;
  const int side = CoarserSurface::side(world_.intervals());
  coarser_ = HeightMap(side, side);
  const std::int64_t stride = std::int64_t{2} << key_.level;
  begin({key_.level + 1, grid_.west - stride, grid_.south - stride, side}, coarser_);
  return !slice.over() && stepGrid(slice);
}

bool NodeTask::stepGrid(const Slice& slice) {
  for (; layer_ < world_.layers().size(); ++layer_) {
    if (!planned_) beginLayer();
    if (!(field_ ? stepField(slice) : stepMaps(slice) && stepRows(slice))) return false;
    planned_ = false;
    if (slice.over()) {
      ++layer_;
      return false;
    }
  }
  const HeightView heights = out_->view();
  for (std::size_t sample = 0; sample < sums_.size(); ++sample) {
    heights.data()[sample] = static_cast<float>(sums_[sample]);
  }
  return true;
}

void NodeTask::beginLayer() {
  const Layer& layer = world_.layers()[layer_];
  planned_ = true;
  sampled_ = false;
  field_.reset();
  plan_ = {};
  row_ = 0;
  if (grid_.level > layer.cutLevel()) {
    for (double& sum : sums_) sum += layer.range().mean;
    return;
  }
  const std::int64_t n = world_.intervals();
  if (layer.field() != nullptr) {
    const auto patch = [n](std::int64_t sample) { return (sample - ((sample % n) + n) % n) / n; };
    const auto share = [&](std::int64_t sample) {
      return static_cast<double>(sample - patch(sample) * n) / static_cast<double>(n);
    };
    const Position corner{patch(grid_.west), patch(grid_.south), share(grid_.west), share(grid_.south)};
    field_ = std::make_unique<FieldTask>(
        layer, layer.fieldRequest(corner, grid_.level, grid_.side, grid_.side), out_->view());
    return;
  }
  const std::int64_t stride = std::int64_t{1} << grid_.level;
  plan_.layer = static_cast<int>(layer_);
  plan_.mapLevel = layer.mapLevel(grid_.level);
  plan_.columns = cellRuns(layer, plan_.mapLevel, grid_.west, stride, grid_.side);
  plan_.rows = cellRuns(layer, plan_.mapLevel, grid_.south, stride, grid_.side);
  columnRun_ = rowRun_ = 0;
}

bool NodeTask::stepField(const Slice& slice) {
  if (!sampled_) {
    sampled_ = field_->step(slice);
    if (!sampled_ || slice.over()) return false;
  }
  const auto side = static_cast<std::size_t>(grid_.side);
  while (row_ < grid_.side) {
    const float* const heights = std::as_const(*out_).view().row(row_);
    double* const sums = sums_.data() + static_cast<std::size_t>(row_) * side;
    for (std::size_t column = 0; column < side; ++column)
      sums[column] += static_cast<double>(heights[column]);
    ++row_;
    if (slice.over()) break;
  }
  return row_ == grid_.side;
}

bool NodeTask::stepMaps(const Slice& slice) {
  const Layer& layer = world_.layers()[layer_];
  const std::size_t across = plan_.columns.size() + 1;
  const std::size_t wanted = plan_.columns.empty() ? 0 : across * (plan_.rows.size() + 1);
  while (plan_.maps.size() < wanted) {
    const auto column = static_cast<std::int64_t>(plan_.maps.size() % across);
    const auto row = static_cast<std::int64_t>(plan_.maps.size() / across);
    const BaseMapKey key{plan_.layer, plan_.mapLevel, plan_.columns.front().cell + column,
                         plan_.rows.front().cell + row};
    if (!mapTask_) {
      if (BaseMap map = store_.find(key)) {
        plan_.maps.push_back(std::move(map));
        continue;
      }
      mapTask_ = std::make_unique<BaseMapTask>(layer, key);
    }
    if (!mapTask_->step(slice)) return false;
    store_.insert(key, mapTask_->result());
    plan_.maps.push_back(mapTask_->result());
    mapTask_.reset();
    if (slice.over()) return false;
  }
  return true;
}

CellMaps NodeTask::cornerMaps(std::size_t column, std::size_t row) const {
  const std::size_t across = plan_.columns.size() + 1;
  const auto at = [&](std::size_t x, std::size_t y) { return plan_.maps[y * across + x]; };
  return {at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)};
}

bool NodeTask::stepRows(const Slice& slice) {
  const Layer& layer = world_.layers()[layer_];
  const auto side = static_cast<std::size_t>(grid_.side);
  while (rowRun_ < plan_.rows.size()) {
    const CellRun& columns = plan_.columns[columnRun_];
    const CellRun& rows = plan_.rows[rowRun_];
    if (!block_) block_ = std::make_unique<CellBlock>(layer, columns, rows, cornerMaps(columnRun_, rowRun_));
    const auto first =
        static_cast<std::size_t>(rows.first + row_) * side + static_cast<std::size_t>(columns.first);
    block_->addRow(row_, std::span(sums_).subspan(first, static_cast<std::size_t>(columns.count)));
    if (++row_ == rows.count) {
      row_ = 0;
      block_.reset();
      if (++columnRun_ == plan_.columns.size()) {
        columnRun_ = 0;
        ++rowRun_;
      }
    }
    if (slice.over()) return rowRun_ == plan_.rows.size();
  }
  return true;
}

}  // namespace teren
