#include "world/NodeErrors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {

namespace {

/// A filter above level 0 runs on the coarse map: in trials the result is off by 5 to 29 % of the layer's
/// deviation.
constexpr double kFilteredCoarsely = 0.2;

/// [m] Root mean square of what is lost by drawing maps of a level instead of the finest ones.
double promisedResidual(const Layer& layer, int mapLevel, double spacing) {
  const double nonsense = 2.0 * layer.range().deviation;
  try {
    double residual = layer.generator().residual(mapLevel, layer.mapSamples(0), spacing);
    for (const auto& filter : layer.filters()) residual = filter->residual(residual, mapLevel);
    return residual >= 0.0 && residual <= nonsense ? residual : nonsense;  // NaN too
  } catch (...) {
    return nonsense;  // an estimate until it is measured: no reason to refuse the world
  }
}

/// [m] Root mean square of a layer's level-0 surface minus its triangles at a level.
double promisedError(const Layer& layer, double spacing, int level) {
  if (level > layer.cutLevel()) return layer.range().deviation;
  if (layer.field() != nullptr) return promisedResidual(layer, level, spacing);
  const int mapLevel = layer.mapLevel(level);
  const double finest = layer.request(0, 0, 0).spacing;
  if (mapLevel == 0) {
    // Between the samples of a map it is smooth: the error grows with the square of the grid's spacing.
    const double share = spacing * static_cast<double>(std::int64_t{1} << level) / (2.0 * finest);
    return share * share * promisedResidual(layer, 1, finest);
  }
  const double residual = promisedResidual(layer, mapLevel, finest);
  const double filtered = layer.filters().empty() ? 0.0 : kFilteredCoarsely * layer.range().deviation;
  return std::sqrt(residual * residual + filtered * filtered);
}

}  // namespace

NodeErrors::NodeErrors(std::span<const Layer> layers, double spacing, int topLevel) {
  promised_.push_back(0.0);
  for (int level = 1; level <= topLevel; ++level) {
    double squares = 0.0;
    for (const Layer& layer : layers) {
      const double error = promisedError(layer, spacing, level);
      squares += error * error;
    }
    promised_.push_back(kPromisedPeak * std::sqrt(squares));
  }
  calibrated_.reserve(promised_.size());
  calibrated_.push_back({});
}

double NodeErrors::estimate(int level) const {
  assert(level >= 0 && level <= topLevel());
  const std::lock_guard lock(mutex_);
  const auto place = static_cast<std::size_t>(level);
  if (place >= calibrated_.size()) return promised_[place];
  return kErrorMargin * (calibrated_[place].mean + kErrorTail * calibrated_[place].deviation);
}

double NodeErrors::estimate(int level, double bend) const {
  assert(level >= 0 && level <= topLevel() && bend >= 0.0);
  const std::lock_guard lock(mutex_);
  const auto place = static_cast<std::size_t>(level);
  if (place >= calibrated_.size()) return promised_[place];
  const LevelErrors& errors = calibrated_[place];
  return kErrorMargin * (errors.expected + errors.perBend * bend) * (1.0 + kErrorTail * errors.spread);
}

int NodeErrors::nextToCalibrate() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(calibrated_.size());
}

LevelErrors NodeErrors::calibration(int level) const {
  const std::lock_guard lock(mutex_);
  assert(level >= 0 && level < static_cast<int>(calibrated_.size()));
  return calibrated_[static_cast<std::size_t>(level)];
}

void NodeErrors::setCalibration(int level, const LevelErrors& errors) {
  const std::lock_guard lock(mutex_);
  if (level == static_cast<int>(calibrated_.size()) && level <= topLevel()) calibrated_.push_back(errors);
}

}  // namespace teren
