#include "patch/NodeTask.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace teren {

NodeTask::NodeTask(const World& world, const NodeKey& key, BaseMapStore& store)
    : world_(world),
      key_(key),
      store_(store),
      heights_(world.intervals() + 1, world.intervals() + 1),
      sums_(heights_.samples().size(), 0.0) {
  assert(key.level >= 0 && key.level <= world.topLevel());
}

std::size_t NodeTask::mostBytes(const World& world, int level) noexcept {
  const auto nodeSide = static_cast<std::size_t>(world.intervals() + 1);
  std::size_t maps = 0;
  for (const Layer& layer : world.layers()) {
    if (level > layer.cutLevel()) continue;
    if (layer.field() != nullptr) {
      maps = std::max(maps, nodeSide * nodeSide * sizeof(float) + sizeof(FieldTask));
      continue;
    }
    const std::size_t cells = std::size_t{1} << std::max(0, level - layer.pitchShift());
    const auto side = static_cast<std::size_t>(layer.mapSamples(layer.mapLevel(level)));
    const std::size_t bytes = side * side * sizeof(float) + sizeof(HeightMap);
    maps = std::max(maps, ((cells + 1) * (cells + 1) + 1) * bytes);
  }
  return maps + nodeSide * nodeSide * (sizeof(float) + sizeof(double)) + sizeof(NodeTask);
}

bool NodeTask::step(const Slice& slice) {
  for (; layer_ < world_.layers().size(); ++layer_) {
    if (!planned_) beginLayer();
    if (!(field_ ? stepField(slice) : stepMaps(slice) && stepRows(slice))) return false;
    planned_ = false;
    if (slice.over()) {
      ++layer_;
      return false;
    }
  }
  const HeightView heights = heights_.view();
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
  if (key_.level > layer.cutLevel()) {
    for (double& sum : sums_) sum += layer.range().mean;
    return;
  }
  const std::int64_t n = world_.intervals();
  const std::int64_t stride = std::int64_t{1} << key_.level;
  if (layer.field() != nullptr) {
    const Position corner{key_.i * stride, key_.j * stride};
    const int side = static_cast<int>(n) + 1;
    field_ = std::make_unique<FieldTask>(layer, layer.fieldRequest(corner, key_.level, side, side),
                                         heights_.view());
    return;
  }
  plan_.layer = static_cast<int>(layer_);
  plan_.mapLevel = layer.mapLevel(key_.level);
  plan_.columns = cellRuns(layer, plan_.mapLevel, key_.i * n * stride, stride, static_cast<int>(n) + 1);
  plan_.rows = cellRuns(layer, plan_.mapLevel, key_.j * n * stride, stride, static_cast<int>(n) + 1);
  columnRun_ = rowRun_ = 0;
}

bool NodeTask::stepField(const Slice& slice) {
  if (!sampled_) {
    sampled_ = field_->step(slice);
    if (!sampled_ || slice.over()) return false;
  }
  const auto side = static_cast<std::size_t>(heights_.columns());
  while (row_ < heights_.rows()) {
    const float* const heights = heights_.view().row(row_);
    double* const sums = sums_.data() + static_cast<std::size_t>(row_) * side;
    for (std::size_t column = 0; column < side; ++column)
      sums[column] += static_cast<double>(heights[column]);
    ++row_;
    if (slice.over()) break;
  }
  return row_ == heights_.rows();
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
  const auto side = static_cast<std::size_t>(world_.intervals() + 1);
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
